/* solver/fluid/navier_stokes.c - volume-averaged Navier-Stokes, incompressible fluid among
 * grains.
 *
 * Forms 27a, b, c of the review, mended [AndersonJackson67], [Zhou10], with p free of its
 * hydrostatic part:
 *   a  rho d(eps u)/dt + rho div(eps u u) = eps (-grad p + div tau + f) - F_d
 *   b                                     = eps (-grad p + f) + div(eps tau) - F_d
 *   c                                     = -grad p + f + div(eps tau) - F_d/eps
 *   d(eps)/dt + div(eps u) = 0
 * f is the pressure gradient that drives periodic directions. A grain feels, besides buoyancy,
 *   a, b  F_d + V (-grad p + f + div tau)           c  F_d/eps
 * The review prints nabla u for div u, and returns pressure force, viscous force and buoyancy
 * to the fluid in all three, which eps grad p and eps div tau hold already; in c, whose
 * pressure the fluid takes alone, the drag carries 1/eps. c is the same physics as a only where
 * the flow is steady and uniform [Zhou10]; a and b are where the porosity is uniform.
 *
 * In time, second order: convection by Adams-Bashforth 2 (with a step that may change; Euler at
 * the first), the viscous Laplacian by the same or by Crank and Nicolson, pressure incremental
 * [Chorin68], [vanKan86]; drag backward Euler, first order, stable at any dt B/rho:
 *   A u* = rho m_old u_old/dt + E + g (f - grad p) + S,   A = rho m/dt + B,  m = eps_f
 *   div((m g/A) grad dp) = div(m u*) + d(eps)/dt,         g = m, in form c 1
 *   u = u* - (g/A) grad dp,   p += dp
 * The drag is in A, so the pressure equation knows it: a uniform bed gives the drag law's
 * pressure drop to round-off at any dt B/rho. Without grains A is constant, and one direct
 * solve does. */
#include "fluid.h"

#include "../diffusion.h"
#include "../../forces/force.h"
#include "../feasibility.h"
#include "../fluid_state.h"
#include "../force_names.h"
#include "../momentum.h"
#include "../porosity_rate.h"
#include "../projection.h"

const struct about fluid_about = {
    .name = "navier_stokes",
    .summary =
        "volume-averaged Navier-Stokes on a staggered grid, implicit drag, FFT pressure solve",
    .equation =
        "27a, b, c: rho d(eps u)/dt + rho div(eps u u) = -eps grad p + eps div tau - F_d",
    .source = "[AndersonJackson67], [Zhou10], [vanKan86], [ConcusGolub73]",
    .range = "sum of u dt/h < 0.5, explicit viscosity 4 nu dt sum 1/h^2 < 1; any drag"};

const struct key fluid_keys[] = {
    {"fluid", "density", KEY_REAL, "kg m-3", "(0, inf)", NULL, "density"},
    {"fluid", "viscosity", KEY_REAL, "Pa s", "[0, inf)", NULL, "dynamic viscosity"},
    {"fluid", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto",
     "the fluid's step; auto: adapts to fluid.courant and to viscosity, in whole grain steps"},
    {"fluid", "courant", KEY_REAL, "1", "(0, 0.5]", "0.25",
     "largest sum of u dt/h that dt = auto aims at"},
    {"fluid", "form", KEY_CHOICE, "", "a | b | c", "a",
     "a: -eps grad p + eps div tau; b: -eps grad p + div(eps tau); c: -grad p + div(eps tau)"},
    {"fluid", "convection", KEY_CHOICE, "", "van_leer | centred | upwind", "van_leer",
     "interpolation of the convected velocity"},
    {"fluid", "viscous", KEY_CHOICE, "", "explicit | implicit", "explicit",
     "Adams-Bashforth 2, or Crank-Nicolson (no limit of the time step)"},
    {"fluid", "porosity_rate", KEY_CHOICE, "", "difference | flux | off", "difference",
     "d(eps)/dt in continuity: in time, by the grains' solid flux, or left out"},
    {"fluid", "tolerance", KEY_REAL, "1", "(0, 0.1]", "1e-11",
     "residual of the pressure solve, relative to its right-hand side"},
    {0},
};

