/* fluid_state.c - fields and sides of the fluid, for every solver of solver/fluid/. */
#include "fluid_state.h"

#include <string.h>

double fluid_expected_velocity(const struct sim *s)
{
    double most = fmax(flow_most(&s->flow), v3_norm(s->flow.held_rate));
    for (int side = 0; side < 6; side++) {
        most = fmax(most, course_most(&s->domain.side[side].inflow));
        most = fmax(most, v3_norm(s->domain.side[side].velocity));
    }
    if (s->flow.profile == PROFILE_PARABOLIC)
        most *= 2.25; /* two pairs of walls */
    return most / (s->grains.n > 0 ? 0.4 : 1.0);
}

double fluid_courant_limit(const struct sim *s)
{
    const double *const h = s->grid.h, u = fluid_expected_velocity(s);
    return u > 0.0 ? COURANT_MOST * fmin(h[0], fmin(h[1], h[2])) / u : (double)INFINITY;
}

double fluid_viscous_limit(const struct sim *s)
{
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        sum += s->grid.n[a] > 1 ? 1.0 / (s->grid.h[a] * s->grid.h[a]) : 0.0;
    sum *= 4.0 * s->fluid.mu / s->fluid.rho;
    return sum > 0.0 ? 1.0 / sum : (double)INFINITY;
}

static double auto_step(const struct sim *s)
{
    const double limit = fmin(fluid_courant_limit(s), fluid_viscous_limit(s));
    return fmin(0.5 * limit, s->run.end / 10.0);
}

static void register_fields(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    const int state = FIELD_STATE, both = FIELD_STATE | FIELD_OUTPUT;
    const struct field list[] = {
        {"fluid_velocity_x", "m s-1", "interstitial velocity of the fluid, x", PLACE_FACE_X,
         KIND_REAL, (void **)&f->u[0], both},
        {"fluid_velocity_y", "m s-1", "interstitial velocity of the fluid, y", PLACE_FACE_Y,
         KIND_REAL, (void **)&f->u[1], both},
        {"fluid_velocity_z", "m s-1", "interstitial velocity of the fluid, z", PLACE_FACE_Z,
         KIND_REAL, (void **)&f->u[2], both},
        {"pressure", "Pa", "pressure without its hydrostatic part", PLACE_CELL, KIND_REAL,
         (void **)&f->p, both},
        {"fluid_fraction", "1", "fluid fraction (porosity)", PLACE_CELL, KIND_REAL,
         (void **)&f->eps, both},
        {"fluid_fraction_old", "1", "fluid fraction a step ago", PLACE_CELL, KIND_REAL,
         (void **)&f->eps_old, state},
    };
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        fields_add(&s->fields, list[i]);
    series_add(&s->series, "courant", "1", "largest u dt / h", &f->courant);
    series_add(&s->series, "divergence", "1", "largest continuity error, times h / u",
               &f->divergence);
}

bool fluid_state_create(struct sim *s, struct scene *scene)
{
    struct fluid *const f = &s->fluid;
    f->exists = true;
    f->rho = scene_real(scene, "fluid", NULL, "density");
    f->mu = scene_real(scene, "fluid", NULL, "viscosity");
    for (int a = 0; a < 3; a++)
        if (s->domain.cells[a] < 1) {
            scene_error(scene, "domain", NULL, "cells",
                        "a scene with a fluid needs three numbers "
                        "of cells, each 1 at least");
            break;
        }
    double cells = 1.0;
    for (int a = 0; a < 3; a++)
        cells *= s->domain.cells[a] + 2.0;
    if (cells > 1e9)
        scene_error(scene, "domain", NULL, "cells", "%.3g cells are more than 1e9", cells);
    const bool automatic = scene_word(scene, "fluid", NULL, "dt", "auto");
    if (!automatic)
        f->dt = scene_real(scene, "fluid", NULL, "dt");
    if (scene_errors(scene) > 0) {
        f->dt = 1.0;
        coupling_read(s, scene);
        return false;
    }
    grid_create(&s->grid, &s->domain);
    if (automatic)
        f->dt = auto_step(s);
    f->p = grid_field(&s->grid);
    f->eps = grid_field(&s->grid);
    f->eps_old = grid_field(&s->grid);
    for (size_t c = 0; c < s->grid.total; c++)
        f->eps[c] = f->eps_old[c] = 1.0;
    for (int a = 0; a < 3; a++) {
        double **const faces[] = {&f->u[a], &f->eps_f[a], &f->drag[a], &f->drag_s[a],
                                  &f->stress[a]};
        for (size_t i = 0; i < sizeof faces / sizeof faces[0]; i++)
            *faces[i] = grid_field(&s->grid);
        for (size_t c = 0; c < s->grid.total; c++)
            f->eps_f[a][c] = 1.0;
    }
    register_fields(s);
    coupling_read(s, scene);
    coupling_create(s);
    return true;
}

