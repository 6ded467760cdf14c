/* fluid_guard.c - continuity and Courant number of the fluid, row by row; stops a run whose
 * velocities cannot be right. */
#include "fluid_state.h"

double fluid_divergence(const struct sim *s, int c)
{
    const struct fluid *const f = &s->fluid;
    double sum = f->bare ? 0.0 : f->rate ? f->rate[c] : (f->eps[c] - f->eps_old[c]) / f->dt;
    for (int a = 0; a < 3; a++) {
        const int up = c + s->grid.s[a];
        const double hi = f->bare ? f->u[a][up] : f->eps_f[a][up] * f->u[a][up];
        const double lo = f->bare ? f->u[a][c] : f->eps_f[a][c] * f->u[a][c];
        sum += (hi - lo) / s->grid.h[a];
    }
    return sum;
}

/* out[i] = d(eps)/dt + div(eps u) of a row; returns the largest flow through a face over h. */
static double divergence_row(const struct sim *s, int j, int k, double *restrict out)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const int n = g->n[0], c = cell(g, 0, j, k);
    double most = 0.0;
    if (f->bare)
        for (int i = 1; i <= n; i++)
            out[i] = 0.0;
    else if (f->rate)
        for (int i = 1; i <= n; i++)
            out[i] = f->rate[c + i];
    else
        for (int i = 1; i <= n; i++)
            out[i] = (f->eps[c + i] - f->eps_old[c + i]) / f->dt;
    for (int a = 0; a < 3; a++) {
        const double *const restrict u = f->u[a] + c, inv = 1.0 / g->h[a];
        const double *const restrict m = f->bare ? u : f->eps_f[a] + c;
        const int sa = g->s[a];
        double fast = 0.0;
        if (f->bare)
#pragma omp simd reduction(max : fast)
            for (int i = 1; i <= n; i++) {
                out[i] += (u[i + sa] - u[i]) * inv;
                fast = fmax(fast, fabs(u[i]));
            }
        else
#pragma omp simd reduction(max : fast)
            for (int i = 1; i <= n; i++) {
                out[i] += (m[i + sa] * u[i + sa] - m[i] * u[i]) * inv;
                fast = fmax(fast, fabs(m[i] * u[i]));
            }
        most = fmax(most, fast * inv);
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
        most = fmax(most, divergence_row(s, j, k, at));
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
static double courant_row(const struct sim *s, int j, int k)
{
    const struct grid *const g = &s->grid;
    const int c = cell(g, 0, j, k), n = g->n[0];
    const double *const restrict u = s->fluid.u[0] + c, *const restrict v = s->fluid.u[1] + c;
    const double *const restrict w = s->fluid.u[2] + c, dt = s->fluid.dt;
    const double x = dt / g->h[0], y = dt / g->h[1], z = dt / g->h[2];
    double most = 0.0;
    int bad = 0;
#pragma omp simd reduction(max : most) reduction(| : bad)
    for (int i = 1; i <= n; i++) {
        const double courant = fabs(u[i]) * x + fabs(v[i]) * y + fabs(w[i]) * z;
        most = fmax(most, courant);
        bad |= !(courant <= 1e300);
    }
    return bad ? (double)NAN : most;
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
            const double here = courant_row(s, j, k);
            double error = 0.0;
            fastest = fmax(fastest, divergence_row(s, j, k, row_of));
#pragma omp simd reduction(max : error)
            for (int i = 1; i <= g->n[0]; i++)
                error = fmax(error, fabs(row_of[i]));
            worst = fmax(worst, error);
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
