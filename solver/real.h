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
 * compiler, so that every build has the same bits.
 *
 * 1/sqrt(x), to about 1e-15 in double: a root in float mended by Newton's steps, which takes a
 * third of the time of a root and a division in double. x below 1e-36 counts as 1e-36: in squares
 * of metres, newtons or kilograms that is nothing. */
static inline real inverse_root(real x)
{
    const real at_least = x > (real)1e-36 ? x : (real)1e-36;
#ifdef SILT_FLOAT
    return 1.0f / sqrtf(at_least);
#else
    const double y = (double)(1.0f / sqrtf((float)at_least)), half = 0.5 * at_least;
    const double once = fma(y, fma(-half * y, y, 0.5), y);
    return fma(once, fma(-half * once, once, 0.5), once);
#endif
}

/* sqrt(x), likewise; 0 at 0. */
static inline real square_root(real x)
{
    return x * inverse_root(x);
}

#endif
