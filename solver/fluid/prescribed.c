/* solver/fluid/prescribed.c - a fixed flow, for one-way studies: the fluid carries the grains
 * and does not feel them; nothing is solved.
 *
 * The velocity is a formula, or is read from a run.nc of silt (the last output; the same grid):
 *   uniform       u = U; without fluid.velocity that of [flow], in by the inflow side
 *   shear         u = U s                          s = x_b/L_b along the direction `across`
 *   parabolic     u = 4 U s (1 - s)
 *   vortex        u = omega x (x - centre)         a rigid rotation about the box's centre
 *   taylor_green  u = U_x (sin a cos b, -cos a sin b), a = 2 pi x/L_x, b = 2 pi y/L_y
 *   file          that of fluid.file
 * (superficial, as the fluid of a one-way coupling is) and may swing as cos(2 pi t/period). The fluid's
 * stress on the grains is that of the flow as it goes, G = rho Du/Dt [MaxeyRiley83], by central
 * differences; it is not known in parts, and all of it counts as forces/pressure_gradient.c. */
#include "fluid.h"

#include <netcdf.h>
#include <string.h>
#include "../feasibility.h"
#include "../fluid_state.h"

#define TURN   6.28318530717958647692
#define FIELDS "uniform | shear | parabolic | vortex | taylor_green | file"

enum field_kind { UNIFORM, SHEAR, PARABOLIC, VORTEX, TAYLOR_GREEN, FROM_FILE };

const struct about fluid_about = {
    .name = "prescribed",
    .summary = "a fixed velocity field, of a formula or a file; one-way, nothing is solved",
    .equation = "u = u(x) cos(2 pi t/period), G = rho Du/Dt",
    .source = "[MaxeyRiley83]",
    .range = "grains too few to change the flow"};

const struct key fluid_keys[] = {
    {"fluid", "density", KEY_REAL, "kg m-3", "(0, inf)", NULL, "density"},
    {"fluid", "viscosity", KEY_REAL, "Pa s", "[0, inf)", NULL, "dynamic viscosity"},
    {"fluid", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto",
     "how often grains feel the flow; auto: half a cell at the largest velocity"},
    {"fluid", "field", KEY_CHOICE, "", FIELDS, "uniform", "the velocity field"},
    {"fluid", "velocity", KEY_VECTOR, "m s-1", "(-inf, inf)", "0 0 0 m/s",
     "U: of the uniform flow (0: as [flow] has it at the inflow side), of the far side of a "
     "shear, the largest of a parabola, amplitude"},
    {"fluid", "across", KEY_CHOICE, "", "x | y | z", "z", "direction in which U varies"},
    {"fluid", "spin", KEY_VECTOR, "s-1", "(-inf, inf)", "0 0 0 1/s",
     "angular velocity of the vortex"},
    {"fluid", "period", KEY_REAL, "s", "steady | (0, inf)", "steady",
     "the field swings as cos(2 pi t/period)"},
    {"fluid", "file", KEY_TEXT, "", "", "", "for field = file: a run.nc with the same grid"},
    {0},
};

struct fluid_work {
    enum field_kind kind;
    vec3 velocity, spin;
    int across;
    double period;
    double follows;  /* m/s, > 0: U is the largest velocity of [flow], this, and goes with it */
    double *base[3]; /* m/s, the field at t = 0 */
};

static double part(vec3 v, int a)
{
    return a == 0 ? v.x : a == 1 ? v.y : v.z;
}

/* Component a of the formula at a place. */
static double formula(const struct sim *s, const struct fluid_work *w, int a, const double x[3])
{
    const double *const L = s->domain.size, S = x[w->across] / L[w->across];
    const double U = part(w->velocity, a);
    const double r[3] = {x[0] - 0.5 * L[0], x[1] - 0.5 * L[1], x[2] - 0.5 * L[2]};
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    const double kx = TURN * x[0] / L[0], ky = TURN * x[1] / L[1], top = part(w->velocity, 0);
    switch (w->kind) {
    case UNIFORM:
        return U;
    case SHEAR:
        return U * S;
    case PARABOLIC:
        return 4.0 * U * S * (1.0 - S);
    case VORTEX:
        return part(w->spin, b) * r[d] - part(w->spin, d) * r[b];
    case TAYLOR_GREEN:
        return a == 0   ? top * sin(kx) * cos(ky)
               : a == 1 ? -top * L[1] / L[0] * cos(kx) * sin(ky)
                        : 0.0;
    case FROM_FILE:
        break;
    }
    return 0.0;
}

static void fill(const struct sim *s, struct fluid_work *w)
{
    const struct grid *const g = &s->grid;
    for (int a = 0; a < 3; a++)
        for (int k = 0; k <= g->n[2] + 1; k++)
            for (int j = 0; j <= g->n[1] + 1; j++)
                for (int i = 0; i <= g->n[0] + 1; i++) {
                    const double x[3] = {(i - (a == 0 ? 1.0 : 0.5)) * g->h[0],
                                         (j - (a == 1 ? 1.0 : 0.5)) * g->h[1],
                                         (k - (a == 2 ? 1.0 : 0.5)) * g->h[2]};
                    w->base[a][cell(g, i, j, k)] = formula(s, w, a, x);
                }
}

