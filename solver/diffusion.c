/* diffusion.c - the viscous Laplacian, and Crank and Nicolson's scheme for it [CrankNicolson47]
 * by conjugate gradients [HestenesStiefel52], scaled with the diagonal.
 *
 * Form a is divided by eps, which makes it symmetric: (rho/dt + B/eps - mu laplace/2); forms b
 * and c are so: (rho eps/dt + B - div(eps mu grad)/2). The control volume of a face on an open
 * side is half a cell; with that weight its row is symmetric too.
 *
 * Without grains A is even, and a direct solve (helmholtz.h) takes the place of the iterations: for
 * w = u_new + u, whose equation knows no Laplacian of u,
 *     (1 - L/2A) w = x + u,   u_new = w - u
 * with w = 2 u on the sides, u being that of the middle of the step. */
#include "diffusion.h"

#include <string.h>
#include "fluid_state.h"

#define INLINE static inline __attribute__((always_inline))

enum { MOST = 1000 }; /* iterations */

void diffusion_create(struct diffusion *d, const struct sim *s)
{
    for (int a = 0; a < 3 && s->fluid.bare; a++)
        d->direct[a] = helmholtz_create(&s->grid, &s->domain, a);
    if (s->fluid.bare)
        return;
    d->r = grid_field(&s->grid);
    d->d = grid_field(&s->grid);
    d->q = grid_field(&s->grid);
    d->part = xalloc((size_t)(s->grid.n[1] + 1) * (s->grid.n[2] + 1), sizeof *d->part);
}

void diffusion_free(struct diffusion *d)
{
    for (int a = 0; a < 3; a++)
        helmholtz_free(d->direct[a]);
    void *const all[] = {d->r, d->d, d->q, d->part};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

void diffusion_row(const struct sim *s, const struct momentum *m, enum form form, int a, int j,
                   int k, const double *field, double *restrict out)
{
    const struct grid *const g = &s->grid;
    const int c = cell(g, 0, j, k), first = inside_first(s, a, 0), last = inside_last(s, 0);
    const double *const restrict u = field + c;
    const int sj = m->skip[1] ? 0 : g->sj, sk = m->skip[2] ? 0 : g->sk, si = !m->skip[0];
    if (form == FORM_A) {
        const double cx = s->fluid.mu / (g->h[0] * g->h[0]);
        const double cy = s->fluid.mu / (g->h[1] * g->h[1]);
        const double cz = s->fluid.mu / (g->h[2] * g->h[2]);
        for (int i = first; i <= last; i++)
            out[i] = cx * (u[i - si] - 2.0 * u[i] + u[i + si]) +
                     cy * (u[i - sj] - 2.0 * u[i] + u[i + sj]) +
                     cz * (u[i - sk] - 2.0 * u[i] + u[i + sk]);
        return;
    }
    const double *const restrict e = s->fluid.eps + c;
    const int sa = g->s[a];
    for (int i = first; i <= last; i++)
        out[i] = 0.0;
    for (int b = 0; b < 3; b++) {
        const int sb = g->s[b];
        if (m->skip[b])
            continue;
        const double full = s->fluid.mu / (g->h[b] * g->h[b]), quarter = 0.25 * full;
        if (b == a)
            for (int i = first; i <= last; i++)
                out[i] += full * (e[i] * (u[i + sb] - u[i]) - e[i - sa] * (u[i] - u[i - sb]));
        else
            for (int i = first; i <= last; i++) {
                const double pair = e[i] + e[i - sa];
                const double high = pair + e[i + sb] + e[i + sb - sa];
                const double low = pair + e[i - sb] + e[i - sb - sa];
                out[i] += quarter * (high * (u[i + sb] - u[i]) - low * (u[i] - u[i - sb]));
            }
    }
}

double diffusion_open(const struct sim *s, const struct momentum *m, enum form form, int a,
                      int end, int c, const double *u)
{
    const struct grid *const g = &s->grid;
    const int sa = g->s[a];
    const bool even = form == FORM_A;
    const double *const e = s->fluid.eps;
    double sum = 2.0 * (even ? 1.0 : e[end ? c - sa : c]) * (u[end ? c - sa : c + sa] - u[c]) /
                 (g->h[a] * g->h[a]);
    for (int b = 0; b < 3; b++) {
        const int sb = g->s[b];
        if (b == a || m->skip[b])
            continue;
        const double pair = even ? 0.0 : e[c] + e[c - sa];
        const double high = even ? 1.0 : 0.25 * (pair + e[c + sb] + e[c + sb - sa]);
        const double low = even ? 1.0 : 0.25 * (pair + e[c - sb] + e[c - sb - sa]);
        sum += (high * (u[c + sb] - u[c]) - low * (u[c] - u[c - sb])) / (g->h[b] * g->h[b]);
    }
    return s->fluid.mu * sum;
}

/* The diagonal of a row of faces: A = rho eps/dt + B, over eps for form a. */
struct diagonal {
    const double *e, *before, *B;
    double rate,
        even; /* kg/(m3 s): rho/dt; mu sum 1/h2: half of L's in cells of even size, away from sides */
    bool form_a;
};

static struct diagonal diagonal_of_row(const struct sim *s, const struct momentum *m, int a,
                                       int row)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    struct diagonal d = {f->eps + row, f->eps + row - g->s[a], f->drag[a] + row, f->rho / f->dt,
                         0.0,          m->form == FORM_A};
    for (int b = 0; b < 3; b++)
        d.even += m->skip[b] ? 0.0 : f->mu / (g->h[b] * g->h[b]);
    return d;
}

