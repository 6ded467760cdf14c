/* momentum.c - convection and viscous stress on the staggered grid [HarlowWelch65], second
 * order.
 *
 *   convection  -rho div(eps u u_a): the volume flux through a face of the control volume is
 *               the mean of the two faces beside it; u_a there is the mean (centred), the
 *               upwind value, or that with half of van Leer's slope [vanLeer74]. On a side of
 *               the box it is the value there.
 *   stress      tau = mu (grad u + grad u^T - 2/3 div u I); with constant mu and form a,
 *               div tau = mu (laplace(u) + grad(div u)/3), also on the grid
 *
 * On the face of an open side nothing changes along the normal: no convection, and of the
 * stress no flux through the side. What flows back in comes from rest outside, at the pressure
 * -rho u^2/2 (Bernoulli), so that a backflow feeds no energy in.
 *
 * Each thread takes a run of rows; the flux through the upper face of a row is kept as the
 * lower one of the next row, that of a layer for the next layer. A flux is computed by the same
 * formula wherever a run begins, so the bits do not depend on the number of threads. */
#include "momentum_rows.h"

#include <omp.h>
#include <string.h>
#include "diffusion.h"
#include "fluid_state.h"

#define INLINE static inline __attribute__((always_inline))

void momentum_create(struct momentum *m, const struct sim *s, enum convection scheme,
                     enum form form, bool implicit)
{
    const struct grid *const g = &s->grid;
    m->scheme = scheme;
    m->form = form;
    m->implicit = implicit;
    for (int b = 0; b < 3; b++) {
        const struct side *const side = &s->domain.side[2 * b];
        const bool slip = side[0].kind == SIDE_SLIP && side[1].kind == SIDE_SLIP;
        m->skip[b] = g->n[b] == 1 && (s->domain.periodic[b] || slip);
    }
    m->threads = omp_get_max_threads();
    m->share = (size_t)g->sj * (3 * (size_t)(g->n[1] + 2) + 3 + 5) + 64;
    m->buffer = xalloc(m->share * (size_t)m->threads, sizeof(double));
}

void momentum_free(struct momentum *m)
{
    xfree(m->buffer);
}

/* u on the face between u0 and u1, where w flows from u0 to u1 */
INLINE double carried(enum convection scheme, double um, double u0, double u1, double u2,
                      double w)
{
    if (scheme == CONVECTION_CENTRED)
        return 0.5 * (u0 + u1);
    const double up = w > 0.0 ? u0 : u1;
    if (scheme == CONVECTION_UPWIND)
        return up;
    const double ahead = w > 0.0 ? u1 - u0 : u0 - u1, behind = w > 0.0 ? u0 - um : u1 - u2;
    const double product = ahead * behind;
    const double slope = product > 0.0 ? product / (ahead + behind) : 0.0; /* half of it */
    return up + slope;
}

/* The rows that a flux is made of: u before, below, above and beyond the face, and the
 * velocities beside it with the fluid fractions above and, `step` before, below them. */
struct flux {
    const double *um, *u0, *u1, *u2, *v1, *v2, *e1, *e2;
    int step;
    double scale; /* rho/(2 h) */
};

INLINE double volume(const struct flux *f, bool porous, int i)
{
    return porous ? grid_face(f->e1, i, f->step) * f->v1[i] +
                        grid_face(f->e2, i, f->step) * f->v2[i]
                  : f->v1[i] + f->v2[i];
}

INLINE double flux_one(const struct flux *f, bool porous, enum convection scheme, int i,
                       double um, double u2)
{
    const double w = f->scale * volume(f, porous, i);
    return w * carried(scheme, um, f->u0[i], f->u1[i], u2, w);
}

INLINE void flux_loop(const struct flux *f, bool porous, enum convection scheme, int first,
                      int last, double *restrict out)
{
    for (int i = first; i <= last; i++)
        out[i] = flux_one(f, porous, scheme, i, f->um[i], f->u2[i]);
}

static void flux_row(const struct flux *f, bool porous, enum convection scheme, int first,
                     int last, double *out)
{
    if (scheme == CONVECTION_CENTRED) {
        if (porous)
            flux_loop(f, true, CONVECTION_CENTRED, first, last, out);
        else
            flux_loop(f, false, CONVECTION_CENTRED, first, last, out);
    } else if (scheme == CONVECTION_VAN_LEER) {
        if (porous)
            flux_loop(f, true, CONVECTION_VAN_LEER, first, last, out);
        else
            flux_loop(f, false, CONVECTION_VAN_LEER, first, last, out);
    } else if (porous) {
        flux_loop(f, true, CONVECTION_UPWIND, first, last, out);
    } else {
        flux_loop(f, false, CONVECTION_UPWIND, first, last, out);
    }
}

