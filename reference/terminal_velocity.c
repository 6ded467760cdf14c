/* reference/terminal_velocity.c - one grain falls through a fluid at rest, or in uniform flow.
 *
 *   m dv/dt = (m - rho V) g - kappa(|w|) w,   kappa = 3 pi mu d Fhat(1, rho |w| d/mu), w = v - u
 *
 * with the drag law of the run for eps = 1 and u the steady velocity at the inflow side, if any, integrated by an adaptive Runge-Kutta method of
 * order 8 [PrinceDormand81] from the velocity of the grain when the fluid sets in; without
 * buoyancy where the scene switches it off. The grain compared is the first of the scene. Its
 * terminal velocity is the root of the balance of forces; those of Stokes' [Stokes1851] and of
 * Schiller and Naumann's drag [SchillerNaumann35], C_D = 24/Re (1 + 0.15 Re^0.687), 0.44 from
 * Re = 1000 on, are given besides. The comparison ends when the grain touches something. Exact
 * for one-way scenes; in two-way ones the difference is what the grid adds. */
#include "reference.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>
#include "../drag/drag.h"
#include "../solver/sim.h"

const struct about reference_about = {
    .name = "terminal_velocity",
    .summary =
        "velocity of one falling grain against the solution of its own equation of motion",
    .equation = "m dv/dt = (m - rho V) g - 3 pi mu d Fhat(1, Re) v",
    .source = "[Stokes1851]; [SchillerNaumann35]",
    .range = "one grain in a fluid at rest, or in steady uniform flow from an inflow side"};
const struct key reference_keys[] = {
    {"reference", "tolerance", KEY_REAL, "1", "(0, inf)", "0.1 %", "of the final velocity"},
    {0},
};

enum { ROWS = 200 };
static const double pi = 3.14159265358979323846;

struct terminal_velocity {
    double tolerance;
    double mass, d, rho, mu;
    vec3 pull; /* N, weight less buoyancy */
    vec3 down; /* unit vector along it */
    vec3 wind; /* m/s, of the fluid */
    bool started, ended;
    double t, v[3]; /* s, m/s: the exact solution, at the time of the last step */
    double speed;   /* m/s, simulated, along `down`, then */
    double next;    /* s, of the next row */
    const struct drag_grain *grain;
    double (*factor)(const struct terminal_velocity *p, double re); /* of the law whose balance
                                                                       is sought */
    gsl_odeiv2_driver *driver;
    gsl_odeiv2_system system;
    struct table *table;
};

enum { COLUMNS = 4 };
static const struct table pattern = {
    .name = "settling",
    .title = "velocity of the falling grain",
    .n_columns = COLUMNS,
    .column = {{"time", "s", "time"},
               {"simulated", "m s-1", "velocity along gravity, simulated"},
               {"exact", "m s-1", "velocity along gravity, exact"},
               {"error", "1", "(simulated - exact) / terminal velocity"}},
    .figure = {.file = "settling.png",
               .title = "velocity of the falling grain",
               .x = "time",
               .x_label = "time / s",
               .y_label = "velocity / m s^{-1}",
               .n_curves = 2,
               .curve = {{"simulated", "points", "simulated"}, {"exact", "line", "exact"}}}};

static double factor_run(const struct terminal_velocity *p, double re)
{
    return drag_factor(
        &(struct drag_point){.eps = 1.0, .re = re, .d = p->d, .y = 1.0, .grain = p->grain});
}

static double factor_stokes(const struct terminal_velocity *p, double re)
{
    (void)p;
    (void)re;
    return 1.0;
}

static double factor_schiller_naumann(const struct terminal_velocity *p, double re)
{
    (void)p;
    return re < 1000.0 ? 1.0 + 0.15 * pow(re, 0.687) : 0.44 / 24.0 * re;
}

/* N; drag at speed v less the pull. */
static double balance(double v, void *params)
{
    const struct terminal_velocity *const p = params;
    const double factor = p->factor(p, p->rho * v * p->d / p->mu);
    return 3.0 * pi * p->mu * p->d * factor * v - v3_norm(p->pull);
}

