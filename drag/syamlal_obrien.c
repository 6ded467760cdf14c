/* drag/syamlal_obrien.c - Syamlal and O'Brien's law, from terminal velocities of suspensions
 * [SyamlalOBrien87].
 *
 *   beta = (3/4) C_D(Re_s/V) rho eps (1-eps) u_r/(V^2 d),  Re_s = rho u_r d/mu = Re/eps
 *   V    = [A - 0.06 Re_s + sqrt((0.06 Re_s)^2 + 0.12 Re_s (2B - A) + A^2)]/2
 *   A    = eps^4.14,  B = c eps^1.28 (eps <= 0.85), eps^q (above);  C_D of Dallavalle
 *   Fhat = (0.63 sqrt(Re_s/V) + 4.8)^2/(24 V)
 *
 * V, the velocity of the suspension over that of one sphere, is the root of V^2 - (A - 0.06
 * Re_s) V - 0.06 Re_s B = 0: taken in the form that does not cancel at large Re_s. c = 0.8 and
 * q = 2.65 are often fitted to a measured fluidisation velocity: drag.c and drag.q. With the
 * two standard values B is continuous at 0.85 to 0.1 %. An isolated creeping sphere feels 0.96
 * of Stokes' drag. */
#include "drag.h"

#include "formulas.h"

static double c = 0.8, q = 2.65;

const struct about drag_about = {
    .name = "syamlal_obrien",
    .summary = "Syamlal and O'Brien's law, from terminal velocities",
    .equation = "Fhat = (0.63 sqrt(Re_s/V) + 4.8)^2/(24 V), V the suspension's velocity ratio",
    .source = "[SyamlalOBrien87]; [Dallavalle48]",
    .range = "eps 0.4 to 1, Re < 1e4",
    .cost = "two powers of eps and a root"};
const struct drag_limits drag_limits = {
    .eps_min = 0.4, .eps_max = 1.0, .re_max = 1e4, .jump = 0.00096, .isolated = 0.96};
const struct key drag_keys[] = {
    {"drag", "c", KEY_REAL, "1", "(0, inf)", "0.8",
     "Syamlal and O'Brien's factor at eps 0.85 and below; fitted to a fluidisation velocity"},
    {"drag", "q", KEY_REAL, "1", "(0, inf)", "2.65", "their exponent above 0.85"},
    {0}};

void drag_init(struct scene *s)
{
    c = scene_real(s, "drag", NULL, "c");
    q = scene_real(s, "drag", NULL, "q");
}

void drag_prepare(struct drag_grain *grain)
{
    (void)grain;
}

double drag_factor(const struct drag_point *p)
{
    const double eps = p->eps, re = p->re / eps;
    const double a = power(eps, 4.14), b = eps <= 0.85 ? c * power(eps, 1.28) : power(eps, q);
    const double half = a - 0.06 * re, product = 0.24 * re * b;
    const double root = sqrt(half * half + product);
    const double v = half > 0.0 ? 0.5 * (half + root) : 0.5 * product / (root - half);
    return sphere_dallavalle(re / v) / v;
}
