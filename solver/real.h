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

#endif
