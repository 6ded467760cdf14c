/* drag/haider_levenspiel.c - Haider and Levenspiel's grain of any sphericity
 * [HaiderLevenspiel89].
 *
 *   C_D  = 24/Re (1 + A Re^B) + C/(1 + D/Re),   Phi the sphericity
 *   A = exp(2.3288 - 6.4581 Phi + 2.4486 Phi^2),   B = 0.0964 + 0.5565 Phi
 *   C = exp(4.905 - 13.8944 Phi + 18.4222 Phi^2 - 10.2599 Phi^3)
 *   D = exp(1.4681 + 12.2584 Phi - 20.7322 Phi^2 + 15.8855 Phi^3)
 *   Fhat = 1 + A Re^B + (C/24) Re^2/(Re + D)
 *
 * d is the volume-equivalent diameter. As Re -> 0 every shape feels Stokes' drag of that
 * sphere: a defect of the form, ganser has none of it. Best for Phi > 0.67. At Phi = 1 it
 * is not the fit that the authors give for spheres alone, but up to 7 % off it.
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. */
#include "drag.h"

#include "formulas.h"

enum { A, B, C, D };

const struct about drag_about = {
    .name = "haider_levenspiel",
    .summary = "Haider and Levenspiel's isolated grain of any sphericity",
    .equation = "Fhat = 1 + A Re^B + (C/24) Re^2/(Re + D), A to D of the sphericity",
    .source = "[HaiderLevenspiel89]",
    .range = "one grain on its own (eps above 0.99), sphericity 0.5 to 1 (best above 0.67), Re "
             "< 2.5e4",
    .cost = "a power of Re: a logarithm and an exponential"};
const struct drag_limits drag_limits = {.eps_min = 0.99,
                                        .eps_max = 1.0,
                                        .re_max = 2.5e4,
                                        .isolated = 1.0,
                                        .shape = DRAG_SPHERICITY};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

void drag_prepare(struct drag_grain *grain)
{
    const double x = grain->sphericity;
    grain->own[A] = exp(2.3288 - 6.4581 * x + 2.4486 * x * x);
    grain->own[B] = 0.0964 + 0.5565 * x;
    grain->own[C] = exp(4.905 - 13.8944 * x + 18.4222 * x * x - 10.2599 * x * x * x);
    grain->own[D] = exp(1.4681 + 12.2584 * x - 20.7322 * x * x + 15.8855 * x * x * x);
}

double drag_factor(const struct drag_point *p)
{
    const double *const own = p->grain->own, re = p->re;
    return 1.0 + own[A] * power(re, own[B]) + own[C] / 24.0 * re * re / (re + own[D]);
}
