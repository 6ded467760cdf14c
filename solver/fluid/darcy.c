/* solver/fluid/darcy.c - seepage: transient total head in a porous bed.
 *
 * The review's eqs (20)-(22), mended (eq. 22 prints a derivative too many):
 *   S_s dH/dt + d(eps)/dt = div(K grad H) + q,     K = k rho g/mu,   H = p/(rho g)
 * solved for p. The drag law gives the conductivity: without inertia the momentum balance is
 * 0 = -m grad p - (B u - S), m = eps_f, so that
 *   m u = S m/B - (m^2/B) grad p
 * and m^2/B = k/mu on a face, the harmonic mean of the two cells (coupling.h): a layered column
 * is exact. Backward Euler in time. A law that depends on the velocity (Ergun) is iterated
 * (Picard).
 *
 * Cells without grains do not resist: the conductivity of a face is held below fluid.contrast
 * times the smallest of the bed; the number of faces so held is a time series. */
#include "fluid.h"

#include <string.h>
#include "../feasibility.h"
#include "../fluid_state.h"

enum { PICARD_MOST = 200 };

const struct about fluid_about = {
    .name = "darcy",
    .summary = "transient total head with storage and source; permeability from the drag law",
    .equation = "S_s dH/dt = div(K grad H) + q - d(eps)/dt, K = k rho g/mu",
    .source = "[Bear72, eq. 6.3.5]",
    .range = "seepage without inertia of the fluid; any drag law"};

const struct key fluid_keys[] = {
    {"fluid", "density", KEY_REAL, "kg m-3", "(0, inf)", NULL, "density"},
    {"fluid", "viscosity", KEY_REAL, "Pa s", "(0, inf)", NULL, "dynamic viscosity"},
    {"fluid", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto", "the fluid's step"},
    {"fluid", "storage", KEY_REAL, "m-1", "[0, inf)", "0 1/m", "specific storage S_s"},
    {"fluid", "source", KEY_REAL, "s-1", "(-inf, inf)", "0 1/s",
     "volume of fluid made per volume and time, q"},
    {"fluid", "contrast", KEY_REAL, "1", "[1, 1e12]", "1e4",
     "largest conductivity of a face over the smallest of the bed"},
    {"fluid", "tolerance", KEY_REAL, "1", "(0, 0.1]", "1e-12",
     "residual of the solve, relative to its right-hand side"},
    {"fluid", "picard", KEY_REAL, "1", "(0, 0.1]", "1e-10",
     "relative change of the velocity at which a drag law that depends on it has converged"},
    {0},
};

struct fluid_work {
    struct pressure *pressure;
    double *conductivity[3]; /* m^2/B on faces, m2/(Pa s) */
    double *rhs, *p_new, *dp;
    double *u_before[3]; /* solved in the round before */
    double tolerance, picard, contrast, storage, source;
    double gravity; /* m/s2, for heads */
    double held;    /* faces whose conductivity is held, for the series */
    double iterations;
};

static void check_sides(struct sim *s, struct scene *scene)
{
    bool open = false, pushed = false;
    for (int side = 0; side < 6; side++) {
        const enum side_kind kind = s->domain.side[side].kind;
        open = open || side_open(&s->domain, side);
        pushed = pushed || kind == SIDE_FLUX || kind == SIDE_INFLOW;
    }
    const bool stores = scene_real(scene, "fluid", NULL, "storage") > 0.0;
    if (!open && !stores && (pushed || scene_real(scene, "fluid", NULL, "source") != 0.0))
        scene_error(
            scene, "domain", NULL, NULL,
            "what flows in must go somewhere: a head or outflow side, or fluid.storage");
    if (v3_norm(s->flow.gradient) > 0.0 &&
        !(s->domain.periodic[0] || s->domain.periodic[1] || s->domain.periodic[2]))
        scene_error(scene, "flow", NULL, "pressure_gradient", "no direction is periodic");
}

void fluid_create(struct sim *s, struct scene *scene)
{
    struct fluid_work *const w = s->fluid.work = xalloc(1, sizeof *w);
    w->tolerance = scene_real(scene, "fluid", NULL, "tolerance");
    w->picard = scene_real(scene, "fluid", NULL, "picard");
    w->contrast = scene_real(scene, "fluid", NULL, "contrast");
    w->storage = scene_real(scene, "fluid", NULL, "storage");
    w->source = scene_real(scene, "fluid", NULL, "source");
    w->gravity = v3_norm(s->domain.gravity) > 0.0 ? v3_norm(s->domain.gravity) : 9.81;
    check_sides(s, scene);
    if (!fluid_state_create(s, scene))
        return;
    enum poisson_side side[6];
    fluid_pressure_sides(&s->domain, side);
    w->pressure = pressure_create(&s->grid, &s->domain, side);
    w->rhs = grid_field(&s->grid);
    w->p_new = grid_field(&s->grid);
    w->dp = grid_field(&s->grid);
    for (int a = 0; a < 3; a++) {
        w->conductivity[a] = grid_field(&s->grid);
        w->u_before[a] = grid_field(&s->grid);
    }
    series_add(&s->series, "pressure_iterations", "1", "iterations of the last head solve",
               &w->iterations);
    series_add(&s->series, "faces_held", "1",
               "faces whose conductivity is held at the contrast", &w->held);
}

void fluid_free(struct sim *s)
{
    struct fluid_work *const w = s->fluid.work;
    if (w && s->fluid.p) {
        pressure_free(w->pressure);
        xfree(w->rhs);
        xfree(w->p_new);
        xfree(w->dp);
        for (int a = 0; a < 3; a++) {
            xfree(w->conductivity[a]);
            xfree(w->u_before[a]);
        }
        fluid_state_free(s);
    }
    xfree(w);
}

void fluid_sense(struct sim *s)
{
    coupling_volume(s);
    coupling_drag(s);
}

void fluid_load(struct sim *s)
{
    coupling_load(s);
}

/* m^2/B, held below contrast times its smallest value; counts the faces held. */
static void conductivities(struct sim *s)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    struct fluid_work *const w = f->work;
    double least = (double)INFINITY;
    for (int a = 0; a < 3; a++)
        for (int k = 1; k <= face_last(g, a, 2); k++)
            for (int j = 1; j <= face_last(g, a, 1); j++)
                for (int i = 1; i <= face_last(g, a, 0); i++) {
                    const int c = cell(g, i, j, k);
                    const double m = f->eps_f[a][c];
                    w->conductivity[a][c] = m * m / f->drag[a][c]; /* inf without grains */
                    least = fmin(least, w->conductivity[a][c]);
                }
    if (!isfinite(least))
        die(EXIT_UNSTABLE,
            "no cell resists the flow at t = %.9g s: darcy needs grains and a drag "
            "law other than none",
            s->t);
    w->held = 0.0;
    for (int a = 0; a < 3; a++)
        for (int k = 1; k <= face_last(g, a, 2); k++)
            for (int j = 1; j <= face_last(g, a, 1); j++)
                for (int i = 1; i <= face_last(g, a, 0); i++) {
                    double *const K = &w->conductivity[a][cell(g, i, j, k)];
                    if (*K > w->contrast * least) {
                        *K = w->contrast * least;
                        w->held += 1.0;
                    }
                }
}

