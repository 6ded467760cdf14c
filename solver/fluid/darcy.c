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
 * K may differ with direction: fluid.anisotropy multiplies that of the drag law, or
 * fluid.conductivity gives it (then B = m^2 rho g/K where there are grains, each bearing the part
 * of its volume). q is fluid.source and the wells. S_s is fluid.storage, or rho g m_v with the
 * compressibility m_v of the bed [Terzaghi43], for a bed whose grains do not move; grains that do
 * move take up d(eps)/dt.
 *
 * Cells without grains do not resist: the conductivity of a face is held below fluid.contrast
 * times the smallest of the bed; the number of faces so held is a time series. */
#include "fluid.h"

#include <string.h>
#include "../feasibility.h"
#include "../fluid_state.h"
#include "../wells.h"

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
    {"fluid", "compressibility", KEY_REAL, "Pa-1", "[0, inf)", "0 1/Pa",
     "of the bed, m_v: in place of the storage, which is rho g m_v then"},
    {"fluid", "conductivity", KEY_VECTOR, "m s-1", "drag | (0, inf)", "drag",
     "hydraulic conductivity in x, y, z, in place of that of the drag law"},
    {"fluid", "anisotropy", KEY_VECTOR, "1", "(0, inf)", "1 1 1",
     "conductivity in x, y, z over that of the drag law"},
    {"fluid", "head", KEY_REAL, "m", "(-inf, inf)", "0 m", "total head at the start"},
    {"fluid", "source", KEY_REAL, "s-1", "(-inf, inf)", "0 1/s",
     "volume of fluid made per volume and time, q"},
    {"fluid", "contrast", KEY_REAL, "1", "[1, 1e12]", "1e4",
     "largest conductivity of a face over the smallest of the bed"},
    {"fluid", "tolerance", KEY_REAL, "1", "(0, 0.1]", "1e-12",
     "residual of the solve, relative to its right-hand side"},
    {"fluid", "picard", KEY_REAL, "1", "(0, 0.1]", "1e-10",
     "relative change of the velocity at which a drag law that depends on it has converged"},
    WELL_KEYS,
    {0},
};

struct fluid_work {
    struct pressure *pressure;
    double *conductivity[3]; /* m^2/B on faces, m2/(Pa s); scratch of the coupling, as rhs */
    double *rhs, *p_new, *dp;
    double *made;        /* 1/s, q at the end of the step */
    double *u_before[3]; /* solved in the round before */
    double tolerance, picard, contrast, storage, source;
    bool given;      /* the conductivity is, */
    double along[3]; /* m/s, in each direction */
    struct wells wells;
    double gravity; /* m/s2, for heads */
    double least;   /* m2/(Pa s), smallest of the conductivities */
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
    const struct fluid_work *const w = s->fluid.work;
    pushed = pushed || w->wells.n > 0 || w->source != 0.0;
    if (!open && !(w->storage > 0.0) && pushed)
        scene_error(scene, "domain", NULL, NULL,
                    "what flows in must go somewhere: a head or outflow side, fluid.storage or "
                    "fluid.compressibility");
    if (v3_norm(s->flow.gradient) > 0.0 &&
        !(s->domain.periodic[0] || s->domain.periodic[1] || s->domain.periodic[2]))
        scene_error(scene, "flow", NULL, "pressure_gradient", "no direction is periodic");
}

/* Storage and conductivity. */
static void read_bed(struct fluid_work *w, struct scene *scene)
{
    const double rho = scene_real(scene, "fluid", NULL, "density");
    const double m_v = scene_real(scene, "fluid", NULL, "compressibility");
    w->storage = scene_real(scene, "fluid", NULL, "storage");
    if (m_v > 0.0 && scene_given(scene, "fluid", NULL, "storage"))
        scene_error(scene, "fluid", NULL, "compressibility",
                    "contradicts fluid.storage: give either one");
    if (m_v > 0.0)
        w->storage = rho * w->gravity * m_v;
    w->given = !scene_word(scene, "fluid", NULL, "conductivity", "drag");
    if (w->given && scene_given(scene, "fluid", NULL, "anisotropy"))
        scene_error(scene, "fluid", NULL, "anisotropy",
                    "contradicts fluid.conductivity: give either one");
    const vec3 k = scene_vector(scene, "fluid", NULL, w->given ? "conductivity" : "anisotropy");
    w->along[0] = k.x;
    w->along[1] = k.y;
    w->along[2] = k.z;
}

