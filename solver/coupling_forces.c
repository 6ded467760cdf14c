/* coupling_forces.c - drag on the grid and forces on the grains, see coupling.h for the equations. */
#include "coupling.h"

#include <string.h>
#include "../drag/drag.h"
#include "sim.h"

/* The superficial velocities at which the drag is taken, see the head of coupling.h. */
static void drag_velocities(struct sim *s)
{
    const struct fluid *const f = &s->fluid;
    enum { UP = 1, DOWN = 2, BOTH = 3 };
    unsigned char *const swing = s->coupling.swing;
    for (int a = 0; a < 3; a++) {
        double *const u = s->coupling.u_drag[a];
#pragma omp parallel for schedule(static)
        for (int c = s->grid.s[a]; c < (int)s->grid.total; c++) {
            const double wish = grid_face(f->eps, c, s->grid.s[a]) * f->u[a][c] - u[c];
            const int now = wish > 0.0 ? UP : wish < 0.0 ? DOWN : 0;
            const int before = swing[c] >> 2 * a & BOTH;
            u[c] += (now | before) == BOTH ? 0.5 * wish : wish;
            swing[c] = (unsigned char)(swing[c] ^ (before ^ now) << 2 * a);
        }
    }
}

/* The interstitial velocity of cells, as the grains see it. */
static void see_velocity(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    const struct grid *const g = &s->grid;
    for (int a = 0; a < 3; a++) {
        const double *const u = c->u_drag[a];
        const int step = g->s[a];
#pragma omp parallel for schedule(static)
        for (int k = 1; k <= g->n[2]; k++)
            for (int j = 1; j <= g->n[1]; j++)
                for (int at = cell(g, 1, j, k); at <= cell(g, g->n[0], j, k); at++)
                    c->seen[a][at] = 0.5 * (u[at] + u[at + step]) / c->eps[at];
        if (c->diffuse)
            diffuse_apply(c->diffuse, c->seen[a]);
    }
}

/* M of coupling.h */
static inline double square_of(const struct sim *s, int a, int at)
{
    const struct coupling *const c = &s->coupling;
    return c->diffuse ? c->M[a][at]
                      : coupling_square(c->eps, at, s->grid.s[a], s->fluid.whole_pressure);
}

/* m/s, of a grain of which the drag depends on its direction; else it is not asked for. */
static vec3 mean_slip(const struct sim *s, int i)
{
    const struct coupling *const c = &s->coupling;
    const struct share *const w = &c->shares[(size_t)i * c->reach];
    vec3 slip = v3_scale(-1.0, s->grains.vel[i]);
    for (int k = 0; k < c->n_shares[i]; k++) {
        const int at = w[k].cell;
        slip = v3_axpy(slip, w[k].weight, v3(c->seen[0][at], c->seen[1][at], c->seen[2][at]));
    }
    return slip;
}

/* w kappa, 1/(1 + theta) and v' of one grain; returns its largest theta. It is `outside` where the
 * law does not hold in a cell that it has a share of. */
static double grain_drag(struct sim *s, int i, bool *outside)
{
    struct coupling *const c = &s->coupling;
    const struct grains *const g = &s->grains;
    const struct share *const w = &c->shares[(size_t)i * c->reach];
    double *const part = &c->part[(size_t)i * c->reach];
    struct drag_point p = {
        .d = drag_grains_diameter(s, i), .y = 1.0, .grain = &c->drag_of.kind[g->kind[i]]};
    double theta[3] = {0.0, 0.0, 0.0};
    struct drag_grain own;
    if (c->drag_of.across[g->kind[i]])
        p.grain = drag_grains_seen(s, i, mean_slip(s, i), &own);
    for (int k = 0; k < c->n_shares[i]; k++) {
        const int at = w[k].cell;
        const vec3 u = v3(c->seen[0][at], c->seen[1][at], c->seen[2][at]);
        p.eps = c->eps_seen[at];
        p.re =
            drag_reynolds(p.eps, v3_norm(v3_sub(u, g->vel[i])), p.d, s->fluid.rho, s->fluid.mu);
        if (c->drag_of.sauter)
            p.y = p.d / c->drag_of.sauter[at];
        if (c->by_volume > 0.0) {
            part[k] = w[k].weight * g->volume[i] * c->by_volume * p.eps * p.eps / (1.0 - p.eps);
        } else {
            part[k] = w[k].weight * drag_kappa(&p, s->fluid.mu);
            *outside = *outside || drag_outside(&p);
        }
        for (int a = 0; a < 3; a++)
            theta[a] += part[k] * square_of(s, a, at);
    }
    const double per_mass = s->fluid.dt * g->inv_mass[i];
    const vec3 f = c->resistance;
    const vec3 rate =
        v3(per_mass * f.x * theta[0], per_mass * f.y * theta[1], per_mass * f.z * theta[2]);
    c->v_ref[i] = g->vel[i];
    c->slack[i] = f;
    if (c->implicit && per_mass > 0.0) {
        const vec3 dv = v3_sub(g->vel[i], c->vel_old[i]);
        const vec3 pushed = v3_sub(forces_change(s, i), c->drag[i]);
        c->v_ref[i] = v3_axpy(v3_add(g->vel[i], dv), per_mass, pushed);
        c->slack[i] = v3(f.x / (1.0 + rate.x), f.y / (1.0 + rate.y), f.z / (1.0 + rate.z));
    }
    return fmax(rate.x, fmax(rate.y, rate.z));
}

