/* verify/test_forces_forms.c - a suspension with virtual mass and lift, two-way, in every form of the
 * momentum equation: what the grains take the fluid loses, the same bits on any number of threads, and the
 * ledger of the grains closes. Spread by a Gaussian, so that the diffusion is part of it. */
/* slots: contact/linear drag/di_felice porosity/gaussian solver/fluid/navier_stokes forces/virtual_mass forces/saffman forces/magnus forces/viscous_torque */
#include <omp.h>
#include "check.h"
#include "harness.h"

static struct sim *suspension(const char *form)
{
    char *const text = xprintf(
        "[domain]\nsize = 12 10 16 mm\ncells = 6 5 8\nx = periodic\ny = wall\nz- = inflow\nz+ "
        "= outflow\n"
        "[fluid]\ndensity = 998 kg/m3\nviscosity = 1.3 mPa s\ndt = 1 ms\nform = %s\n"
        "[flow]\nvelocity = 37 mm/s\n"
        "[grains beads]\ndiameter = 1.1 mm\ndensity = 1300 kg/m3\ncount = 150\nfill = random\n"
        "velocity = 0.01 0.02 -0.03 m/s\nspin = 3 -7 11 rad/s\n"
        "[material beads]\nstiffness = 200 N/m\nrestitution = 0.7\nfriction = 0.3\n"
        "[run]\nend = 1 s\nforce = on\n",
        form);
    struct sim *const s = sim_from(text);
    xfree(text);
    ledger_start(s);
    return s;
}

int main(void)
{
    const char *const forms[] = {"a", "b", "c"};
    const int team[] = {1, 2, 3};
    unsigned long bits[3];
    for (int f = 0; f < 3; f++) {
        omp_set_num_threads(1);
        struct sim *const s = suspension(forms[f]);
        for (int k = 0; k < 30; k++)
            step(s);
        double given = 0.0;
        for (int i = 0; i < s->grains.n; i++)
            given = fmax(given, v3_norm(s->coupling.forces.given[i]));
        check(s->ledger.handover_error < 1e-10 && given > 0.0,
              "form %s: handed over but for %.1e (virtual mass and lift up to %.2g N)",
              forms[f], s->ledger.handover_error, given);
        check(s->ledger.momentum_error < 1e-10, "  momentum of the grains closes, %.1e",
              s->ledger.momentum_error);
        check(s->ledger.volume_error < 1e-12, "  volume, %.1e", s->ledger.volume_error);
        sim_free(s);
    }
    for (int t = 0; t < 3; t++) {
        omp_set_num_threads(team[t]);
        struct sim *const s = suspension("a");
        for (int k = 0; k < 10; k++)
            step(s);
        bits[t] = sim_bits(s);
        sim_free(s);
        check(bits[t] == bits[0], "the same bits on %d threads", team[t]);
    }
    return check_end();
}