/* Pressure held at a side, Pa. */
static double held(const struct sim *s, int side)
{
    const struct side *const e = &s->domain.side[side];
    return e->kind == SIDE_HEAD
               ? s->fluid.rho * s->fluid.work->gravity * course_at(&e->head, s->t + s->fluid.dt)
               : 0.0;
}

/* Superficial flow of the grains' own motion and of the driving gradient through a face. */
static double carried(const struct sim *s, int a, int c)
{
    const struct fluid *const f = &s->fluid;
    const double drive = a == 0   ? s->flow.gradient.x
                         : a == 1 ? s->flow.gradient.y
                                  : s->flow.gradient.z;
    const double m = f->eps_f[a][c];
    const double by_grains = f->drag[a][c] > 0.0 ? m * f->drag_s[a][c] / f->drag[a][c] : 0.0;
    return by_grains + f->work->conductivity[a][c] * drive;
}

/* m u on the face of layer n of direction a, at pressure p. */
static double flux(const struct sim *s, const double *p, int a, int n, int c)
{
    const struct grid *const g = &s->grid;
    const double K = s->fluid.work->conductivity[a][c], h = g->h[a];
    if (!s->domain.periodic[a] && (n == 1 || n == g->n[a] + 1)) {
        const int side = 2 * a + (n > 1);
        const double out = n > 1 ? -1.0 : 1.0;
        if (side_open(&s->domain, side)) {
            const double inside = n > 1 ? p[c - g->s[a]] : p[c];
            return carried(s, a, c) - out * K * (inside - held(s, side)) * 2.0 / h;
        }
        if (s->domain.side[side].kind == SIDE_FLUX)
            return out * course_at(&s->domain.side[side].flux, s->t + s->fluid.dt);
        if (s->domain.side[side].kind == SIDE_INFLOW)
            return out * fluid_inflow(s, side, s->t + s->fluid.dt);
        return 0.0;
    }
    return carried(s, a, c) - K * (p[c] - p[c - g->s[a]]) / h;
}

