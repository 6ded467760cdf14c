/* fluid_guard.c - continuity and Courant number of the fluid, row by row; stops a run whose
 * velocities cannot be right. */
#include "fluid_state.h"

/* Largest |x|, NAN if one is not finite; eight at a time, which the compiler makes vectors of. */
static double largest(const double *restrict x, int n)
{
    double most[8] = {0}, sum[8] = {0}, all = 0.0, total = 0.0;
    int i = 0;
    for (; i + 8 <= n; i += 8)
        for (int l = 0; l < 8; l++) {
            const double size = fabs(x[i + l]);
            most[l] = size > most[l] ? size : most[l];
            sum[l] += size;
        }
    for (; i < n; i++) {
        const double size = fabs(x[i]);
        most[0] = size > most[0] ? size : most[0];
        sum[0] += size;
    }
    for (int l = 0; l < 8; l++) {
        all = most[l] > all ? most[l] : all;
        total += sum[l];
    }
    return total <= 1e300 ? all : (double)NAN;
}

/* out[i] = d(eps)/dt + div(eps u) of a row. */
static void divergence_row(const struct sim *s, int j, int k, double *restrict out)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const int n = g->n[0], c = cell(g, 0, j, k), sj = g->sj, sk = g->sk;
    const double *const restrict u = f->u[0] + c, *const restrict v = f->u[1] + c;
    const double *const restrict w = f->u[2] + c;
    const double x = 1.0 / g->h[0], y = 1.0 / g->h[1], z = 1.0 / g->h[2];
    if (f->bare) {
        for (int i = 1; i <= n; i++)
            out[i] = (u[i + 1] - u[i]) * x + (v[i + sj] - v[i]) * y + (w[i + sk] - w[i]) * z;
        return;
    }
    const double *const restrict e = f->eps + c;
    const double *const restrict change = (f->rate ? f->rate : f->eps) + c;
    const double *const restrict old = f->eps_old + c;
    const double now = f->rate ? 1.0 : 1.0 / f->dt, before = f->rate ? 0.0 : 1.0;
    for (int i = 1; i <= n; i++)
        out[i] = (change[i] - before * old[i]) * now +
                 (grid_face(e, i + 1, 1) * u[i + 1] - grid_face(e, i, 1) * u[i]) * x +
                 (grid_face(e, i + sj, sj) * v[i + sj] - grid_face(e, i, sj) * v[i]) * y +
                 (grid_face(e, i + sk, sk) * w[i + sk] - grid_face(e, i, sk) * w[i]) * z;
}

/* Largest velocity of a row over h, 1/s; NAN if one is not finite. */
static double fastest_of_row(const struct sim *s, int j, int k)
{
    const int c = cell(&s->grid, 1, j, k), n = s->grid.n[0];
    double most = 0.0;
    for (int a = 0; a < 3; a++) {
        const double here = largest(s->fluid.u[a] + c, n) / s->grid.h[a];
        most = here <= most ? most : here;
    }
    return most;
}

double fluid_divergences(const struct sim *s, double scale, double *out)
{
    const struct grid *const g = &s->grid;
    const int rows = g->n[1] * g->n[2];
    double most = 0.0;
#pragma omp parallel for schedule(static) reduction(max : most) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        const int j = row % g->n[1] + 1, k = row / g->n[1] + 1;
        double *const restrict at = out + cell(g, 0, j, k);
        divergence_row(s, j, k, at);
        if (!s->fluid.bare)
            most = fmax(most, fastest_of_row(s, j, k));
        for (int i = 1; i <= g->n[0]; i++)
            at[i] *= scale;
    }
    return most;
}

static _Noreturn void die_velocity(const struct sim *s, int i, int j, int k, double courant)
{
    const struct grid *const g = &s->grid;
    const int c = cell(g, i, j, k);
    int a = 0;
    for (int b = 1; b < 3; b++)
        if (!(fabs(s->fluid.u[b][c]) / g->h[b] <= fabs(s->fluid.u[a][c]) / g->h[a]))
            a = b;
    const double u = s->fluid.u[a][c];
    if (!isfinite(u))
        die(EXIT_UNSTABLE,
            "the velocity of the fluid is not finite in cell %d %d %d (centre %.4g %.4g %.4g "
            "m) at t = %.9g s; take a shorter fluid.dt",
            i, j, k, (i - 0.5) * g->h[0], (j - 0.5) * g->h[1], (k - 0.5) * g->h[2], s->t);
    die(EXIT_UNSTABLE,
        "the Courant number is %.3g in cell %d %d %d (centre %.4g %.4g %.4g m, %c velocity "
        "%.4g m/s, fluid fraction %.3g) at t = %.9g s: more than %g; take fluid.dt below %.3g "
        "s",
        courant, i, j, k, (i - 0.5) * g->h[0], (j - 0.5) * g->h[1], (k - 0.5) * g->h[2],
        'x' + a, u, s->fluid.bare ? 1.0 : s->fluid.eps[c], s->t, COURANT_MOST,
        COURANT_MOST * s->fluid.dt / courant);
}

/* Largest Courant number of a row; NAN if one is not finite. */
static double courant_row(const struct sim *s, int j, int k, double *restrict scratch)
{
    const struct grid *const g = &s->grid;
    const int c = cell(g, 0, j, k), n = g->n[0];
    const double *const restrict u = s->fluid.u[0] + c, *const restrict v = s->fluid.u[1] + c;
    const double *const restrict w = s->fluid.u[2] + c, dt = s->fluid.dt;
    const double x = dt / g->h[0], y = dt / g->h[1], z = dt / g->h[2];
    for (int i = 1; i <= n; i++)
        scratch[i] = fabs(u[i]) * x + fabs(v[i]) * y + fabs(w[i]) * z;
    return largest(scratch + 1, n);
}

static double courant_of(const struct sim *s, int i, int j, int k)
{
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        sum += fabs(s->fluid.u[a][cell(&s->grid, i, j, k)]) * s->fluid.dt / s->grid.h[a];
    return sum;
}

/* The first cell that breaks the limit is named. */
static void find_culprit(const struct sim *s, double limit)
{
    for (int k = 1; k <= s->grid.n[2]; k++)
        for (int j = 1; j <= s->grid.n[1]; j++)
            for (int i = 1; i <= s->grid.n[0]; i++)
                if (!(courant_of(s, i, j, k) <= limit))
                    die_velocity(s, i, j, k, courant_of(s, i, j, k));
}

void fluid_guard(struct sim *s, bool limited)
{
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const double limit = limited ? COURANT_MOST : 1e300;
    const int rows = g->n[1] * g->n[2];
    double fastest = 0.0, worst = 0.0, courant = 0.0;
    int broken = 0;
#pragma omp parallel reduction(max                                                             \
                               : fastest, worst, courant,                                      \
                                 broken) if (s->grid.total > GRID_SMALL)
    {
        double *const row_of = xalloc((size_t)g->sj, sizeof *row_of);
#pragma omp for schedule(static)
        for (int row = 0; row < rows; row++) {
            const int j = row % g->n[1] + 1, k = row / g->n[1] + 1;
            const double here = courant_row(s, j, k, row_of);
            fastest = fmax(fastest, here / f->dt);
            divergence_row(s, j, k, row_of);
            worst = fmax(worst, largest(row_of + 1, g->n[0]));
            courant = fmax(courant, here);
            broken = !(here <= limit) ? 1 : broken;
        }
        xfree(row_of);
    }
    if (broken)
        find_culprit(s, limit);
    f->courant = courant;
    f->divergence = fastest > 0.0 ? worst / fastest : 0.0;
}
