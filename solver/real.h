/* real.h - the precision of the contact loop: double, or float in a build by `make REAL=float`.
 *
 * `real` is for what belongs to one pair or one step: overlaps, relative velocities, forces of a
 * contact, its memory. Positions, velocities, sums and the ledger stay double. Code in `real`
 * takes its functions from <tgmath.h> (included here), and its unsuffixed constants have the
 * precision of the build (-fsingle-precision-constant, see the Makefile). */
#ifndef REAL_H
#define REAL_H

#include <stdint.h>
#include <tgmath.h>

#ifdef SILT_FLOAT
typedef float real;
#define REAL_NAME "float"
#else
typedef double real;
#define REAL_NAME "double"
#endif

/* Fused multiplication and addition is asked for by name (fma) where it pays, never left to the
 * compiler, so that every build has the same bits. */

/* The least number that has an inverse, with room. */
#ifdef SILT_FLOAT
#define real_least 1e-37F
#else
#define real_least 1e-300
#endif

/* 1/sqrt(x), x >= 0, to the last places: half of the exponent by shifting the number as an integer
 * [Lomont03], then a polynomial in what is wrong with that guess (7 %), and in double a step of
 * third order: a root and a division take several times as long. 0 counts as 1e-36:
 * in squares of metres, newtons or kilograms that is nothing. */
static inline double inverse_root_double(double x)
{
    const double at_least = x + 1e-36;
    int64_t bits;
    double y;
    __builtin_memcpy(&bits, &at_least, sizeof bits);
    bits = 0x5fe6e8eabeb722a6 - (bits >> 1);
    __builtin_memcpy(&y, &bits, sizeof y);
    const double h = fma(-(at_least * y), y, 1.0);
    const double p =
        fma(fma(0.31364642969779577, h, 0.3762736749950394), h, 0.49999933439808675);
    const double z = y * fma(p, h, 0.9999992605323762), e = fma(-(at_least * z), z, 1.0);
    return fma(e * z, fma(0.375, e, 0.5), z);
}

static inline real inverse_root(real x)
{
#ifdef SILT_FLOAT
    const real at_least = x + (real)1e-36;
    int32_t bits;
    float y;
    __builtin_memcpy(&bits, &at_least, sizeof bits);
    bits = 0x5f374756 - (bits >> 1);
    __builtin_memcpy(&y, &bits, sizeof y);
    const float h = fmaf(-(at_least * y), y, 1.0f);
    const float p = fmaf(fmaf(0.27475188628f, h, 0.31393374689f), h, 0.37499847298f);
    return y * fmaf(fmaf(p, h, 0.49999833435f), h, 1.0f);
#else
    return inverse_root_double(x);
#endif
}

/* sqrt(x), likewise; 0 at 0. */
static inline real square_root(real x)
{
    return x * inverse_root(x);
}

#endif