/* kappa'/eps^2 and that times v', per cell, where the drag on faces is going to be. */
static void spread_drag(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    struct fluid *const f = &s->fluid;
    double *const out[6] = {f->drag[0],   f->drag[1],   f->drag[2],
                            f->drag_s[0], f->drag_s[1], f->drag_s[2]};
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++) {
        double *const v = &c->values[(size_t)i * SPREAD_STRIDE];
        v[0] = c->slack[i].x;
        v[1] = c->slack[i].y;
        v[2] = c->slack[i].z;
        v[3] = c->slack[i].x * c->v_ref[i].x;
        v[4] = c->slack[i].y * c->v_ref[i].y;
        v[5] = c->slack[i].z * c->v_ref[i].z;
    }
    spread_columns(&c->spread, c->part, c->values, 6, out);
    for (int q = 0; q < 6; q++) {
        if (c->diffuse)
            diffuse_apply(c->diffuse, out[q]);
#pragma omp parallel for schedule(static)
        for (size_t k = 0; k < s->grid.total; k++)
            out[q][k] /= c->eps[k] * c->eps[k];
    }
}

/* B = m^2/V times the mean of the two cells, S likewise (form 27c: m) */
static void drag_on_faces(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    const double inverse = 1.0 / s->grid.volume;
    for (int a = 0; a < 3; a++) {
        grid_ghosts(&s->grid, &s->domain, f->drag[a]);
        grid_ghosts(&s->grid, &s->domain, f->drag_s[a]);
        grid_face_mean(&s->grid, &s->domain, f->drag[a], a, f->drag[a]);
        grid_face_mean(&s->grid, &s->domain, f->drag_s[a], a, f->drag_s[a]);
#pragma omp parallel for schedule(static)
        for (int k = s->grid.s[a]; k < (int)s->grid.total; k++) {
            const double m = grid_face(f->eps, k, s->grid.s[a]);
            const double scale = (f->whole_pressure ? m : m * m) * inverse;
            f->drag[a][k] *= scale;
            f->drag_s[a][k] *= scale;
        }
    }
}

void coupling_drag(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    double relaxation = 0.0;
    int n_outside = 0;
    forces_sense(s);
    drag_velocities(s);
    see_velocity(s);
#pragma omp parallel for schedule(dynamic, 64) reduction(max : relaxation) reduction(+ : n_outside)
    for (int i = 0; i < s->grains.n; i++) {
        bool outside = false;
        relaxation = fmax(relaxation, grain_drag(s, i, &outside));
        n_outside += outside;
    }
    c->relaxation = relaxation;
    c->drag_of.outside = n_outside;
    drag_grains_warn(s);
    if (!c->implicit && relaxation > 2.0)
        die(EXIT_UNSTABLE,
            "explicit drag is unstable at t = %.9g s: fluid.dt is %.3g of a grain's relaxation "
            "time "
            "m/kappa (2 at most); take a shorter fluid.dt or coupling.drag = implicit",
            s->t, relaxation);
    if (c->ways == 1)
        return; /* B and S stay zero */
    spread_drag(s);
    drag_on_faces(s);
    forces_on_fluid(s);
}

/* The flow and the stress of cells, as the grains feel them (form 27c: no stress). */
static void see_flow(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const bool whole = f->whole_pressure;
    for (int a = 0; a < 3; a++) {
        const double *const u = f->u[a], *const G = f->stress[a], *const eps = f->eps;
        const int step = g->s[a];
#pragma omp parallel for schedule(static)
        for (int k = 1; k <= g->n[2]; k++)
            for (int j = 1; j <= g->n[1]; j++)
                for (int at = cell(g, 1, j, k); at <= cell(g, g->n[0], j, k); at++) {
                    const int up = at + step;
                    const double e = c->eps[at];
                    const double lo = whole ? 1.0 : 0.5 * (e + c->eps[at - step]);
                    const double hi = whole ? 1.0 : 0.5 * (e + c->eps[up]);
                    c->seen[a][at] = 0.5 *
                                     (lo * (grid_face(eps, at, step) * u[at]) +
                                      hi * (grid_face(eps, up, step) * u[up])) /
                                     (e * e);
                    c->K[a][at] = whole ? 0.0 : 0.5 * (G[at] + G[up]);
                }
        if (c->diffuse)
            diffuse_apply(c->diffuse, c->seen[a]);
        if (c->diffuse && !whole)
            diffuse_apply(c->diffuse, c->K[a]);
    }
}

