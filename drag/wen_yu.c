/* drag/wen_yu.c - Wen and Yu's law of fluidised suspensions [WenYu66].
 *
 *   beta = (3/4) C_D rho eps (1-eps) u_r eps^-2.65/d,  C_D of Schiller and Naumann
 *   Fhat = (C_D Re/24) eps^-3.65
 *
 * The review's row of this law prints F_d = beta eps^-2.65 (u - v): the volume of the grain
 * and, in the dilute branch, the density of the fluid are missing, and eps^-2.65 multiplies
 * Ergun's branch as well. Its two branches together are the answer gidaspow. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {
    .name = "wen_yu",
    .summary = "Wen and Yu's fluidised suspension on Schiller and Naumann's sphere",
    .equation = "Fhat = (C_D Re/24) eps^-3.65, C_D of Schiller and Naumann",
    .source = "[WenYu66]; [SchillerNaumann35]",
    .range = "eps 0.7 to 1 (fitted above 0.8), Re < 2e5",
    .cost = "two powers, of Re and of eps: two logarithms and two exponentials"};
const struct drag_limits drag_limits = {
    .eps_min = 0.7, .eps_max = 1.0, .re_max = 2e5, .jump = 0.0039, .isolated = 1.0};
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
    return sphere_schiller_naumann(p->re) * voidage(p->eps, 3.65);
}
