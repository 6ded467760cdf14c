/* drag/beetstra.c - Beetstra, van der Hoef and Kuipers' law, from lattice-Boltzmann runs, with
 * its correction for mixed sizes [Beetstra07].
 *
 *   Fhat = y { 10 phi/eps^2 + eps^2 (1 + 1.5 sqrt(phi)) + [0.413 Re/(24 eps^2)]
 *          [1/eps + 3 eps phi + 8.4 Re^-0.343]/[1 + 10^(3 phi) Re^-(1+4 phi)/2] }
 *   phi  = 1 - eps;  y = d over the Sauter mean diameter of the grains around, and within the
 *          braces Re is that of the mean diameter, Re/y
 *
 * This is the drag without the pressure gradient (model A), so the correction is y alone
 * [erratum of 2007]: the published eps y + phi y^2 of the total force, less the share phi y^2
 * of the pressure gradient, which goes with the volume. The term 0.064 y^3 of the first paper
 * is left out, as in the erratum's form. A table that is in circulation has 1.15 sqrt(phi):
 * 1.5 is right. */
#include "drag.h"

#include <math.h>

static const double ln10 = 2.30258509299404568402;

const struct about drag_about = {
    .name = "beetstra",
    .summary = "Beetstra, van der Hoef and Kuipers' law, with their correction for mixed sizes",
    .equation = "Fhat = y {10 phi/eps^2 + eps^2 (1 + 1.5 sqrt(phi)) + 0.413 Re/(24 eps^2) "
                "[1/eps + 3 eps phi + 8.4 Re^-0.343]/[1 + 10^(3 phi) Re^-(1+4 phi)/2]}",
    .source = "[Beetstra07]",
    .range = "eps 0.4 to 0.9, Re < 1000",
    .cost = "a logarithm, two exponentials and a root"};
const struct drag_limits drag_limits = {
    .eps_min = 0.4, .eps_max = 0.9, .re_max = 1000.0, .sauter = true, .isolated = 1.0};
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
    const double eps = p->eps, phi = 1.0 - eps, eps2 = eps * eps, re = p->re / p->y;
    const double creeping = 10.0 * phi / eps2 + eps2 * (1.0 + 1.5 * sqrt(phi));
    if (!(re > 0.0))
        return p->y * creeping;
    const double log_re = log(re);
    const double top = 1.0 / eps + 3.0 * eps * phi + 8.4 * exp(-0.343 * log_re);
    const double bottom = 1.0 + exp(3.0 * ln10 * phi - (0.5 + 2.0 * phi) * log_re);
    return p->y * (creeping + 0.413 / 24.0 * re / eps2 * top / bottom);
}
