/* pressure.c - the loop around conjugate gradients (krylov.h) that keeps the solution and its
 * true residual in double precision [GolubYe99], [Strzodka06]; chooses the preconditioner by
 * the coefficient's statistics. */
#include "pressure.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "feasibility.h"
#include "krylov.h"

enum { MOST = 3000 }; /* iterations */

/* Chosen by measurement, see bench/kernels.c. */
static const double contrast_multigrid = 40.0, /* multigrid beats the direct solve */
    contrast_double = 1e3,                     /* single precision loses the differences */
    variance_layers = 0.1, /* within layers, of the whole: layer means are better below */
    drop_single = 1e-5;    /* of the residual, before it is taken anew */

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

struct pressure *pressure_create(const struct grid *g, const struct domain *d,
                                 const enum poisson_side side[6])
{
    struct pressure *const p = xalloc(1, sizeof *p);
    p->g = g;
    p->d = d;
    memcpy(p->side, side, sizeof p->side);
    box_create(&p->box, g);
    p->direct = poisson_create(g, side);
    double **const layers[] = {&p->flat, &p->up, &p->square, &p->least, &p->most};
    for (size_t i = 0; i < sizeof layers / sizeof layers[0]; i++)
        *layers[i] = xalloc((size_t)g->n[2] + 2, sizeof(double));
    p->part = xalloc(2 * (size_t)p->box.n[1] * p->box.n[2], sizeof(double));
    return p;
}

void pressure_free(struct pressure *p)
{
    if (!p)
        return;
    poisson_free(p->direct);
    krylov_single.free(p->krylov[0]);
    krylov_double.free(p->krylov[1]);
    void *const all[] = {p->flat, p->up, p->square, p->least, p->most, p->part, p};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

void pressure_lend(struct pressure *p, double *one, double *other)
{
    p->lent[0] = one;
    p->lent[1] = other;
}

void pressure_method(struct pressure *p, enum pressure_method method)
{
    p->method = method;
}

/* Few cells: one thread is quicker. */
static bool worth_threads(const struct pressure *p)
{
    return p->g->total > POISSON_SERIAL;
}

/* Ghosts of one side: the image, the cell inside, or its negative. */
static void side_ghosts(const struct pressure *p, int side, double *phi)
{
    const struct grid *const g = p->g;
    const int a = side / 2, b = a == 0 ? 1 : 0, c = a == 2 ? 1 : 2, n = g->n[a];
    const bool periodic = p->side[side] == POISSON_PERIODIC;
    const int inside = (side % 2 == (periodic ? 0 : 1) ? n : 1) * g->s[a];
    const int ghost = (side % 2 ? n + 1 : 0) * g->s[a];
    const double sign = p->side[side] == POISSON_DIRICHLET ? -1.0 : 1.0;
    const int from_image = periodic && side % 2 ? g->s[a] : inside;
#pragma omp for schedule(static)
    for (int k = 0; k <= g->n[c] + 1; k++)
        for (int j = 0; j <= g->n[b] + 1; j++) {
            const int at = j * g->s[b] + k * g->s[c];
            phi[at + ghost] = sign * phi[at + from_image];
        }
}

void pressure_ghosts(const struct pressure *p, double *phi)
{
#pragma omp parallel if (worth_threads(p))
    for (int side = 0; side < 6; side++) /* later directions fill edges and corners */
        side_ghosts(p, side, phi);
}

static long rows_of(const struct box *b)
{
    return (long)b->n[1] * b->n[2];
}

/* First cell of a row in fields of the grid and of the box. */
static int in_grid(const struct box *b, long row)
{
    return b->grid_start + (int)(row % b->n[1]) * b->grid_s[1] +
           (int)(row / b->n[1]) * b->grid_s[2];
}

static size_t in_box(const struct box *b, long row)
{
    return (size_t)b->start + (size_t)(row % b->n[1]) * b->s[1] +
           (size_t)(row / b->n[1]) * b->s[2];
}

static double sum_of(const double *part, long n)
{
    double sum = 0.0;
    for (long i = 0; i < n; i++)
        sum += part[i];
    return sum;
}

/* Sum of x over a row of a field of the grid, and of its squares; eight sums side by side. */
static double row_sum(const double *x, int stride, int n, bool squares)
{
    enum { SIDE = 8 };
    double sum[SIDE] = {0.0}, total = 0.0;
    int i = 0;
    for (; i + SIDE <= n; i += SIDE)
        for (int l = 0; l < SIDE; l++) {
            const double v = x[(size_t)(i + l) * stride];
            sum[l] += squares ? v * v : v;
        }
    for (; i < n; i++) {
        const double v = x[(size_t)i * stride];
        total += squares ? v * v : v;
    }
    for (int l = 0; l < SIDE; l++)
        total += sum[l];
    return total;
}

/* Norm of rhs; *mean: its mean. */
static double rhs_norm(const struct pressure *p, const double *rhs, double *mean)
{
    const struct box *const b = &p->box;
    const long rows = rows_of(b);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        p->part[row] = row_sum(rhs + in_grid(b, row), b->grid_s[0], b->n[0], true);
        p->part[rows + row] = row_sum(rhs + in_grid(b, row), b->grid_s[0], b->n[0], false);
    }
    *mean = sum_of(p->part + rows, rows) / ((double)b->n[0] * (double)rows);
    return sqrt(sum_of(p->part, rows));
}

