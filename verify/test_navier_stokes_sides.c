/* verify/test_navier_stokes_sides.c - the fluid at its sides and in its choices: continuity
 * between every pair of sides, with and without grains; forms a, b, c in a bed of uniform
 * porosity; rates that are held; steps that adapt; a backflow; thin boxes; grains so fine that
 * drag would limit an explicit step; a pressure that does not converge. */
/* slots: drag/stokes porosity/divided solver/fluid/navier_stokes contact/linear */
#include <omp.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "../solver/fluid_state.h"
#include "check.h"
#include "harness.h"

#define MATERIAL                                                                               \
    "material = m\n[material m]\nstiffness = 100 N/m\nrestitution = 0.6\nfriction = 0.4\n"
#define WATER "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\n"

static unsigned long seed = 4711;
static double noise(void)
{
    seed = seed * 6364136223846793005ul + 1442695040888963407ul;
    return (double)(seed >> 11) / 9007199254740992.0 - 0.5;
}

/* Stokes's law is taken out of its range on purpose: no warnings. */
static struct sim *quiet_from(const char *text)
{
    struct sim *const s = sim_from(text);
    s->coupling.drag_of.told = true;
    return s;
}

/* ---- every pair of sides ---- */

enum { KINDS = 4, PAIRS = 17 };
static const char *const kind[KINDS] = {"wall", "slip", "inflow", "outflow"};

/* Largest continuity error of some steps from noise, between this pair along `a`; the other
 * directions periodic and between a wall and an outflow. */
static double pair_error(int a, int pair, const char *grains, const char *keys)
{
    const char along = (char)('x' + a), open = (char)('x' + (a + 1) % 3);
    const char wrapped = (char)('x' + (a + 2) % 3);
    char *const sides = pair == PAIRS - 1
                            ? xprintf("%c = periodic\n", along)
                            : xprintf("%c- = %s\n%c+ = %s\n", along, kind[pair % KINDS], along,
                                      kind[pair / KINDS]);
    const bool inflow = pair < PAIRS - 1 && (pair % KINDS == 2 || pair / KINDS == 2);
    char *const text =
        xprintf("[domain]\nsize = 12 14 10 mm\ncells = 6 7 5\n%s%c = periodic\n%c+ = outflow\n"
                "%s" WATER "dt = 0.5 ms\n%s%s[run]\nend = 1 s\n%s",
                sides, wrapped, open, inflow ? "[flow]\nvelocity = 10 mm/s\n" : "", keys,
                grains, grains[0] ? "dt = 20 us\n" : "");
    struct sim *const s = quiet_from(text);
    double worst = 0.0;
    for (int b = 0; b < 3; b++)
        for (size_t c = 0; c < s->grid.total; c++)
            s->fluid.u[b][c] = 0.01 * noise();
    for (int n = 0; n < 3; n++) {
        step(s);
        worst = fmax(worst, s->fluid.divergence);
    }
    sim_free(s);
    xfree(text);
    xfree(sides);
    return worst;
}

static void check_pairs(const char *grains, const char *keys, const char *what)
{
    double worst = 0.0;
    for (int a = 0; a < 3; a++)
        for (int pair = 0; pair < PAIRS; pair++)
            worst = fmax(worst, pair_error(a, pair, grains, keys));
    check(worst < 1e-10, "%s: continuity between all %d pairs of sides along x, y, z: %.2g",
          what, PAIRS, worst);
}

/* ---- forms ---- */

struct bed {
    double drop, rate;
    vec3 load;
};

/* A lattice of frozen grains, one to a cell, between these sides, after some steps. */
static struct sim *lattice(const char *form, const char *sides, int steps)
{
    char *const text =
        xprintf("[grains bed]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = unit_cell\n"
                "spacing = 1 mm\nfrozen = yes\n" MATERIAL
                "[domain]\nsize = 4 5 6 mm\ncells = 4 5 6\n%s" WATER "dt = 0.2 ms\nform = %s\n"
                "[run]\nend = 1e9 s\n",
                sides, form);
    struct sim *const s = quiet_from(text);
    for (int n = 0; n < steps; n++)
        step(s);
    xfree(text);
    return s;
}

/* Largest differences of velocity and of the grains' loads, relative. */
static void differ(const struct sim *s, const struct sim *q, double out[2])
{
    double u = 0.0, size = 0.0, f = 0.0, load = 0.0;
    for (int a = 0; a < 3; a++)
        for (int k = 1; k <= s->grid.n[2]; k++)
            for (int j = 1; j <= s->grid.n[1]; j++)
                for (int i = 1; i <= s->grid.n[0]; i++) {
                    const int c = cell(&s->grid, i, j, k);
                    u = fmax(u, fabs(s->fluid.u[a][c] - q->fluid.u[a][c]));
                    size = fmax(size, fabs(q->fluid.u[a][c]));
                }
    for (int i = 0; i < s->grains.n; i++) {
        f = fmax(f, v3_norm(v3_sub(s->grains.load[i], q->grains.load[i])));
        load = fmax(load, v3_norm(q->grains.load[i]));
    }
    out[0] = u / size;
    out[1] = f / load;
}