/* The rows of the flux beyond row (j, k) of component a, in direction b. */
static struct flux flux_rows(const struct sim *s, int a, int b, int j, int k, bool porous)
{
    const struct grid *const g = &s->grid;
    const int c = cell(g, 0, j, k), sb = g->s[b], n = g->n[b];
    const double *const u = s->fluid.u[a] + c, *const v = s->fluid.u[b] + c;
    const int near = a == b ? 0 : sb, far = a == b ? sb : sb - g->s[a];
    struct flux f = {.um = u - sb,
                     .u0 = u,
                     .u1 = u + sb,
                     .u2 = u + 2 * sb,
                     .v1 = v + near,
                     .v2 = v + far,
                     .scale = 0.5 * s->fluid.rho / g->h[b]};
    const int at = b == 0 ? 1 : b == 1 ? j : k;
    if (porous) { /* face 0 is face n */
        f.step = sb;
        f.e1 = s->fluid.eps + c + (a == b && at == 0 ? n * sb : near);
        f.e2 = s->fluid.eps + c + far;
    }
    if (b == 0)
        return f; /* its ends: flux_ends */
    if (at == 0)
        f.um = s->domain.periodic[b] ? u + (n - 1) * sb : u;
    if (at == n)
        f.u2 = s->domain.periodic[b] ? u + (2 - n) * sb : f.u1;
    return f;
}

/* Along x: the first and the last flux of a row, whose neighbours wrap around or do not exist.
 */
static void flux_ends(const struct sim *s, const struct flux *f, bool porous,
                      enum convection scheme, int a, double *out)
{
    const int n = s->grid.n[0];
    const double *const u = f->u0;
    if (s->domain.periodic[0]) {
        out[n] = flux_one(f, porous, scheme, n, u[n - 1], u[2]);
        out[0] = out[n];
    } else if (a == 0) {
        out[n] = flux_one(f, porous, scheme, n, u[n - 1], u[n + 1]);
    } else { /* on the sides themselves */
        out[0] = flux_one(f, porous, CONVECTION_CENTRED, 0, 0.0, 0.0);
        out[n] = flux_one(f, porous, CONVECTION_CENTRED, n, 0.0, 0.0);
    }
}

/* out[i], i = first - 1 (along x) or first, to last: rho w u_a/h through the upper face in
 * direction b of the control volumes of row (j, k) of component a. */
static void upper_flux(const struct sim *s, const struct momentum *m, int a, int b, int j,
                       int k, bool porous, double *out)
{
    const int at[3] = {0, j, k};
    const int first = inside_first(s, a, 0) - (b == 0), last = inside_last(s, 0);
    const bool rim =
        b > 0 && a != b && !s->domain.periodic[b] && (at[b] == 0 || at[b] == s->grid.n[b]);
    const enum convection scheme = rim ? CONVECTION_CENTRED : m->scheme;
    const struct flux f = flux_rows(s, a, b, j, k, porous);
    flux_row(&f, porous, scheme, first, last, out);
    if (b == 0)
        flux_ends(s, &f, porous, scheme, a, out);
}

struct scratch momentum_scratch(const struct momentum *m, const struct grid *g, long first)
{
    double *at = m->buffer + m->share * (size_t)omp_get_thread_num();
    struct scratch t = {.first = first};
    for (int a = 0; a < 3; a++) {
        t.layer[a] = at;
        at += (size_t)g->sj * (g->n[1] + 2);
        t.row[a] = at;
        at += g->sj;
    }
    double **const rows[] = {&t.fx, &t.fy, &t.fz, &t.rest, &t.laplace};
    for (int i = 0; i < 5; i++, at += g->sj)
        *rows[i] = at;
    return t;
}

struct fluxes momentum_fluxes(const struct sim *s, const struct momentum *m,
                              const struct scratch *t, int a, int j, int k, bool porous)
{
    const struct grid *const g = &s->grid;
    const long row = (long)(k - 1) * g->n[1] + (j - 1);
    const bool kept[2] = {row > t->first && j > inside_first(s, a, 1),
                          row - g->n[1] >= t->first && k > inside_first(s, a, 2)};
    struct fluxes f = {.fx = t->fx,
                       .low = {t->row[a], t->layer[a] + (size_t)g->sj * j},
                       .high = {t->fy, t->fz}};
    if (!m->skip[0])
        upper_flux(s, m, a, 0, j, k, porous, f.fx);
    for (int b = 1; b < 3; b++) {
        if (m->skip[b])
            continue;
        if (!kept[b - 1])
            upper_flux(s, m, a, b, b == 1 ? j - 1 : j, b == 2 ? k - 1 : k, porous,
                       f.low[b - 1]);
        upper_flux(s, m, a, b, j, k, porous, f.high[b - 1]);
    }
    return f;
}