/* The grains' drag follows the conductivity. */
static void set_resistance(struct sim *s, struct scene *scene)
{
    const struct fluid_work *const w = s->fluid.work;
    struct coupling *const c = &s->coupling;
    c->resistance = v3(1.0 / w->along[0], 1.0 / w->along[1], 1.0 / w->along[2]);
    c->by_volume = w->given ? s->fluid.rho * w->gravity : 0.0;
    if (w->given && s->grains.n > 0 && !porosity_displaces)
        scene_error(
            scene, "fluid", NULL, "conductivity",
            "grains bear it by their volume on the grid: modules.porosity must not be none");
}

void fluid_create(struct sim *s, struct scene *scene)
{
    struct fluid_work *const w = s->fluid.work = xalloc(1, sizeof *w);
    w->tolerance = scene_real(scene, "fluid", NULL, "tolerance");
    w->picard = scene_real(scene, "fluid", NULL, "picard");
    w->contrast = scene_real(scene, "fluid", NULL, "contrast");
    w->source = scene_real(scene, "fluid", NULL, "source");
    w->gravity = v3_norm(s->domain.gravity) > 0.0 ? v3_norm(s->domain.gravity) : 9.81;
    const double start = scene_real(scene, "fluid", NULL, "head");
    read_bed(w, scene);
    wells_read(&w->wells, scene, &s->domain);
    check_sides(s, scene);
    if (!fluid_state_create(s, scene))
        return;
    set_resistance(s, scene);
    wells_place(&w->wells, &s->grid);
    for (size_t c = 0; c < s->grid.total; c++)
        s->fluid.p[c] = s->fluid.rho * w->gravity * start;
    enum poisson_side side[6];
    fluid_pressure_sides(&s->domain, side);
    w->pressure = pressure_create(&s->grid, &s->domain, side);
    pressure_lend(w->pressure, s->coupling.seen[1], s->coupling.seen[2]);
    w->rhs = s->coupling.seen[0];
    w->p_new = grid_field(&s->grid);
    w->dp = grid_field(&s->grid);
    w->made = grid_field(&s->grid);
    s->fluid.rate = grid_field(&s->grid);
    for (int a = 0; a < 3; a++) {
        w->conductivity[a] = s->coupling.K[a];
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
        xfree(w->p_new);
        xfree(w->dp);
        xfree(w->made);
        xfree(s->fluid.rate);
        for (int a = 0; a < 3; a++) {
            xfree(w->u_before[a]);
        }
        fluid_state_free(s);
    }
    if (w)
        wells_free(&w->wells);
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

/* Smallest m^2/B of direction a; the field, or the conductivity given where nothing resists. */
static double conductivity_of(struct sim *s, int a)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const double given = f->work->along[a] / (f->rho * f->work->gravity);
    const bool is_given = f->work->given;
    double *const K = f->work->conductivity[a], least = (double)INFINITY;
#pragma omp parallel for schedule(static) reduction(min : least)
    for (int k = 1; k <= face_last(g, a, 2); k++)
        for (int j = 1; j <= face_last(g, a, 1); j++)
            for (int i = 1; i <= face_last(g, a, 0); i++) {
                const int c = cell(g, i, j, k);
                const double m = grid_face(f->eps, c, g->s[a]), B = f->drag[a][c];
                K[c] = B > 0.0 ? m * m / B : is_given ? given : (double)INFINITY;
                least = fmin(least, K[c]);
            }
    return least;
}

/* No more than `most`; how many were. */
static long hold(struct sim *s, int a, double most)
{
    const struct grid *const g = &s->grid;
    double *const K = s->fluid.work->conductivity[a];
    long held = 0;
#pragma omp parallel for schedule(static) reduction(+ : held)
    for (int k = 1; k <= face_last(g, a, 2); k++)
        for (int j = 1; j <= face_last(g, a, 1); j++)
            for (int c = cell(g, 1, j, k); c <= cell(g, face_last(g, a, 0), j, k); c++)
                if (K[c] > most) {
                    K[c] = most;
                    held++;
                }
    return held;
}