static void set_velocity(struct sim *s, const double *p)
{
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    for (int a = 0; a < 3; a++)
#pragma omp parallel for schedule(static)
        for (int k = 1; k <= face_last(g, a, 2); k++)
            for (int j = 1; j <= face_last(g, a, 1); j++)
                for (int i = 1; i <= face_last(g, a, 0); i++) {
                    const int c = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                    f->u[a][c] = flux(s, p, a, n, c) / f->eps_f[a][c];
                }
}

/* One linear solve: the new pressure for the conductivities at hand, as a change to p_new. */
static void solve_head(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    struct fluid_work *const w = f->work;
    const double shift = w->storage / (f->rho * w->gravity * f->dt);
    set_velocity(s, w->p_new); /* what the guess lets through: the residual */
    double scale = 0.0;
#pragma omp parallel for schedule(static) reduction(max : scale)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int c = cell(g, 1, j, k); c <= cell(g, g->n[0], j, k); c++) {
                const double stored = shift * (w->p_new[c] - f->p[c]);
                w->rhs[c] = fluid_divergence(s, c) + stored - w->source;
                for (int a = 0; a < 3; a++)
                    scale = fmax(scale, fabs(f->u[a][c]) * f->eps_f[a][c] / g->h[a]);
                scale = fmax(scale, fabs(stored) + fabs(w->source));
            }
    const double lost = pressure_imbalance(w->pressure, shift, w->rhs);
    if (lost > 1e-6 && scale > 0.0)
        die(EXIT_UNSTABLE, "what flows into the closed box has nowhere to go at t = %.9g s",
            s->t);
    const double floor = 1e-15 * scale * sqrt((double)g->n[0] * g->n[1] * g->n[2]);
    for (size_t c = 0; c < g->total; c++)
        w->dp[c] = 0.0;
    const struct solve r =
        pressure_solve(w->pressure, w->conductivity, shift, w->rhs, w->dp, w->tolerance, floor);
    w->iterations = f->iterations = r.iterations;
    f->residual = r.start > 0.0 ? r.end / r.start : 0.0;
    if (!r.converged)
        die(EXIT_UNSTABLE,
            "the head has not converged at t = %.9g s: residual %.3g of its start after "
            "%d iterations, fluid.tolerance is %g; a smaller fluid.contrast helps",
            s->t, f->residual, r.iterations, w->tolerance);
    for (size_t c = 0; c < g->total; c++)
        w->p_new[c] += w->dp[c];
    set_velocity(s, w->p_new);
}

/* Largest change of a velocity since u_before, and its distance from the one that the drag was
 * taken at, over the largest velocity. */
static double change(const struct sim *s)
{
    const struct fluid *const f = &s->fluid;
    double most = 0.0, fastest = 0.0;
    for (int a = 0; a < 3; a++)
        for (size_t c = 0; c < s->grid.total; c++) {
            const double off = f->eps_f[a][c] * f->u[a][c] - s->coupling.u_drag[a][c];
            most = fmax(most, fmax(fabs(f->u[a][c] - f->work->u_before[a][c]), fabs(off)));
            fastest = fmax(fastest, fabs(f->u[a][c]));
        }
    return fastest > 0.0 ? most / fastest : 0.0;
}

void fluid_step(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    struct fluid_work *const w = f->work;
    const struct grid *const g = &s->grid;
    const size_t bytes = g->total * sizeof(double);
    memcpy(w->p_new, f->p, bytes);
    int rounds = 0;
    double changed;
    do {
        for (int a = 0; a < 3; a++)
            memcpy(w->u_before[a], f->u[a], bytes);
        if (rounds > 0)
            coupling_drag(s); /* at the velocity just found, see coupling.h */
        conductivities(s);
        solve_head(s);
        changed = change(s);
        if (++rounds > PICARD_MOST)
            die(EXIT_UNSTABLE,
                "the drag law and the velocity do not agree at t = %.9g s: it still "
                "changes by %.3g after %d rounds, fluid.picard is %g",
                s->t, changed, PICARD_MOST, w->picard);
    } while (changed > w->picard);
    memcpy(f->p, w->p_new, bytes);
    for (int a = 0; a < 3; a++)
        for (size_t c = 0; c < g->total; c++)
            f->stress[a][c] =
                f->eps_f[a][c] > 0.0
                    ? (f->drag[a][c] * f->u[a][c] - f->drag_s[a][c]) / f->eps_f[a][c]
                    : 0.0;
    fluid_guard(s, false);
}

double fluid_side_pressure(const struct sim *s, int side)
{
    return fluid_boundary_pressure(s, side);
}

void fluid_feasibility(const struct sim *s, struct feasibility *f)
{
    (void)s;
    (void)f; /* backward Euler: no limit */
}
