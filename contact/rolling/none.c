/* contact/rolling/none.c - no resistance to rolling. Also the template: copy it, keep every
 * symbol. */
#include "rolling.h"

const struct about rolling_about = {.name = "none",
                                    .summary = "no resistance to rolling",
                                    .equation = "",
                                    .source = "",
                                    .range = "always"};
const struct key rolling_keys[] = {{0}};
const int rolling_history = 0;
const unsigned rolling_needs = 0;

void rolling_init(struct scene *s, const struct materials *m)
{
    (void)s;
    (void)m;
}

void rolling_moments(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

void rolling_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}
