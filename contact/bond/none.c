/* contact/bond/none.c - nothing is glued. Also the template: copy it, keep every symbol. */
#include "bond.h"

const struct about bond_about = {.name = "none",
                                 .summary = "nothing is glued",
                                 .equation = "",
                                 .source = "",
                                 .range = "always"};
const struct key bond_keys[] = {{0}};
const int bond_history = 0;
const unsigned bond_needs = 0;

void bond_init(struct scene *s, const struct materials *m)
{
    (void)s;
    (void)m;
}

void bond_forces(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

void bond_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

double bond_range(void)
{
    return 0.0;
}
