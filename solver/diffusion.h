/* diffusion.h - the Laplacian of the velocity, and its implicit half in Crank and Nicolson's
 * scheme. */
#ifndef DIFFUSION_H
#define DIFFUSION_H

#include "helmholtz.h"
#include "momentum.h"

/* L u on the inside faces of row (j, k) of component a, ghosts filled; N/m3:
 * mu laplace(u) (form a: to be multiplied by eps), or div(eps mu grad u). out[i] for face i. */
void diffusion_row(const struct sim *s, const struct momentum *m, enum form form, int a, int j,
                   int k, const double *u, double *restrict out);

/* The same on face c of an open side; nothing passes through the side itself. */
double diffusion_open(const struct sim *s, const struct momentum *m, enum form form, int a,
                      int end, int c, const double *u);

struct diffusion {
    struct helmholtz *direct[3]; /* without grains, for each component */
    double *r, *d, *q; /* with grains, grid fields: scratch of the conjugate gradients */
    double *part;      /* sums of rows */
};

void diffusion_create(struct diffusion *d, const struct sim *s);
void diffusion_free(struct diffusion *d);

/* With grains, component a. x: the velocity predicted without L (all else in it). u: in, the old velocity
 * with sides and ghosts of the middle of the step; out, that of
 *     A (u_new - x) = (L u_new + L u)/2,   A = rho eps/dt + B
 * Returns the iterations; stops the run where they do not converge. */
int diffusion_solve(const struct sim *s, const struct momentum *m, struct diffusion *d, int a,
                    const double *x, double *u, double tolerance);

/* The same without grains, in one direct solve. sum: x + u in (fluid.u, with sides and ghosts of the
 * middle of the step, is the old velocity); the new velocity out, on the faces that have an equation. */
void diffusion_direct(const struct sim *s, const struct diffusion *d, int a, double *sum);

#endif
