/* drag/ergun.c - Ergun's law of packed beds [Ergun52].
 *
 *   -dp/dx = 150 mu (1-eps)^2 U/(eps^3 d^2) + 1.75 rho (1-eps) U^2/(eps^3 d),  U = eps u_r
 *   beta   = 150 mu (1-eps)^2/(eps d^2) + 1.75 rho (1-eps) u_r/d
 *   Fhat   = [150 (1-eps) + 1.75 Re]/(18 eps^2)
 *
 * In a scene of Darcy's it is the conductivity that depends on the velocity, the last row of
 * the review's Table 3: K = rho g U/(-dp/dx). Its u* there is the superficial velocity U.
 *
 * The review's Table 4 prints beta as a coefficient per volume of grains, without one factor
 * (1-eps): right as it stands, wrong if multiplied by (1-eps) again; and in its row of Wen and
 * Yu a factor eps^-2.65 multiplies this branch too, which is a misprint.
 *
 * Out of its range the law has no isolated sphere: at eps = 1 the factor is 1.75 Re/18, which
 * vanishes with Re. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {.name = "ergun",
                                 .summary = "Ergun's law of packed beds (150 and 1.75)",
                                 .equation = "Fhat = [150 (1-eps) + 1.75 Re]/(18 eps^2)",
                                 .source = "[Ergun52]",
                                 .range = "packed beds, eps 0.35 to 0.8, Re/(1-eps) < 2500"};
const struct drag_limits drag_limits = {
    .eps_min = 0.35, .eps_max = 0.8, .re_max = 2500.0, .per_solid = true};
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
    return packed_ergun(p->eps, p->re);
}
