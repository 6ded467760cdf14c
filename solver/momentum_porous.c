/* momentum_porous.c - the explicit terms among grains, see momentum.h and momentum.c.
 *
 * Form a:     m div tau = m mu (laplace(u) + grad(div u)/3),   m = eps on the face
 * Form b, c:  div(eps tau), eps at centres and the mean of four cells at edges; split into
 *             div(eps mu grad u), which may be left to diffusion.h, and the rest. */
#include "momentum_rows.h"

#include "diffusion.h"
#include "fluid_state.h"

/* What of div(eps tau)/mu is not div(eps grad u), for row (j, k) of component a. */
static void rest_row(const struct sim *s, const struct momentum *m, const double *divergence,
                     int a, int j, int k, double *restrict out)
{
    const struct grid *const g = &s->grid;
    const int c = cell(g, 0, j, k), sa = g->s[a];
    const int first = inside_first(s, a, 0), last = inside_last(s, 0);
    const double *const restrict u = s->fluid.u[a] + c, *const restrict e = s->fluid.eps + c;
    const double *const restrict div = divergence + c;
    const double ia = 1.0 / g->h[a];
    for (int i = first; i <= last; i++)
        out[i] = ia * (e[i] * ((u[i + sa] - u[i]) * ia - 2.0 / 3.0 * div[i]) -
                       e[i - sa] * ((u[i] - u[i - sa]) * ia - 2.0 / 3.0 * div[i - sa]));
    for (int b = 0; b < 3; b++) {
        if (b == a || m->skip[b])
            continue;
        const int sb = g->s[b];
        const double *const restrict v = s->fluid.u[b] + c;
        const double scale = 0.25 * ia / g->h[b];
        for (int i = first; i <= last; i++) {
            const double pair = e[i] + e[i - sa];
            const double high = pair + e[i + sb] + e[i + sb - sa];
            const double low = pair + e[i - sb] + e[i - sb - sa];
            out[i] += scale * (high * (v[i + sb] - v[i + sb - sa]) - low * (v[i] - v[i - sa]));
        }
    }
}

/* What a row is made of. */
struct porous_row {
    int a, j, k;
    const double *div;
    const struct fluxes *f;
    const struct scratch *t;
    double *out, *visc; /* of the row */
};

/* div tau of the row to visc; R to out. */
static void porous_row(const struct sim *s, const struct momentum *m,
                       const struct porous_row *r)
{
    const struct grid *const g = &s->grid;
    const int a = r->a, c = cell(g, 0, r->j, r->k), sa = g->s[a];
    const int first = inside_first(s, a, 0), last = inside_last(s, 0);
    const double *const restrict fx = r->f->fx, *const restrict yl = r->f->low[0];
    const double *const restrict yh = r->f->high[0], *const restrict zl = r->f->low[1];
    const double *const restrict zh = r->f->high[1], *const restrict laplace = r->t->laplace;
    const double *const restrict e = s->fluid.eps + c, *const restrict div = r->div + c;
    double *const restrict rest = r->t->rest, *const restrict out = r->out;
    double *const restrict visc = r->visc;
    const double third = s->fluid.mu / (3.0 * g->h[a]), mu = s->fluid.mu;
    const double explicit_part = m->implicit ? 0.0 : 1.0;
    diffusion_row(s, m, FORM_A, a, r->j, r->k, s->fluid.u[a], r->t->laplace);
    if (m->form == FORM_A) {
        for (int i = first; i <= last; i++) {
            const double eps = 0.5 * (e[i] + e[i - sa]),
                         dilate = third * (div[i] - div[i - sa]);
            visc[i] = laplace[i] + dilate;
            out[i] = eps * (explicit_part * laplace[i] + dilate) -
                     ((fx[i] - fx[i - 1]) + (yh[i] - yl[i]) + (zh[i] - zl[i]));
        }
        return;
    }
    for (int i = first; i <= last; i++)
        visc[i] = laplace[i] + third * (div[i] - div[i - sa]);
    rest_row(s, m, r->div, a, r->j, r->k, rest);
    if (!m->implicit)
        diffusion_row(s, m, m->form, a, r->j, r->k, s->fluid.u[a], r->t->laplace);
    for (int i = first; i <= last; i++)
        out[i] = explicit_part * laplace[i] + mu * rest[i] -
                 ((fx[i] - fx[i - 1]) + (yh[i] - yl[i]) + (zh[i] - zl[i]));
}

static void porous_open(const struct sim *s, const struct momentum *m, int a, double *out,
                        double *visc)
{
    const struct grid *const g = &s->grid;
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    for (int end = 0; end < 2; end++) {
        if (!side_open(&s->domain, 2 * a + end))
            continue;
        for (int k = 1; k <= g->n[d]; k++)
            for (int j = 1; j <= g->n[b]; j++) {
                const int c = (end ? g->n[a] + 1 : 1) * g->s[a] + j * g->s[b] + k * g->s[d];
                const double eps = grid_face(s->fluid.eps, c, g->s[a]), *const u =
                                                                            s->fluid.u[a];
                const double spread = diffusion_open(s, m, m->form, a, end, c, u);
                visc[c] = diffusion_open(s, m, FORM_A, a, end, c, u);
                out[c] = eps * momentum_back(s, a, end, c) + (m->implicit         ? 0.0
                                                              : m->form == FORM_A ? eps * spread
                                                                                  : spread);
            }
    }
}

void momentum_porous(const struct sim *s, const struct momentum *m, const double *div,
                     double *const out[3], double *const visc[3])
{
    const struct grid *const g = &s->grid;
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
                const struct fluxes f = momentum_fluxes(s, m, &t, a, j, k, true);
                porous_row(s, m,
                           &(struct porous_row){a, j, k, div, &f, &t, out[a] + c, visc[a] + c});
                momentum_keep(g, &f);
            }
        }
    }
    for (int a = 0; a < 3; a++)
        porous_open(s, m, a, out[a], visc[a]);
}

void momentum_dilatation(const struct sim *s, double *div)
{
    const struct grid *const g = &s->grid;
    const int rows = g->n[1] * g->n[2];
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int row = 0; row < rows; row++) {
        const int c = cell(g, 0, row % g->n[1] + 1, row / g->n[1] + 1);
        const double *const restrict u = s->fluid.u[0] + c, *const restrict v =
                                                                s->fluid.u[1] + c;
        const double *const restrict w = s->fluid.u[2] + c;
        const double x = 1.0 / g->h[0], y = 1.0 / g->h[1], z = 1.0 / g->h[2];
        double *const restrict out = div + c;
        for (int i = 1; i <= g->n[0]; i++)
            out[i] =
                (u[i + 1] - u[i]) * x + (v[i + g->sj] - v[i]) * y + (w[i + g->sk] - w[i]) * z;
    }
    grid_ghosts(g, &s->domain, div);
}
