/* contact/cohesion/none.c - nothing pulls. Also the template: copy it, keep every symbol. */
#include "cohesion.h"

const struct about cohesion_about = {.name = "none",
                                     .summary = "nothing pulls",
                                     .equation = "",
                                     .source = "",
                                     .range = "always"};
const struct key cohesion_keys[] = {{0}};
const int cohesion_history = 0;
const unsigned cohesion_needs = 0;

void cohesion_init(struct scene *s, const struct materials *m)
{
    (void)s;
    (void)m;
}

void cohesion_forces(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

void cohesion_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

double cohesion_range(void)
{
    return 0.0;
}