INLINE double diagonal_at(const struct diagonal *d, bool form_a, int i)
{
    const double eps = 0.5 * (d->e[i] + d->before[i]);
    return form_a ? d->rate + d->B[i] / eps : d->rate * eps + d->B[i];
}

/* That of A - L/2, which scales the residual. */
INLINE double scale_at(const struct diagonal *d, bool form_a, int i)
{
    const double eps = 0.5 * (d->e[i] + d->before[i]);
    return form_a ? 1.0 / (d->rate + d->B[i] / eps + d->even)
                  : 1.0 / (d->rate * eps + d->B[i] + eps * d->even);
}

/* A run over the rows of faces of component a that are solved for, those of open sides too; a
 * row's faces are c + i, i = first..last; the first and last may have half the weight. */
struct run_of_faces {
    int c, first, last;
    bool half_row, half_first, half_last;
};

static bool faces_of_row(const struct sim *s, int a, int j, int k, struct run_of_faces *r)
{
    const struct grid *const g = &s->grid;
    const bool wrap = s->domain.periodic[a];
    const bool low = !wrap && side_open(&s->domain, 2 * a);
    const bool high = !wrap && side_open(&s->domain, 2 * a + 1);
    const int at[3] = {0, j, k};
    *r = (struct run_of_faces){.c = cell(g, 0, j, k), .first = 1, .last = g->n[0]};
    if (a == 0) {
        r->first = wrap || low ? 1 : 2;
        r->last = g->n[0] + high;
        r->half_first = low;
        r->half_last = high;
        return true;
    }
    const bool edge = !wrap && (at[a] == 1 || at[a] == g->n[a] + 1);
    r->half_row = edge;
    return edge ? at[a] == 1 ? low : high : at[a] <= g->n[a];
}

static int rows_of(const struct sim *s, int a)
{
    return face_last(&s->grid, a, 1) * face_last(&s->grid, a, 2);
}

static void row_at(const struct sim *s, int a, int row, int *j, int *k)
{
    *j = row % face_last(&s->grid, a, 1) + 1;
    *k = row / face_last(&s->grid, a, 1) + 1;
}

/* x . y over the faces of a row, each with its volume. */
static double row_dot(const struct run_of_faces *r, const double *x, const double *y)
{
    double lane[8] = {0}, sum = 0.0;
    int i = r->c + r->first;
    for (; i + 7 <= r->c + r->last; i += 8)
        for (int l = 0; l < 8; l++)
            lane[l] += x[i + l] * y[i + l];
    for (; i <= r->c + r->last; i++)
        sum += x[i] * y[i];
    for (int l = 0; l < 8; l++)
        sum += lane[l];
    const int lo = r->c + r->first, hi = r->c + r->last;
    sum -= r->half_first ? 0.5 * x[lo] * y[lo] : 0.0;
    sum -= r->half_last ? 0.5 * x[hi] * y[hi] : 0.0;
    return r->half_row ? 0.5 * sum : sum;
}

