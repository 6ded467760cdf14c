/* poisson.c - the direct solve [SwarztrauberSweet73], [Costa18]: transforms diagonalise x and
 * y; what is left is a tridiagonal system in z for each mode, swept for many modes at once
 * (poisson_body.h). Here: set-up, and the solve in double precision. */
#include "poisson_plan.h"

#include <omp.h>

#define REAL  double
#define INDEX long
static inline const double *table_of(const struct transform *t)
{
    return t->table;
}
#include "poisson_body.h"

static bool dirichlet(const struct poisson *p, int side)
{
    return p->side[side] == POISSON_DIRICHLET;
}

static double eigenvalue(const struct poisson *p, int axis, const struct transform *t, int m)
{
    const double h = p->g->h[axis];
    const double alone = (double)(2 * dirichlet(p, 2 * axis) + 2 * dirichlet(p, 2 * axis + 1));
    return (t ? t->eigenvalue[m] : alone) / (h * h);
}

/* lambda, with rows padded to a whole number of double packs of each precision. */
static void pad_lambda(struct poisson *p)
{
    const int nx = p->n[0], ny = p->n[1];
    for (int single = 0; single < 2; single++) {
        const int lines = single ? 32 : 16, width = (nx + lines - 1) / lines * lines;
        double *const wide = xalloc((size_t)width * ny, sizeof *wide);
        float *const narrow = xalloc((size_t)width * ny, sizeof *narrow);
        for (int j = 0; j < ny; j++)
            for (int i = 0; i < width; i++) {
                const double one = 1.0 / (p->g->h[0] * p->g->h[0]);
                const double x = i < nx ? p->lambda[i + (size_t)nx * j] : one;
                wide[i + (size_t)width * j] = x;
                narrow[i + (size_t)width * j] = (float)x;
            }
        p->width[single] = width;
        p->lambda_wide[single] = single ? (void *)narrow : (void *)wide;
        xfree(single ? (void *)wide : (void *)narrow);
    }
}

void box_create(struct box *b, const struct grid *g)
{
    const int first = g->n[0] == 1 && g->n[1] > 1 ? 1 : 0, axis[3] = {first, 1 - first, 2};
    b->total = 1;
    b->start = 0;
    for (int i = 0; i < 3; i++) {
        b->axis[i] = axis[i];
        b->n[i] = g->n[axis[i]];
        b->s[i] = (int)b->total;
        b->start += b->s[i];
        b->total *= (size_t)b->n[i] + 2;
        b->grid_s[i] = g->s[axis[i]];
    }
    b->grid_start = cell(g, 1, 1, 1);
}

struct poisson *poisson_create(const struct grid *g, const enum poisson_side side[6])
{
    struct poisson *const p = xalloc(1, sizeof *p);
    box_create(&p->box, g);
    const int *const axis = p->box.axis;
    p->g = g;
    p->norm = 1.0;
    for (int i = 0; i < 6; i++)
        p->side[i] = side[i];
    for (int i = 0; i < 3; i++) {
        p->n[i] = p->box.n[i];
        if (i < 2 && p->n[i] > 1) {
            p->t[i] = transform_create(p->n[i], side[2 * axis[i]], side[2 * axis[i] + 1]);
            p->norm *= p->t[i]->norm;
        }
    }
    const int nx = p->n[0], ny = p->n[1];
    p->lambda = xalloc((size_t)nx * ny, sizeof(double));
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++)
            p->lambda[i + (size_t)nx * j] =
                eigenvalue(p, axis[0], p->t[0], i) + eigenvalue(p, axis[1], p->t[1], j);
    pad_lambda(p);
    p->layers = xalloc((size_t)p->n[2], sizeof *p->layers);
    const size_t lines = 4 * (size_t)(nx > ny ? nx : ny);
    p->scratch_size = 64 * (lines + 2 * SWEEP_PACKS * (size_t)p->n[2] + 8);
    p->scratch_size += 64 * ((size_t)p->n[2] / 8 + 1);
    return p;
}

