/* forces.c - the answers of forces/ at work, see forces.h. */
#include "forces.h"

#include <string.h>
#include "../forces/force.h"
#include "sim.h"

void forces_read(struct sim *s, struct scene *scene)
{
    struct fluid_forces *const o = &s->coupling.forces;
    for (int f = 0; forces[f]; f++) {
        if (forces[f]->read)
            forces[f]->read(scene);
        o->pressure += forces[f]->of_pressure;
        o->viscous += forces[f]->of_viscous;
        o->weight += forces[f]->of_weight;
        o->any = o->any || forces[f]->act || forces[f]->added_mass || forces[f]->spin_rate;
        o->spins = o->spins || forces[f]->spin_rate;
        if (forces[f]->added_mass)
            o->added += forces[f]->added_mass();
    }
}

static void add_grain_field(struct sim *s, const char *name, const char *unit, const char *what,
                            vec3 **data, int flags)
{
    *data = xalloc((size_t)s->grains.capacity, sizeof **data);
    fields_add(&s->fields,
               (struct field){name, unit, what, PLACE_GRAIN, KIND_VEC3, (void **)data, flags});
}

void forces_create(struct sim *s)
{
    static const char *const old[3] = {"cell_velocity_old_x", "cell_velocity_old_y",
                                       "cell_velocity_old_z"};
    struct fluid_forces *const o = &s->coupling.forces;
    if (!o->any)
        return;
    for (int a = 0; a < 3; a++) {
        double **const all[] = {&o->u[a], &o->curl[a], &o->u_old[a], &o->on_cells[a]};
        for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
            *all[i] = grid_field(&s->grid);
        fields_add(&s->fields,
                   (struct field){old[a], "m s-1", "velocity at the centre a step ago",
                                  PLACE_CELL, KIND_REAL, (void **)&o->u_old[a], FIELD_STATE});
    }
    add_grain_field(s, "other_force", "N", "lift and thermal force of the fluid", &o->force,
                    FIELD_STATE | FIELD_OUTPUT);
    add_grain_field(s, "other_force_old", "N", "the same a step ago", &o->force_old,
                    FIELD_STATE);
    add_grain_field(s, "added_mass_pull", "N", "added mass times the fluid's acceleration",
                    &o->pulled, FIELD_STATE);
    add_grain_field(s, "spin_old", "rad s-1", "angular velocity a fluid step ago", &o->spin_old,
                    FIELD_STATE);
    grains_follow(&s->grains, (void **)&o->given, sizeof *o->given);
    grains_follow(&s->grains, (void **)&o->torque, sizeof *o->torque);
}

void forces_free(struct sim *s)
{
    struct fluid_forces *const o = &s->coupling.forces;
    void *const all[] = {o->force, o->force_old, o->pulled, o->spin_old, o->given, o->torque};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    for (int a = 0; a < 3; a++) {
        xfree(o->u[a]);
        xfree(o->curl[a]);
        xfree(o->u_old[a]);
        xfree(o->on_cells[a]);
    }
}

/* u[a] = interstitial velocity at the centres, ghosts filled. */
static void velocity_of_cells(struct sim *s)
{
    const struct coupling *const c = &s->coupling;
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    for (int a = 0; a < 3; a++) {
        double *const out = c->forces.u[a];
        const int step = g->s[a];
#pragma omp parallel for schedule(static)
        for (int k = 1; k <= g->n[2]; k++)
            for (int j = 1; j <= g->n[1]; j++)
                for (int at = cell(g, 1, j, k); at <= cell(g, g->n[0], j, k); at++)
                    out[at] = 0.5 *
                              (grid_face(f->eps, at, step) * f->u[a][at] +
                               grid_face(f->eps, at + step, step) * f->u[a][at + step]) /
                              f->eps[at];
        grid_ghosts(g, &s->domain, out);
    }
}

/* d x/d b at cell `at` of layer n: central, one-sided next to a side that is not periodic. */
static double slope(const struct sim *s, const double *x, int b, int n, int at)
{
    const struct grid *const g = &s->grid;
    const int step = g->s[b], last = g->n[b];
    const bool lo = s->domain.periodic[b] || n > 1, hi = s->domain.periodic[b] || n < last;
    if (last == 1 || !(lo || hi))
        return 0.0;
    return (x[hi ? at + step : at] - x[lo ? at - step : at]) / ((lo + hi) * g->h[b]);
}

