/* drag/ergun.c - Ergun's law of packed beds [Ergun52].
 *
 *   -dp/dx = 150 mu (1-eps)^2 U/(eps^3 d^2) + 1.75 rho (1-eps) U^2/(eps^3 d),  U = eps u_r
 *   beta   = 150 mu (1-eps)^2/(eps d^2) + 1.75 rho (1-eps) u_r/d
 *   Fhat   = [150 (1-eps) + 1.75 Re]/(18 eps^2)
 *
 * The review that lists it prints beta as a coefficient per volume of grains, without one
 * factor (1-eps): right as it stands, wrong if multiplied by (1-eps) again; and in its row of
 * Wen and Yu a factor eps^-2.65 multiplies this branch too, which is a misprint.
 *
 * Out of its range the law has no isolated sphere: at eps = 1 the factor is 1.75 Re/18, which
 * vanishes with Re. */
#include "drag.h"

const struct about drag_about = {.name = "ergun",
                                 .summary = "Ergun's law of packed beds (150 and 1.75)",
                                 .equation = "Fhat = [150 (1-eps) + 1.75 Re]/(18 eps^2)",
                                 .source = "[Ergun52]",
                                 .range =
                                     "packed beds, eps 0.35 to 0.8, 1 < Re/(1-eps) < 2500"};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

double drag_factor(const struct drag_point *p)
{
    return (150.0 * (1.0 - p->eps) + 1.75 * p->re) / (18.0 * p->eps * p->eps);
}
