/* projection.c - prediction, correction and stress, see projection.h and
 * solver/fluid/navier_stokes.c. On inside faces the pressure of the two cells, on those of open
 * sides that of the cell inside, half a cell away from p = 0. */
#include "projection.h"

#include "fluid_state.h"

static double component(vec3 v, int a)
{
    return a == 0 ? v.x : a == 1 ? v.y : v.z;
}

/* Rows of faces of component a, counted; those at the ends of y and z included. */
static int rows_of(const struct sim *s, int a)
{
    return face_last(&s->grid, a, 1) * face_last(&s->grid, a, 2);
}

static void row_at(const struct sim *s, int a, int row, int *j, int *k)
{
    *j = row % face_last(&s->grid, a, 1) + 1;
    *k = row / face_last(&s->grid, a, 1) + 1;
}

static bool row_inside(const struct sim *s, int a, int j, int k)
{
    return j >= inside_first(s, a, 1) && k >= inside_first(s, a, 2) && j <= s->grid.n[1] &&
           k <= s->grid.n[2];
}

/* Face c of an open side of direction a (end 0: low, 1: high). */
struct open_face {
    int a, end, c;
};

/* The faces of one side across direction a, counted. */
static int open_faces(const struct sim *s, int a)
{
    return s->grid.n[(a + 1) % 3] * s->grid.n[(a + 2) % 3];
}

static struct open_face open_at(const struct sim *s, int a, int end, int n)
{
    const struct grid *const g = &s->grid;
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    const int j = n % g->n[b] + 1, k = n / g->n[b] + 1;
    return (struct open_face){a, end,
                              (end ? g->n[a] + 1 : 1) * g->s[a] + j * g->s[b] + k * g->s[d]};
}

struct predict {
    double now, before, drive;
    const double *R;
    double *old, *x;
};

static void predict_open(const struct sim *s, const struct predict *q, struct open_face o)
{
    const struct fluid *const f = &s->fluid;
    const int c = o.c, a = o.a, sa = s->grid.s[a];
    const double rate = f->rho / f->dt, m = grid_face(f->eps, c, sa),
                 A = rate * m + f->drag[a][c];
    const double m_old = 0.5 * (f->eps_old[c] + f->eps_old[c - sa]);
    const double R = q->R[c], g = f->whole_pressure ? 1.0 : m;
    q->x[c] = (rate * m_old * f->u[a][c] + q->now * R + q->before * q->old[c] -
               g * fluid_gradient(s, f->p, a, o.end, c) + f->drag_s[a][c]) /
              A;
    q->old[c] = R;
}

static void predict_row(const struct sim *s, int a, const struct predict *q, int j, int k)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const grid = &s->grid;
    const int at = cell(grid, 0, j, k), sa = grid->s[a], last = grid->n[0];
    const double *const restrict u = f->u[a] + at, *const restrict p = f->p + at;
    const double *const restrict e = f->eps + at, *const restrict e_old = f->eps_old + at;
    const double *const restrict B = f->drag[a] + at, *const restrict S = f->drag_s[a] + at;
    const double *const Rs = q->R + at; /* may be x */
    double *const xs = q->x + at, *const restrict old = q->old + at;
    const double rate = f->rho / f->dt, inv = 1.0 / grid->h[a], now = q->now;
    const double before = q->before, drive = q->drive, whole = f->whole_pressure ? 1.0 : 0.0;
#pragma omp simd
    for (int i = inside_first(s, a, 0); i <= last; i++) {
        const double m = 0.5 * (e[i] + e[i - sa]), m_old = 0.5 * (e_old[i] + e_old[i - sa]);
        const double g = m + whole * (1.0 - m), R = Rs[i];
        xs[i] = (rate * m_old * u[i] + now * R + before * old[i] +
                 g * (drive - (p[i] - p[i - sa]) * inv) + S[i]) /
                (rate * m + B[i]);
        old[i] = R;
    }
}

static void coefficient_row(const struct sim *s, int a, double *w, int j, int k)
{
    const struct fluid *const f = &s->fluid;
    const int at = cell(&s->grid, 0, j, k), last = face_last(&s->grid, a, 0), sa = s->grid.s[a];
    const double rate = f->rho / f->dt, whole = f->whole_pressure ? 1.0 : 0.0;
    const double *const restrict e = f->eps + at, *const restrict B = f->drag[a] + at;
    double *const restrict out = w + at;
    for (int i = 1; i <= last; i++) {
        const double m = 0.5 * (e[i] + e[i - sa]), g = m + whole * (1.0 - m);
        out[i] = m * g / (rate * m + B[i]);
    }
}