static void check_forms(void)
{
    static const char *const plug = "x = periodic\ny = periodic\nz- = inflow\nz+ = outflow\n"
                                    "[flow]\nvelocity = 3 mm/s\n";
    static const char *const channel = "x = periodic\nz = periodic\n"
                                       "[flow]\npressure_gradient = 5 0 40 Pa/m\n";
    double off[2];
    struct sim *const a = lattice("a", plug, 60);
    for (int form = 0; form < 2; form++) {
        struct sim *const other = lattice(form ? "c" : "b", plug, 60);
        differ(other, a, off);
        check(off[0] < 1e-12 && off[1] < 1e-11,
              "uniform bed, steady: form %s as a: velocity %.2g, forces on grains %.2g",
              form ? "c" : "b", off[0], off[1]);
        check_rel(fluid_side_pressure(other, Z_LO), fluid_side_pressure(a, Z_LO), 1e-11,
                  "  its pressure drop, Pa");
        check(other->coupling.calls > 0 && other->ledger.handover_error < 1e-12,
              "  momentum handed over cancels: %.2g", other->ledger.handover_error);
        sim_free(other);
    }
    sim_free(a);
    struct sim *const between = lattice("a", channel, 100), *const b =
                                                                lattice("b", channel, 100);
    struct sim *const c = lattice("c", channel, 100);
    differ(b, between, off);
    check(off[0] < 1e-11 && off[1] < 1e-11,
          "uniform bed between walls: form b as a: velocity %.2g, forces %.2g", off[0], off[1]);
    differ(c, between, off);
    check(off[0] > 1e-4, "  form c is another law there: velocity differs by %.2g", off[0]);
    sim_free(between);
    sim_free(b);
    sim_free(c);
}

/* Still water over a random frozen bed stays still; each grain feels its buoyancy. */
static void check_still(const char *form)
{
    char *const text = xprintf(
        "[grains a]\ndiameter = 2 mm\ndensity = 2650 kg/m3\nfill = random\ncount = 150\n"
        "frozen = yes\n" MATERIAL "[domain]\nsize = 12 14 30 mm\ncells = 4 5 10\nz+ = outflow\n"
        "gravity = 1 0 -9.81 m/s2\n" WATER "dt = 0.5 ms\nform = %s\nviscous = implicit\n"
        "[run]\nend = 1 s\n",
        form);
    struct sim *const s = quiet_from(text);
    double moves = 0.0, off = 0.0;
    for (int n = 0; n < 20; n++)
        step(s);
    for (int a = 0; a < 3; a++)
        moves = fmax(moves, max_abs(s->fluid.u[a], s->grid.total));
    for (int i = 0; i < s->grains.n; i++) {
        const vec3 want = v3_scale(-1000.0 * s->grains.volume[i], s->domain.gravity);
        off = fmax(off, v3_norm(v3_sub(s->grains.load[i], want)) / v3_norm(want));
    }
    check(moves == 0.0 && off < 1e-14, "form %s, still water: moves %g m/s, buoyancy %.2g off",
          form, moves, off);
    sim_free(s);
    xfree(text);
}

/* ---- rates, steps ---- */

static void check_held(void)
{
    struct sim *const plain =
        quiet_from("[domain]\nsize = 3 4 5 mm\ncells = 3 6 5\nx = periodic\nz = periodic\n"
                   "[flow]\nrate = 7 0 -2 mm/s\n" WATER "dt = 1 ms\n[run]\nend = 1 s\n");
    step(plain);
    check(plain->flow.rate_off < 1e-16, "a rate is held from the first step: %.2g m/s off",
          plain->flow.rate_off);
    for (int n = 0; n < 6000; n++)
        step(plain);
    const double G = 12.0 * 1e-3 * 7e-3 / (4e-3 * 4e-3), cells = 6.0;
    check_rel(plain->flow.gradient.x, G * cells * cells / (cells * cells + 2.0), 1e-5,
              "what it takes between walls, on 6 cells, Pa/m");
    sim_free(plain);
    struct sim *const bed = quiet_from(
        "[grains a]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = random\ncount = 60\n"
        "frozen = yes\n" MATERIAL
        "[domain]\nsize = 8 8 8 mm\ncells = 4 4 4\nx = periodic\ny = periodic\nz = periodic\n"
        "[flow]\nrate = 0 3 0 mm/s\n" WATER "dt = 2 ms\n[run]\nend = 9 s\n");
    for (int n = 0; n < 60; n++)
        step(bed);
    check(bed->flow.rate_off < 1e-9, "a rate is held among grains: %.2g m/s off",
          bed->flow.rate_off);
    sim_free(bed);
}

