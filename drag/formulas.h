/* drag/formulas.h - formulas that several laws of this folder share.
 *
 * C_D Re/24 of an isolated sphere, finite at Re = 0
 *   Schiller and Naumann   1 + 0.15 Re^0.687; 0.44 Re/24 from 1000 on, where it jumps up by
 *                          0.4 %                                       [SchillerNaumann35]
 *   Dallavalle             (0.63 sqrt(Re) + 4.8)^2/24, 0.96 at Re = 0   [Dallavalle48]
 * and what a permeability means for one grain: Fhat = eps d^2/(18 (1-eps) k), drag.h. */
#ifndef DRAG_FORMULAS_H
#define DRAG_FORMULAS_H

#include <math.h>

/* x^y for x >= 0, y > 0; half the time of pow, and right to 1e-14 for all that occurs here. */
static inline double power(double x, double y)
{
    return x > 0.0 ? exp(y * log(x)) : 0.0;
}

/* eps^-y */
static inline double voidage(double eps, double y)
{
    return exp(-y * log(eps));
}

static inline double sphere_schiller_naumann(double re)
{
    return re < 1000.0 ? 1.0 + 0.15 * power(re, 0.687) : 0.44 / 24.0 * re;
}

static inline double sphere_dallavalle(double re)
{
    const double root = 0.63 * sqrt(re) + 4.8;
    return root * root / 24.0;
}

/* exp[-(1.5 - log10 Re)^2/2] of Di Felice's exponent, of log Re. */
static inline double intermediate_of(double log_re)
{
    const double x = 1.5 - 0.43429448190325182765 * log_re;
    return exp(-0.5 * x * x);
}

/* The same of Re; 0 at Re = 0 (below 1e-12 it is under 1e-39). */
static inline double sphere_intermediate(double re)
{
    if (!(re > 1e-12))
        return 0.0;
    return intermediate_of(log(re));
}

/* Ergun's factor, see ergun.c. */
static inline double packed_ergun(double eps, double re)
{
    return (150.0 * (1.0 - eps) + 1.75 * re) / (18.0 * eps * eps);
}

/* Kozeny and Carman's factor, see kozeny_carman.c. Packed beds only: the solid fraction counts
 * as 1 % at least, so that a grain that has left the bed is not without drag. */
static inline double packed_kozeny_carman(double eps, double constant)
{
    return (1.0 / 18.0) * constant * fmax(1.0 - eps, 0.01) / (eps * eps);
}

#endif