/* m^2/B, held below contrast times its smallest value; counts the faces held. */
static void conductivities(struct sim *s)
{
    struct fluid_work *const w = s->fluid.work;
    w->held = 0.0;
    double of_all = (double)INFINITY;
    for (int a = 0; a < 3; a++)
        of_all = fmin(of_all, conductivity_of(s, a));
    if (!isfinite(of_all))
        die(EXIT_UNSTABLE,
            "no cell resists the flow at t = %.9g s: darcy needs grains and a drag "
            "law other than none, or fluid.conductivity",
            s->t);
    w->least = of_all;
    for (int a = 0; a < 3 && !w->given; a++)
        w->held += (double)hold(s, a, w->contrast * of_all);
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
    const double m = grid_face(f->eps, c, s->grid.s[a]);
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
                    f->u[a][c] = flux(s, p, a, n, c) / grid_face(f->eps, c, g->s[a]);
                }
}

/* What continuity has besides div(eps u), at pressure p: d(eps)/dt + S dp/dt - q.
 * Returns the largest of the last two. */
static double set_rate(struct sim *s, const double *p)
{
    const struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    const struct fluid_work *const w = f->work;
    const double shift = w->storage / (f->rho * w->gravity * f->dt);
    double scale = 0.0;
#pragma omp parallel for schedule(static) reduction(max : scale)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int c = cell(g, 1, j, k); c <= cell(g, g->n[0], j, k); c++) {
                const double stored = shift * (p[c] - f->p[c]);
                f->rate[c] = (f->eps[c] - f->eps_old[c]) / f->dt + stored - w->made[c];
                scale = fmax(scale, fabs(stored) + fabs(w->made[c]));
            }
    return scale;
}

/* One linear solve: the new pressure for the conductivities at hand, as a change to p_new. */
static void solve_head(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    struct fluid_work *const w = f->work;
    const double shift = w->storage / (f->rho * w->gravity * f->dt);
    set_velocity(s, w->p_new); /* what the guess lets through: the residual */
    const double made = set_rate(s, w->p_new);
    const double scale = fmax(made, fluid_divergences(s, 1.0, w->rhs));
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
    set_rate(s, w->p_new);
}

/* Largest change of a velocity since u_before, and its distance from the one that the drag was
 * taken at, over the largest velocity, of the grains too. What a gradient of 1e-12 would drive is
 * rest. */
static double change(const struct sim *s)
{
    const struct fluid *const f = &s->fluid;
    double most = 0.0, fastest = 1e-12 * f->work->least * f->rho * f->work->gravity;
    for (int a = 0; a < 3; a++)
        for (int c = s->grid.s[a]; c < (int)s->grid.total; c++) {
            const double off =
                grid_face(f->eps, c, s->grid.s[a]) * f->u[a][c] - s->coupling.u_drag[a][c];
            most = fmax(most, fmax(fabs(f->u[a][c] - f->work->u_before[a][c]), fabs(off)));
            fastest = fmax(fastest, fabs(f->u[a][c]));
            if (f->drag[a][c] > 0.0)
                fastest = fmax(fastest, fabs(f->drag_s[a][c] / f->drag[a][c]));
        }
    return most / fastest;
}

void fluid_step(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    struct fluid_work *const w = f->work;
    const struct grid *const g = &s->grid;
    const size_t bytes = g->total * sizeof(double);
    memcpy(w->p_new, f->p, bytes);
    for (size_t c = 0; c < g->total; c++)
        w->made[c] = w->source;
    wells_add(&w->wells, g, s->t + f->dt, w->made);
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
        for (int c = g->s[a]; c < (int)g->total; c++)
            f->stress[a][c] = s->coupling.forces.pressure *
                              (f->drag[a][c] * f->u[a][c] - f->drag_s[a][c]) /
                              grid_face(f->eps, c, g->s[a]);
    fluid_guard(s, false);
}

double fluid_side_pressure(const struct sim *s, int side)
{
    return fluid_boundary_pressure(s, side);
}

void fluid_feasibility(const struct sim *s, struct feasibility *f)
{
    pressure_feasibility(&s->grid, 2, f); /* backward Euler: no limit of the step */
}