double pressure_imbalance(const struct pressure *p, double shift, const double *rhs)
{
    const struct grid *const g = p->g;
    if (!poisson_singular(p->direct, shift))
        return 0.0;
    double sum = 0.0, size = 0.0;
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int c = cell(g, 1, j, k); c <= cell(g, g->n[0], j, k); c++) {
                sum += rhs[c];
                size += fabs(rhs[c]);
            }
    return size > 0.0 ? fabs(sum) / size : 0.0;
}

/* True if face i (1..n+1) of direction a passes nothing. */
static bool closed(const struct pressure *p, int a, int i)
{
    return (i == 1 && p->side[2 * a] == POISSON_NEUMANN) ||
           (i == p->g->n[a] + 1 && p->side[2 * a + 1] == POISSON_NEUMANN);
}

/* Sums over layer k, each face once: of c in x and y and of the face below in z, of squares;
 * extremes. */
static void layer_statistics(struct pressure *p, double *const c[3], int k)
{
    const struct grid *const g = p->g;
    const double count = (double)g->n[0] * g->n[1];
    double flat = 0.0, up = 0.0, square = 0.0, least = (double)INFINITY, most = 0.0;
    long faces = 0;
    for (int a = 0; a < (k <= g->n[2] ? 3 : 1); a++) {
        const int axis = k <= g->n[2] ? a : 2;
        if (axis == 2 &&
            (closed(p, 2, k) || (k > g->n[2] && p->side[Z_HI] == POISSON_PERIODIC)))
            continue;
        for (int j = 1; j <= g->n[1] + (axis == 1); j++) {
            if (axis == 1 && closed(p, 1, j))
                continue;
            const int lo = axis == 0 && closed(p, 0, 1) ? 2 : 1;
            const int hi = g->n[0] + (axis == 0 && !closed(p, 0, g->n[0] + 1));
            const double *const x = c[axis] + cell(g, 0, j, k);
            for (int i = lo; i <= hi; i++) {
                least = x[i] > 0.0 && x[i] < least ? x[i] : least;
                most = x[i] > most ? x[i] : most;
            }
            const double sum = row_sum(x + lo, 1, hi - lo + 1, false);
            *(axis == 2 ? &up : &flat) += sum;
            if (axis != 2) {
                square += row_sum(x + lo, 1, hi - lo + 1, true);
                faces += hi - lo + 1;
            }
        }
    }
    p->least[k] = least;
    p->most[k] = most;
    if (k <= g->n[2]) {
        p->flat[k] = faces > 0 ? flat / (double)faces : 0.0;
        p->square[k] = faces > 0 ? square / (double)faces : 0.0;
    }
    p->up[k] = up / count;
}

static struct statistics statistics(struct pressure *p, double *const c[3])
{
    const int n = p->g->n[2];
    struct statistics s = {.least = (double)INFINITY};
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (int k = 1; k <= n + 1; k++)
        layer_statistics(p, c, k);
    if (p->side[Z_HI] == POISSON_PERIODIC)
        p->up[n + 1] = p->up[1];
    double mean = 0.0, square = 0.0;
    for (int k = 1; k <= n + 1; k++) {
        s.least = fmin(s.least, p->least[k]);
        s.most = fmax(s.most, p->most[k]);
        if (k > n)
            continue;
        mean += p->flat[k] / n;
        square += p->square[k] / n;
        s.within += (p->square[k] - p->flat[k] * p->flat[k]) / n;
    }
    s.variance = square - mean * mean;
    s.scale = s.most > 0.0 ? 1.0 / s.most : 1.0;
    return s;
}

