/* coupling_forces.c - drag on the grid and forces on the grains, see coupling.h for the equations.
 *
 * Sums to the grid go in the order of the grains: every thread walks all shares and adds those of
 * its own slab of cells, so the bits do not depend on the number of threads. */
#include "coupling.h"

#include <string.h>
#include "../drag/drag.h"
#include "sim.h"

/* Q of coupling.h: m_f times the superficial velocity (form 27c: that alone), mean of the two
 * faces of each cell. */
static void sense_flow(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const bool whole = f->whole_pressure;
    for (int a = 0; a < 3; a++) {
        const int step = g->s[a];
#pragma omp parallel for schedule(static)
        for (int k = 1; k <= g->n[2]; k++)
            for (int j = 1; j <= g->n[1]; j++)
                for (int at = cell(g, 1, j, k); at <= cell(g, g->n[0], j, k); at++) {
                    const int up = at + step;
                    const double lo = whole ? 1.0 : 0.5 * (c->eps[at] + c->eps[at - step]);
                    const double hi = whole ? 1.0 : 0.5 * (c->eps[at] + c->eps[up]);
                    c->Q[a][at] = 0.5 * (lo * (f->eps_f[a][at] * f->u[a][at]) +
                                         hi * (f->eps_f[a][up] * f->u[a][up]));
                }
    }
}

/* The superficial velocities at which the drag is taken, see the head of coupling.h. */
static void drag_velocities(struct sim *s)
{
    const struct fluid *const f = &s->fluid;
    for (int a = 0; a < 3; a++) {
        double *const u = s->coupling.u_drag[a], *const swing = s->coupling.swing[a];
#pragma omp parallel for schedule(static)
        for (size_t c = 0; c < s->grid.total; c++) {
            const double wish = f->eps_f[a][c] * f->u[a][c] - u[c];
            u[c] += wish * swing[c] < 0.0 ? 0.5 * wish : wish;
            swing[c] = wish;
        }
    }
}

/* Superficial velocity of a cell. */
static vec3 superficial(const struct sim *s, int at)
{
    double *const *const u = s->coupling.u_drag;
    return v3(0.5 * (u[0][at] + u[0][at + s->grid.s[0]]),
              0.5 * (u[1][at] + u[1][at + s->grid.s[1]]),
              0.5 * (u[2][at] + u[2][at + s->grid.s[2]]));
}

/* kappa, 1/(1 + theta) and v' of one grain; returns its largest theta. It is `outside` where
 * the law does not hold in a cell that it has a share of. */
static double grain_drag(struct sim *s, int i, bool *outside)
{
    struct coupling *const c = &s->coupling;
    const struct grains *const g = &s->grains;
    const struct share *const w = &c->shares[(size_t)i * c->reach];
    double *const kappa = &c->kappa[(size_t)i * c->reach];
    struct drag_point p = {
        .d = drag_grains_diameter(s, i), .y = 1.0, .grain = &c->drag_of.kind[g->kind[i]]};
    double theta[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < c->n_shares[i]; k++) {
        const int at = w[k].cell;
        const double eps = c->eps[at];
        const vec3 u = v3_scale(1.0 / eps, superficial(s, at));
        p.eps = eps;
        p.re =
            drag_reynolds(eps, v3_norm(v3_sub(u, g->vel[i])), p.d, s->fluid.rho, s->fluid.mu);
        if (c->drag_of.sauter)
            p.y = p.d / c->drag_of.sauter[at];
        kappa[k] = drag_kappa(&p, s->fluid.mu);
        *outside = *outside || drag_outside(&p);
        for (int a = 0; a < 3; a++)
            theta[a] += w[k].weight * kappa[k] * c->M[a][at] / (eps * eps);
    }
    const double per_mass = s->fluid.dt * g->inv_mass[i];
    const vec3 rate = v3(per_mass * theta[0], per_mass * theta[1], per_mass * theta[2]);
    c->v_ref[i] = g->vel[i];
    c->slack[i] = v3(1.0, 1.0, 1.0);
    if (c->implicit && per_mass > 0.0) {
        const vec3 dv = v3_sub(g->vel[i], c->vel_old[i]);
        c->v_ref[i] = v3_axpy(v3_add(g->vel[i], dv), -per_mass, c->drag[i]);
        c->slack[i] = v3(1.0 / (1.0 + rate.x), 1.0 / (1.0 + rate.y), 1.0 / (1.0 + rate.z));
    }
    return fmax(rate.x, fmax(rate.y, rate.z));
}

