/* pressure.h - div(c grad phi) - shift phi = r with c on the faces of the grid, by conjugate
 * gradients preconditioned with the direct solve for c averaged over each layer. */
#ifndef PRESSURE_H
#define PRESSURE_H

#include "poisson.h"

struct pressure; /* direct solve and scratch */

struct solve { /* what a solve took */
    int iterations;
    double start, end; /* 2-norms of the residual */
    bool converged;
};

struct pressure *pressure_create(const struct grid *g, const struct domain *d,
                                 const enum poisson_side side[6]);
void pressure_free(struct pressure *p);

/* c[a]: face fields (low face of the cell), every face of the interior and of the boundary set;
 * boundary faces of Neumann sides are ignored. phi: the guess, then the solution; its ghosts
 * are filled with the side conditions. Stops at |r| <= tolerance |rhs| or <= floor, in 2-norms.
 */
struct solve pressure_solve(struct pressure *p, double *const c[3], double shift,
                            const double *rhs, double *phi, double tolerance, double floor);

/* Ghosts of phi by the side conditions: periodic, zero gradient, or value 0 on the face. */
void pressure_ghosts(const struct pressure *p, double *phi);

/* The mean of rhs over its largest size: what no phi can balance where constants solve the
 * equation (0 otherwise). */
double pressure_imbalance(const struct pressure *p, double shift, const double *rhs);

#endif