static double add_rows(const struct diffusion *d, int rows)
{
    double sum = 0.0;
    for (int row = 0; row < rows; row++)
        sum += d->part[row];
    return sum;
}

/* out = L u of a row; the faces of open sides by themselves */
static void laplace_of_row(const struct sim *s, const struct momentum *m, int a, int j, int k,
                           const struct run_of_faces *r, const double *u, double *out)
{
    if (r->half_row) {
        const int end = a == 1 ? j > 1 : k > 1;
        for (int i = r->first; i <= r->last; i++)
            out[i] = diffusion_open(s, m, m->form, a, end, r->c + i, u);
        return;
    }
    diffusion_row(s, m, m->form, a, j, k, u, out);
    if (r->half_first)
        out[r->first] = diffusion_open(s, m, m->form, a, 0, r->c + r->first, u);
    if (r->half_last)
        out[r->last] = diffusion_open(s, m, m->form, a, 1, r->c + r->last, u);
}

/* r = A (x - u) + L u, d = 0; returns r . r/A^2, the square of a change of velocity. */
static double first_residual(const struct sim *s, const struct momentum *m, struct diffusion *d,
                             int a, const double *x, const double *u)
{
    const int rows = rows_of(s, a);
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        struct run_of_faces r;
        int j, k;
        row_at(s, a, row, &j, &k);
        d->part[row] = 0.0;
        if (!faces_of_row(s, a, j, k, &r))
            continue;
        laplace_of_row(s, m, a, j, k, &r, u, d->r + r.c);
        const struct diagonal w = diagonal_of_row(s, m, a, r.c);
        double *const restrict res = d->r + r.c, *const restrict q = d->q + r.c;
        const double *const restrict to = x + r.c, *const restrict from = u + r.c;
        for (int i = r.first; i <= r.last; i++) {
            const double A = w.form_a ? diagonal_at(&w, true, i) : diagonal_at(&w, false, i);
            res[i] += A * (to[i] - from[i]);
            q[i] = res[i] / A;
        }
        memset(d->d + r.c + r.first, 0, (size_t)(r.last - r.first + 1) * sizeof(double));
        d->part[row] = row_dot(&r, d->q, d->q);
    }
    return add_rows(d, rows);
}

/* z = r scaled, in q; returns r . z. With alpha, before that, u += alpha d, r -= alpha q. */
static double scaled(const struct sim *s, const struct momentum *m, struct diffusion *d, int a,
                     double alpha, double *u)
{
    const int rows = rows_of(s, a);
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        struct run_of_faces r;
        int j, k;
        row_at(s, a, row, &j, &k);
        d->part[row] = 0.0;
        if (!faces_of_row(s, a, j, k, &r))
            continue;
        double *const restrict res = d->r + r.c, *const restrict q = d->q + r.c;
        double *const restrict x = u + r.c;
        const double *const restrict way = d->d + r.c;
        const struct diagonal w = diagonal_of_row(s, m, a, r.c);
        for (int i = r.first; i <= r.last; i++) {
            const double left = res[i] - alpha * q[i];
            x[i] += alpha * way[i];
            res[i] = left;
            q[i] = left * (w.form_a ? scale_at(&w, true, i) : scale_at(&w, false, i));
        }
        d->part[row] = row_dot(&r, d->q, d->r);
    }
    return add_rows(d, rows);
}

/* d = z + beta d */
static void turn(const struct sim *s, struct diffusion *d, int a, double beta)
{
    const int rows = rows_of(s, a);
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        struct run_of_faces r;
        int j, k;
        row_at(s, a, row, &j, &k);
        if (faces_of_row(s, a, j, k, &r))
            for (int c = r.c + r.first; c <= r.c + r.last; c++)
                d->d[c] = d->q[c] + beta * d->d[c];
    }
}