/* K and KV: kappa'/eps^2 and that times v', per cell, in the order of the grains. */
static void spread_drag(struct sim *s)
{
    struct coupling *const c = &s->coupling;
#pragma omp parallel
    {
        int lo, hi;
        grid_slab(&s->grid, &lo, &hi);
        for (int a = 0; a < 3; a++) {
            memset(c->K[a] + lo, 0, (size_t)(hi - lo) * sizeof(double));
            memset(c->KV[a] + lo, 0, (size_t)(hi - lo) * sizeof(double));
        }
        for (int i = 0; i < s->grains.n; i++) {
            const struct share *const w = &c->shares[(size_t)i * c->reach];
            const double slack[3] = {c->slack[i].x, c->slack[i].y, c->slack[i].z};
            const double v[3] = {c->v_ref[i].x, c->v_ref[i].y, c->v_ref[i].z};
            for (int k = 0; k < c->n_shares[i]; k++) {
                const int at = w[k].cell;
                if (at < lo || at >= hi)
                    continue;
                const double part = w[k].weight * c->kappa[(size_t)i * c->reach + k] /
                                    (c->eps[at] * c->eps[at]);
                for (int a = 0; a < 3; a++) {
                    c->K[a][at] += part * slack[a];
                    c->KV[a][at] += part * slack[a] * v[a];
                }
            }
        }
    }
}

/* B = m^2 mean(K)/V, S = m^2 mean(KV)/V on faces (form 27c: m) */
static void drag_on_faces(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    struct fluid *const f = &s->fluid;
    const size_t total = s->grid.total;
    const double inverse = 1.0 / s->grid.volume;
    for (int a = 0; a < 3; a++) {
        grid_ghosts(&s->grid, &s->domain, c->K[a]);
        grid_ghosts(&s->grid, &s->domain, c->KV[a]);
        grid_face_mean(&s->grid, &s->domain, c->K[a], a, f->drag[a]);
        grid_face_mean(&s->grid, &s->domain, c->KV[a], a, f->drag_s[a]);
        for (size_t k = 0; k < total; k++) {
            const double m = f->eps_f[a][k];
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
    drag_velocities(s);
#pragma omp parallel for schedule(dynamic, 64) reduction(max : relaxation)                     \
    reduction(+ : n_outside)
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
}

/* Drag and stress force on one grain. */
static vec3 grain_load(struct sim *s, int i)
{
    struct coupling *const c = &s->coupling;
    const struct grains *const g = &s->grains;
    const struct share *const w = &c->shares[(size_t)i * c->reach];
    const double v[3] = {c->v_ref[i].x, c->v_ref[i].y, c->v_ref[i].z};
    const double slack[3] = {c->slack[i].x, c->slack[i].y, c->slack[i].z};
    double drag[3] = {0.0, 0.0, 0.0}, stress[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < c->n_shares[i]; k++) {
        const int at = w[k].cell;
        const double part =
            w[k].weight * c->kappa[(size_t)i * c->reach + k] / (c->eps[at] * c->eps[at]);
        for (int a = 0; a < 3; a++) {
            const double *const G = s->fluid.stress[a];
            drag[a] += slack[a] * part * (c->Q[a][at] - v[a] * c->M[a][at]);
            if (!s->fluid.whole_pressure)
                stress[a] += w[k].weight * 0.5 * (G[at] + G[at + s->grid.s[a]]);
        }
    }
    c->drag[i] = v3(drag[0], drag[1], drag[2]);
    const double volume = c->pressure_gradient ? g->volume[i] : 0.0;
    return v3_axpy(c->drag[i], volume, v3(stress[0], stress[1], stress[2]));
}

/* What the fluid loses to the grains, from the faces: B u - S and the grains' share of the
 * stress */
static vec3 lost_by_fluid(const struct sim *s)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < 3; a++) {
        const bool open = !s->domain.periodic[a];
        const int last[3] = {g->n[0] + (a == 0 && open), g->n[1] + (a == 1 && open),
                             g->n[2] + (a == 2 && open)};
        for (int k = 1; k <= last[2]; k++)
            for (int j = 1; j <= last[1]; j++)
                for (int i = 1; i <= last[0]; i++) {
                    const int at = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                    const double part = open && (n == 1 || n == g->n[a] + 1) ? 0.5 : 1.0;
                    double lost = f->drag[a][at] * f->u[a][at] - f->drag_s[a][at];
                    if (s->coupling.pressure_gradient && !f->whole_pressure)
                        lost += (1.0 - f->eps_f[a][at]) * f->stress[a][at];
                    sum[a] += part * g->volume * lost;
                }
    }
    return v3(sum[0], sum[1], sum[2]);
}

void coupling_load(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    struct grains *const g = &s->grains;
    const double buoyant = c->buoyancy ? -s->fluid.rho : 0.0;
    sense_flow(s);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        const vec3 exchanged = grain_load(s, i);
        const vec3 load = v3_axpy(exchanged, buoyant * g->volume[i], s->domain.gravity);
        /* the force at hand holds the old load */
        g->force[i] = v3_add(g->force[i], v3_sub(load, g->load[i]));
        g->load[i] = load;
        c->vel_old[i] = g->vel[i];
        c->pos_load[i] = g->pos[i];
        c->v_ref[i] = exchanged; /* not needed any more: kept for the sum below */
    }
    c->to_grains = v3(0.0, 0.0, 0.0);
    for (int i = 0; i < g->n; i++)
        c->to_grains = v3_add(c->to_grains, c->v_ref[i]);
    c->from_fluid = c->ways == 2 ? lost_by_fluid(s) : c->to_grains;
    c->calls++;
}
