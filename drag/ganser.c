/* drag/ganser.c - Ganser's grain of any shape, by its two limits [Ganser93, eq. 18].
 *
 *   C_D  = K2 {24/X (1 + 0.1118 X^0.6567) + 0.4305/(1 + 3305/X)},   X = Re K1 K2
 *   K1   = 1/[d_n/(3 d) + (2/3) Phi^-1/2]          the shape factor of Stokes' regime
 *   K2   = 10^{1.8148 (-log10 Phi)^0.5743}         and of Newton's
 *   Fhat = [1 + 0.1118 X^0.6567 + (0.4305/24) X^2/(X + 3305)]/K1
 *
 * Phi is the sphericity, d_n the diameter of the circle of equal projected area: d_n/d =
 * Phi_cross^-1/2 with the crosswise sphericity, 1 for isometric grains. The correction for the
 * wall of a tube is left out.
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. */
#include "drag.h"

#include "formulas.h"

enum { K1, K1_K2 };

const struct about drag_about = {
    .name = "ganser",
    .summary = "Ganser's isolated grain of any shape",
    .equation = "Fhat = [1 + 0.1118 X^0.6567 + (0.4305/24) X^2/(X + 3305)]/K1, X = Re K1 K2",
    .source = "[Ganser93, eq. 18]",
    .range = "one grain on its own (eps above 0.99), Re K1 K2 < 1e5",
    .cost = "a power of Re: a logarithm and an exponential"};
const struct drag_limits drag_limits = {.eps_min = 0.99,
                                        .eps_max = 1.0,
                                        .re_max = 1e5,
                                        .isolated = 1.0,
                                        .shape = DRAG_SPHERICITY | DRAG_CROSSWISE};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

void drag_prepare(struct drag_grain *grain)
{
    const double phi = grain->sphericity;
    const double k1 = 1.0 / (1.0 / (3.0 * sqrt(grain->crosswise)) + 2.0 / (3.0 * sqrt(phi)));
    const double k2 = pow(10.0, 1.8148 * pow(-log10(fmin(phi, 1.0)), 0.5743));
    grain->own[K1] = k1;
    grain->own[K1_K2] = k1 * k2;
}

double drag_factor(const struct drag_point *p)
{
    const double k1 = p->grain->own[K1], x = p->re * p->grain->own[K1_K2];
    return (1.0 + 0.1118 * power(x, 0.6567) + 0.4305 / 24.0 * x * x / (x + 3305.0)) / k1;
}
