/* drag/kozeny_carman.c - Kozeny and Carman's permeability of packed beds [Kozeny27, Carman37].
 *
 *   k    = eps^3 d^2/(C (1-eps)^2),   C = 180 (Carman) or 150 (the viscous part of Ergun)
 *   Fhat = (C/18) (1-eps)/eps^2
 *
 * Above eps_cap the permeability stays that of eps_cap, a numerical guard [the seed review's
 * Table 3, row 1] and no physics: k(eps) = k(eps_cap) means
 *   Fhat = eps d^2/(18 (1-eps) k(eps_cap)) = (C/18) eps (1-eps_cap)^2/((1-eps) eps_cap^3),
 * a resistance per volume that no longer falls with the solid in it, hence a force per grain
 * that grows as 1/(1-eps). So that it stays finite, 1-eps in this denominator is at least
 * 0.01: in thinner suspensions k rises again as 0.01/(1-eps). eps_cap = 1 switches the guard
 * off; the factor then falls to (C/18) 0.01 at eps = 1.
 *
 * The review's rows mix k in m2 (C = 180) and a conductivity in m/s (C = 150) under one
 * symbol: k is a permeability here, and the conductivity is k rho g/mu. */
#include "drag.h"

#include "formulas.h"

static const double phi_least = 0.01;
static double constant = 180.0, eps_cap = 0.7;
static double beyond; /* (C/18) (1-eps_cap)^2/eps_cap^3 */

const struct about drag_about = {
    .name = "kozeny_carman",
    .summary = "Kozeny and Carman's permeability, constant as asked",
    .equation = "Fhat = (constant/18) (1-eps)/eps^2; above eps_cap: permeability of eps_cap",
    .source = "[Kozeny27]; [Carman37]",
    .range = "packed beds, eps 0.35 to 0.7, Re/(1-eps) < 1",
    .cost = "two divisions and a limit"};
const struct drag_limits drag_limits = {
    .eps_min = 0.35, .eps_max = 0.7, .re_max = 1.0, .per_solid = true};
const struct key drag_keys[] = {
    {"drag", "constant", KEY_REAL, "1", "(0, inf)", "180",
     "constant of Kozeny and Carman: 180 (Carman) or 150 (viscous part of Ergun)"},
    {"drag", "eps_cap", KEY_REAL, "1", "(0, 1]", "0.7",
     "fluid fraction above which the permeability stays constant; 1: no such cap"},
    {0}};

void drag_init(struct scene *s)
{
    constant = scene_real(s, "drag", NULL, "constant");
    eps_cap = scene_real(s, "drag", NULL, "eps_cap");
    beyond =
        constant / 18.0 * (1.0 - eps_cap) * (1.0 - eps_cap) / (eps_cap * eps_cap * eps_cap);
}

void drag_prepare(struct drag_grain *grain)
{
    (void)grain;
}

double drag_factor(const struct drag_point *p)
{
    const double eps = p->eps;
    if (eps <= eps_cap)
        return packed_kozeny_carman(eps, constant);
    return beyond * eps / fmax(1.0 - eps, phi_least);
}
