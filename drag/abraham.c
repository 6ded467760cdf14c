/* drag/abraham.c - Abraham's sphere: a boundary layer about it, of thickness 9.06/sqrt(Re)
 * [Abraham70].
 *
 *   C_D  = (24/9.06^2) (1 + 9.06/sqrt(Re))^2
 *   Fhat = C_D Re/24 = (1 + sqrt(Re)/9.06)^2
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. */
#include "drag.h"

#include <math.h>

const struct about drag_about = {.name = "abraham",
                                 .summary = "Abraham's isolated sphere",
                                 .equation = "Fhat = (1 + sqrt(Re)/9.06)^2",
                                 .source = "[Abraham70]",
                                 .range = "one sphere on its own (eps above 0.99), Re < 5000"};
const struct drag_limits drag_limits = {
    .eps_min = 0.99, .eps_max = 1.0, .re_max = 5000.0, .isolated = 1.0};
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
    const double root = 1.0 + sqrt(p->re) / 9.06;
    return root * root;
}