/* c is the same all over each layer, to round-off. */
static bool layered(const struct pressure *p, const struct statistics *s, double *const c[3])
{
    const struct grid *const g = p->g;
    const double within = 1e-13;
    bool same = s->within <= 1e-12 * (s->variance + s->most * s->most);
    for (int k = 1; same && k <= g->n[2]; k++)
        same = p->most[k] - p->least[k] <= within * p->most[k] || p->least[k] < p->most[k];
    if (!same)
        return false;
#pragma omp parallel for schedule(static) reduction(&& : same) if (worth_threads(p))
    for (int k = 1; k <= g->n[2] + 1; k++)
        for (int a = 0; a < 3; a++) {
            const bool inside = a == 2 ? !closed(p, 2, k) : k <= g->n[2] && g->n[a] > 1;
            const double mean = a == 2 ? p->up[k] : p->flat[k];
            for (int j = 1; j <= g->n[1] && inside && same; j++)
                for (int i = 1; i <= g->n[0]; i++)
                    if (!closed(p, a, a == 0 ? i : a == 1 ? j : k))
                        same = same && fabs(c[a][cell(g, i, j, k)] - mean) <= within * mean;
        }
    return same;
}

static void box_means(struct pressure *p)
{
    const int n = p->g->n[2];
    double flat = 0.0, up = 0.0;
    int faces = 0;
    for (int k = 1; k <= n + 1; k++) {
        flat += k <= n ? p->flat[k] / n : 0.0;
        if (!closed(p, 2, k) && !(k > n && p->side[Z_HI] == POISSON_PERIODIC)) {
            up += p->up[k];
            faces++;
        }
    }
    for (int k = 1; k <= n + 1; k++) {
        p->flat[k] = flat > 0.0 ? flat : up / faces;
        p->up[k] = faces > 0 ? up / faces : flat;
    }
}

/* Puts n values into a field of either precision. */
static void put(const struct krylov *w, void *field, size_t at, const double *x, int n)
{
    if (w->real == sizeof(float)) {
        float *const to = (float *)field + at;
        for (int i = 0; i < n; i++)
            to[i] = (float)x[i];
    } else {
        memcpy((double *)field + at, x, (size_t)n * sizeof *x);
    }
}

enum { SEGMENT = 512 }; /* of a row, converted at a time */

/* The coefficients over h^2, times `scale`; sides as krylov.h wants them. */
static void set_coefficients(struct pressure *p, struct krylov *w, double *const c[3],
                             double scale)
{
    const struct grid *const g = p->g;
    const struct box *const b = &p->box;
    for (int a = 0; a < 3; a++) {
        const int axis = b->axis[a],
                  last[3] = {b->n[0] + (a == 0), b->n[1] + (a == 1), b->n[2] + (a == 2)};
        const double factor = scale / (g->h[axis] * g->h[axis]);
        const double side[2] = {p->side[2 * axis] == POISSON_NEUMANN     ? 0.0
                                : p->side[2 * axis] == POISSON_DIRICHLET ? 2.0
                                                                         : 1.0,
                                p->side[2 * axis + 1] == POISSON_NEUMANN     ? 0.0
                                : p->side[2 * axis + 1] == POISSON_DIRICHLET ? 2.0
                                                                             : 1.0};
#pragma omp parallel for schedule(static) if (worth_threads(p))
        for (int row = 0; row < last[1] * last[2]; row++) {
            const int j = row % last[1], k = row / last[1];
            const double *const from =
                c[axis] + b->grid_start + j * b->grid_s[1] + k * b->grid_s[2];
            const size_t to = (size_t)b->start + (size_t)j * b->s[1] + (size_t)k * b->s[2];
            const int at_row = a == 1 ? j : k;
            double f = factor;
            if (a > 0)
                f *= at_row == 0 ? side[0] : at_row == b->n[a] ? side[1] : 1.0;
            double x[SEGMENT];
            for (int i0 = 0; i0 < last[0]; i0 += SEGMENT) {
                const int n = last[0] - i0 < SEGMENT ? last[0] - i0 : SEGMENT;
                for (int i = 0; i < n; i++)
                    x[i] = f * from[(size_t)(i0 + i) * b->grid_s[0]];
                if (a == 0 && i0 == 0)
                    x[0] *= side[0];
                if (a == 0 && i0 + n == last[0])
                    x[n - 1] *= side[1];
                put(w, w->c[a], to + i0, x, n);
            }
        }
    }
}

