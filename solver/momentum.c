/* momentum.c - convection and viscous stress on the staggered grid [HarlowWelch65], second
 * order.
 *
 *   convection  -rho div(eps u u_a): the volume flux through a face of the control volume is
 * the mean of the two faces beside it; u_a there is the mean (centred), the upwind value, or
 * the upwind value with half of van Leer's slope [vanLeer74] stress      tau = mu (grad u +
 * grad u^T - 2/3 div u I), at centres and edges On the face of an open side the flow does not
 * change along the normal: no convection, and of the stress the part across. */
#include "momentum.h"

#include "fluid_state.h"

void momentum_create(struct momentum *m, const struct grid *g, enum convection scheme)
{
    m->scheme = scheme;
    m->slope = grid_field(g);
    m->div = grid_field(g);
}

void momentum_free(struct momentum *m)
{
    xfree(m->slope);
    xfree(m->div);
}

bool face_solved(const struct sim *s, int a, int i)
{
    if (s->domain.periodic[a])
        return i <= s->grid.n[a];
    if (i == 1)
        return side_open(&s->domain, 2 * a);
    if (i == s->grid.n[a] + 1)
        return side_open(&s->domain, 2 * a + 1);
    return true;
}

static double van_leer(double a, double b)
{
    return a * b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
}

/* Slopes of u along direction b, where both neighbours exist; 0 on the rim, wrapped if
 * periodic. */
static void slopes(const struct sim *s, const struct momentum *m, const double *u, int a, int b)
{
    const struct grid *const g = &s->grid;
    const int step = g->s[b];
    const int last[3] = {face_last(g, a, 0), face_last(g, a, 1), face_last(g, a, 2)};
    const bool rim =
        a == b && !s->domain.periodic[b]; /* its last face has no neighbour beyond */
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= last[2]; k++)
        for (int j = 1; j <= last[1]; j++)
            for (int i = 1; i <= last[0]; i++) {
                const int c = cell(g, i, j, k), n = b == 0 ? i : b == 1 ? j : k;
                const bool inside = n <= g->n[b] && !(rim && n == 1);
                m->slope[c] = inside ? van_leer(u[c] - u[c - step], u[c + step] - u[c]) : 0.0;
            }
    const int c1 = (b + 1) % 3, c2 = (b + 2) % 3;
    for (int k = 1; k <= face_last(g, a, c2); k++)
        for (int j = 1; j <= face_last(g, a, c1); j++) {
            const int at = j * g->s[c1] + k * g->s[c2], n = g->n[b];
            const bool wrap = s->domain.periodic[b];
            m->slope[at] = wrap ? m->slope[at + n * step] : 0.0;
            if (wrap || a != b)
                m->slope[at + (n + 1) * step] = wrap ? m->slope[at + step] : 0.0;
        }
}

/* u on the face between c and c + step, where the volume flux is w */
static double advected(const struct momentum *m, const double *u, int c, int step, double w)
{
    if (m->scheme == CONVECTION_CENTRED)
        return 0.5 * (u[c] + u[c + step]);
    const double half = m->scheme == CONVECTION_VAN_LEER ? 0.5 : 0.0;
    return w > 0.0 ? u[c] + half * m->slope[c] : u[c + step] - half * m->slope[c + step];
}

void momentum_convection(const struct sim *s, struct momentum *m, int a, double *out)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const double *const u = f->u[a];
    const int sa = g->s[a];
    const int last[3] = {face_last(g, a, 0), face_last(g, a, 1), face_last(g, a, 2)};
    for (size_t c = 0; c < g->total; c++)
        out[c] = 0.0;
    for (int b = 0; b < 3; b++) {
        const int sb = g->s[b];
        const double *const v = f->u[b], *const e = f->eps_f[b];
        const double scale = f->rho / g->h[b];
        if (m->scheme == CONVECTION_VAN_LEER)
            slopes(s, m, u, a, b);
#pragma omp parallel for schedule(static)
        for (int k = 1; k <= last[2]; k++)
            for (int j = 1; j <= last[1]; j++)
                for (int i = 1; i <= last[0]; i++) {
                    const int c = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                    if (!face_solved(s, a, n) ||
                        (!s->domain.periodic[a] && (n == 1 || n == g->n[a] + 1)))
                        continue;
                    /* volume fluxes through the low and high face of the control volume */
                    const int lo_1 = a == b ? c - sb : c - sa, hi_1 = a == b ? c : c + sb - sa;
                    const int lo_2 = c, hi_2 = c + sb;
                    const double w_lo = 0.5 * (e[lo_1] * v[lo_1] + e[lo_2] * v[lo_2]);
                    const double w_hi = 0.5 * (e[hi_1] * v[hi_1] + e[hi_2] * v[hi_2]);
                    out[c] -= scale * (w_hi * advected(m, u, c, sb, w_hi) -
                                       w_lo * advected(m, u, c - sb, sb, w_lo));
                }
    }
}

void momentum_dilatation(const struct sim *s, struct momentum *m)
{
    const struct grid *const g = &s->grid;
    double *const *const u = s->fluid.u;
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int c = cell(g, i, j, k);
                m->div[c] = 0.0;
                for (int b = 0; b < 3; b++)
                    m->div[c] += (u[b][c + g->s[b]] - u[b][c]) / g->h[b];
            }
    grid_ghosts(g, &s->domain, m->div);
}

void momentum_viscous(const struct sim *s, const struct momentum *m, int a, double *out)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const double *const u = f->u[a];
    const int sa = g->s[a];
    const double ha = g->h[a];
    const int last[3] = {face_last(g, a, 0), face_last(g, a, 1), face_last(g, a, 2)};
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= last[2]; k++)
        for (int j = 1; j <= last[1]; j++)
            for (int i = 1; i <= last[0]; i++) {
                const int c = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                const bool inside =
                    s->domain.periodic[a] ? n <= g->n[a] : n > 1 && n <= g->n[a];
                double sum = 0.0;
                if (inside) {
                    const double hi = 2.0 * ((u[c + sa] - u[c]) / ha - m->div[c] / 3.0);
                    const double lo = 2.0 * ((u[c] - u[c - sa]) / ha - m->div[c - sa] / 3.0);
                    sum = (hi - lo) / ha;
                }
                for (int b = 0; b < 3 && (inside || face_solved(s, a, n)); b++) {
                    if (b == a)
                        continue;
                    const int sb = g->s[b];
                    const double hb = g->h[b], *const v = f->u[b];
                    double up = (u[c + sb] - u[c]) / hb, down = (u[c] - u[c - sb]) / hb;
                    if (inside) { /* along an open side the flow does not change across it */
                        up += (v[c + sb] - v[c + sb - sa]) / ha;
                        down += (v[c] - v[c - sa]) / ha;
                    }
                    sum += (up - down) / hb;
                }
                out[c] = f->mu * sum;
            }
    if (!s->domain.periodic[a]) /* the last face of a periodic direction is the first */
        return;
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    for (int k = 1; k <= g->n[d]; k++)
        for (int j = 1; j <= g->n[b]; j++) {
            const int at = j * g->s[b] + k * g->s[d];
            out[at + (g->n[a] + 1) * sa] = out[at + sa];
        }
}
