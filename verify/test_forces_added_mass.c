/* verify/test_forces_added_mass.c - virtual mass in runs, against closed forms.
 *
 * A light sphere released in a liquid rises with (rho - rho_p)/(rho_p + C_m rho) g, whatever the step. In
 * a fluid that accelerates by G/rho a sphere accelerates by (1 + C_m) G/(rho_p + C_m rho). Two-way, what
 * it takes the fluid loses, and both ledgers close. */
/* slots: porosity/trilinear solver/fluid/navier_stokes forces/virtual_mass */
#include <omp.h>
#include "check.h"
#include "harness.h"

#define BOX                                                                                    \
    "[domain]\nsize = 20 20 20 mm\ncells = 5 5 5\nx = periodic\ny = periodic\nz = periodic\n"  \
    "[fluid]\ndensity = 913 kg/m3\nviscosity = %g Pa s\ndt = %g s\n"                           \
    "[grains ball]\ndiameter = 1.3 mm\ndensity = %g kg/m3\nfill = point\nposition = 7.3 9.1 "  \
    "4.7 mm\n"                                                                                 \
    "velocity = %g 0 0 m/s\n[run]\nend = 1 s\n"

static const double rho = 913.0;

static void test_release(double rho_p, double c_m, double dt, int steps)
{
    char *const text =
        xprintf(BOX "[coupling]\nways = one\n[forces]\nvirtual_mass_coefficient = %g\n", 1e-3,
                dt, rho_p, 0.0, c_m);
    struct sim *const s = sim_from(text);
    for (int k = 0; k < steps; k++)
        step(s);
    const double a = (rho - rho_p) / (rho_p + c_m * rho) * 9.81;
    char *const what =
        xprintf("released at %g kg/m3, C_m %g, step %g s: velocity, m/s", rho_p, c_m, dt);
    check_rel(s->grains.vel[0].z, a * s->t * v3_norm(s->domain.gravity) / 9.81, 1e-11, what);
    check(s->ledger.momentum_error < 1e-11, "  the momentum of the grains closes: %.1e",
          s->ledger.momentum_error);
    xfree(what);
    xfree(text);
    sim_free(s);
}

static void test_accelerated(double rho_p)
{
    const double G = 217.0, c_m = 0.5;
    char *const text =
        xprintf(BOX "[coupling]\nways = one\n[flow]\npressure_gradient = 0 %g 0 Pa/m\n", 1e-3,
                1e-3, rho_p, 0.0, G);
    struct sim *const s = sim_from(text);
    s->domain.gravity = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < 30; k++)
        step(s);
    const double a = (1.0 + c_m) * G / (rho_p + c_m * rho);
    char *const what = xprintf("in accelerated fluid, %g kg/m3: velocity, m/s", rho_p);
    check_rel(s->grains.vel[0].y, a * s->t, 1e-10, what);
    xfree(what);
    xfree(text);
    sim_free(s);
}

/* A sphere shot into fluid at rest, no drag, no gravity: what it loses the fluid wins. */
static void test_handed_over(double rho_p)
{
    char *const text = xprintf(BOX, 1e-3, 1e-3, rho_p, 0.3);
    struct sim *const s = sim_from(text);
    const double mass = s->grains.mass[0];
    s->domain.gravity = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < 50; k++)
        step(s);
    const struct grid *const g = &s->grid;
    double fluid = 0.0;
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int c = cell(g, i, j, k);
                fluid += rho * g->volume * grid_face(s->fluid.eps, c, 1) * s->fluid.u[0][c];
            }
    /* relative to a sum that is small against its parts: the sphere coasts */
    check(s->ledger.handover_error < 1e-10, "%g kg/m3 shot: handed over but for %.1e", rho_p,
          s->ledger.handover_error);
    check_rel(mass * s->grains.vel[0].x + fluid, mass * 0.3, 1e-5,
              "  momentum of both, but for the lag of a step, kg m/s");
    printf("    velocity %.6f of its start\n", s->grains.vel[0].x / 0.3);
    xfree(text);
    sim_free(s);
}

int main(void)
{
    omp_set_num_threads(1);
    test_release(100.0, 0.5, 1e-3, 10);
    test_release(1.2, 0.5, 1e-3, 10);
    test_release(1e-3, 0.5, 5e-4, 20);
    test_release(2650.0, 0.5, 1e-3, 10);
    test_release(371.0, 0.83, 2e-3, 10);
    test_accelerated(913.0);
    test_accelerated(2650.0);
    test_accelerated(13.0);
    test_handed_over(13.0);
    test_handed_over(2650.0);
    return check_end();
}