void fluid_state_free(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    if (!f->p)
        return;
    coupling_free(s);
    xfree(f->p);
    xfree(f->eps);
    xfree(f->eps_old);
    for (int a = 0; a < 3; a++) {
        void *const faces[] = {f->u[a], f->eps_f[a], f->drag[a], f->drag_s[a], f->stress[a]};
        for (size_t i = 0; i < sizeof faces / sizeof faces[0]; i++)
            xfree(faces[i]);
    }
}

bool side_open(const struct domain *d, int side)
{
    return d->side[side].kind == SIDE_OUTFLOW || d->side[side].kind == SIDE_HEAD;
}

void fluid_pressure_sides(const struct domain *d, enum poisson_side side[6])
{
    for (int i = 0; i < 6; i++)
        side[i] = d->periodic[i / 2] ? POISSON_PERIODIC
                  : side_open(d, i)  ? POISSON_DIRICHLET
                                     : POISSON_NEUMANN;
}

double fluid_inflow(const struct sim *s, int side, double t)
{
    const struct side *const e = &s->domain.side[side];
    return e->own_inflow ? course_at(&e->inflow, t) : flow_velocity(&s->flow, t);
}

/* What the profile makes of the mean velocity at cell i of direction b, beside an inflow side:
 * the mean over each cell of a parabola between two walls, so that the mean over the side is 1. */
static double profile(const struct sim *s, int b, int i)
{
    const struct side *const lo = &s->domain.side[2 * b], *const hi = lo + 1;
    const bool walls = lo->kind == SIDE_WALL && hi->kind == SIDE_WALL;
    if (s->flow.profile == PROFILE_UNIFORM || !walls)
        return 1.0;
    const double n = s->grid.n[b], x0 = (i - 1) / n, x1 = i / n;
    return n * (3.0 * (x1 * x1 - x0 * x0) - 2.0 * (x1 * x1 * x1 - x0 * x0 * x0));
}

/* Index of layer i of direction a at (j, k) of the two directions after it. */
static inline int at_layer(const struct grid *g, int a, int i, int j, int k)
{
    return i * g->s[a] + j * g->s[(a + 1) % 3] + k * g->s[(a + 2) % 3];
}

/* The normal component of direction a: given on its faces, and one ghost beyond. */
static void normal_component(struct sim *s, int a, double t)
{
    const struct grid *const g = &s->grid;
    const int nb = g->n[(a + 1) % 3], nc = g->n[(a + 2) % 3], n = g->n[a];
    double *const u = s->fluid.u[a];
    const double *const m = s->fluid.eps_f[a];
    double given[2];
    for (int end = 0; end < 2; end++) {
        const struct side *const side = &s->domain.side[2 * a + end];
        given[end] = side->kind == SIDE_INFLOW ? fluid_inflow(s, 2 * a + end, t)
                     : side->kind == SIDE_FLUX ? course_at(&side->flux, t)
                                               : 0.0;
    }
    for (int k = 1; k <= nc; k++)
        for (int j = 1; j <= nb; j++) {
            const int lo = at_layer(g, a, 1, j, k), hi = at_layer(g, a, n + 1, j, k);
            if (s->domain.periodic[a]) {
                u[hi] = u[lo];
                u[lo - g->s[a]] = u[hi - g->s[a]];
                continue;
            }
            for (int end = 0; end < 2; end++) {
                const struct side *const side = &s->domain.side[2 * a + end];
                const int face = end ? hi : lo;
                if (side->kind == SIDE_WALL || side->kind == SIDE_SLIP)
                    u[face] = 0.0;
                else if (side->kind == SIDE_INFLOW)
                    u[face] = (end ? -1.0 : 1.0) * given[end] * profile(s, (a + 1) % 3, j) *
                              profile(s, (a + 2) % 3, k) / m[face];
                else if (side->kind == SIDE_FLUX)
                    u[face] = (end ? -1.0 : 1.0) * given[end] / m[face];
            }
            u[lo - g->s[a]] = u[lo];
        }
}

/* The ghosts of component a beyond the sides of direction b. */
static void tangential_ghosts(struct sim *s, int a, int b)
{
    const struct grid *const g = &s->grid;
    double *const u = s->fluid.u[a];
    const int c1 = (b + 1) % 3, c2 = (b + 2) % 3;
    for (int k = 0; k <= g->n[c2] + 1; k++)
        for (int j = 0; j <= g->n[c1] + 1; j++)
            for (int end = 0; end < 2; end++) {
                const int n = g->n[b];
                const int ghost = at_layer(g, b, end ? n + 1 : 0, j, k);
                const int inside = at_layer(g, b, end ? n : 1, j, k);
                const struct side *const side = &s->domain.side[2 * b + end];
                const double wall = a == 0   ? side->velocity.x
                                    : a == 1 ? side->velocity.y
                                             : side->velocity.z;
                if (side->kind == SIDE_PERIODIC)
                    u[ghost] = u[at_layer(g, b, end ? 1 : n, j, k)];
                else if (side->kind == SIDE_WALL)
                    u[ghost] = 2.0 * wall - u[inside];
                else if (side->kind == SIDE_INFLOW || side->kind == SIDE_FLUX)
                    u[ghost] = -u[inside];
                else
                    u[ghost] = u[inside];
            }
}