/* q = (A - L/2) d; returns d . q */
static double apply(const struct sim *s, const struct momentum *m, struct diffusion *d, int a)
{
    const int rows = rows_of(s, a);
    fluid_ghosts_of_change(s, a, d->d);
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        struct run_of_faces r;
        int j, k;
        row_at(s, a, row, &j, &k);
        d->part[row] = 0.0;
        if (!faces_of_row(s, a, j, k, &r))
            continue;
        laplace_of_row(s, m, a, j, k, &r, d->d, d->q + r.c);
        const struct diagonal w = diagonal_of_row(s, m, a, r.c);
        double *const restrict q = d->q + r.c;
        const double *const restrict way = d->d + r.c;
        for (int i = r.first; i <= r.last; i++)
            q[i] = (w.form_a ? diagonal_at(&w, true, i) : diagonal_at(&w, false, i)) * way[i] -
                   0.5 * q[i];
        d->part[row] = row_dot(&r, d->d, d->q);
    }
    return add_rows(d, rows);
}

/* A direct solve of component a. */
struct plain {
    const struct sim *s;
    int a;
    double *sum; /* m/s, x + u, then w, then u_new */
    double nu;   /* m2, half of mu over A */
};

/* w on a side, half of it: along the side the velocity of a wall; across it (u: on the side) what
 * is given there. False where the side does not hold w, or holds it at 0: most of them, whose cells in memory
 * are better left alone. */
static bool side_holds(const struct plain *q, int side, double *along)
{
    const struct side *const e = &q->s->domain.side[side];
    const double wall[3] = {e->velocity.x, e->velocity.y, e->velocity.z};
    *along = wall[q->a];
    return side / 2 == q->a ? e->kind == SIDE_INFLOW || e->kind == SIDE_FLUX
                            : e->kind == SIDE_WALL && *along != 0.0;
}

/* What the sides add to row (j, k). */
static void add_sides(const void *with, int j, int k, int first, int last)
{
    const struct plain *const q = with;
    const struct grid *const g = &q->s->grid;
    const int at[3] = {0, j, k}, row = cell(g, 0, j, k);
    for (int side = 0; side < 6; side++) {
        const int b = side / 2, end = side % 2, beyond = end ? g->s[b] : -g->s[b];
        const int inside = end ? g->n[b] : b == q->a ? 2 : 1;
        const double c = 2.0 * q->nu / (g->h[b] * g->h[b]);
        double along;
        if ((b > 0 && at[b] != inside) || !side_holds(q, side, &along))
            continue;
        const double *const u = q->s->fluid.u[q->a] + row + beyond;
        const double weight = b == q->a && g->n[b] == 1 ? 2.0 : 1.0; /* beside an open side */
        for (int i = b > 0 ? first : inside; i <= (b > 0 ? last : inside); i++)
            q->sum[row + i] += weight * c * (b == q->a ? u[i] : 2.0 * along);
    }
}

static void subtract_old(const void *with, int j, int k, int first, int last)
{
    const struct plain *const q = with;
    const int row = cell(&q->s->grid, 0, j, k);
    const double *const restrict u = q->s->fluid.u[q->a] + row;
    double *const restrict sum = q->sum + row;
    for (int i = first; i <= last; i++)
        sum[i] -= u[i];
}

void diffusion_direct(const struct sim *s, const struct diffusion *d, int a, double *sum)
{
    const double nu = 0.5 * s->fluid.mu * s->fluid.dt / s->fluid.rho;
    const struct plain q = {s, a, sum, nu};
    const struct helmholtz_hook hook = {add_sides, subtract_old, &q};
    helmholtz_solve(d->direct[a], 1.0, nu, sum, &hook);
}

int diffusion_solve(const struct sim *s, const struct momentum *m, struct diffusion *d, int a,
                    const double *x, double *u, double tolerance)
{
    if (first_residual(s, m, d, a, x, u) == 0.0)
        return 0;
    double rz = scaled(s, m, d, a, 0.0, u), beta = 0.0;
    const double target = tolerance * tolerance * rz;
    int n = 0;
    while (rz > target) {
        if (++n > MOST)
            die(EXIT_UNSTABLE,
                "the implicit viscosity has not converged at t = %.9g s: residual %.3g of its "
                "start after %d iterations",
                s->t, sqrt(rz / target) * tolerance, MOST);
        turn(s, d, a, beta);
        const double dq = apply(s, m, d, a);
        if (!(dq > 0.0))
            break;
        const double rz_new = scaled(s, m, d, a, rz / dq, u);
        beta = rz_new / rz;
        rz = rz_new;
    }
    return n;
}