void projection_predict(const struct sim *s, int a, double now, double before, const double *R,
                        double *old, double *x, double *w)
{
    const struct predict q = {now, before, component(s->flow.gradient, a), R, old, x};
    const int rows = rows_of(s, a), faces = open_faces(s, a);
    for (int end = 0; end < 2; end++)
        if (side_open(&s->domain, 2 * a + end))
            for (int n = 0; n < faces; n++)
                predict_open(s, &q, open_at(s, a, end, n));
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        int j, k;
        row_at(s, a, row, &j, &k);
        if (row_inside(s, a, j, k))
            predict_row(s, a, &q, j, k);
        if (w)
            coefficient_row(s, a, w, j, k);
    }
}

void projection_coefficient(const struct sim *s, int a, double *w)
{
    const int rows = rows_of(s, a);
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        int j, k;
        row_at(s, a, row, &j, &k);
        coefficient_row(s, a, w, j, k);
    }
}

static void correct_row(struct sim *s, int a, const double *w, const double *pressure, int j,
                        int k)
{
    const struct grid *const g = &s->grid;
    const int at = cell(g, 0, j, k), sa = g->s[a], last = g->n[0],
              first = inside_first(s, a, 0);
    double *const restrict u = s->fluid.u[a] + at;
    const double *const restrict dp = pressure + at, inv = 1.0 / g->h[a];
    if (!w) {
        const double step = s->fluid.dt / s->fluid.rho * inv;
        for (int i = first; i <= last; i++)
            u[i] -= step * (dp[i] - dp[i - sa]);
        return;
    }
    const double *const restrict e = s->fluid.eps + at, *const restrict q = w + at;
    for (int i = first; i <= last; i++)
        u[i] -= 2.0 * inv * q[i] / (e[i] + e[i - sa]) * (dp[i] - dp[i - sa]);
}

static void correct_open(struct sim *s, const double *w, const double *dp, struct open_face o)
{
    const struct fluid *const f = &s->fluid;
    const double step = w ? w[o.c] / grid_face(f->eps, o.c, s->grid.s[o.a]) : f->dt / f->rho;
    f->u[o.a][o.c] -= step * fluid_gradient(s, dp, o.a, o.end, o.c);
}

static void add_pressure(struct sim *s, const double *dp)
{
    const struct grid *const g = &s->grid;
    const int rows = g->n[1] * g->n[2];
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        const int at = cell(g, 0, row % g->n[1] + 1, row / g->n[1] + 1);
        double *const restrict p = s->fluid.p + at;
        const double *const restrict more = dp + at;
        for (int i = 1; i <= g->n[0]; i++)
            p[i] += more[i];
    }
    grid_ghosts(g, &s->domain, s->fluid.p);
}

void projection_correct(struct sim *s, double *const w[3], const double *dp)
{
    const struct grid *const g = &s->grid;
    const int rows = g->n[1] * g->n[2];
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        const int j = row % g->n[1] + 1, k = row / g->n[1] + 1;
        for (int a = 0; a < 3; a++)
            if (row_inside(s, a, j, k))
                correct_row(s, a, w ? w[a] : NULL, dp, j, k);
        if (!w) {
            const int at = cell(g, 0, j, k);
            double *const restrict p = s->fluid.p + at;
            for (int i = 1; i <= g->n[0]; i++)
                p[i] += dp[at + i];
        }
    }
    for (int side = 0; side < 6; side++)
        if (side_open(&s->domain, side))
            for (int n = 0; n < open_faces(s, side / 2); n++)
                correct_open(s, w ? w[side / 2] : NULL, dp, open_at(s, side / 2, side % 2, n));
    if (!w)
        grid_ghosts(g, &s->domain, s->fluid.p);
}

static void stress_row(struct sim *s, int a, const double *change, int j, int k)
{
    const struct grid *const g = &s->grid;
    const int at = cell(g, 0, j, k), sa = g->s[a];
    double *const restrict G = s->fluid.stress[a] + at;
    const double *const restrict p = s->fluid.p + at, *const restrict dp = change + at;
    const double inv = 1.0 / g->h[a], drive = component(s->flow.gradient, a);
    const double viscous = s->coupling.forces.viscous, pressure = s->coupling.forces.pressure;
    for (int i = inside_first(s, a, 0); i <= g->n[0]; i++)
        G[i] =
            viscous * G[i] + pressure * (drive - (p[i] + dp[i] - p[i - sa] - dp[i - sa]) * inv);
}

