/* solver/fluid/navier_stokes.c - volume-averaged Navier-Stokes, incompressible fluid among
 * grains.
 *
 * Form 27a of the review, mended [AndersonJackson67], with p free of its hydrostatic part:
 *   rho d(eps u)/dt + rho div(eps u u) = eps (-grad p + div tau + f) - (B u - S)
 *   d(eps)/dt + div(eps u) = 0
 * (the review prints nabla u for div u, and returns buoyancy and pressure force to the fluid,
 * which eps grad p holds already). f is the pressure gradient that drives periodic directions.
 *
 * In time: convection and stress by Adams-Bashforth 2 (Euler at the first step), drag backward
 * Euler, pressure incremental [Chorin68], [vanKan86]:
 *   A u* = rho m_old u_old/dt + E + m (G_visc + f - grad p) + S,   A = rho m/dt + B,  m = eps_f
 *   div((m^2/A) grad dp) = div(m u*) + (eps - eps_old)/dt
 *   u = u* - (m/A) grad dp,   p += dp
 * The drag is in A, so the pressure equation knows it: a uniform bed gives the drag law's
 * pressure drop to round-off at any dt B/rho. */
#include "fluid.h"

#include "../feasibility.h"
#include "../fluid_state.h"
#include "../momentum.h"

const struct about fluid_about = {
    .name = "navier_stokes",
    .summary =
        "volume-averaged Navier-Stokes on a staggered grid, implicit drag, FFT pressure solve",
    .equation = "27a: rho d(eps u)/dt + rho div(eps u u) = -eps grad p + eps div tau - F_d",
    .source = "[AndersonJackson67], [vanKan86], [ConcusGolub73]",
    .range = "sum of u dt/h < 0.5, 4 nu dt sum 1/h^2 < 1; any drag"};

const struct key fluid_keys[] = {
    {"fluid", "density", KEY_REAL, "kg m-3", "(0, inf)", NULL, "density"},
    {"fluid", "viscosity", KEY_REAL, "Pa s", "[0, inf)", NULL, "dynamic viscosity"},
    {"fluid", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto",
     "the fluid's step; auto: half of the limits at the largest velocity of [flow]"},
    {"fluid", "form", KEY_CHOICE, "", "27a", "27a",
     "27a: -eps grad p + eps div tau on the fluid, the rest of both on the grains"},
    {"fluid", "convection", KEY_CHOICE, "", "van_leer | centred | upwind", "van_leer",
     "interpolation of the convected velocity"},
    {"fluid", "tolerance", KEY_REAL, "1", "(0, 0.1]", "1e-11",
     "residual of the pressure solve, relative to its right-hand side"},
    {0},
};

/* The explicit terms, this step and the step before, and scratch. */
struct fluid_work {
    struct momentum momentum;
    struct pressure *pressure;
    double *convection[3], *viscous[3];         /* N/m3, this step */
    double *convection_old[3], *viscous_old[3]; /* N/m3, the step before */
    double *coefficient[3], *rhs, *dp;
    double tolerance;
    double iterations; /* of the last solve, for the series */
};

static void check_sides(struct sim *s, struct scene *scene)
{
    bool inflow = false, open = false;
    for (int side = 0; side < 6; side++) {
        const enum side_kind kind = s->domain.side[side].kind;
        inflow = inflow || kind == SIDE_INFLOW;
        open = open || kind == SIDE_OUTFLOW;
        if (kind == SIDE_HEAD || kind == SIDE_FLUX)
            scene_error(
                scene, "domain", NULL, side_name[side],
                "%s sides are for fluid = darcy; navier_stokes knows periodic, wall, slip, "
                "inflow, outflow",
                side_kind_name[kind]);
    }
    if (inflow && !open)
        scene_error(scene, "domain", NULL, NULL, "an inflow side needs an outflow side");
    const double drive[3] = {s->flow.gradient.x, s->flow.gradient.y, s->flow.gradient.z};
    for (int a = 0; a < 3; a++)
        if (drive[a] != 0.0 && !s->domain.periodic[a])
            scene_error(scene, "flow", NULL, "pressure_gradient",
                        "drives periodic directions only, and %c is not", 'x' + a);
    if (!inflow && s->flow.velocity > 0.0)
        scene_error(scene, "flow", NULL, "velocity", "there is no inflow side");
}

