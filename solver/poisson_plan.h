/* poisson_plan.h - what the two precisions of the direct solve share; for poisson*.c only. */
#ifndef POISSON_PLAN_H
#define POISSON_PLAN_H

#include "poisson.h"

enum { SWEEP_PACKS = 16 }; /* modes swept at a time: so many packs of 64 bytes */

struct layer { /* of the tridiagonal systems: -diagonal - flat lambda, and its neighbours */
    double below, above, diagonal, flat;
};

struct poisson {
    const struct grid *g;
    enum poisson_side side[6];
    struct box box;
    int n[3];               /* the box's: cells along a row, rows of a plane, planes */
    int start, stride[3];   /* of this solve's fields */
    struct transform *t[2]; /* along rows and across them; NULL where one cell thick */
    double *lambda;         /* rows x n[0], 1/m2 */
    int width[2];           /* modes in a row of the work, padded; double and single */
    void *lambda_wide[2];   /* the same, padded */
    double norm;
    void *work;           /* planes x rows x width, for the precision asked for so far */
    size_t work_size;     /* bytes */
    struct layer *layers; /* n[2] */
    bool singular;        /* this solve */
    char *scratch;        /* of each thread */
    size_t scratch_size;  /* bytes of one thread */
    int threads;          /* that it has room for */
};

/* Layers for these coefficients, room for this precision and for the threads at hand. */
void poisson_prepare(struct poisson *p, const double *flat, const double *up, double shift,
                     bool single);

void poisson_layout(struct poisson *p, bool grid); /* fields of the grid, or of the box */

/* The column x[0..n-1] of the mode in whose plane a constant solves the equation: zero mean. */
void poisson_singular_column(const struct poisson *p, double *x);

#endif
