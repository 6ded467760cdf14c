/* pressure_parts.h - what the files of the variable-coefficient solve share: its state, and the passes over
 * rows in double precision (pressure_field.c, pressure_coefficient.c). For pressure*.c only. */
#ifndef PRESSURE_PARTS_H
#define PRESSURE_PARTS_H

#include <string.h>
#include "krylov.h"
#include "pressure.h"

struct statistics {
    double least, most;
    double variance, within; /* of c: over the box, and within layers */
    double scale;            /* 1/most */
};

struct pressure {
    const struct grid *g;
    const struct domain *d;
    enum poisson_side side[6];
    enum pressure_method method;
    struct box box;
    struct poisson *direct;
    struct krylov *krylov[2];      /* in single, and once it is needed in double precision */
    double *lent[2];               /* another's, or NULL */
    double *flat, *up;             /* layer means */
    double *square, *least, *most; /* of each layer: mean of c^2, extremes */
    double *part;                  /* sums of the rows */
};

enum { SEGMENT = 512 }; /* of a row, converted at a time */

/* Few cells: one thread is quicker. */
static inline bool worth_threads(const struct pressure *p)
{
    return p->g->total > POISSON_SERIAL;
}

static inline long rows_of(const struct box *b)
{
    return (long)b->n[1] * b->n[2];
}

/* First cell of a row in fields of the grid and of the box. */
static inline int in_grid(const struct box *b, long row)
{
    return b->grid_start + (int)(row % b->n[1]) * b->grid_s[1] +
           (int)(row / b->n[1]) * b->grid_s[2];
}

static inline size_t in_box(const struct box *b, long row)
{
    return (size_t)b->start + (size_t)(row % b->n[1]) * b->s[1] +
           (size_t)(row / b->n[1]) * b->s[2];
}

static inline double sum_of(const double *part, long n)
{
    double sum = 0.0;
    for (long i = 0; i < n; i++)
        sum += part[i];
    return sum;
}

/* Puts n values into a field of either precision. */
static inline void put(const struct krylov *w, void *field, size_t at, const double *x, int n)
{
    if (w->real == sizeof(float)) {
        float *const to = (float *)field + at;
        for (int i = 0; i < n; i++)
            to[i] = (float)x[i];
    } else {
        memcpy((double *)field + at, x, (size_t)n * sizeof *x);
    }
}

/* Sum of x over a row of a field of the grid, and of its squares; eight sums side by side. */
double pressure_row_sum(const double *x, int stride, int n, bool squares);

/* Of the coefficients; the means of the layers to p->flat, p->up. */
struct statistics pressure_statistics(struct pressure *p, double *const c[3]);

/* c is the same all over each layer, to round-off. */
bool pressure_layered(const struct pressure *p, const struct statistics *s, double *const c[3]);

/* p->flat, p->up: the means over the box in place of those of the layers. */
void pressure_box_means(struct pressure *p);

/* The coefficients over h^2, times `scale`; sides as krylov.h wants them. */
void pressure_set_coefficients(struct pressure *p, struct krylov *w, double *const c[3],
                               double scale);

/* Norm of rhs; *mean: its mean. */
double pressure_rhs_norm(const struct pressure *p, const double *rhs, double *mean);

/* The true residual rhs - mean - A phi: its 2-norm; times `scale` into w->r if there is a w. */
double pressure_residual(const struct pressure *p, double *const c[3], double shift,
                         const double *rhs, double mean, double *phi, double scale,
                         struct krylov *w);

/* What round-off of phi alone leaves of the residual: 2-norm of the sum over faces of c |phi|. */
double pressure_round_off(const struct pressure *p, double *const c[3], const double *phi);

/* phi += factor x, x = 0 */
void pressure_take(const struct pressure *p, struct krylov *w, double factor, double *phi);

#endif
