/* coupling.c - the exchange between grains and fluid, see coupling.h for the equations. */
#include "coupling.h"

#include <string.h>
#include "../drag/drag.h"
#include "shares_grain.h"
#include "sim.h"

const struct key coupling_keys[] = {
    {"coupling", "ways", KEY_CHOICE, "", "two | one", "two",
     "one: the fluid does not feel the grains"},
    {"coupling", "drag", KEY_CHOICE, "", "implicit | explicit", "implicit",
     "treatment of the drag on the grains; explicit is stable for fluid.dt below m/kappa only"},
    {"coupling", "porosity_min", KEY_REAL, "1", "[0, 1)", "0.05",
     "a smaller fluid fraction in a cell stops the run"},
    {0},
};

void coupling_read(struct sim *s, struct scene *scene)
{
    struct coupling *const c = &s->coupling;
    scene_declare(scene, coupling_keys);
    c->ways = scene_choice(scene, "coupling", NULL, "ways") == 0 && !s->fluid.deaf ? 2 : 1;
    c->resistance = v3(1.0, 1.0, 1.0);
    c->implicit = scene_choice(scene, "coupling", NULL, "drag") == 0;
    c->eps_min = scene_real(scene, "coupling", NULL, "porosity_min");
    drag_init(scene);
    drag_grains_read(s, scene);
    porosity_init(scene);
    shares_grain_create(&s->grains, scene);
    forces_read(s, scene);
}

void coupling_create(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    struct grains *const g = &s->grains;
    const size_t n = (size_t)g->capacity;
    c->reach = porosity_reach(&s->grid, grains_widest(g));
    const size_t reach = (size_t)c->reach;
    grains_follow(g, (void **)&c->n_shares, sizeof *c->n_shares);
    grains_follow(g, (void **)&c->shares, reach * sizeof *c->shares);
    grains_follow(g, (void **)&c->part, reach * sizeof *c->part);
    grains_follow(g, (void **)&c->values, SPREAD_STRIDE * sizeof *c->values);
    grains_follow(g, (void **)&c->v_ref, sizeof *c->v_ref);
    grains_follow(g, (void **)&c->slack, sizeof *c->slack);
    spread_create(&c->spread, &s->grid);
    c->diffuse = porosity_diffusion(&s->grid, &s->domain, grains_widest(g));
    c->drag = xalloc(n, sizeof *c->drag);
    c->vel_old = xalloc(n, sizeof *c->vel_old);
    c->pos_load = xalloc(n, sizeof *c->pos_load);
    c->coupled = xalloc(n, sizeof *c->coupled);
    fields_add(&s->fields,
               (struct field){"coupled", "1", "it has felt the fluid before", PLACE_GRAIN,
                              KIND_INT, (void **)&c->coupled, FIELD_STATE});
    c->eps = c->ways == 2 ? s->fluid.eps : grid_field(&s->grid);
    drag_grains_create(s);
    forces_create(s);
    c->eps_seen = c->diffuse ? grid_field(&s->grid) : c->eps;
    for (int a = 0; a < 3; a++) {
        static const char *const name[3] = {"drag_velocity_x", "drag_velocity_y",
                                            "drag_velocity_z"};
        const enum place place = (enum place)(PLACE_FACE_X + a);
        c->u_drag[a] = grid_field(&s->grid);
        fields_add(&s->fields,
                   (struct field){name[a], "m s-1", "velocity the drag was taken at", place,
                                  KIND_REAL, (void **)&c->u_drag[a], FIELD_STATE});
        c->K[a] = grid_field(&s->grid);
        c->seen[a] = grid_field(&s->grid);
        c->M[a] = c->diffuse ? grid_field(&s->grid) : NULL;
    }
    c->swing = xalloc(s->grid.total, sizeof *c->swing);
    fields_add(&s->fields,
               (struct field){"drag_swing", "1", "signs of its last wishes to change",
                              PLACE_CELL, KIND_BYTE, (void **)&c->swing, FIELD_STATE});
    fields_add(&s->fields,
               (struct field){"drag", "N", "drag force on the grain", PLACE_GRAIN, KIND_VEC3,
                              (void **)&c->drag, FIELD_STATE | FIELD_OUTPUT});
    fields_add(&s->fields,
               (struct field){"velocity_old", "m s-1", "velocity a fluid step ago", PLACE_GRAIN,
                              KIND_VEC3, (void **)&c->vel_old, FIELD_STATE});
    fields_add(&s->fields,
               (struct field){"position_old", "m", "position a fluid step ago", PLACE_GRAIN,
                              KIND_VEC3, (void **)&c->pos_load, FIELD_STATE});
}