static void curl_of_cells(struct sim *s)
{
    struct fluid_forces *const o = &s->coupling.forces;
    const struct grid *const g = &s->grid;
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int at = cell(g, i, j, k), n[3] = {i, j, k};
                for (int a = 0; a < 3; a++) {
                    const int b = (a + 1) % 3, d = (a + 2) % 3;
                    o->curl[a][at] =
                        slope(s, o->u[d], b, n[b], at) - slope(s, o->u[b], d, n[d], at);
                }
            }
}

static void diffuse_three(struct sim *s, double *const x[3])
{
    for (int a = 0; a < 3 && s->coupling.diffuse; a++)
        diffuse_apply(s->coupling.diffuse, x[a]);
}

/* What the weights of grain i make of three fields. */
static vec3 felt(const struct sim *s, int i, double *const x[3])
{
    const struct coupling *const c = &s->coupling;
    const struct share *const w = &c->shares[(size_t)i * c->reach];
    vec3 sum = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < c->n_shares[i]; k++)
        sum = v3_axpy(sum, w[k].weight, v3(x[0][w[k].cell], x[1][w[k].cell], x[2][w[k].cell]));
    return sum;
}

static struct force_view view(const struct sim *s, int i)
{
    const struct coupling *const c = &s->coupling;
    const struct grains *const g = &s->grains;
    const struct share *const w = &c->shares[(size_t)i * c->reach];
    struct force_view v = {.d = drag_grains_diameter(s, i),
                           .mass = g->mass[i],
                           .rho = s->fluid.rho,
                           .mu = s->fluid.mu,
                           .dt = s->fluid.dt,
                           .slip = v3_sub(felt(s, i, c->forces.u), g->vel[i]),
                           .curl = felt(s, i, c->forces.curl),
                           .spin = g->spin[i],
                           .id = g->id[i],
                           .step = s->step,
                           .seed = s->run.seed};
    for (int k = 0; k < c->n_shares[i]; k++)
        v.eps += w[k].weight * c->eps_seen[w[k].cell];
    return v;
}

/* N m; backward Euler on the spin, as the drag is on the velocity (coupling.h). */
static vec3 implicit_torque(const struct sim *s, int i, double rate, vec3 curl)
{
    const struct grains *const g = &s->grains;
    const double per_inertia = s->fluid.dt * g->inv_inertia[i];
    const vec3 turned = v3_sub(g->spin[i], s->coupling.forces.spin_old[i]);
    vec3 spin = g->spin[i];
    spin = v3_axpy(v3_add(spin, turned), -per_inertia, g->load_torque[i]);
    return v3_scale(rate / (1.0 + per_inertia * rate),
                    v3_axpy(v3_scale(-1.0, spin), 0.5, curl));
}

/* F_x, the torque, and what the fluid is to lose. */
static void sense_grain(struct sim *s, int i)
{
    struct fluid_forces *const o = &s->coupling.forces;
    const struct grains *const g = &s->grains;
    const struct force_view v = view(s, i);
    if (!s->coupling.coupled[i])
        o->spin_old[i] = g->spin[i];
    const double added = o->added * v.rho * g->volume[i];
    double rate = 0.0;
    vec3 force = v3(0.0, 0.0, 0.0), given = force;
    for (int f = 0; forces[f]; f++) {
        if (forces[f]->spin_rate)
            rate += forces[f]->spin_rate(&v);
        if (!forces[f]->act)
            continue;
        const vec3 more = forces[f]->act(&v);
        force = v3_add(force, more);
        given = v3_axpy(given, forces[f]->returned ? 1.0 : 0.0, more);
    }
    if (added > 0.0 && s->coupling.coupled[i]) {
        const vec3 dv = v3_sub(g->vel[i], s->coupling.vel_old[i]);
        given = v3_add(given, v3_axpy(o->pulled[i], -added / v.dt, dv));
    }
    o->force[i] = force;
    o->given[i] = given;
    if (o->spins)
        o->torque[i] = implicit_torque(s, i, rate, v.curl);
}