/* m/s; the speed at which a law's drag carries the pull. NAN if there is none. */
static double terminal(struct terminal_velocity *p,
                       double (*factor)(const struct terminal_velocity *, double))
{
    double hi = 1e-12, v = (double)NAN;
    p->factor = factor;
    if (v3_norm(p->pull) == 0.0)
        return 0.0;
    while (balance(hi, p) < 0.0) {
        hi *= 2.0;
        if (hi > 1e6)
            return v;
    }
    gsl_function f = {.function = balance, .params = p};
    gsl_root_fsolver *const solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    gsl_root_fsolver_set(solver, &f, 0.0, hi);
    for (int i = 0; i < 200; i++) {
        gsl_root_fsolver_iterate(solver);
        v = gsl_root_fsolver_root(solver);
        if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver),
                                   gsl_root_fsolver_x_upper(solver), 0.0, 1e-14) == GSL_SUCCESS)
            break;
    }
    gsl_root_fsolver_free(solver);
    return v;
}

/* dv/dt; the signature is GSL's. */
static int acceleration(double t, const double v[], double dvdt[], void *params)
{
    const struct terminal_velocity *const p = params;
    const vec3 w = v3_sub(v3(v[0], v[1], v[2]), p->wind);
    const double speed = v3_norm(w);
    const double kappa = 3.0 * pi * p->mu * p->d * factor_run(p, p->rho * speed * p->d / p->mu);
    (void)t;
    dvdt[0] = (p->pull.x - kappa * w.x) / p->mass;
    dvdt[1] = (p->pull.y - kappa * w.y) / p->mass;
    dvdt[2] = (p->pull.z - kappa * w.z) / p->mass;
    return GSL_SUCCESS;
}

static vec3 velocity(const struct sim *s)
{
    for (int i = 0; i < s->grains.n; i++)
        if (s->grains.id[i] == 0)
            return s->grains.vel[i];
    return v3(0.0, 0.0, 0.0);
}

/* The state at hand becomes the start of the exact solution. */
static void start(struct terminal_velocity *p, const struct sim *s)
{
    const vec3 v = velocity(s);
    p->v[0] = v.x;
    p->v[1] = v.y;
    p->v[2] = v.z;
    p->t = s->t;
}

void reference_create(struct sim *s, struct scene *scene)
{
    struct terminal_velocity *const p = xalloc(1, sizeof *p);
    s->reference = p;
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    if (!s->fluid.exists || (scene_errors(scene) == 0 && s->grains.n < 1))
        scene_error(scene, "modules", NULL, "reference",
                    "terminal_velocity needs a fluid and a grain");
    if (scene_errors(scene) > 0)
        return;
    p->mass = s->grains.mass[0];
    p->d = s->grains.species[s->grains.kind[0]].diameter;
    p->rho = s->fluid.rho;
    p->mu = s->fluid.mu;
    p->grain = &s->coupling.drag_of.kind[s->grains.kind[0]];
    if (!(factor_run(p, 1.0) > 0.0)) {
        scene_error(scene, "modules", NULL, "drag", "terminal_velocity needs a drag law");
        return;
    }
    const double fluid = s->coupling.forces.weight * p->rho * s->grains.volume[0];
    p->pull = v3_scale(p->mass + fluid, s->domain.gravity);
    const double pull = v3_norm(p->pull);
    for (int side = 0; side < 6; side++)
        if (s->domain.side[side].kind == SIDE_INFLOW) {
            const double in = (side % 2 ? -1.0 : 1.0) * s->flow.velocity;
            p->wind = v3_add(p->wind, v3(side / 2 == 0 ? in : 0.0, side / 2 == 1 ? in : 0.0,
                                         side / 2 == 2 ? in : 0.0));
        }
    p->down = pull > 0.0 ? v3_scale(1.0 / pull, p->pull) : v3(0.0, 0.0, -1.0);
    p->system = (gsl_odeiv2_system){acceleration, NULL, 3, p};
    p->driver =
        gsl_odeiv2_driver_alloc_y_new(&p->system, gsl_odeiv2_step_rk8pd, 1e-9, 1e-16, 1e-12);
    p->table = tables_add(&s->tables, &pattern);
    start(p, s);
}

