/* drag/koch_hill_linear.c - Hill, Koch and Ladd's law as programs for grains in fluids use it:
 * one regime [KochHill01].
 *
 *   Fhat = eps [F0 + F3 Re/2],   phi = 1 - eps
 *   F0   = [1 + 3 sqrt(phi/2) + (135/64) phi ln phi + 16.14 phi]
 *          /[1 + 0.681 phi - 8.48 phi^2 + 8.16 phi^3]   phi < 0.4;   10 phi/eps^3 above
 *   F3   = 0.0673 + 0.212 phi + 0.0232/eps^5
 *
 * The total force F0 + F3 Re/2, with the mean pressure gradient, times eps. The quadratic
 * regime of small Re (F1) is left out; koch_hill has it. F0 jumps by 1 % at phi = 0.4.
 *
 * The review prints 0.5 F3 Re^2 for 0.5 F3 Re, and F3 with (1-phi)^5 for (1-phi)^-5 (0.15 for
 * 0.45 at phi = 0.4), and calls the dimensionless force F_d. */
#include "drag.h"

#include <math.h>

/* F0 of phi < 0.4 */
static double dilute(double phi)
{
    const double log_part = phi > 0.0 ? 135.0 / 64.0 * phi * log(phi) : 0.0;
    return (1.0 + 3.0 * sqrt(0.5 * phi) + log_part + 16.14 * phi) /
           (1.0 + 0.681 * phi - 8.48 * phi * phi + 8.16 * phi * phi * phi);
}

const struct about drag_about = {.name = "koch_hill_linear",
                                 .summary = "Hill, Koch and Ladd's law, linear in Re",
                                 .equation = "Fhat = eps [F0(phi) + F3(phi) Re/2]",
                                 .source = "[KochHill01]",
                                 .range = "eps 0.36 to 1, Re < 100; jumps at eps = 0.6 by 1 %",
                                 .cost = "a logarithm and a root"};
const struct drag_limits drag_limits = {
    .eps_min = 0.36, .eps_max = 1.0, .re_max = 100.0, .jump = 0.0104, .isolated = 1.0};
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
    const double eps = p->eps, phi = 1.0 - eps, eps5 = eps * eps * eps * eps * eps;
    const double f0 = phi < 0.4 ? dilute(phi) : 10.0 * phi / (eps * eps * eps);
    const double f3 = 0.0673 + 0.212 * phi + 0.0232 / eps5;
    return eps * (f0 + 0.5 * f3 * p->re);
}
