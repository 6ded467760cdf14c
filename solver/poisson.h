/* poisson.h - div(c grad phi) - shift phi = r on the cells of the grid, directly, where c
 * depends on the layer (z) only: transforms in x and y, a tridiagonal solve in z.
 *
 * Each direction is periodic, or each of its sides is a Neumann side (no flux) or a Dirichlet
 * side (phi = 0 on the face, half a cell away). A direction one cell thick costs nothing. The
 * bits of the result do not depend on the number of threads. */
#ifndef POISSON_H
#define POISSON_H

#include "grid.h"
#include "transform.h"

enum { POISSON_SERIAL = 8192 }; /* cells that are not worth a team of threads */

struct poisson; /* tables and scratch */

struct poisson *poisson_create(const struct grid *g, const enum poisson_side side[6]);
void poisson_free(struct poisson *p);

/* True if a constant is in the null space: no Dirichlet side, shift 0. */
bool poisson_singular(const struct poisson *p, double shift);

/* flat[k], k = 1..n: c in x and y of layer k. up[k], k = 1..n+1: c on the face below layer k.
 * rhs and out are grid fields (only interior cells are read and written) and may be the same.
 * A singular problem is solved for a zero mean; the mean of its rhs is ignored. */
void poisson_solve(struct poisson *p, const double *flat, const double *up, double shift,
                   const double *rhs, double *out);

/* The cells in the order that the solvers work in: along x, then y, then z, or along y first
 * where x is one cell thick. Its own fields have one ghost on each side, like those of the grid. */
struct box {
    int axis[3]; /* of rows, of the rows of a plane, of planes */
    int n[3];    /* cells */
    int s[3];    /* strides; s[0] = 1 */
    int start;   /* first interior cell */
    size_t total;
    int grid_start, grid_s[3]; /* the same cells in fields of the grid */
};

void box_create(struct box *b, const struct grid *g);

/* What the solve calls from its threads, each plane once, just after it has written out there
 * (planes lo..hi - 1 from 0). */
struct poisson_hook {
    void (*after)(void *with, int lo, int hi);
    void *with;
};

/* The same for fields of the box, the second in single precision (to about 1e-6); `hook` may be
 * NULL. */
void poisson_solve_double(struct poisson *p, const double *flat, const double *up, double shift,
                          const double *rhs, double *out, const struct poisson_hook *hook);
void poisson_solve_single(struct poisson *p, const double *flat, const double *up, double shift,
                          const float *rhs, float *out, const struct poisson_hook *hook);

#endif
