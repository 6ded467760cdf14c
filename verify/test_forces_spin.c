/* verify/test_forces_spin.c - spin and lift in runs: what a grain sees of a shear, against the exact
 * shear; the torque's decay against the exact one of its scheme; reactions. */
/* slots: drag/stokes porosity/trilinear solver/fluid/navier_stokes forces/magnus forces/saffman forces/viscous_torque */
#include <omp.h>
#include "check.h"
#include "harness.h"

static const double d = 0.83e-3, mu = 1.37e-2, rho = 997.0, rho_p = 2650.0;

/* Couette flow between plates, u = shear z along x, with one grain. */
static struct sim *couette(double shear, double dt, const char *more)
{
    char *const text = xprintf(
        "[domain]\nsize = 8 8 12 mm\ncells = 4 4 12\nx = periodic\ny = periodic\nz = wall\n"
        "gravity = 0 0 0 m/s2\n[side z+]\nvelocity = %.17g 0 0 m/s\n"
        "[fluid]\ndensity = %g kg/m3\nviscosity = %g Pa s\ndt = %.17g s\n[run]\nend = 1 "
        "s\nforce = on\n"
        "[grains ball]\ndiameter = %g m\ndensity = %g kg/m3\nfill = point\nposition = 3.1 4.7 "
        "5.3 mm\n"
        "%s",
        shear * 12e-3, rho, mu, dt, d, rho_p, more);
    struct sim *const s = sim_from(text);
    const struct grid *const g = &s->grid;
    for (size_t c = 0; c < g->total; c++)
        s->fluid.u[0][c] = shear * ((double)((int)c / g->sk) - 0.5) * g->h[2];
    xfree(text);
    return s;
}

static void test_seen(void)
{
    const double shear = 17.3, z = 5.3e-3;
    struct sim *const s = couette(shear, 1e-3,
                                  "velocity = 0.02 0 0 m/s\n[coupling]\nways = one\n"
                                  "[forces]\nsaffman = saffman\nmagnus = rubinow_keller\n");
    fluid_sense(s);
    const double slip = shear * z - 0.02;
    /* curl = (0, shear, 0): (slip, 0, 0) x curl points to +z */
    const double saffman = 1.615 * mu * d * slip * sqrt(rho * d * d * shear / mu);
    const double magnus = PI / 8.0 * rho * pow(d, 3) * 0.5 * shear * slip;
    check_rel(s->coupling.forces.force[0].z, saffman - magnus, 1e-11,
              "lift in a shear, Saffman less Magnus, N");
    check_abs(s->coupling.forces.force[0].x, 0.0, 1e-12 * saffman, "none along the flow");
    sim_free(s);
}

static void test_decay(double theta, int steps)
{
    const double rate = PI * mu * pow(d, 3), inertia = rho_p * PI / 60.0 * pow(d, 5);
    struct sim *const s = couette(0.0, theta * inertia / rate,
                                  "spin = 0.7 -0.4 0.9 rad/s\n[coupling]\nways = one\n");
    for (int k = 0; k < steps; k++)
        step(s);
    char *const what = xprintf("spin after %d steps of %g relaxation times", steps, theta);
    check_abs(s->grains.spin[0].z, 0.9 * pow(1.0 + theta, -steps), 1e-12, what);
    if (theta < 0.1)
        check_rel(s->grains.spin[0].x, 0.7 * exp(-theta * steps), 0.03,
                  "  near the exponential");
    xfree(what);
    sim_free(s);
}

static void test_terminal(void)
{
    struct sim *const s = couette(9.7, 2e-3, "[coupling]\nways = one\n");
    for (int k = 0; k < 60; k++)
        step(s);
    check_rel(s->grains.spin[0].y, 0.5 * 9.7, 1e-6, "it comes to spin with the fluid, rad/s");
    sim_free(s);
}

static void test_reaction(void)
{
    struct sim *const s = couette(9.7, 2e-4, "spin = 0 90 0 rad/s\nvelocity = 0 0.03 0 m/s\n");
    for (int k = 0; k < 20; k++)
        step(s);
    check(s->ledger.handover_error < 1e-12 && v3_norm(s->coupling.forces.given[0]) > 0.0,
          "lift of %.2e N is taken from the fluid, but for %.1e",
          v3_norm(s->coupling.forces.given[0]), s->ledger.handover_error);
    sim_free(s);
}

int main(void)
{
    omp_set_num_threads(1);
    test_seen();
    test_decay(0.02, 100);
    test_decay(3.0, 10);
    test_decay(1e4, 3);
    test_terminal();
    test_reaction();
    return check_end();
}