/* On an open side as inside; where the velocity is given, what balances the drag: 0 on a wall. */
static void stress_on_side(struct sim *s, int side, const double *dp)
{
    struct fluid *const f = &s->fluid;
    const int a = side / 2, end = side % 2;
    const enum side_kind kind = s->domain.side[side].kind;
    const bool open = side_open(&s->domain, side), inflow = kind == SIDE_INFLOW;
    const double viscous = s->coupling.forces.viscous, pressure = s->coupling.forces.pressure;
    for (int n = 0; n < open_faces(s, a); n++) {
        const int c = open_at(s, a, end, n).c;
        const double g = f->whole_pressure ? 1.0 : grid_face(f->eps, c, s->grid.s[a]);
        double *const G = &f->stress[a][c];
        if (open)
            *G = viscous * *G - pressure * (fluid_gradient(s, f->p, a, end, c) +
                                            fluid_gradient(s, dp, a, end, c));
        else
            *G = inflow ? pressure * (f->drag[a][c] * f->u[a][c] - f->drag_s[a][c]) / g : 0.0;
    }
}

static void wrap_stress(struct sim *s, int a)
{
    const struct grid *const g = &s->grid;
    for (int n = 0; n < open_faces(s, a); n++) {
        const int c = open_at(s, a, 0, n).c;
        s->fluid.stress[a][c + g->n[a] * g->s[a]] = s->fluid.stress[a][c];
    }
}

void projection_stress(struct sim *s, const double *dp)
{
    for (int a = 0; a < 3; a++) {
        const int rows = s->grid.n[1] * s->grid.n[2];
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
        for (int row = 0; row < rows; row++) {
            const int j = row % s->grid.n[1] + 1, k = row / s->grid.n[1] + 1;
            if (row_inside(s, a, j, k))
                stress_row(s, a, dp, j, k);
        }
        if (s->domain.periodic[a]) {
            wrap_stress(s, a);
        } else {
            stress_on_side(s, 2 * a, dp);
            stress_on_side(s, 2 * a + 1, dp);
        }
    }
    add_pressure(s, dp);
}

/* Sums over the cells: of m u (its low face), and of w, of component a; rows by rows. */
static void sums_of(const struct sim *s, int a, const double *w, double *flow, double *give)
{
    const struct grid *const g = &s->grid;
    const int rows = g->n[1] * g->n[2];
    double *const part = xalloc(2 * (size_t)rows, sizeof *part);
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        const int at = cell(g, 0, row % g->n[1] + 1, row / g->n[1] + 1);
        for (int i = 1; i <= g->n[0]; i++) {
            const double m = s->fluid.bare ? 1.0 : grid_face(s->fluid.eps, at + i, g->s[a]);
            part[2 * row] += m * s->fluid.u[a][at + i];
            part[2 * row + 1] += w ? w[at + i] : s->fluid.dt / s->fluid.rho;
        }
    }
    *flow = *give = 0.0;
    for (int row = 0; row < rows; row++) {
        *flow += part[2 * row];
        *give += part[2 * row + 1];
    }
    xfree(part);
}

/* u += w/m push */
static void push_rows(struct sim *s, int a, const double *w, double push)
{
    const struct grid *const g = &s->grid;
    const int rows = g->n[1] * g->n[2];
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        const int at = cell(g, 0, row % g->n[1] + 1, row / g->n[1] + 1);
        for (int c = at + 1; c <= at + g->n[0]; c++)
            s->fluid.u[a][c] += push * (w ? w[c] / grid_face(s->fluid.eps, c, g->s[a])
                                          : s->fluid.dt / s->fluid.rho);
    }
}

double projection_rate_off(const struct sim *s)
{
    const double cells = (double)s->grid.n[0] * s->grid.n[1] * s->grid.n[2];
    double most = 0.0;
    for (int a = 0; a < 3; a++) {
        double through, give;
        if (!s->domain.periodic[a])
            continue;
        sums_of(s, a, NULL, &through, &give);
        most = fmax(most, fabs(through / cells - component(s->flow.held_rate, a)));
    }
    return most;
}

void projection_hold(struct sim *s, double *const w[3])
{
    struct flow *const flow = &s->flow;
    double *const gradient[3] = {&flow->gradient.x, &flow->gradient.y, &flow->gradient.z};
    const double cells = (double)s->grid.n[0] * s->grid.n[1] * s->grid.n[2];
    for (int a = 0; a < 3; a++) {
        if (!s->domain.periodic[a])
            continue;
        double through, give;
        sums_of(s, a, w ? w[a] : NULL, &through, &give);
        const double push = (component(flow->held_rate, a) * cells - through) / give;
        *gradient[a] += push;
        push_rows(s, a, w ? w[a] : NULL, push);
    }
}
