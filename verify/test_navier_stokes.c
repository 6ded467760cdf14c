/* verify/test_navier_stokes.c - the fluid without grains against exact flows, its orders of
 * accuracy; with grains: continuity, still fluid, momentum, bits. */
/* slots: drag/di_felice porosity/divided solver/fluid/navier_stokes contact/linear */
#include <omp.h>
#include "../drag/drag.h"
#include "check.h"
#include "harness.h"

#define FLUID "[fluid]\ndensity = 1100 kg/m3\nviscosity = 0.037 Pa s\nconvection = centred\n"

static const double rho = 1100.0, mu = 0.037;

/* Largest error of plane Poiseuille (drive) or Couette (moving wall) flow on n cells. */
static double channel(int n, double drive, double wall)
{
    const double H = 0.013, nu = mu / rho, dt = 0.2 * H * H / (n * (double)n * nu);
    char *const text =
        xprintf(FLUID "dt = %.17g s\n[domain]\nsize = 10 %g 10 mm\ncells = 2 %d 1\nx = "
                      "periodic\nz = periodic\n"
                      "y- = wall\ny+ = wall\n[side y+]\nvelocity = %g 0 0 m/s\n"
                      "[flow]\npressure_gradient = %g 0 0 Pa/m\n[run]\nend = 1e9 s\n",
                dt, 1e3 * H, n, wall, drive);
    struct sim *const s = sim_from(text);
    for (int k = 0; k < 15 * n * n; k++)
        step(s);
    double worst = 0.0, fastest = 0.0;
    for (int j = 1; j <= n; j++) {
        const double y = (j - 0.5) * H / n;
        const double exact = drive / (2.0 * mu) * y * (H - y) + wall * y / H;
        worst = fmax(worst, fabs(s->fluid.u[0][cell(&s->grid, 1, j, 1)] - exact));
        fastest = fmax(fastest, fabs(exact));
    }
    sim_free(s);
    xfree(text);
    return worst / fastest;
}

/* Taylor and Green's vortices in the plane of two directions a, b: error after half a decay
 * time. */
static double taylor_green(int n, int a, int b)
{
    const double L = 2.0 * PI * 0.01, k = 100.0, U = 0.05, nu = mu / rho;
    const double end = 0.25 / (2.0 * nu * k * k);
    const int steps = 6 * n;
    int cells[3] = {1, 1, 1};
    cells[a] = cells[b] = n;
    char *const text = xprintf(
        FLUID
        "dt = %.17g s\n[domain]\nsize = %.17g %.17g %.17g m\ncells = %d %d %d\nx = periodic\n"
        "y = periodic\nz = periodic\n[run]\nend = 1e9 s\n",
        end / steps, L, L, L, cells[0], cells[1], cells[2]);
    struct sim *const s = sim_from(text);
    const struct grid *const g = &s->grid;
    double worst = 0.0;
    for (int round = 0; round < 2; round++) {
        const double decay = round ? exp(-2.0 * nu * k * k * s->t) : 1.0;
        for (int q = 1; q <= g->n[2]; q++)
            for (int j = 1; j <= g->n[1]; j++)
                for (int i = 1; i <= g->n[0]; i++) {
                    const int c = cell(g, i, j, q), at[3] = {i, j, q};
                    const double fa = (at[a] - 1) * g->h[a], ca = fa + 0.5 * g->h[a];
                    const double fb = (at[b] - 1) * g->h[b], cb = fb + 0.5 * g->h[b];
                    const double u = U * decay * sin(k * fa) * cos(k * cb);
                    const double v = -U * decay * cos(k * ca) * sin(k * fb);
                    if (round == 0) {
                        s->fluid.u[a][c] = u;
                        s->fluid.u[b][c] = v;
                    } else {
                        worst = fmax(worst, fmax(fabs(s->fluid.u[a][c] - u),
                                                 fabs(s->fluid.u[b][c] - v)));
                    }
                }
        for (int m = 0; m < steps && round == 0; m++)
            step(s);
    }
    sim_free(s);
    xfree(text);
    return worst / U;
}

static void check_order(const char *what, double coarse, double fine)
{
    check(coarse / fine > 3.4, "%s: errors %.3g and %.3g, order %.2f", what, coarse, fine,
          log2(coarse / fine));
}

