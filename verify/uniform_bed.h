/* verify/uniform_bed.h - a bed of uniform porosity gives the drag law's pressure drop; included
 * by a test that links one drag law and one fluid solver. Grains of 1 mm on a simple cubic
 * lattice, one to a cell: every cell has the fluid fraction 1 - pi/6. */
#ifndef UNIFORM_BED_H
#define UNIFORM_BED_H

#include "check.h"
#include "harness.h"

#define BED                                                                                    \
    "[grains bed]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = unit_cell\nspacing = 1 mm\n"  \
    "frozen = yes\n"

static const double bed_d = 1e-3, bed_mu = 1.37e-3, bed_rho = 913.0;

/* Pa/m at superficial velocity U: the law of the test, written out here once more. */
static double law_gradient(double phi, double eps, double U);

/* Steady flow from an inflow to an outflow, or from a given flux to a head. */
static inline void check_through(const char *sides, const char *flow, double re, double rate_dt,
                                 int steps)
{
    const double phi = PI / 6.0, eps = 1.0 - phi, U = re * bed_mu / (bed_rho * bed_d);
    const double rate = law_gradient(phi, eps, U) * eps / (bed_rho * U); /* B/(rho eps) */
    char *const set = xprintf(flow, U);
    char *const text =
        xprintf(BED "[domain]\nsize = 3 2 7 mm\ncells = 3 2 7\nx = periodic\ny = periodic\n%s"
                    "[fluid]\ndensity = %.17g kg/m3\nviscosity = %.17g Pa s\ndt = %.17g s\n%s"
                    "[run]\nend = 1e9 s\nforce = on\n",
                sides, bed_rho, bed_mu, rate_dt / rate, set);
    struct sim *const s = sim_from(text);
    for (int k = 0; k < steps; k++)
        step(s);
    const double drop = fluid_side_pressure(s, Z_LO) - fluid_side_pressure(s, Z_HI);
    char *const what = xprintf("Re %g, dt x drag rate %g: pressure drop, Pa", re, rate_dt);
    check_rel(drop, 7e-3 * law_gradient(phi, eps, U), 1e-6, what);
    check(s->ledger.handover_error < 1e-12, "  momentum handed over cancels: %.2g",
          s->ledger.handover_error);
    xfree(what);
    xfree(text);
    xfree(set);
    sim_free(s);
}

/* A periodic bed driven by a pressure gradient: the superficial velocity that it comes to. */
static inline void check_driven(double re, double rate_dt, int steps)
{
    const double phi = PI / 6.0, eps = 1.0 - phi, U = re * bed_mu / (bed_rho * bed_d);
    const double rate = law_gradient(phi, eps, U) * eps / (bed_rho * U);
    char *const text = xprintf(
        BED
        "[domain]\nsize = 3 2 4 mm\ncells = 3 2 4\nx = periodic\ny = periodic\nz = periodic\n"
        "[fluid]\ndensity = %.17g kg/m3\nviscosity = %.17g Pa s\ndt = %.17g s\n"
        "[flow]\npressure_gradient = 0 0 %.17g Pa/m\n[run]\nend = 1e9 s\nforce = on\n",
        bed_rho, bed_mu, rate_dt / rate, law_gradient(phi, eps, U));
    struct sim *const s = sim_from(text);
    for (int k = 0; k < steps; k++)
        step(s);
    char *const what =
        xprintf("driven, Re %g, dt x drag rate %g: superficial velocity", re, rate_dt);
    const int c = cell(&s->grid, 2, 1, 3);
    check_rel(s->fluid.u[2][c] * grid_face(s->fluid.eps, c, s->grid.sk), U, 1e-6, what);
    xfree(what);
    xfree(text);
    sim_free(s);
}

static inline void check_navier_stokes(void)
{
    static const double re[] = {1e-3, 1.0, 1e3}, rate[] = {1e-3, 0.1, 10.0, 1e4};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++) /* long steps are past the Courant limit, where advection
                                       makes round-off grow: the drag is steady at once there */
            check_through("z- = inflow\nz+ = outflow\n", "[flow]\nvelocity = %.17g m/s\n",
                          re[i], rate[k], rate[k] > 1.0 ? 6 : 12);
    for (int i = 0; i < 3; i++) {
        check_driven(re[i], 0.1, 400);
        check_driven(re[i], 10.0, 60);
        check_driven(re[i], 1e4, 60);
    }
}

static inline void check_darcy(void)
{
    static const double re[] = {1e-3, 1.0, 1e3};
    for (int i = 0; i < 3; i++)
        check_through("z- = flux\nz+ = head\n", "[side z-]\nflux = %.17g m/s\n", re[i], 1.0, 3);
}

#endif