void forces_sense(struct sim *s)
{
    struct fluid_forces *const o = &s->coupling.forces;
    if (!o->any || !o->due)
        return;
    o->due = false;
    velocity_of_cells(s);
    curl_of_cells(s);
    if (s->coupling.calls == 0) {
        for (int a = 0; a < 3; a++)
            memcpy(o->u_old[a], o->u[a], s->grid.total * sizeof(double));
    }
    diffuse_three(s, o->u);
    diffuse_three(s, o->curl);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++)
        sense_grain(s, i);
}

vec3 forces_change(const struct sim *s, int i)
{
    const struct fluid_forces *const o = &s->coupling.forces;
    return o->any ? v3_sub(o->force[i], o->force_old[i]) : v3(0.0, 0.0, 0.0);
}

void forces_on_fluid(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    struct fluid_forces *const o = &c->forces;
    if (!o->any)
        return;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++) {
        double *const v = &c->values[(size_t)i * SPREAD_STRIDE];
        v[0] = o->given[i].x;
        v[1] = o->given[i].y;
        v[2] = o->given[i].z;
    }
    spread_columns(&c->spread, NULL, c->values, 3, o->on_cells);
    diffuse_three(s, o->on_cells);
    const double per_volume = 1.0 / s->grid.volume;
    for (int a = 0; a < 3; a++) {
        double *const faces = c->seen[a]; /* free at this point */
        grid_ghosts(&s->grid, &s->domain, o->on_cells[a]);
        grid_face_mean(&s->grid, &s->domain, o->on_cells[a], a, faces);
#pragma omp parallel for schedule(static)
        for (size_t at = 0; at < s->grid.total; at++)
            s->fluid.drag_s[a][at] -= per_volume * faces[at];
    }
}

/* Du/Dt of cells, into `curl`: along the path of the fluid. */
void forces_see_acceleration(struct sim *s)
{
    struct fluid_forces *const o = &s->coupling.forces;
    const struct grid *const g = &s->grid;
    if (!(o->added > 0.0))
        return;
    velocity_of_cells(s);
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int at = cell(g, i, j, k), n[3] = {i, j, k};
                for (int a = 0; a < 3; a++) {
                    double rate = (o->u[a][at] - o->u_old[a][at]) / s->fluid.dt;
                    for (int b = 0; b < 3; b++)
                        rate += o->u[b][at] * slope(s, o->u[a], b, n[b], at);
                    o->curl[a][at] = rate;
                }
            }
    for (int a = 0; a < 3; a++)
        memcpy(o->u_old[a], o->u[a], g->total * sizeof(double));
    diffuse_three(s, o->curl);
}

vec3 forces_load(struct sim *s, int i)
{
    struct fluid_forces *const o = &s->coupling.forces;
    struct grains *const g = &s->grains;
    if (!o->any)
        return v3(0.0, 0.0, 0.0);
    const double added = o->added * s->fluid.rho * g->volume[i];
    vec3 load = o->force[i];
    if (added > 0.0) {
        o->pulled[i] = v3_scale(added, felt(s, i, o->curl));
        load = v3_add(load, o->pulled[i]);
        if (g->inv_mass[i] > 0.0)
            load = v3_axpy(load, -added, s->domain.gravity);
    }
    if (o->spins) {
        g->torque[i] = v3_add(g->torque[i], v3_sub(o->torque[i], g->load_torque[i]));
        g->load_torque[i] = o->torque[i];
    }
    o->spin_old[i] = g->spin[i];
    o->force_old[i] = o->force[i];
    return load;
}

void forces_inertia(struct sim *s)
{
    struct grains *const g = &s->grains;
    const double per_volume = s->coupling.forces.added * s->fluid.rho;
    if (!(per_volume > 0.0))
        return;
    for (int i = 0; i < g->n; i++) {
        const double added = per_volume * g->volume[i], want = 1.0 / (g->mass[i] + added);
        if (g->inv_mass[i] == 0.0 || g->inv_mass[i] == want)
            continue;
        ledger_gain(s, i, added);
        g->inv_mass[i] = want;
    }
}