static const char *const form_equation[] = {
    "27a: rho d(eps u)/dt + rho div(eps u u) = -eps grad p + eps div tau - F_d",
    "27b: rho d(eps u)/dt + rho div(eps u u) = -eps grad p + div(eps tau) - F_d",
    "27c: rho d(eps u)/dt + rho div(eps u u) = -grad p + div(eps tau) - F_d/eps"};

struct fluid_work {
    struct momentum momentum;
    struct diffusion diffusion; /* with implicit viscosity */
    struct pressure *pressure;  /* with grains */
    struct poisson *direct;     /* without */
    double *one;                /* its coefficients, 1 */
    double *old[3];             /* N/m3, explicit terms a step ago (state) */
    double
        *now[3]; /* without grains the new velocities; with, R, then the coefficient w (scratch
                       of the coupling, as rhs) */
    double *dp;  /* Pa */
    double *rhs; /* 1/s, with grains */
    double tolerance, courant;
    double iterations; /* of the last pressure solve, for the series */
    double rate;       /* 1/s, Courant number over the step, at the last step (state) */
    double dt_old;     /* s, the last step (state); 0: none yet */
    bool adapts, by_flux;
};

static void check_sides(struct sim *s, struct scene *scene)
{
    bool inflow = false, common = false, open = false;
    for (int side = 0; side < 6; side++) {
        const enum side_kind kind = s->domain.side[side].kind;
        inflow = inflow || kind == SIDE_INFLOW;
        common = common || (kind == SIDE_INFLOW && !s->domain.side[side].own_inflow);
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
    const double rate[3] = {s->flow.held_rate.x, s->flow.held_rate.y, s->flow.held_rate.z};
    for (int a = 0; a < 3; a++)
        if ((drive[a] != 0.0 || rate[a] != 0.0) && !s->domain.periodic[a])
            scene_error(scene, "flow", NULL, drive[a] != 0.0 ? "pressure_gradient" : "rate",
                        "drives periodic directions only, and %c is not", 'x' + a);
    if (!common && flow_most(&s->flow) > 0.0)
        scene_error(scene, "flow", NULL, s->flow.course.n > 0 ? "table" : "velocity",
                    inflow ? "every inflow side has its own" : "there is no inflow side");
}

static void check_forces(struct scene *scene, enum form form)
{
    const char *const text = scene_text(scene, "modules", NULL, "forces");
    for (int i = 0; forces[i] && form == FORM_C; i++)
        if ((forces[i]->of_pressure != 0.0 || forces[i]->of_viscous != 0.0) &&
            force_names_given(text, forces[i]->about.name))
            scene_error(scene, "modules", NULL, "forces",
                        "fluid.form = c has %s in the drag, which carries 1/eps; leave it out",
                        forces[i]->about.name);
}

static void create_fields(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    const struct grid *const g = &s->grid;
    static const char *const names[3] = {"explicit_x", "explicit_y", "explicit_z"};
    for (int a = 0; a < 3; a++) {
        ns->old[a] = grid_field(g);
        ns->now[a] = s->fluid.bare ? grid_field(g) : s->coupling.K[a];
        fields_add(&s->fields,
                   (struct field){names[a], "N m-3", "explicit terms of momentum a step ago",
                                  (enum place)(PLACE_FACE_X + a), KIND_REAL,
                                  (void **)&ns->old[a], FIELD_STATE});
    }
    ns->dp = grid_field(g);
    if (!s->fluid.bare) { /* the last change is the guess of the next */
        ns->rhs = s->coupling.seen[0];
        fields_add(&s->fields,
                   (struct field){"pressure_change", "Pa", "change of the pressure in a step",
                                  PLACE_CELL, KIND_REAL, (void **)&ns->dp, FIELD_STATE});
    }
    if (ns->by_flux)
        s->fluid.rate = grid_field(g);
    if (ns->momentum.implicit)
        diffusion_create(&ns->diffusion, s);
}

void fluid_create(struct sim *s, struct scene *scene)
{
    struct fluid_work *const ns = s->fluid.work = xalloc(1, sizeof *ns);
    ns->tolerance = scene_real(scene, "fluid", NULL, "tolerance");
    ns->courant = scene_real(scene, "fluid", NULL, "courant");
    ns->adapts = scene_word(scene, "fluid", NULL, "dt", "auto");
    const enum form form = (enum form)scene_choice(scene, "fluid", NULL, "form");
    const int scheme = scene_choice(scene, "fluid", NULL, "convection");
    const bool implicit = scene_choice(scene, "fluid", NULL, "viscous") == 1;
    const int rate = scene_choice(scene, "fluid", NULL, "porosity_rate");
    s->fluid.bare = s->grains.n == 0 && s->traffic.n_sources == 0;
    s->fluid.whole_pressure = form == FORM_C;
    s->fluid.pieces = !ns->adapts ? 1 : s->grains.n > s->grains.n_frozen ? 8 : 256;
    s->fluid.implicit_viscosity = implicit;
    s->fluid.equation = form_equation[form];
    check_sides(s, scene);
    if (!fluid_state_create(s, scene))
        return;
    check_forces(scene, form);
    enum poisson_side side[6];
    fluid_pressure_sides(&s->domain, side);
    ns->by_flux = !s->fluid.bare && rate > 0 && s->coupling.ways == 2;
    ns->momentum.rate_off = rate == 2;
    momentum_create(&ns->momentum, s, (enum convection)scheme, form, implicit);
    create_fields(s);
    if (s->fluid.bare) {
        ns->direct = poisson_create(&s->grid, side);
        ns->one = xalloc((size_t)s->grid.n[2] + 2, sizeof *ns->one);
        for (int k = 0; k < s->grid.n[2] + 2; k++)
            ns->one[k] = 1.0;
    } else {
        ns->pressure = pressure_create(&s->grid, &s->domain, side);
        pressure_lend(ns->pressure, s->coupling.seen[1], s->coupling.seen[2]);
        series_add(&s->series, "pressure_iterations", "1", "iterations of the pressure solve",
                   &ns->iterations);
    }
    if (ns->adapts)
        series_add(&s->series, "fluid_step", "s", "the fluid's time step", &s->fluid.dt);
    if (s->flow.held)
        series_add(&s->series, "rate_error", "m s-1",
                   "largest difference of the flow rate to the one that is held",
                   &s->flow.rate_off);
}

void fluid_free(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    if (!s->fluid.p)
        return;
    pressure_free(ns->pressure);
    poisson_free(ns->direct);
    momentum_free(&ns->momentum);
    diffusion_free(&ns->diffusion);
    for (int a = 0; a < 3; a++) {
        xfree(ns->old[a]);
        if (s->fluid.bare)
            xfree(ns->now[a]);
    }
    void *const all[] = {ns->one, ns->dp, s->fluid.rate, ns};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    fluid_state_free(s);
}

/* The step for dt = auto, from the last step's velocities and what flows in next: shorter at
 * once, longer by a fifth at a time and not for little. */
static void adapt(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    if (!ns->adapts || ns->dt_old == 0.0)
        return;
    const double rate = fmax(ns->rate, fluid_entry_rate(s, s->t + ns->dt_old));
    double most = fmin(ns->courant / rate, s->run.end / 10.0); /* rate 0: infinite */
    if (!ns->momentum.implicit)
        most = fmin(most, 0.8 * fluid_viscous_limit(s));
    const int now = (int)rint(ns->dt_old / s->run.dt);
    const double room = floor(most / s->run.dt + 1e-9);
    const double left = fmax(1.0, ceil((s->run.end - s->t) / s->run.dt - 1e-9));
    int n = now;
    if (room < now)
        n = room > 1.0 ? (int)room : 1;
    else if (room > 1.25 * now)
        n = now + (now < 5 ? 1 : now / 5);
    n = n > left ? (int)left : n;
    s->run.substeps = n;
    s->fluid.dt = n * s->run.dt;
}

void fluid_sense(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    adapt(s);
    if (s->fluid.steps == 0 && ns->dt_old == 0.0) /* the flow starts as it enters */
        fluid_velocity_sides(s, s->t);
    if (s->fluid.bare)
        return;
    coupling_volume(s);
    if (s->fluid.steps == 0 && ns->dt_old == 0.0)
        fluid_velocity_sides(s, s->t);
    if (ns->by_flux && !ns->momentum.rate_off)
        porosity_rate(s, ns->rhs, s->fluid.rate);
    coupling_drag(s);
}

void fluid_load(struct sim *s)
{
    if (!s->fluid.bare)
        coupling_load(s);
}

/* A closed box cannot lose or gain volume: what would be dropped in silence stops the run, but
 * not what round-off leaves of flows that balance (`most`: the largest u/h). */
static void check_balance(const struct sim *s, double most)
{
    const struct fluid_work *const ns = s->fluid.work;
    const struct grid *const g = &s->grid;
    const double lost = pressure_imbalance(ns->pressure, 0.0, ns->rhs);
    double size = 0.0;
    for (int row = 0; row < g->n[1] * g->n[2] && lost > 1e-6; row++)
        size = fmax(size, max_abs(ns->rhs + cell(g, 1, row % g->n[1] + 1, row / g->n[1] + 1),
                                  (size_t)g->n[0]));
    if (lost * size > 1e-10 * most)
        die(EXIT_UNSTABLE,
            "the fluid of the closed box has nowhere to go at t = %.9g s: its volume is asked "
            "to change by %.3g of the flow",
            s->t, lost);
}

/* dp for the velocities u* at hand, without grains: rho/dt div u* in one direct solve. */
static void solve_plain(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    fluid_divergences(s, s->fluid.rho / s->fluid.dt, ns->dp);
    poisson_solve(ns->direct, ns->one, ns->one, 0.0, ns->dp, ns->dp);
    grid_ghosts(&s->grid, &s->domain, ns->dp);
}

static void solve_porous(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const double most = fluid_divergences(s, 1.0, ns->rhs);
    const double floor = 1e-15 * most * sqrt((double)g->n[0] * g->n[1] * g->n[2]);
    check_balance(s, most);
    const struct solve r =
        pressure_solve(ns->pressure, ns->now, 0.0, ns->rhs, ns->dp, ns->tolerance, floor);
    ns->iterations = f->iterations = r.iterations;
    f->residual = r.start > 0.0 ? r.end / r.start : 0.0;
    if (!isfinite(most) || !isfinite(r.start))
        die(EXIT_UNSTABLE,
            "the flow has blown up at t = %.9g s, step %ld: its divergence is %.3g 1/s; take a "
            "shorter fluid.dt (./run.sh check names its limits)",
            s->t, s->step, most);
    if (!r.converged)
        die(EXIT_UNSTABLE,
            "the pressure has not converged at t = %.9g s, step %ld: residual %.3g of its "
            "start after %d iterations, fluid.tolerance is %g (smallest fluid fraction %.3g)",
            s->t, s->step, f->residual, r.iterations, ns->tolerance, s->coupling.eps_least);
}

static void swap(double **a, double **b)
{
    double *const c = *a;
    *a = *b;
    *b = c;
}

/* u* without grains. */
static void predict_plain(struct sim *s, double now, double before)
{
    struct fluid_work *const ns = s->fluid.work;
    momentum_plain(s, &ns->momentum, now, before, ns->old, ns->now);
    if (ns->momentum.implicit) {
        fluid_velocity_sides(s, s->t + 0.5 * s->fluid.dt);
        for (int a = 0; a < 3; a++)
            diffusion_direct(s, &ns->diffusion, a, ns->now[a]);
    }
    for (int a = 0; a < 3; a++)
        swap(&s->fluid.u[a], &ns->now[a]);
}

/* u* with grains, and the coefficient of the pressure equation. */
static void predict_porous(struct sim *s, double now, double before)
{
    struct fluid_work *const ns = s->fluid.work;
    const bool implicit = ns->momentum.implicit;
    momentum_dilatation(s, ns->rhs);
    momentum_porous(s, &ns->momentum, ns->rhs, ns->now, s->fluid.stress);
    for (int a = 0; a < 3; a++)
        projection_predict(s, a, now, before, ns->now[a], ns->old[a],
                           implicit ? ns->now[a] : s->fluid.u[a], implicit ? NULL : ns->now[a]);
    if (implicit) {
        fluid_velocity_sides(s, s->t + 0.5 * s->fluid.dt);
        for (int a = 0; a < 3; a++)
            diffusion_solve(s, &ns->momentum, &ns->diffusion, a, ns->now[a], s->fluid.u[a],
                            1e-8);
        for (int a = 0; a < 3; a++)
            projection_coefficient(s, a, ns->now[a]);
    }
}

void fluid_step(struct sim *s)
{
    struct fluid_work *const ns = s->fluid.work;
    struct fluid *const f = &s->fluid;
    double *const *const w = f->bare ? NULL : ns->now;
    const double ratio = ns->dt_old > 0.0 ? f->dt / ns->dt_old : 0.0;
    flow_drive(&s->flow, s->t + 0.5 * f->dt);
    fluid_velocity_sides(s, s->t);
    if (f->bare)
        predict_plain(s, 1.0 + 0.5 * ratio, -0.5 * ratio);
    else
        predict_porous(s, 1.0 + 0.5 * ratio, -0.5 * ratio);
    if (s->flow.held)
        projection_hold(s, w);
    fluid_velocity_sides(s, s->t + f->dt); /* what enters at the end of the step */
    if (f->bare)
        solve_plain(s);
    else
        solve_porous(s);
    projection_correct(s, w, ns->dp);
    fluid_velocity_sides(s, s->t + f->dt);
    if (!f->bare)
        projection_stress(s, ns->dp);
    if (s->flow.held)
        s->flow.rate_off = projection_rate_off(s);
    fluid_guard(s, !s->run.force);
    ns->rate = f->courant / f->dt;
    ns->dt_old = f->dt;
    f->steps++;
}

double fluid_side_pressure(const struct sim *s, int side)
{
    return fluid_boundary_pressure(s, side);
}

void fluid_feasibility(const struct sim *s, struct feasibility *f)
{
    const bool direct = s->fluid.bare && s->fluid.implicit_viscosity; /* helmholtz.h */
    pressure_feasibility(&s->grid, direct ? 3 : 2, f);
    if (isfinite(fluid_courant_limit(s)))
        feasibility_add(f, "Courant", "s", s->fluid.dt, fluid_courant_limit(s), true,
                        s->grains.n > 0 ? "h/(2 u) at the largest velocity given, porosity 0.4"
                                        : "h/(2 u) at the largest velocity given");
    if (isfinite(fluid_viscous_limit(s)))
        feasibility_add(f, "explicit viscosity", "s", s->fluid.dt, fluid_viscous_limit(s),
                        !s->fluid.implicit_viscosity,
                        s->fluid.implicit_viscosity ? "implicit: accuracy only"
                                                    : "1/(4 nu sum 1/h^2)");
}
