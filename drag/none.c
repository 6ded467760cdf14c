/* drag/none.c - no drag: the fluid slips past the grains. Also the template for new laws. */
#include "drag.h"

#include <math.h>

const struct about drag_about = {.name = "none",
                                 .summary = "no drag",
                                 .equation = "F_d = 0",
                                 .source = "",
                                 .range = "always"};
const struct drag_limits drag_limits = {
    .eps_min = 0.0, .eps_max = 1.0, .re_max = (double)INFINITY};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

void drag_prepare(struct drag_grain *grain)
{
    (void)grain;
}

double drag_factor(const struct drag_point *p)
{
    (void)p;
    return 0.0;
}
