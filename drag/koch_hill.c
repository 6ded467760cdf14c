/* drag/koch_hill.c - Hill, Koch and Ladd's law in the form of Benyahia, Syamlal and O'Brien,
 * over all porosities and Reynolds numbers [BenyahiaSyamlalOBrien06, HillKochLadd01].
 *
 *   Fhat = eps F,   phi = 1 - eps,   R = Re/2 (of the radius)
 *   F = 1 + 3R/8      phi <= 0.01 and R <= (F2 - 1)/(3/8 - F3)
 *     = F0 + F1 R^2   phi >  0.01 and R <= [F3 + sqrt(F3^2 - 4 F1 (F0 - F2))]/(2 F1)
 *     = F2 + F3 R     else
 *   F0, F2 = (1-w) [1 + 3 sqrt(phi/2) + (135/64) phi ln phi + a phi]
 *            /[1 + 0.681 phi - b phi^2 + c phi^3] + w 10 phi/eps^3;   10 phi/eps^3, phi >= 0.4
 *            w = exp[-10 (0.4-phi)/phi];  a, b, c = 17.14, 8.48, 8.16 (F0),
 *            17.89, 11.03, 15.41 (F2)
 *   F1 = sqrt(2/phi)/40, phi <= 0.1;  0.11 + 5.1e-4 exp(11.6 phi) above
 *   F3 = 0.9351 phi + 0.03667, phi < 0.0953;  0.0673 + 0.212 phi + 0.0232/eps^5 above
 *
 * F is the total force, with the mean pressure gradient. An isolated sphere feels 1 + 0.018
 * Re: right as Re -> 0 only, far too little at Re = 100. The published law jumps at phi = 0.01
 * (the form of the creeping branch) and slightly at 0.0953 and 0.1.
 *
 * The review prints F0 + 0.5 F1 Re^2 (right: F1 Re^2/4, since R = Re/2), 0.5 F3 Re^2 (right:
 * 0.5 F3 Re), F3 with (1-phi)^5 (right: to the power -5), and one switch at Re = 20, where F0
 * and F3 do not meet. */
#include "drag.h"

#include <math.h>

/* What F0 and F2 have in common. */
struct creeping {
    double top;   /* numerator without a phi */
    double dense; /* 10 phi/eps^3 */
    double w;     /* of that */
};

static struct creeping common(double phi, double eps3)
{
    const double dense = 10.0 * phi / eps3;
    if (phi >= 0.4)
        return (struct creeping){1.0, dense, 1.0};
    if (!(phi > 0.0))
        return (struct creeping){1.0, dense, 0.0};
    return (struct creeping){1.0 + 3.0 * sqrt(0.5 * phi) + 135.0 / 64.0 * phi * log(phi), dense,
                             exp(10.0 - 4.0 / phi)};
}

static double creeping(const struct creeping *x, double phi, double a, double b, double c)
{
    return (1.0 - x->w) * (x->top + a * phi) /
               (1.0 + 0.681 * phi - b * phi * phi + c * phi * phi * phi) +
           x->w * x->dense;
}

const struct about drag_about = {
    .name = "koch_hill",
    .summary = "Hill, Koch and Ladd's law, Benyahia, Syamlal and O'Brien's form",
    .equation = "Fhat = eps F; F = F0 + F1 R^2 at small, F2 + F3 R at large R = Re/2",
    .source = "[BenyahiaSyamlalOBrien06]; [HillKochLadd01]",
    .range = "eps 0.36 to 1, Re < 200; jumps at eps = 0.99 by 22 %",
    .cost = "a logarithm, an exponential and two roots, and a choice of branch"};
const struct drag_limits drag_limits = {
    .eps_min = 0.36, .eps_max = 1.0, .re_max = 200.0, .jump = 0.2183, .isolated = 1.0};
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
    const double eps = p->eps, phi = 1.0 - eps, r = 0.5 * p->re, eps3 = eps * eps * eps;
    const struct creeping x = common(phi, eps3);
    const double f3 = phi < 0.0953 ? 0.9351 * phi + 0.03667
                                   : 0.0673 + 0.212 * phi + 0.0232 / (eps3 * eps * eps);
    const double f2 = creeping(&x, phi, 17.89, 11.03, 15.41);
    if (phi <= 0.01)
        return eps * (r * (3.0 / 8.0 - f3) <= f2 - 1.0 ? 1.0 + 3.0 / 8.0 * r : f2 + f3 * r);
    const double f0 = creeping(&x, phi, 17.14, 8.48, 8.16);
    const double f1 = phi <= 0.1 ? sqrt(2.0 / phi) / 40.0 : 0.11 + 5.1e-4 * exp(11.6 * phi);
    const double root = sqrt(f3 * f3 - 4.0 * f1 * (f0 - f2));
    return eps * (2.0 * f1 * r <= f3 + root ? f0 + f1 * r * r : f2 + f3 * r);
}