/* Why component a cannot be read, or NULL. */
static const char *read_component(const struct sim *s, int nc, int a, double *out)
{
    static const char *const names[3] = {"fluid_velocity_x", "fluid_velocity_y",
                                         "fluid_velocity_z"};
    const struct grid *const g = &s->grid;
    const size_t n[3] = {(size_t)g->n[0] + (a == 0), (size_t)g->n[1] + (a == 1),
                         (size_t)g->n[2] + (a == 2)};
    int var, dims = 0, dim[NC_MAX_VAR_DIMS];
    size_t start[4] = {0}, count[4];
    if (nc_inq_varid(nc, names[a], &var) || nc_inq_var(nc, var, NULL, NULL, &dims, dim, NULL) ||
        dims != 4)
        return "holds no velocities of a fluid (fluid_velocity_x, _y, _z)";
    for (int d = 0; d < 4; d++)
        if (nc_inq_dimlen(nc, dim[d], &count[d]))
            return "cannot be read";
    if (count[0] == 0 || count[1] != n[2] || count[2] != n[1] || count[3] != n[0])
        return "is of another grid than domain.cells";
    start[0] = count[0] - 1;
    count[0] = count[1] = count[2] = 1;
    for (int k = 1; k <= (int)n[2]; k++)
        for (int j = 1; j <= (int)n[1]; j++) {
            start[1] = (size_t)k - 1;
            start[2] = (size_t)j - 1;
            if (nc_get_vara_double(nc, var, start, count, out + cell(g, 1, j, k)))
                return "cannot be read";
        }
    return NULL;
}

static void read_file(struct sim *s, struct scene *scene, struct fluid_work *w)
{
    const char *const path = scene_text(scene, "fluid", NULL, "file");
    const char *const slash = strrchr(scene_path(scene), '/'), *why = NULL;
    char *const beside =
        slash && path[0] != '/'
            ? xprintf("%.*s/%s", (int)(slash - scene_path(scene)), scene_path(scene), path)
            : xstrdup(path);
    int nc = -1;
    if (nc_open(beside, NC_NOWRITE, &nc) != NC_NOERR &&
        nc_open(path, NC_NOWRITE, &nc) != NC_NOERR)
        why = "is no netCDF file, neither beside the scene nor here";
    for (int a = 0; a < 3 && !why; a++) {
        why = read_component(s, nc, a, s->fluid.u[a]);
        if (a == 2 && !why)
            for (int b = 0; b < 3; b++) {
                fluid_ghosts_nearest(s, b, s->fluid.u[b]);
                memcpy(w->base[b], s->fluid.u[b], s->grid.total * sizeof(double));
            }
    }
    if (nc >= 0)
        nc_close(nc);
    if (why)
        scene_error(scene, "fluid", NULL, "file", "%s", why);
    xfree(beside);
}

static double largest(const struct sim *s, const struct fluid_work *w)
{
    double most = 0.0;
    for (int a = 0; a < 3; a++)
        most = fmax(most, max_abs(w->base[a], s->grid.total) / s->grid.h[a]);
    return most;
}

/* A uniform flow without a velocity of its own has that of [flow]. */
static void follow_inflow(const struct sim *s, struct fluid_work *w)
{
    if (w->kind != UNIFORM || v3_norm(w->velocity) > 0.0)
        return;
    for (int side = 0; side < 6; side++)
        if (s->domain.side[side].kind == SIDE_INFLOW && !s->domain.side[side].own_inflow) {
            w->follows = flow_most(&s->flow);
            const double in = side % 2 ? -w->follows : w->follows;
            w->velocity = v3(side / 2 == 0 ? in : 0.0, side / 2 == 1 ? in : 0.0,
                             side / 2 == 2 ? in : 0.0);
            return;
        }
}

static void check_scene(struct scene *scene, const struct fluid_work *w)
{
    if (scene_word(scene, "coupling", NULL, "ways", "two") &&
        scene_given(scene, "coupling", NULL, "ways"))
        scene_error(scene, "coupling", NULL, "ways",
                    "a prescribed flow does not feel the grains: one, or leave it out");
    /* at rest, if that is said */
    if (w->kind != VORTEX && w->kind != FROM_FILE && v3_norm(w->velocity) == 0.0 &&
        !scene_given(scene, "fluid", NULL, "velocity"))
        scene_error(scene, "fluid", NULL, "velocity",
                    "the flow needs its velocity, or an inflow side and that of [flow]");
    if (w->kind == VORTEX && v3_norm(w->spin) == 0.0)
        scene_error(scene, "fluid", NULL, "spin", "the vortex needs its spin");
    if (w->kind == FROM_FILE && scene_text(scene, "fluid", NULL, "file")[0] == '\0')
        scene_error(scene, "fluid", NULL, "file", "field = file needs it");
}