void fluid_create(struct sim *s, struct scene *scene)
{
    struct fluid_work *const ns = s->fluid.work = xalloc(1, sizeof *ns);
    ns->tolerance = scene_real(scene, "fluid", NULL, "tolerance");
    scene_choice(scene, "fluid", NULL, "form");
    const int scheme = scene_choice(scene, "fluid", NULL, "convection");
    check_sides(s, scene);
    if (!fluid_state_create(s, scene))
        return;
    const struct grid *const g = &s->grid;
    enum poisson_side side[6];
    static const char *const names[3][2] = {{"convection_old_x", "viscous_old_x"},
                                            {"convection_old_y", "viscous_old_y"},
                                            {"convection_old_z", "viscous_old_z"}};
    fluid_pressure_sides(&s->domain, side);
    ns->pressure = pressure_create(g, &s->domain, side);
    momentum_create(&ns->momentum, g, (enum convection)scheme);
    ns->rhs = grid_field(g);
    ns->dp = grid_field(g);
    for (int a = 0; a < 3; a++) {
        double **const fields[] = {&ns->convection[a], &ns->viscous[a], &ns->convection_old[a],
                                   &ns->viscous_old[a], &ns->coefficient[a]};
        for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
            *fields[i] = grid_field(g);
        const enum place place = a == 0 ? PLACE_FACE_X : a == 1 ? PLACE_FACE_Y : PLACE_FACE_Z;
        fields_add(&s->fields,
                   (struct field){names[a][0], "N m-3", "convection a step ago", place,
                                  KIND_REAL, (void **)&ns->convection_old[a], FIELD_STATE});
        fields_add(&s->fields,
                   (struct field){names[a][1], "N m-3", "div tau a step ago", place, KIND_REAL,
                                  (void **)&ns->viscous_old[a], FIELD_STATE});
    }
    series_add(&s->series, "pressure_iterations", "1", "iterations of the pressure solve",
               &ns->iterations);
}

void fluid_free(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    if (!s->fluid.p)
        return;
    pressure_free(ns->pressure);
    momentum_free(&ns->momentum);
    for (int a = 0; a < 3; a++) {
        void *const all[] = {ns->convection[a], ns->viscous[a], ns->convection_old[a],
                             ns->viscous_old[a], ns->coefficient[a]};
        for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
            xfree(all[i]);
    }
    xfree(ns->rhs);
    xfree(ns->dp);
    xfree(ns);
    fluid_state_free(s);
}

void fluid_sense(struct sim *s)
{
    coupling_volume(s);
    if (s->coupling.calls == 0) /* the flow starts as it enters */
        fluid_velocity_sides(s, s->t);
    coupling_drag(s);
}

void fluid_load(struct sim *s)
{
    coupling_load(s);
}

/* Explicit terms at the old velocities, extrapolated to the half step. */
static void explicit_terms(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    const bool first = s->fluid.steps == 0;
    momentum_dilatation(s, &ns->momentum);
    for (int a = 0; a < 3; a++) {
        momentum_convection(s, &ns->momentum, a, ns->convection[a]);
        momentum_viscous(s, &ns->momentum, a, ns->viscous[a]);
        double *const now[2] = {ns->convection[a], ns->viscous[a]};
        double *const old[2] = {ns->convection_old[a], ns->viscous_old[a]};
        for (int q = 0; q < 2; q++)
#pragma omp parallel for schedule(static)
            for (size_t c = 0; c < s->grid.total; c++) {
                const double x = now[q][c];
                now[q][c] = first ? x : 1.5 * x - 0.5 * old[q][c];
                old[q][c] = x;
            }
    }
}

/* dp/dx on face c of layer i of direction a; half a cell on an open side, where p = 0 */
static double gradient(const struct sim *s, const double *p, int a, int i, int c)
{
    const struct grid *const g = &s->grid;
    if (!s->domain.periodic[a] && i == 1)
        return 2.0 * p[c] / g->h[a];
    if (!s->domain.periodic[a] && i == g->n[a] + 1)
        return -2.0 * p[c - g->s[a]] / g->h[a];
    return (p[c] - p[c - g->s[a]]) / g->h[a];
}

static void predict(struct sim *s, int a)
{
    struct fluid_work *const ns = s->fluid.work;
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const double rate = f->rho / f->dt;
    const double drive = a == 0   ? s->flow.gradient.x
                         : a == 1 ? s->flow.gradient.y
                                  : s->flow.gradient.z;
    const int last[3] = {face_last(g, a, 0), face_last(g, a, 1), face_last(g, a, 2)};
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= last[2]; k++)
        for (int j = 1; j <= last[1]; j++)
            for (int i = 1; i <= last[0]; i++) {
                const int c = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                const double m = f->eps_f[a][c], A = rate * m + f->drag[a][c];
                const double m_old = 0.5 * (f->eps_old[c] + f->eps_old[c - g->s[a]]);
                ns->coefficient[a][c] = m * m / A;
                if (!face_solved(s, a, n))
                    continue;
                const double push = ns->viscous[a][c] + drive - gradient(s, f->p, a, n, c);
                f->u[a][c] = (rate * m_old * f->u[a][c] + ns->convection[a][c] + m * push +
                              f->drag_s[a][c]) /
                             A;
            }
}