#define SUSPENSION                                                                             \
    "[grains a]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = random\ncount = 300\nmaterial " \
    "= m\n"                                                                                    \
    "[grains b]\ndiameter = 2 mm\ndensity = 800 kg/m3\nfill = random\ncount = 60\nmaterial = " \
    "m\n"                                                                                      \
    "[material m]\nstiffness = 100 N/m\nrestitution = 0.6\nfriction = 0.4\n"                   \
    "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 0.5 ms\n"                        \
    "[run]\nend = 1 s\ndt = 20 us\n"

/* Grains rise and sink among each other between these sides. */
static void check_suspension(const char *sides, const char *what)
{
    char *const text =
        xprintf(SUSPENSION "[domain]\nsize = 12 14 30 mm\ncells = 4 5 10\n%s", sides);
    struct sim *const s = sim_from(text);
    ledger_start(s);
    double divergence = 0.0;
    for (int k = 0; k < 60; k++) {
        step(s);
        if (k > 0)
            divergence = fmax(divergence, s->fluid.divergence);
    }
    check(s->fluid.courant > 1e-3, "%s: it moves, Courant %.3g", what, s->fluid.courant);
    check(divergence < 1e-10, "%s: d(eps)/dt + div(eps u) is %.2g of u/h", what, divergence);
    check(s->ledger.handover_error < 1e-12, "%s: momentum handed over cancels: %.2g", what,
          s->ledger.handover_error);
    check(s->ledger.momentum_error < 1e-11, "%s: momentum of the grains closes: %.2g", what,
          s->ledger.momentum_error);
    check(s->ledger.volume_error < 1e-12, "%s: volume on the grid: %.2g", what,
          s->ledger.volume_error);
    sim_free(s);
    xfree(text);
}

static unsigned long bits(int threads)
{
    omp_set_num_threads(threads);
    struct sim *const s = sim_from(SUSPENSION "[domain]\nsize = 12 14 30 mm\ncells = 4 5 10\n"
                                              "x = periodic\nz- = inflow\nz+ = outflow\n"
                                              "[flow]\nvelocity = 10 mm/s\n");
    ledger_start(s);
    for (int k = 0; k < 25; k++)
        step(s);
    const unsigned long h = sim_bits(s);
    sim_free(s);
    return h;
}

/* Still fluid over a random frozen bed: nothing moves, each grain feels its buoyancy. */
static void check_still(void)
{
    struct sim *const s = sim_from(
        "[grains a]\ndiameter = 2 mm\ndensity = 2650 kg/m3\nfill = random\ncount = 200\n"
        "frozen = yes\n[material a]\nstiffness = 100 N/m\nrestitution = 0.6\n"
        "friction = 0.4\n[domain]\nsize = 12 14 30 mm\ncells = 4 5 10\nz+ = outflow\n"
        "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 0.5 ms\n[run]\nend = 1 s\n");
    for (int k = 0; k < 50; k++)
        step(s);
    double moves = 0.0, off = 0.0;
    for (int a = 0; a < 3; a++)
        moves = fmax(moves, max_abs(s->fluid.u[a], s->grid.total));
    for (int i = 0; i < s->grains.n; i++) {
        const vec3 want = v3(0.0, 0.0, 1000.0 * 9.81 * s->grains.volume[i]);
        off = fmax(off, v3_norm(v3_sub(s->grains.load[i], want)) / want.z);
    }
    check(moves == 0.0, "still fluid over a frozen bed stays still: %g m/s", moves);
    check(off < 1e-14, "each grain feels its buoyancy: %g off", off);
    sim_free(s);
}