static unsigned long adapted(int threads, double *t, int *changes)
{
    omp_set_num_threads(threads);
    struct sim *const s = quiet_from(
        "[grains a]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = random\ncount = "
        "40\n" MATERIAL
        "[domain]\nsize = 12 14 30 mm\ncells = 4 5 10\nz- = inflow\nz+ = outflow\n"
        "[flow]\nvelocity = 400 mm/s\nramp = 0.2 s\n" WATER "dt = auto\ncourant = 0.1\n"
        "[run]\nend = 0.05 s\ndt = 20 us\n");
    int before = s->run.substeps;
    bool whole = true;
    *changes = 0;
    while (s->t < 0.05 - 1e-9 && s->step < 10000) {
        step(s);
        whole = whole && fabs(s->fluid.dt / s->run.dt - s->run.substeps) < 1e-9 &&
                s->fluid.courant < 0.2;
        *changes += s->run.substeps != before;
        before = s->run.substeps;
    }
    *t = whole ? s->t : (double)NAN;
    const unsigned long h = sim_bits(s);
    sim_free(s);
    omp_set_num_threads(1);
    return h;
}

static void check_adaptive(void)
{
    double t, again;
    int changes;
    const unsigned long one = adapted(1, &t, &changes);
    check(changes > 3, "the step adapts: %d changes", changes);
    check_rel(t, 0.05, 1e-12, "in whole grain steps, to the very end, s");
    check(adapted(3, &again, &changes) == one && again == t, "the same bits on 3 threads");
}

/* A strong vortex is carried out through an outflow, and partly comes back in: nothing grows. */
static void check_backflow(const char *convection)
{
    char *const text = xprintf(
        "[domain]\nsize = 2 1 1 m\ncells = 32 16 1\nx- = inflow\nx+ = outflow\ny = slip\n"
        "z = periodic\n[flow]\nvelocity = 0.4 m/s\n[fluid]\ndensity = 1 kg/m3\n"
        "viscosity = 1e-4 Pa s\ndt = 5 ms\nconvection = %s\n[run]\nend = 1e9 s\n",
        convection);
    struct sim *const s = quiet_from(text);
    const struct grid *const g = &s->grid;
    for (int j = 1; j <= 16; j++)
        for (int i = 1; i <= 33; i++) {
            const double r = 0.3, x = (i - 1) / 16.0 - 1.4, y = (j - 0.5) / 16.0 - 0.5;
            const double xc = x + 0.5 / 16.0, yf = y - 0.5 / 16.0;
            s->fluid.u[0][cell(g, i, j, 1)] =
                0.4 - 1.2 * y / r * exp(0.5 - 0.5 * (x * x + y * y) / (r * r));
            if (i <= 32)
                s->fluid.u[1][cell(g, i, j, 1)] =
                    1.2 * xc / r * exp(0.5 - 0.5 * (xc * xc + yf * yf) / (r * r));
        }
    double back = 0.0, most = 0.0, last = 0.0;
    for (int n = 0; n < 2400; n++) {
        step(s);
        for (int j = 1; j <= 16; j++)
            back = fmin(back, s->fluid.u[0][cell(g, 33, j, 1)]);
        last = max_abs(s->fluid.u[0], g->total);
        most = fmax(most, last);
    }
    check(back < -0.1, "%s: the vortex draws fluid back in, %.2g m/s", convection, back);
    check(most < 2.4 && last < 0.6, "  and nothing grows: at most %.3g m/s, at last %.3g m/s",
          most, last);
    sim_free(s);
    xfree(text);
}

/* A box one cell thick and one of three cells: the same flow in two dimensions. */
static void check_thin(const char *sides, int a, int b, int thin)
{
    double u[2][64];
    for (int q = 0; q < 2; q++) {
        int n[3] = {8, 8, 8};
        n[thin] = q ? 3 : 1;
        char *const text =
            xprintf("[domain]\nsize = 1 1 1 m\ncells = %d %d %d\n%s[side %c+]\nvelocity = %s\n"
                    "[fluid]\ndensity = 1 kg/m3\nviscosity = 0.01 Pa s\ndt = 10 ms\n"
                    "[run]\nend = 9 s\n",
                    n[0], n[1], n[2], sides, 'x' + b,
                    a == 0   ? "1 0 0 m/s"
                    : a == 1 ? "0 1 0 m/s"
                             : "0 0 1 m/s");
        struct sim *const s = quiet_from(text);
        for (int m = 0; m < 40; m++)
            step(s);
        for (int m = 0; m < 64; m++) {
            int at[3];
            at[a] = m % 8 + 1;
            at[b] = m / 8 + 1;
            at[thin] = 1;
            u[q][m] = s->fluid.u[a][cell(&s->grid, at[0], at[1], at[2])];
        }
        sim_free(s);
        xfree(text);
    }
    double off = 0.0;
    for (int m = 0; m < 64; m++)
        off = fmax(off, fabs(u[0][m] - u[1][m]));
    check(off < 1e-14 && fabs(u[0][60]) > 1e-3,
          "one cell thick along %c: as three cells, to %.2g", 'x' + thin, off);
}

