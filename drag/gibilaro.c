/* drag/gibilaro.c - Gibilaro's law of fluidised beds [Gibilaro85].
 *
 *   beta = (17.3/Re + 0.336) rho (1-eps) eps u_r eps^-2.8/d   (Re superficial)
 *   Fhat = (17.3 + 0.336 Re) eps^-3.8/18
 *
 * An isolated creeping sphere feels 17.3/18 = 0.961 of Stokes' drag. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {.name = "gibilaro",
                                 .summary = "Gibilaro's law of fluidised beds",
                                 .equation = "Fhat = (17.3 + 0.336 Re) eps^-3.8/18",
                                 .source = "[Gibilaro85]",
                                 .range = "eps 0.4 to 1, Re < 1e4",
                                 .cost = "a power of eps: a logarithm and an exponential"};
const struct drag_limits drag_limits = {
    .eps_min = 0.4, .eps_max = 1.0, .re_max = 1e4, .isolated = 17.3 / 18.0};
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
    return (17.3 + 0.336 * p->re) / 18.0 * voidage(p->eps, 3.8);
}