void fluid_velocity_sides(struct sim *s, double t)
{
    for (int a = 0; a < 3; a++)
        normal_component(s, a, t);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            if (b != a)
                tangential_ghosts(s, a, b);
}

double fluid_boundary_pressure(const struct sim *s, int side)
{
    const struct grid *const g = &s->grid;
    const int a = side / 2, end = side % 2, n = g->n[a];
    const int nb = g->n[(a + 1) % 3], nc = g->n[(a + 2) % 3];
    const double gravity = v3_norm(s->domain.gravity);
    const double drive[3] = {s->flow.gradient.x, s->flow.gradient.y, s->flow.gradient.z};
    if (s->domain.side[side].kind == SIDE_OUTFLOW)
        return 0.0;
    if (s->domain.side[side].kind == SIDE_HEAD)
        return s->fluid.rho * (gravity > 0.0 ? gravity : 9.81) *
               course_at(&s->domain.side[side].head, s->t);
    double sum = 0.0;
    for (int k = 1; k <= nc; k++)
        for (int j = 1; j <= nb; j++) {
            const int face = at_layer(g, a, end ? n + 1 : 1, j, k);
            const int inside = at_layer(g, a, end ? n : 1, j, k);
            const double G = s->fluid.stress[a][face] - drive[a];
            sum += s->fluid.p[inside] + (end ? -0.5 : 0.5) * g->h[a] * G;
        }
    return sum / ((double)nb * nc);
}

double fluid_divergence(const struct sim *s, int c)
{
    const struct fluid *const f = &s->fluid;
    double sum = (f->eps[c] - f->eps_old[c]) / f->dt;
    for (int a = 0; a < 3; a++) {
        const int up = c + s->grid.s[a];
        sum += (f->eps_f[a][up] * f->u[a][up] - f->eps_f[a][c] * f->u[a][c]) / s->grid.h[a];
    }
    return sum;
}

static _Noreturn void die_velocity(const struct sim *s, int a, int c, double courant)
{
    const struct grid *const g = &s->grid;
    const int k = c / g->sk, j = c % g->sk / g->sj, i = c % g->sj;
    const double u = s->fluid.u[a][c];
    if (!isfinite(u))
        die(EXIT_UNSTABLE,
            "the velocity of the fluid is not finite in cell %d %d %d (centre %.4g %.4g %.4g "
            "m) at t "
            "= %.9g s; take a shorter fluid.dt",
            i, j, k, (i - 0.5) * g->h[0], (j - 0.5) * g->h[1], (k - 0.5) * g->h[2], s->t);
    die(EXIT_UNSTABLE,
        "the Courant number is %.3g in cell %d %d %d (centre %.4g %.4g %.4g m, %c velocity "
        "%.4g m/s, "
        "fluid fraction %.3g) at t = %.9g s: more than %g; take fluid.dt below %.3g s",
        courant, i, j, k, (i - 0.5) * g->h[0], (j - 0.5) * g->h[1], (k - 0.5) * g->h[2],
        'x' + a, u, s->fluid.eps[c], s->t, COURANT_MOST, COURANT_MOST * s->fluid.dt / courant);
}

void fluid_guard(struct sim *s, bool limited)
{
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    double fastest = 0.0, worst = 0.0, least = fmin(g->h[0], fmin(g->h[1], g->h[2]));
    f->courant = 0.0;
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int c = cell(g, i, j, k);
                double courant = 0.0;
                int fast = 0;
                for (int a = 0; a < 3; a++) {
                    const double u = fabs(f->u[a][c]);
                    courant += u * f->dt / g->h[a];
                    fast = !(u / g->h[a] <= fabs(f->u[fast][c]) / g->h[fast]) ? a : fast;
                    fastest = fmax(fastest, u * f->eps_f[a][c]);
                }
                if (!(courant <= 1e300) || (limited && courant > COURANT_MOST))
                    die_velocity(s, fast, c, courant);
                f->courant = fmax(f->courant, courant);
                worst = fmax(worst, fabs(fluid_divergence(s, c)));
            }
    f->divergence = fastest > 0.0 ? worst * least / fastest : 0.0;
}