/* Drag and stress force on one grain. */
static vec3 grain_load(struct sim *s, int i)
{
    struct coupling *const c = &s->coupling;
    const struct grains *const g = &s->grains;
    const struct share *const w = &c->shares[(size_t)i * c->reach];
    const double *const part = &c->part[(size_t)i * c->reach];
    const double v[3] = {c->v_ref[i].x, c->v_ref[i].y, c->v_ref[i].z};
    double drag[3] = {0.0, 0.0, 0.0}, stress[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < c->n_shares[i]; k++) {
        const int at = w[k].cell;
        for (int a = 0; a < 3; a++) {
            drag[a] += part[k] * (c->seen[a][at] - v[a] * square_of(s, a, at));
            stress[a] += w[k].weight * c->K[a][at];
        }
    }
    c->drag[i] = v3(c->slack[i].x * drag[0], c->slack[i].y * drag[1], c->slack[i].z * drag[2]);
    return v3_axpy(c->drag[i], g->volume[i], v3(stress[0], stress[1], stress[2]));
}

/* What the fluid loses through the faces of direction a in layer k: B u - S and the grains' share of
 * the stress; a face of the boundary has half a cell. */
static double lost_in_layer(const struct sim *s, int a, int k)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const bool open = !s->domain.periodic[a];
    const int last[2] = {g->n[0] + (a == 0 && open), g->n[1] + (a == 1 && open)};
    double sum = 0.0;
    for (int j = 1; j <= last[1]; j++)
        for (int i = 1; i <= last[0]; i++) {
            const int at = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
            const double part = open && (n == 1 || n == g->n[a] + 1) ? 0.5 : 1.0;
            double lost = f->drag[a][at] * f->u[a][at] - f->drag_s[a][at];
            if (!f->whole_pressure)
                lost += (1.0 - grid_face(f->eps, at, g->s[a])) * f->stress[a][at];
            sum += part * lost;
        }
    return g->volume * sum;
}

static vec3 lost_by_fluid(const struct sim *s)
{
    const int layers = s->grid.n[2] + 1;
    double *const lost = xalloc(3 * (size_t)layers, sizeof *lost), sum[3] = {0.0, 0.0, 0.0};
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= layers; k++)
        for (int a = 0; a < 3; a++)
            if (k < layers || (a == 2 && !s->domain.periodic[2]))
                lost[3 * (k - 1) + a] = lost_in_layer(s, a, k);
    for (int k = 0; k < layers; k++)
        for (int a = 0; a < 3; a++)
            sum[a] += lost[3 * k + a];
    xfree(lost);
    return v3(sum[0], sum[1], sum[2]);
}

/* Sum over the grains, in blocks. */
static vec3 sum_over_grains(const vec3 *x, int n)
{
    const int blocks = (n + SUM_BLOCK - 1) / SUM_BLOCK;
    vec3 *const part = xalloc((size_t)blocks + 1, sizeof *part), sum = v3(0.0, 0.0, 0.0);
#pragma omp parallel for schedule(static)
    for (int b = 0; b < blocks; b++)
        for (int i = b * SUM_BLOCK; i < n && i < (b + 1) * SUM_BLOCK; i++)
            part[b] = v3_add(part[b], x[i]);
    for (int b = 0; b < blocks; b++)
        sum = v3_add(sum, part[b]);
    xfree(part);
    return sum;
}

void coupling_load(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    struct grains *const g = &s->grains;
    const double buoyant = c->forces.weight * s->fluid.rho;
    see_flow(s);
    forces_see_acceleration(s);
    forces_inertia(s);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        const vec3 exchanged = grain_load(s, i);
        const vec3 other = v3_add(exchanged, forces_load(s, i));
        const vec3 load = v3_axpy(other, buoyant * g->volume[i], s->domain.gravity);
        /* the force at hand holds the old load */
        g->force[i] = v3_add(g->force[i], v3_sub(load, g->load[i]));
        g->load[i] = load;
        c->vel_old[i] = g->vel[i];
        c->pos_load[i] = g->pos[i];
        c->coupled[i] = 1;
        /* not needed any more: kept for the sum below */
        c->v_ref[i] = c->forces.any ? v3_add(exchanged, c->forces.given[i]) : exchanged;
    }
    c->to_grains = sum_over_grains(c->v_ref, g->n);
    c->from_fluid = c->ways == 2 ? lost_by_fluid(s) : c->to_grains;
    c->calls++;
}