/* ---- 13 um silica in water, a fluid step of 1 ms ---- */

static void fine_grain(const char *drag, int steps, double *velocity, double *relaxation)
{
    char *const text = xprintf(
        "[grains a]\ndiameter = 13 um\ndensity = 2650 kg/m3\nfill = point\n"
        "position = 50 50 150 um\n" MATERIAL
        "[domain]\nsize = 100 100 200 um\ncells = 2 2 4\nz+ = outflow\n"
        "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 1 ms\nviscous = implicit\n"
        "[coupling]\nways = one\ndrag = %s\n[run]\nend = 1 s\ndt = 1 ms\nforce = on\n",
        drag);
    struct sim *const s = quiet_from(text);
    for (int n = 0; n < steps; n++)
        step(s);
    *velocity = s->grains.vel[0].z;
    *relaxation = s->coupling.relaxation;
    sim_free(s);
    xfree(text);
}

static void check_fine(void)
{
    const double d = 13e-6, want = -1650.0 * 9.81 * d * d / (18.0 * 1e-3);
    double v, theta;
    fine_grain("implicit", 200, &v, &theta);
    check(theta > 30.0, "13 um silica in water: fluid.dt is %.3g relaxation times", theta);
    check(fabs(v / want - 1.0) < 3e-3,
          "its grain step is as long, and it settles at %.5g of Stokes", v / want);
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        if (!freopen("/dev/null", "w", stderr))
            _exit(9);
        fine_grain("explicit", 200, &v, &theta);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    check(WIFEXITED(status) && WEXITSTATUS(status) == EXIT_UNSTABLE,
          "explicit drag is stopped there: exit %d", WEXITSTATUS(status));
}

/* ---- a pressure that does not converge ---- */

/* A step with a drag that pushes here and there, which leaves coefficients of both signs and is nothing for
 * conjugate gradients: what the program says on the way out, and how it ends. */
static int unconverged(char *said, size_t room)
{
    int end[2], status = 0;
    fflush(stdout);
    if (pipe(end) != 0)
        return -1;
    const pid_t child = fork();
    if (child == 0) {
        dup2(end[1], STDERR_FILENO);
        struct sim *const s =
            lattice("a", "x = periodic\ny = periodic\nz- = wall\nz+ = outflow\n", 1);
        for (int n = 0; n < 5; n++) {
            for (int a = 0; a < 3; a++)
                for (size_t c = 0; c < s->grid.total; c++) {
                    s->fluid.drag[a][c] = -6e6 * (noise() + 0.5);
                    s->fluid.u[a][c] = 0.01 * noise();
                }
            fluid_step(s);
        }
        _exit(0);
    }
    close(end[1]);
    size_t n = 0;
    for (ssize_t more; n + 1 < room && (more = read(end[0], said + n, room - 1 - n)) > 0;)
        n += (size_t)more;
    said[n] = '\0';
    close(end[0]);
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void check_unconverged(void)
{
    char said[2000];
    const int status = unconverged(said, sizeof said);
    char *const line = strchr(said, '\n');
    if (line)
        *line = '\0';
    check(status == EXIT_UNSTABLE && strstr(said, "the pressure has not converged at t = ") &&
              strstr(said, "residual"),
          "a pressure that does not converge ends the run with %d: %s", status, said);
}

int main(void)
{
    omp_set_num_threads(1); /* small grids: a team would only wait */
    check_pairs("", "", "no grains");
    check_pairs("", "viscous = implicit\n", "no grains, implicit viscosity");
    check_pairs("[grains a]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = random\ncount = "
                "90\n" MATERIAL,
                "", "grains that fall");
    check_pairs("[grains a]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = random\ncount = "
                "90\n" MATERIAL,
                "form = c\nporosity_rate = flux\nviscous = implicit\n",
                "form c, solid flux, implicit viscosity");
    check_forms();
    check_still("a");
    check_still("b");
    check_still("c");
    check_held();
    check_adaptive();
    check_unconverged();
    check_backflow("centred");
    check_backflow("van_leer");
    check_thin("z = periodic\n", 0, 1, 2);
    check_thin("y = periodic\n", 0, 2, 1);
    check_thin("x = slip\n", 1, 2, 0);
    check_fine();
    return check_end();
}