void fluid_create(struct sim *s, struct scene *scene)
{
    struct fluid_work *const w = s->fluid.work = xalloc(1, sizeof *w);
    w->kind = (enum field_kind)scene_choice(scene, "fluid", NULL, "field");
    w->velocity = scene_vector(scene, "fluid", NULL, "velocity");
    w->spin = scene_vector(scene, "fluid", NULL, "spin");
    w->across = scene_choice(scene, "fluid", NULL, "across");
    w->period = scene_word(scene, "fluid", NULL, "period", "steady")
                    ? (double)INFINITY
                    : scene_real(scene, "fluid", NULL, "period");
    follow_inflow(s, w);
    s->fluid.deaf = true;
    s->fluid.bare = s->grains.n == 0 && !scene_has(scene, "grains");
    const bool made = fluid_state_create(s, scene);
    check_scene(scene, w);
    if (!made)
        return;
    for (int a = 0; a < 3; a++)
        w->base[a] = grid_field(&s->grid);
    if (w->kind == FROM_FILE)
        read_file(s, scene, w);
    else
        fill(s, w);
    if (scene_word(scene, "fluid", NULL, "dt", "auto")) {
        const double rate = fmax(largest(s, w), isfinite(w->period) ? 40.0 / w->period : 0.0);
        s->fluid.dt = fmin(rate > 0.0 ? 0.5 / rate : s->run.end, s->run.end / 10.0);
    }
    for (int a = 0; a < 3; a++)
        memcpy(s->fluid.u[a], w->base[a], s->grid.total * sizeof(double));
}

void fluid_free(struct sim *s)
{
    struct fluid_work *const w = s->fluid.work;
    if (w && s->fluid.p)
        for (int a = 0; a < 3; a++)
            xfree(w->base[a]);
    fluid_state_free(s);
    xfree(w);
}

/* rho Du/Dt of component a on its faces: u . grad u at time t, and the swing. */
static void acceleration(struct sim *s, int a, double rate)
{
    const struct fluid_work *const w = s->fluid.work;
    const struct grid *const g = &s->grid;
    const int sa = g->s[a];
    double *const *const u = s->fluid.u;
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int c = cell(g, i, j, k);
                double sum = rate * w->base[a][c];
                for (int b = 0; b < 3; b++) {
                    const int sb = g->s[b];
                    const double v = b == a ? u[a][c]
                                            : 0.25 * (u[b][c] + u[b][c + sb] + u[b][c - sa] +
                                                      u[b][c + sb - sa]);
                    sum += v * (u[a][c + sb] - u[a][c - sb]) / (2.0 * g->h[b]);
                }
                s->fluid.stress[a][c] = s->coupling.forces.pressure * s->fluid.rho * sum;
            }
    if (!s->domain.periodic[a]) /* the last face as the one before */
        for (int k = 1; k <= g->n[(a + 2) % 3]; k++)
            for (int j = 1; j <= g->n[(a + 1) % 3]; j++) {
                const int c =
                    (g->n[a] + 1) * sa + j * g->s[(a + 1) % 3] + k * g->s[(a + 2) % 3];
                s->fluid.stress[a][c] = s->fluid.stress[a][c - sa];
            }
    fluid_ghosts_nearest(s, a, s->fluid.stress[a]);
}

/* The field at time t. */
static void set_time(struct sim *s, double t)
{
    const struct fluid_work *const w = s->fluid.work;
    const bool steady = !isfinite(w->period);
    const bool fixed = steady && !(w->follows > 0.0);
    const double course = w->follows > 0.0 ? flow_velocity(&s->flow, t) / w->follows : 1.0;
    const double swing = course * (steady ? 1.0 : cos(TURN * t / w->period));
    const double rate = steady ? 0.0 : -TURN / w->period * sin(TURN * t / w->period);
    for (int a = 0; a < 3; a++)
        for (size_t c = 0; c < s->grid.total && !fixed; c++)
            s->fluid.u[a][c] = swing * w->base[a][c];
    for (int a = 0; a < 3 && !s->fluid.bare; a++)
        acceleration(s, a, rate);
}

void fluid_sense(struct sim *s)
{
    set_time(s, s->t);
    if (s->fluid.bare)
        return;
    coupling_volume(s);
    coupling_drag(s);
}

void fluid_step(struct sim *s)
{
    set_time(s, s->t + 0.5 * s->fluid.dt);
    fluid_guard(s, false);
    s->fluid.steps++;
}

void fluid_load(struct sim *s)
{
    if (!s->fluid.bare)
        coupling_load(s);
}

double fluid_side_pressure(const struct sim *s, int side)
{
    (void)s;
    (void)side;
    return 0.0; /* there is no pressure in a prescribed flow */
}

void fluid_feasibility(const struct sim *s, struct feasibility *f)
{
    (void)s;
    (void)f; /* nothing is solved: no limit */
}
