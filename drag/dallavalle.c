/* drag/dallavalle.c - Dallavalle's sphere [Dallavalle48].
 *
 *   C_D  = (0.63 + 4.8/sqrt(Re))^2
 *   Fhat = C_D Re/24 = (0.63 sqrt(Re) + 4.8)^2/24
 *
 * Its creeping limit is 23.04/24 = 0.96 of Stokes' drag: the fit's, 4 % low.
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. Di Felice's law is this sphere with
 * one. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {.name = "dallavalle",
                                 .summary = "Dallavalle's isolated sphere",
                                 .equation = "Fhat = (0.63 sqrt(Re) + 4.8)^2/24",
                                 .source = "[Dallavalle48]",
                                 .range = "one sphere on its own (eps above 0.99), Re < 2e5"};
const struct drag_limits drag_limits = {
    .eps_min = 0.99, .eps_max = 1.0, .re_max = 2e5, .isolated = 0.96};
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
    return sphere_dallavalle(p->re);
}