static void correct(struct sim *s, int a)
{
    struct fluid_work *const ns = s->fluid.work;
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const int last[3] = {face_last(g, a, 0), face_last(g, a, 1), face_last(g, a, 2)};
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= last[2]; k++)
        for (int j = 1; j <= last[1]; j++)
            for (int i = 1; i <= last[0]; i++) {
                const int c = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                if (face_solved(s, a, n))
                    f->u[a][c] -=
                        ns->coefficient[a][c] / f->eps_f[a][c] * gradient(s, ns->dp, a, n, c);
            }
}

/* Scale of the right-hand side, for what round-off leaves: velocity over cell, over all cells.
 */
static double round_off(const struct sim *s)
{
    const struct grid *const g = &s->grid;
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        sum = fmax(sum, max_abs(s->fluid.u[a], g->total) / g->h[a]);
    return 1e-15 * sum * sqrt((double)g->n[0] * g->n[1] * g->n[2]);
}

/* A closed box cannot lose or gain volume: what would be dropped in silence stops the run. */
static void check_balance(const struct sim *s, double floor)
{
    const struct fluid_work *const ns = s->fluid.work;
    const double size = max_abs(ns->rhs, s->grid.total);
    const double lost = pressure_imbalance(ns->pressure, 0.0, ns->rhs);
    if (lost > 1e-6 && size > 1e3 * floor)
        die(EXIT_UNSTABLE,
            "the fluid of the closed box has nowhere to go at t = %.9g s: its volume is asked "
            "to change "
            "by %.3g of the flow",
            s->t, lost);
}

static void project(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int c = cell(g, 1, j, k); c <= cell(g, g->n[0], j, k); c++) {
                ns->rhs[c] = fluid_divergence(s, c);
                ns->dp[c] = 0.0;
            }
    const double floor = round_off(s);
    check_balance(s, floor);
    const struct solve r = pressure_solve(ns->pressure, ns->coefficient, 0.0, ns->rhs, ns->dp,
                                          ns->tolerance, floor);
    ns->iterations = f->iterations = r.iterations;
    f->residual = r.start > 0.0 ? r.end / r.start : 0.0;
    if (!r.converged)
        die(EXIT_UNSTABLE,
            "the pressure has not converged at t = %.9g s, step %ld: residual %.3g of its "
            "start "
            "after %d iterations, fluid.tolerance is %g (smallest fluid fraction %.3g)",
            s->t, s->step, f->residual, r.iterations, ns->tolerance, s->coupling.eps_least);
    for (int a = 0; a < 3; a++)
        correct(s, a);
    for (size_t c = 0; c < g->total; c++)
        f->p[c] += ns->dp[c];
    fluid_velocity_sides(s, s->t + f->dt);
}

/* G = -grad p + div tau + f where there is an equation; on an inflow face what balances its
 * drag. */
static void stress(struct sim *s, int a)
{
    struct fluid_work *const ns = s->fluid.work;
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const double drive = a == 0   ? s->flow.gradient.x
                         : a == 1 ? s->flow.gradient.y
                                  : s->flow.gradient.z;
    const double viscous = s->coupling.viscous ? 1.0 : 0.0;
    const int last[3] = {face_last(g, a, 0), face_last(g, a, 1), face_last(g, a, 2)};
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= last[2]; k++)
        for (int j = 1; j <= last[1]; j++)
            for (int i = 1; i <= last[0]; i++) {
                const int c = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                if (face_solved(s, a, n) || s->domain.periodic[a]) {
                    f->stress[a][c] =
                        drive - gradient(s, f->p, a, n, c) + viscous * ns->viscous[a][c];
                } else { /* a given velocity: 0 on a wall */
                    const int side = 2 * a + (n > 1);
                    const bool inflow = s->domain.side[side].kind == SIDE_INFLOW;
                    f->stress[a][c] =
                        inflow ? (f->drag[a][c] * f->u[a][c] - f->drag_s[a][c]) / f->eps_f[a][c]
                               : 0.0;
                }
            }
}

void fluid_step(struct sim *s)
{
    fluid_velocity_sides(s, s->t);
    explicit_terms(s);
    for (int a = 0; a < 3; a++)
        predict(s, a);
    fluid_velocity_sides(s, s->t + s->fluid.dt); /* what enters at the end of the step */
    project(s);
    for (int a = 0; a < 3; a++)
        stress(s, a);
    fluid_guard(s, !s->run.force);
    s->fluid.steps++;
}

double fluid_side_pressure(const struct sim *s, int side)
{
    return fluid_boundary_pressure(s, side);
}

void fluid_feasibility(const struct sim *s, struct feasibility *f)
{
    if (isfinite(fluid_courant_limit(s)))
        feasibility_add(f, "Courant", "s", s->fluid.dt, fluid_courant_limit(s), true,
                        "h/(2 u) at the largest velocity of [flow], porosity 0.4");
    if (isfinite(fluid_viscous_limit(s)))
        feasibility_add(f, "explicit viscosity", "s", s->fluid.dt, fluid_viscous_limit(s), true,
                        "1/(4 nu sum 1/h^2)");
}
