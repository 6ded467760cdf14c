/* poisson.h - div(c grad phi) - shift phi = r on the cells of the grid, directly, where c
 * depends on the layer (z) only: transforms in x and y, a tridiagonal solve in z.
 *
 * Each direction is periodic, or each of its sides is a Neumann side (no flux) or a Dirichlet
 * side (phi = 0 on the face, half a cell away). */
#ifndef POISSON_H
#define POISSON_H

#include "grid.h"

enum poisson_side { POISSON_PERIODIC, POISSON_NEUMANN, POISSON_DIRICHLET };

struct poisson; /* plans and scratch */

struct poisson *poisson_create(const struct grid *g, const enum poisson_side side[6]);
void poisson_free(struct poisson *p);

/* True if a constant is in the null space: no Dirichlet side, shift 0. */
bool poisson_singular(const struct poisson *p, double shift);

/* flat[k], k = 1..n: c in x and y of layer k. up[k], k = 1..n+1: c on the face below layer k.
 * rhs and out are grid fields (only interior cells are read and written) and may be the same.
 * A singular problem is solved for a zero mean; the mean of its rhs is ignored. */
void poisson_solve(struct poisson *p, const double *flat, const double *up, double shift,
                   const double *rhs, double *out);

#endif
