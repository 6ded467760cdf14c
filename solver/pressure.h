/* pressure.h - div(c grad phi) - shift phi = r with c on the faces of the grid.
 *
 * Where c depends on the height only, one direct solve (poisson.h). Else conjugate gradients
 * inside a loop that takes the true residual in double precision: preconditioned by the direct
 * solve, with c averaged over each layer where the layers explain its variance and over the box
 * where they do not; by multigrid where the contrast is large. Single precision inside, double
 * beyond a contrast of a thousand. The bits do not depend on the number of threads. */
#ifndef PRESSURE_H
#define PRESSURE_H

#include "poisson.h"

struct pressure; /* direct solve and scratch */

enum pressure_method { /* what preconditions */
                       PRESSURE_AUTO,
                       PRESSURE_BOX,      /* the direct solve for the mean of c */
                       PRESSURE_LAYERS,   /* the direct solve for the mean of each layer */
                       PRESSURE_MULTIGRID /* a V-cycle */
};

struct solve { /* what a solve took */
    int iterations;
    double start, end; /* 2-norms of the true residual */
    bool converged;
    enum pressure_method method;
    double contrast; /* largest c over smallest, 0 and the faces of Neumann sides left out */
};

struct pressure *pressure_create(const struct grid *g, const struct domain *d,
                                 const enum poisson_side side[6]);
void pressure_free(struct pressure *p);

/* Before the first solve: two grid fields of the caller that later solves use as scratch. */
void pressure_lend(struct pressure *p, double *one, double *other);

/* Which method later solves take; AUTO (the default) chooses by the field. */
void pressure_method(struct pressure *p, enum pressure_method method);

/* c[a]: face fields (low face of the cell), every face of the interior and of the boundary set;
 * boundary faces of Neumann sides are ignored. phi: the guess, then the solution; its ghosts
 * are filled with the side conditions. A good guess (the last solution, or twice the last less
 * the one before) saves a third of the iterations; one whose residual is twice |rhs| is taken for 0. Stops at |r| <= tolerance |rhs| or <= floor,
 * in 2-norms, or where round-off of phi allows no better. Where constants solve the equation, the mean of rhs is ignored and that of phi
 * stays as it was (0 if the guess is not taken). */
struct solve pressure_solve(struct pressure *p, double *const c[3], double shift,
                            const double *rhs, double *phi, double tolerance, double floor);

/* Ghosts of phi by the side conditions: periodic, zero gradient, or value 0 on the face. */
void pressure_ghosts(const struct pressure *p, double *phi);

/* The mean of rhs over its largest size: what no phi can balance where constants solve the
 * equation (0 otherwise). */
double pressure_imbalance(const struct pressure *p, double shift, const double *rhs);

/* Advice where a size of the grid makes the transforms slow: a line of the report. directions: 2 of the
 * pressure, 3 where implicit viscosity has transforms along z too. */
struct feasibility;
void pressure_feasibility(const struct grid *g, int directions, struct feasibility *f);

#endif
