/* contact/lubrication/none.c - no film between grains. Also the template: copy it, keep every symbol. */
#include "lubrication.h"

const struct about lubrication_about = {.name = "none",
                                        .summary = "no film between grains",
                                        .equation = "",
                                        .source = "",
                                        .range = "always"};
const struct key lubrication_keys[] = {{0}};
const int lubrication_history = 0;
const unsigned lubrication_needs = 0;

void lubrication_init(struct scene *s, const struct materials *m)
{
    (void)s;
    (void)m;
}

void lubrication_forces(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

void lubrication_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

double lubrication_range(void)
{
    return 0.0;
}