/* Two layers of frozen grains, coarse below fine: the drop is the sum of the two. */
static void check_layers(void)
{
    const double U = 0.004, eps = 1.0 - PI / 6.0, water = 1000.0, viscosity = 1e-3;
    struct sim *const s = sim_from(
        "[grains coarse]\ndiameter = 2 mm\ndensity = 2650 kg/m3\nfill = unit_cell\n"
        "spacing = 2 mm\nto = 4 4 6 mm\nfrozen = yes\nmaterial = m\n"
        "[grains fine]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = unit_cell\nspacing = 1 "
        "mm\n"
        "from = 0 0 6 mm\nfrozen = yes\nmaterial = m\n"
        "[material m]\nstiffness = 100 N/m\nrestitution = 0.6\nfriction = 0.4\n"
        "[domain]\nsize = 4 4 10 mm\ncells = 2 2 5\nx = periodic\ny = periodic\nz- = inflow\n"
        "z+ = outflow\n[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 1 ms\n"
        "[flow]\nvelocity = 4 mm/s\n[run]\nend = 1 s\n");
    for (int k = 0; k < 40; k++)
        step(s);
    double per_volume[2]; /* kappa over d^3 of coarse and fine */
    for (int i = 0; i < 2; i++) {
        const double d = i ? 1e-3 : 2e-3;
        const struct drag_point p = {.eps = eps,
                                     .re = drag_reynolds(eps, U / eps, d, water, viscosity),
                                     .d = d,
                                     .y = 1.0,
                                     .grain = &s->coupling.drag_of.kind[i]};
        per_volume[i] = drag_kappa(&p, viscosity) / (d * d * d);
    }
    check_rel(fluid_side_pressure(s, Z_LO),
              (6e-3 * per_volume[0] + 4e-3 * per_volume[1]) * U / (eps * eps), 1e-9,
              "two layers: pressure drop, Pa");
    sim_free(s);
}

/* Mean flow past one frozen grain in a periodic box, driven along x. */
static double past_grain(double x, double y)
{
    char *const text = xprintf(
        "[grains a]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = point\nfrozen = yes\n"
        "position = %.17g %.17g 2.6 mm\nmaterial = m\n"
        "[material m]\nstiffness = 100 N/m\nrestitution = 0.6\nfriction = 0.4\n"
        "[domain]\nsize = 8 8 8 mm\ncells = 4 4 4\nx = periodic\ny = periodic\nz = periodic\n"
        "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 5 ms\n"
        "[flow]\npressure_gradient = 1 0.3 0 Pa/m\n[run]\nend = 1 s\n",
        x, y);
    struct sim *const s = sim_from(text);
    double mean = 0.0;
    for (int k = 0; k < 300; k++)
        step(s);
    for (int k = 1; k <= 4; k++)
        for (int j = 1; j <= 4; j++)
            for (int i = 1; i <= 4; i++)
                mean += s->fluid.u[0][cell(&s->grid, i, j, k)] / 64.0;
    sim_free(s);
    xfree(text);
    return mean;
}

/* A periodic box has no edge: a grain moved by whole cells feels and disturbs the same flow. */
static void check_shift(void)
{
    const double inside = past_grain(4.7, 5.3);
    check_rel(past_grain(0.7, 5.3), inside, 1e-11,
              "a grain at the periodic side in x: flow, m/s");
    check_rel(past_grain(6.7, 7.3), inside, 1e-11, "a grain at the sides in x and y");
}

int main(void)
{
    check_layers();
    check_shift();
    check_order("Poiseuille", channel(6, 3.1, 0.0), channel(12, 3.1, 0.0));
    check(channel(7, 0.0, 0.019) < 1e-9, "Couette is exact: %.2g", channel(7, 0.0, 0.019));
    check_order("Taylor-Green, x y", taylor_green(16, 0, 1), taylor_green(32, 0, 1));
    check_order("Taylor-Green, y z", taylor_green(16, 1, 2), taylor_green(32, 1, 2));
    check_order("Taylor-Green, x z", taylor_green(16, 0, 2), taylor_green(32, 0, 2));
    check_still();
    check_suspension("x = periodic\ny = periodic\n", "closed below and above");
    check_suspension("x = slip\nz- = inflow\nz+ = outflow\n[flow]\nvelocity = 15 mm/s\n",
                     "through flow");
    check_suspension("y = slip\nx- = inflow\nx+ = outflow\n[flow]\nvelocity = 15 mm/s\n",
                     "along x");
    check_suspension("x = slip\nz+ = outflow\n", "open above");
    const unsigned long one = bits(1);
    const int threads[] = {2, 3, 7, 16};
    for (int i = 0; i < 4; i++)
        check(bits(threads[i]) == one, "the same bits on 1 and %d threads", threads[i]);
    return check_end();
}