/* The true residual rhs - mean - A phi: its 2-norm; times `scale` into w->r if there is a w. */
static double residual(const struct pressure *p, double *const c[3], double shift,
                       const double *rhs, double mean, double *phi, double scale,
                       struct krylov *w)
{
    const struct grid *const g = p->g;
    const struct box *const b = &p->box;
    const double sx = 1.0 / (g->h[0] * g->h[0]), sy = 1.0 / (g->h[1] * g->h[1]);
    const double sz = 1.0 / (g->h[2] * g->h[2]);
    const int sj = g->sj, sk = g->sk, step = b->grid_s[0];
    const double *const cx = c[0], *const cy = c[1], *const cz = c[2];
    const long rows = rows_of(b);
    pressure_ghosts(p, phi);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        double r[SEGMENT], sum = 0.0;
        for (int i0 = 0; i0 < b->n[0]; i0 += SEGMENT) {
            const int n = b->n[0] - i0 < SEGMENT ? b->n[0] - i0 : SEGMENT;
            const int first = in_grid(b, row) + i0 * step;
            for (int i = 0; i < n; i++) {
                const int m = first + i * step;
                const double f = phi[m];
                r[i] = rhs[m] - mean + shift * f -
                       (sx * (cx[m + 1] * (phi[m + 1] - f) - cx[m] * (f - phi[m - 1])) +
                        sy * (cy[m + sj] * (phi[m + sj] - f) - cy[m] * (f - phi[m - sj])) +
                        sz * (cz[m + sk] * (phi[m + sk] - f) - cz[m] * (f - phi[m - sk])));
            }
            sum += row_sum(r, 1, n, true);
            for (int i = 0; i < n && w; i++)
                r[i] *= scale;
            if (w)
                put(w, w->r, in_box(b, row) + i0, r, n);
        }
        p->part[row] = sum;
    }
    return sqrt(sum_of(p->part, rows));
}

/* What round-off of phi alone leaves of the residual: 2-norm of the sum over faces of c |phi|. */
static double round_off(const struct pressure *p, double *const c[3], const double *phi)
{
    const struct grid *const g = p->g;
    const struct box *const b = &p->box;
    const long rows = rows_of(b);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        p->part[row] = 0.0;
        for (int i = 0; i < b->n[0]; i++) {
            const int m = in_grid(b, row) + i * b->grid_s[0];
            double sum = 0.0;
            for (int a = 0; a < 3; a++)
                sum += (c[a][m] * (fabs(phi[m]) + fabs(phi[m - g->s[a]])) +
                        c[a][m + g->s[a]] * (fabs(phi[m]) + fabs(phi[m + g->s[a]]))) /
                       (g->h[a] * g->h[a]);
            p->part[row] += sum * sum;
        }
    }
    return DBL_EPSILON * sqrt(sum_of(p->part, rows));
}

/* phi += factor x, x = 0 */
static void take_correction(const struct pressure *p, struct krylov *w, double factor,
                            double *phi)
{
    const struct box *const b = &p->box;
    const long rows = rows_of(b);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        double *const to = phi + in_grid(b, row);
        const size_t at = in_box(b, row);
        if (w->real == sizeof(float)) {
            float *const x = (float *)w->x + at;
            for (int i = 0; i < b->n[0]; i++) {
                to[(size_t)i * b->grid_s[0]] += factor * (double)x[i];
                x[i] = 0.0F;
            }
        } else {
            double *const x = (double *)w->x + at;
            for (int i = 0; i < b->n[0]; i++) {
                to[(size_t)i * b->grid_s[0]] += factor * x[i];
                x[i] = 0.0;
            }
        }
    }
}

static enum pressure_method choose(const struct pressure *p, const struct statistics *s)
{
    if (p->method != PRESSURE_AUTO)
        return p->method;
    if (s->within <= variance_layers * s->variance)
        return PRESSURE_LAYERS;
    return s->most > contrast_multigrid * s->least ? PRESSURE_MULTIGRID : PRESSURE_BOX;
}

static struct krylov *krylov_for(struct pressure *p, bool in_double)
{
    const struct box *const b = &p->box;
    bool periodic[3];
    for (int a = 0; a < 3; a++)
        periodic[a] = p->side[2 * b->axis[a]] == POISSON_PERIODIC;
    const struct krylov_kind *const kind = in_double ? &krylov_double : &krylov_single;
    struct krylov **const w = &p->krylov[in_double];
    if (!*w)
        *w = kind->create(b, periodic, p->direct, p->lent[0] ? p->lent : NULL);
    return *w;
}