void poisson_free(struct poisson *p)
{
    if (!p)
        return;
    transform_free(p->t[0]);
    transform_free(p->t[1]);
    void *const all[] = {
        p->lambda, p->lambda_wide[0], p->lambda_wide[1], p->work, p->layers, p->scratch, p};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

bool poisson_singular(const struct poisson *p, double shift)
{
    for (int side = 0; side < 6; side++)
        if (dirichlet(p, side))
            return false;
    return shift == 0.0;
}

void poisson_prepare(struct poisson *p, const double *flat, const double *up, double shift,
                     bool single)
{
    const size_t size = (size_t)p->width[single] * p->n[1] * p->n[2] *
                        (single ? sizeof(float) : sizeof(double));
    if (size > p->work_size) {
        xfree(p->work);
        p->work = xalloc(size, 1);
        p->work_size = size;
    }
    const double scale = 1.0 / (p->g->h[2] * p->g->h[2]);
    const int n = p->n[2];
    const bool periodic = p->side[Z_LO] == POISSON_PERIODIC;
    for (int k = 1; k <= n; k++) {
        struct layer l = {.below = up[k] * scale, .above = up[k + 1] * scale, .flat = flat[k]};
        double side = 0.0;
        if (k == 1 && !periodic) {
            side += dirichlet(p, Z_LO) ? 2.0 * l.below : 0.0;
            l.below = 0.0;
        }
        if (k == n && !periodic) {
            side += dirichlet(p, Z_HI) ? 2.0 * l.above : 0.0;
            l.above = 0.0;
        }
        l.diagonal = l.below + l.above + side + shift;
        p->layers[k - 1] = l;
    }
    if (periodic && n == 1)
        p->layers[0] = (struct layer){.diagonal = shift, .flat = flat[1]};
    p->singular = poisson_singular(p, shift);
    const int threads = omp_get_max_threads();
    if (threads > p->threads) {
        xfree(p->scratch);
        p->scratch = xalloc((size_t)threads, p->scratch_size);
        p->threads = threads;
    }
}

void poisson_singular_column(const struct poisson *p, double *x)
{
    const struct layer *const l = p->layers;
    const int n = p->n[2];
    double mean = 0.0,
           new_mean = 0.0, *const pivot = (double *)xalloc((size_t)n, sizeof(double));
    for (int k = 0; k < n; k++)
        mean += x[k] / n;
    x[0] = 0.0; /* in place of the first equation */
    for (int k = 1; k < n; k++) {
        const double below = k > 1 ? l[k].below : 0.0;
        const double inverse = -1.0 / (l[k].diagonal + below * pivot[k - 1]);
        pivot[k] = l[k].above * inverse;
        x[k] = (x[k] - mean - below * x[k - 1]) * inverse;
    }
    for (int k = n - 2; k >= 1; k--)
        x[k] -= pivot[k] * x[k + 1];
    for (int k = 0; k < n; k++)
        new_mean += x[k] / n;
    for (int k = 0; k < n; k++)
        x[k] -= new_mean;
    xfree(pivot);
}

void poisson_layout(struct poisson *p, bool grid)
{
    p->start = grid ? p->box.grid_start : p->box.start;
    for (int i = 0; i < 3; i++)
        p->stride[i] = grid ? p->box.grid_s[i] : p->box.s[i];
}

void poisson_solve_double(struct poisson *p, const double *flat, const double *up, double shift,
                          const double *rhs, double *out, const struct poisson_hook *hook)
{
    poisson_prepare(p, flat, up, shift, false);
    poisson_layout(p, false);
    direct(p, rhs, out, hook);
}

void poisson_solve(struct poisson *p, const double *flat, const double *up, double shift,
                   const double *rhs, double *out)
{
    poisson_prepare(p, flat, up, shift, false);
    poisson_layout(p, true);
    direct(p, rhs, out, NULL);
}