void momentum_keep(const struct grid *g, const struct fluxes *f)
{
    for (int b = 0; b < 2; b++)
        memcpy(f->low[b], f->high[b], (size_t)g->sj * sizeof(double));
}

/* New velocities of row (j, k), see momentum_plain. */
static void plain_row(const struct sim *s, const struct momentum *m, const struct fluxes *f,
                      int a, int j, int k, const double *restrict laplace, const double ab[2],
                      double *restrict old, double *restrict out)
{
    const struct grid *const g = &s->grid;
    const int c = cell(g, 0, j, k), last = inside_last(s, 0), sa = g->s[a];
    const double drive[3] = {s->flow.gradient.x, s->flow.gradient.y, s->flow.gradient.z};
    const double *const restrict u = s->fluid.u[a] + c, *const restrict p = s->fluid.p + c;
    const double *const restrict fx = f->fx, *const restrict yl = f->low[0];
    const double *const restrict yh = f->high[0], *const restrict zl = f->low[1];
    const double *const restrict zh = f->high[1];
    const double step = s->fluid.dt / s->fluid.rho, inv = 1.0 / g->h[a], push = drive[a];
    const double now = ab[0], before = ab[1], viscous = m->implicit ? 0.0 : 1.0;
    const double times = m->implicit ? 2.0 : 1.0;
    for (int i = inside_first(s, a, 0); i <= last; i++) {
        const double R =
            viscous * laplace[i] - ((fx[i] - fx[i - 1]) + (yh[i] - yl[i]) + (zh[i] - zl[i]));
        out[i] =
            times * u[i] + step * (now * R + before * old[i] + push - (p[i] - p[i - sa]) * inv);
        old[i] = R;
    }
}

double momentum_back(const struct sim *s, int a, int end, int c)
{
    const double u = s->fluid.u[a][c], inwards = end ? -u : u;
    return inwards > 0.0 ? -s->fluid.rho * u * fabs(u) / s->grid.h[a] : 0.0;
}

static void plain_open(const struct sim *s, const struct momentum *m, int a, const double ab[2],
                       double *old, double *out)
{
    const struct grid *const g = &s->grid;
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    const double step = s->fluid.dt / s->fluid.rho, viscous = m->implicit ? 0.0 : 1.0;
    const double times = m->implicit ? 2.0 : 1.0;
    for (int end = 0; end < 2; end++) {
        if (!side_open(&s->domain, 2 * a + end))
            continue;
        for (int k = 1; k <= g->n[d]; k++)
            for (int j = 1; j <= g->n[b]; j++) {
                const int c = (end ? g->n[a] + 1 : 1) * g->s[a] + j * g->s[b] + k * g->s[d];
                const double R =
                    viscous * diffusion_open(s, m, FORM_A, a, end, c, s->fluid.u[a]) +
                    momentum_back(s, a, end, c);
                out[c] = times * s->fluid.u[a][c] +
                         step * (ab[0] * R + ab[1] * old[c] -
                                 fluid_gradient(s, s->fluid.p, a, end, c));
                old[c] = R;
            }
    }
}

void momentum_rows(const struct grid *g, long *lo, long *hi)
{
    const long rows = (long)g->n[1] * g->n[2];
    const int threads = omp_get_num_threads(), me = omp_get_thread_num();
    *lo = rows * me / threads;
    *hi = rows * (me + 1) / threads;
}

void momentum_plain(const struct sim *s, const struct momentum *m, double now, double before,
                    double *const old[3], double *const out[3])
{
    const struct grid *const g = &s->grid;
    const double ab[2] = {now, before};
#pragma omp parallel num_threads(m->threads) if (s->grid.total > GRID_SMALL)
    {
        long lo, hi;
        momentum_rows(g, &lo, &hi);
        const struct scratch t = momentum_scratch(m, g, lo);
        for (long row = lo; row < hi; row++) {
            const int j = (int)(row % g->n[1]) + 1, k = (int)(row / g->n[1]) + 1;
            for (int a = 0; a < 3; a++) {
                if (j < inside_first(s, a, 1) || k < inside_first(s, a, 2))
                    continue;
                const int c = cell(g, 0, j, k);
                const struct fluxes f = momentum_fluxes(s, m, &t, a, j, k, false);
                if (!m->implicit)
                    diffusion_row(s, m, FORM_A, a, j, k, s->fluid.u[a], t.laplace);
                plain_row(s, m, &f, a, j, k, t.laplace, ab, old[a] + c, out[a] + c);
                momentum_keep(g, &f);
            }
        }
    }
    for (int a = 0; a < 3; a++)
        plain_open(s, m, a, ab, old[a], out[a]);
}