/* One direct solve of the residual, as a change of phi; what is left of it. */
static double solve_directly(struct pressure *p, double *const c[3], double shift,
                             const double *rhs, double mean, double *phi)
{
    struct krylov scratch = {.real = sizeof(double), .r = p->lent[0], .x = p->lent[1]};
    struct krylov *const w = p->lent[0] ? &scratch : krylov_for(p, true);
    residual(p, c, shift, rhs, mean, phi, 1.0, w);
    poisson_solve_double(p->direct, p->flat, p->up, shift, w->r, w->x, NULL);
    take_correction(p, w, 1.0, phi);
    return residual(p, c, shift, rhs, mean, phi, 1.0, NULL);
}

/* Conjugate gradients from the residual that `w` holds, in rounds: each takes the true residual
 * anew. Stops where a round no longer gains. */
static void iterate(struct pressure *p, double *const c[3], double shift, const double *rhs,
                    double mean, double *phi, double target, const struct statistics *s,
                    bool in_double, double unit, struct solve *result)
{
    struct krylov *const w = krylov_for(p, in_double);
    const struct krylov_kind *const kind = in_double ? &krylov_double : &krylov_single;
    const bool multigrid = result->method == PRESSURE_MULTIGRID;
    set_coefficients(p, w, c, s->scale);
    w->shift = shift * s->scale;
    for (int k = 1; k <= p->g->n[2] + 1; k++) {
        w->flat[k] = p->flat[k] * s->scale;
        w->up[k] = p->up[k] * s->scale;
    }
    if (multigrid)
        kind->coarsen(w);
    bool fresh = true;
    double before;
    do {
        before = result->end;
        const double goal = fmax(0.7 * target, in_double ? 0.0 : drop_single * before);
        double end;
        result->iterations +=
            kind->solve(w, multigrid, fresh, goal * unit, MOST - result->iterations, &end);
        take_correction(p, w, s->scale / unit, phi);
        result->end = residual(p, c, shift, rhs, mean, phi, unit, w);
        fresh = false;
    } while (result->end > target && result->end < 0.5 * before && result->iterations < MOST);
}

struct solve pressure_solve(struct pressure *p, double *const c[3], double shift,
                            const double *rhs, double *phi, double tolerance, double floor)
{
    const struct statistics s = statistics(p, c);
    double mean;
    const double size = rhs_norm(p, rhs, &mean), unit = size > 0.0 ? 1.0 / size : 1.0;
    mean = poisson_singular(p->direct, shift) ? mean : 0.0;
    const double target = fmax(tolerance * size, floor);
    struct solve result = {.method = choose(p, &s), .contrast = s.most / s.least};
    bool in_double = result.contrast > contrast_double;
    if (!in_double)
        krylov_single.start(krylov_for(p, false));
    result.start = result.end =
        residual(p, c, shift, rhs, mean, phi, unit, krylov_for(p, in_double));
    if (result.end > target && p->method == PRESSURE_AUTO && layered(p, &s, c)) {
        for (; result.iterations < 3 && result.end > target; result.iterations++)
            result.end = solve_directly(p, c, shift, rhs, mean, phi);
    } else {
        if (result.method == PRESSURE_BOX)
            box_means(p);
        for (; result.end > target && result.iterations < MOST; in_double = true) {
            iterate(p, c, shift, rhs, mean, phi, target, &s, in_double, unit, &result);
            if (in_double)
                break; /* round-off: no better */
            if (result.end > target)
                residual(p, c, shift, rhs, mean, phi, unit, krylov_for(p, true));
        }
    }
    result.converged = result.end <= target || result.end <= round_off(p, c, phi);
    pressure_ghosts(p, phi);
    return result;
}

void pressure_feasibility(const struct grid *g, struct feasibility *f)
{
    for (int a = 0; a < 2; a++)
        if (transform_largest_prime(g->n[a]) > TRANSFORM_QUICK) {
            char name[64], note[96];
            snprintf(name, sizeof name, "cells in %c, largest prime factor", 'x' + a);
            snprintf(note, sizeof note,
                     "the pressure solve is quicker with %d cells than with %d",
                     transform_good_size(g->n[a]), g->n[a]);
            feasibility_add(f, name, "1", transform_largest_prime(g->n[a]), TRANSFORM_QUICK,
                            false, note);
        }
}
