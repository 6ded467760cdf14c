/* drag/gidaspow_blend.c - Ergun's law and Wen and Yu's, blended about eps = 0.8
 * [HuilinGidaspow03].
 *
 *   Fhat = w (Wen and Yu) + (1-w) (Ergun)
 *   w    = 1/2 + atan[150 x 1.75 (eps - 0.8)]/pi
 *
 * The continuous form of gidaspow. The weight never quite comes to an end: an isolated sphere
 * feels 0.994 of Wen and Yu's drag and 0.006 of Ergun's. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {
    .name = "gidaspow_blend",
    .summary = "Ergun's and Wen and Yu's law, blended about eps = 0.8",
    .equation = "Fhat = w WenYu + (1-w) Ergun, w = 1/2 + atan[262.5 (eps - 0.8)]/pi",
    .source = "[HuilinGidaspow03]; [Ergun52]; [WenYu66]",
    .range = "eps 0.35 to 1, Re < 2e5 (beds: Re/(1-eps) < 2500)",
    .cost = "Wen and Yu's two powers and an arc tangent"};
const struct drag_limits drag_limits = {.eps_min = 0.35,
                                        .eps_max = 1.0,
                                        .re_max = 2e5,
                                        .jump = 0.004,
                                        .isolated = 0.99393768763743};
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
    const double w = 0.5 + atan(150.0 * 1.75 * (p->eps - 0.8)) / 3.14159265358979323846;
    return w * sphere_schiller_naumann(p->re) * voidage(p->eps, 3.65) +
           (1.0 - w) * packed_ergun(p->eps, p->re);
}