void coupling_free(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    void *const all[] = {c->n_shares, c->shares,  c->part,     c->values, c->v_ref,
                         c->drag,     c->vel_old, c->pos_load, c->swing,  c->slack};
    drag_grains_free(s);
    shares_grain_free(&s->grains);
    forces_free(s);
    xfree(c->coupled);
    spread_free(&c->spread);
    diffuse_free(c->diffuse);
    if (c->eps_seen != c->eps)
        xfree(c->eps_seen);
    if (c->eps != s->fluid.eps)
        xfree(c->eps);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    for (int a = 0; a < 3; a++) {
        xfree(c->K[a]);
        xfree(c->u_drag[a]);
        xfree(c->seen[a]);
        xfree(c->M[a]);
    }
}

static _Noreturn void die_full(const struct sim *s)
{
    const struct grid *const g = &s->grid;
    const double *const eps = s->coupling.eps;
    int least = cell(g, 1, 1, 1);
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int at = cell(g, 1, j, k); at <= cell(g, g->n[0], j, k); at++)
                least = eps[at] < eps[least] ? at : least;
    const int k = least / g->sk, j = least % g->sk / g->sj, i = least % g->sj;
    die(EXIT_UNSTABLE,
        "the fluid fraction of cell %d %d %d (centre %.4g %.4g %.4g m) is %.4g at t = %.9g s, "
        "below "
        "coupling.porosity_min = %g; take larger cells, or an answer of porosity/ that spreads "
        "a "
        "grain over cells",
        i, j, k, (i - 0.5) * g->h[0], (j - 0.5) * g->h[1], (k - 0.5) * g->h[2], eps[least],
        s->t, s->coupling.eps_min);
}

/* eps = 1 - volume / cell volume; the total against the grains' */
static void fluid_fraction(struct sim *s, const double *volume)
{
    struct coupling *const c = &s->coupling;
    const struct grid *const g = &s->grid;
    const double per_cell = porosity_displaces ? 1.0 / g->volume : 0.0;
    const double on_grid = sum_blocks(volume, g->total);
    const double of_grains = sum_blocks(s->grains.volume, (size_t)s->grains.n);
    double least = 1.0;
#pragma omp parallel for schedule(static) reduction(min : least)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int at = cell(g, 1, j, k); at <= cell(g, g->n[0], j, k); at++) {
                c->eps[at] = 1.0 - volume[at] * per_cell;
                least = c->eps[at] < least ? c->eps[at] : least;
            }
    c->eps_least = least;
    c->volume_error = of_grains > 0.0 ? fabs(on_grid / of_grains - 1.0) : 0.0;
    if (least < c->eps_min)
        die_full(s);
    grid_ghosts(g, &s->domain, c->eps);
    if (c->diffuse) {
        memcpy(c->eps_seen, c->eps, g->total * sizeof *c->eps);
        diffuse_apply(c->diffuse, c->eps_seen);
    }
}

/* M of coupling.h, diffused. */
static void sense_squares(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    const struct grid *const g = &s->grid;
    for (int a = 0; a < 3 && c->diffuse; a++) {
#pragma omp parallel for schedule(static)
        for (int k = 1; k <= g->n[2]; k++)
            for (int j = 1; j <= g->n[1]; j++)
                for (int at = cell(g, 1, j, k); at <= cell(g, g->n[0], j, k); at++)
                    c->M[a][at] = coupling_square(c->eps, at, g->s[a], s->fluid.whole_pressure);
        diffuse_apply(c->diffuse, c->M[a]);
    }
}

/* A grain that the fluid has not acted on yet: the change of velocity that the forces at hand would
 * make in a step, so that implicit drag knows of weight and buoyancy from the start. */
static void first_change(struct sim *s, int i)
{
    const struct grains *const g = &s->grains;
    const double rho = s->coupling.forces.weight * s->fluid.rho;
    const vec3 dry = v3_sub(g->force[i], g->load[i]);
    const vec3 force = v3_axpy(dry, g->mass[i] + rho * g->volume[i], s->domain.gravity);
    s->coupling.vel_old[i] = v3_axpy(g->vel[i], -s->fluid.dt * g->inv_mass[i], force);
}

void coupling_volume(struct sim *s)
{
    struct coupling *const c = &s->coupling;
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
#pragma omp parallel for schedule(dynamic, 64)
    for (int i = 0; i < s->grains.n; i++) {
        c->n_shares[i] =
            porosity_shares(g, &s->domain, &s->grains, i, &c->shares[(size_t)i * c->reach]);
        if (!c->coupled[i])
            first_change(s, i);
    }
    spread_prepare(&c->spread, s->grains.n, c->reach, c->n_shares, c->shares);
    spread_one(&c->spread, s->grains.volume, c->K[0]);
    if (c->diffuse)
        diffuse_apply(c->diffuse, c->K[0]);
    drag_grains_sauter(s, c->K[0]);
    memcpy(f->eps_old, f->eps, g->total * sizeof *f->eps);
    fluid_fraction(s, c->K[0]);
    if (c->calls == 0) {
        memcpy(f->eps_old, f->eps, g->total * sizeof *f->eps);
    }
    sense_squares(s);
    c->forces.due = true;
}
