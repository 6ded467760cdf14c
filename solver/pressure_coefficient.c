/* pressure_coefficient.c - the coefficients of the variable-coefficient solve: their statistics, which choose
 * the preconditioner, and their scaled copy, see pressure_parts.h. */
#include "pressure_parts.h"

/* True if face i (1..n+1) of direction a passes nothing. */
static bool closed(const struct pressure *p, int a, int i)
{
    return (i == 1 && p->side[2 * a] == POISSON_NEUMANN) ||
           (i == p->g->n[a] + 1 && p->side[2 * a + 1] == POISSON_NEUMANN);
}

enum { SIDE = 8 }; /* of a row, side by side, which the compiler makes vectors of */

typedef double pack __attribute__((vector_size(8 * SIDE)));
typedef long pack_index __attribute__((vector_size(8 * SIDE)));

struct layer_sums {
    pack sum, square, least, most;
};

static inline pack smaller(pack a, pack b)
{
    const pack_index first = a < b;
    return (pack)(((pack_index)a & first) | ((pack_index)b & ~first));
}

/* Adds SIDE values to the sums and the extremes; 0 is no least. */
static inline void add_pack(struct layer_sums *s, pack x)
{
    const pack_index passes = x > 0.0;
    const pack infinite = (pack){0} + (double)INFINITY;
    s->sum += x;
    s->square += x * x;
    s->least =
        smaller((pack)(((pack_index)x & passes) | ((pack_index)infinite & ~passes)), s->least);
    s->most = -smaller(-x, -s->most);
}

static void add_row(struct layer_sums *into, const double *x, int n)
{
    struct layer_sums s = *into;
    pack here;
    int i = 0;
    for (; i + SIDE <= n; i += SIDE) {
        memcpy(&here, x + i, sizeof here);
        add_pack(&s, here);
    }
    if (i < n) {
        here = (pack){0};
        memcpy(&here, x + i, (size_t)(n - i) * sizeof *x);
        add_pack(&s, here);
    }
    *into = s;
}

static double total(pack x)
{
    double sum = 0.0;
    for (int l = 0; l < SIDE; l++)
        sum += x[l];
    return sum;
}

/* Sums over layer k, each face once: of c in x and y and of the face below in z, of squares;
 * extremes. */
static void layer_statistics(struct pressure *p, double *const c[3], int k)
{
    const struct grid *const g = p->g;
    const double count = (double)g->n[0] * g->n[1];
    struct layer_sums flat = {0}, up = {0};
    long faces = 0;
    for (int l = 0; l < SIDE; l++)
        flat.least[l] = up.least[l] = (double)INFINITY;
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
            add_row(axis == 2 ? &up : &flat, c[axis] + cell(g, lo, j, k), hi - lo + 1);
            faces += axis == 2 ? 0 : hi - lo + 1;
        }
    }
    p->least[k] = (double)INFINITY;
    p->most[k] = 0.0;
    for (int l = 0; l < SIDE; l++) {
        p->least[k] = fmin(p->least[k], fmin(flat.least[l], up.least[l]));
        p->most[k] = fmax(p->most[k], fmax(flat.most[l], up.most[l]));
    }
    if (k <= g->n[2]) {
        p->flat[k] = faces > 0 ? total(flat.sum) / (double)faces : 0.0;
        p->square[k] = faces > 0 ? total(flat.square) / (double)faces : 0.0;
    }
    p->up[k] = total(up.sum) / count;
}

struct statistics pressure_statistics(struct pressure *p, double *const c[3])
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
bool pressure_layered(const struct pressure *p, const struct statistics *s, double *const c[3])
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

void pressure_box_means(struct pressure *p)
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

/* The coefficients over h^2, times `scale`; sides as krylov.h wants them. */
void pressure_set_coefficients(struct pressure *p, struct krylov *w, double *const c[3],
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
