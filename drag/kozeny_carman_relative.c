/* drag/kozeny_carman_relative.c - a permeability known at one porosity, carried to others as
 * Kozeny and Carman's [DingetAl20; the review's Table 3, row 3].
 *
 *   k    = k0 (eps/eps0)^3 ((1-eps0)/(1-eps))^2
 *   Fhat = eps d^2/(18 (1-eps) k) = [d^2 eps0^3/(18 (1-eps0)^2 k0)] (1-eps)/eps^2
 *
 * k0 and eps0 are measured: the size of the grains does not enter k. Each grain takes its
 * share of the resistance by its volume, hence d^2. Above eps = 0.99 the solid fraction counts
 * as 0.01. */
#include "drag.h"

#include "formulas.h"

static double scale; /* 1/m2: eps0^3/((1-eps0)^2 k0) */

const struct about drag_about = {
    .name = "kozeny_carman_relative",
    .summary =
        "permeability measured at one porosity, carried to others as Kozeny and Carman's",
    .equation = "k = k0 (eps/eps0)^3 ((1-eps0)/(1-eps))^2",
    .source = "[DingetAl20]; [Carman37]",
    .range = "packed beds, eps 0.2 to 0.7, Re/(1-eps) < 1",
    .cost = "two divisions and a limit"};
const struct drag_limits drag_limits = {
    .eps_min = 0.2, .eps_max = 0.7, .re_max = 1.0, .per_solid = true};
const struct key drag_keys[] = {
    {"drag", "permeability", KEY_REAL, "m2", "(0, inf)", NULL,
     "k0: permeability of the bed at the fluid fraction drag.eps_0"},
    {"drag", "eps_0", KEY_REAL, "1", "(0, 1)", "0.4", "fluid fraction of that bed"},
    {0}};

void drag_init(struct scene *s)
{
    const double k0 = scene_real(s, "drag", NULL, "permeability");
    const double eps0 = scene_real(s, "drag", NULL, "eps_0");
    scale =
        k0 > 0.0 && eps0 < 1.0 ? eps0 * eps0 * eps0 / ((1.0 - eps0) * (1.0 - eps0) * k0) : 0.0;
}

void drag_prepare(struct drag_grain *grain)
{
    (void)grain;
}

double drag_factor(const struct drag_point *p)
{
    /* the constant that gives k0 at eps0 to grains of this diameter */
    const double constant = p->d * p->d * scale;
    return packed_kozeny_carman(p->eps, constant);
}