static void add_row(struct terminal_velocity *p, double scale)
{
    const double exact = v3_dot(p->down, v3(p->v[0], p->v[1], p->v[2]));
    const double row[COLUMNS] = {p->t, p->speed, exact, (p->speed - exact) / scale};
    table_row(p->table, row);
}

void reference_watch(struct sim *s)
{
    struct terminal_velocity *const p = s->reference;
    if (p->ended)
        return;
    if (!s->fluid.on) {
        start(p, s);
        return;
    }
    if (s->neighbours.touching > 0) {
        p->ended = true;
        return;
    }
    if (gsl_odeiv2_driver_apply(p->driver, &p->t, s->t, p->v) != GSL_SUCCESS)
        die(EXIT_UNSTABLE, "the exact solution of the falling grain failed at t = %g s", s->t);
    p->speed = v3_dot(p->down, velocity(s));
    p->started = true;
    if (s->t >= p->next) {
        add_row(p, 1.0); /* the error is divided by the terminal velocity at the end */
        p->next = s->t + s->run.end / ROWS;
    }
}

void reference_report(struct sim *s)
{
    struct terminal_velocity *const p = s->reference;
    struct summary *const sum = &s->summary;
    struct table *const t = p->table;
    const double limit = terminal(p, factor_run);
    const double exact = v3_dot(p->down, v3(p->v[0], p->v[1], p->v[2]));
    const double error = p->started ? p->speed / exact - 1.0 : (double)NAN;
    if (p->started && (t->n_rows == 0 || t->row[(size_t)(t->n_rows - 1) * COLUMNS] < p->t))
        add_row(p, 1.0);
    double worst = 0.0;
    for (int r = 0; r < t->n_rows; r++) {
        double *const e = &t->row[(size_t)r * COLUMNS + 3];
        *e /= limit > 0.0 ? limit : exact;
        worst = fmax(worst, fabs(*e));
    }
    summary_number(sum, "velocity", p->speed, "m s-1");
    summary_number(sum, "velocity_exact", exact, "m s-1");
    summary_number(sum, "velocity_error", error, "1");
    summary_number(sum, "velocity_error_worst", worst, "1");
    summary_number(sum, "terminal_velocity", limit, "m s-1");
    summary_number(sum, "terminal_reynolds", p->rho * limit * p->d / p->mu, "1");
    summary_number(sum, "terminal_velocity_stokes", terminal(p, factor_stokes), "m s-1");
    summary_number(sum, "terminal_velocity_schiller_naumann",
                   terminal(p, factor_schiller_naumann), "m s-1");
    printf(
        "terminal velocity: drag law %.6g m/s, Stokes %.6g m/s, Schiller-Naumann %.6g m/s\n"
        "largest difference on the way: %.3g %% of the terminal velocity; reached %.4g of it\n",
        limit, terminal(p, factor_stokes), terminal(p, factor_schiller_naumann), 100.0 * worst,
        p->speed / limit);
    const bool good = fabs(error) <= p->tolerance;
    printf("reference: %s velocity at t = %g s, %.6g m/s against %.6g m/s, %+.4f %%, tolerance "
           "%g %%\n",
           good ? "pass" : "FAIL", p->t, p->speed, exact, 100.0 * error, 100.0 * p->tolerance);
    summary_reference(sum, (struct comparison){.quantity = "velocity at the end",
                                               .source = reference_about.source,
                                               .unit = "m s-1",
                                               .got = p->speed,
                                               .want = exact,
                                               .error = error,
                                               .tolerance = p->tolerance});
    summary_text(sum, "verdict", good ? "pass" : "FAIL");
}

void reference_free(struct sim *s)
{
    struct terminal_velocity *const p = s->reference;
    if (p && p->driver)
        gsl_odeiv2_driver_free(p->driver);
    xfree(p);
}
