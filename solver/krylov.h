/* krylov.h - conjugate gradients in the fields of a box (poisson.h), in single or in double
 * precision: the engine of pressure.c, which keeps phi and the true residual in double.
 *
 *   A x = sum over faces c (x_neighbour - x) - shift x
 *
 * with c over the square of the cell's size, 0 on Neumann sides, twice that on Dirichlet sides
 * (where x = 0 on the face, half a cell away; the ghost stays 0). Preconditioned by the direct
 * solve with coefficients of the layers [ConcusGolub73], or by a V-cycle of multigrid
 * (multigrid_body.h). The factor of the new direction is Polak and Ribiere's, which forgives a
 * preconditioner that is symmetric to single precision only [GolubYe99]. */
#ifndef KRYLOV_H
#define KRYLOV_H

#include "poisson.h"

struct krylov {
    const struct box *box;
    bool periodic[3];
    size_t real; /* bytes of a number: 4 or 8 */
    void *c[3];  /* on low faces; set by pressure.c, ghosts included */
    void *x, *r; /* correction (from 0) and residual */
    void *z, *s, *q;
    bool lent;    /* r, z, s, q are another's */
    double *part; /* sums of the rows, for dot products */
    double shift, rz;
    double *flat, *up; /* of the layers, for the direct solve (scaled as c) */
    struct poisson *direct;
    struct multigrid *multigrid; /* NULL until it is asked for */
};

/* One precision. */
struct krylov_kind {
    /* lent: NULL, or two fields of b->total doubles that a solve may use as scratch. */
    struct krylov *(*create)(const struct box *b, const bool periodic[3],
                             struct poisson *direct, double *const lent[2]);
    void (*free)(struct krylov *w);

    /* Before r is set for a new equation: ghosts that are never written are 0. */
    void (*start)(struct krylov *w);

    /* To be called when c has been set, before multigrid is asked for with it. */
    void (*coarsen)(struct krylov *w);

    /* Iterates until |r|_2 <= goal, at most so often; adds to x. Goes on with the directions of
     * the call before, unless `fresh`. Returns the iterations; *end: |r|_2 of the recurrence. */
    int (*solve)(struct krylov *w, bool multigrid, bool fresh, double goal, int most,
                 double *end);
};

extern const struct krylov_kind krylov_single, krylov_double;

#endif
