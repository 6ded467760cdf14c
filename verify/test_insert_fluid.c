/* verify/test_insert_fluid.c - grains that come and go in a fluid: it is not pushed where it makes
 * room or takes their place, and what is handed over still adds up. */
/* slots: contact/linear drag/ergun porosity/divided solver/fluid/navier_stokes */
#include "check.h"
#include "harness.h"

#define SCENE(gravity)                                                                         \
    "[domain]\nsize = 12 12 24 mm\ncells = 4 4 8\nx = periodic\ny = periodic\nz+ = "           \
    "outflow\ngravity "                                                                        \
    "= " gravity                                                                               \
    "\n[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 0.2 ms\n[grains a]\n"          \
    "diameter = 1.3 mm\ndensity = 2385 kg/m3\nmaterial = m\ncount = 20\nfill = random\n"       \
    "[material m]\nstiffness = 500 N/m\nrestitution = 0.6\nfriction = 0.3\n"                   \
    "[run]\nend = 20 ms\ndt = 20 us\n[insert rain]\nrate = 5000 1/s\nfrom = 0 0 14 mm\n"       \
    "to = 12 12 22 mm\n[delete hole]\nshape = sphere\ncentre = 6 6 15 mm\nradius = 3 mm\n"

static double fastest(const struct sim *s)
{
    double u = 0.0;
    for (int a = 0; a < 3; a++)
        u = fmax(u, max_abs(s->fluid.u[a], s->grid.total));
    return u;
}

int main(void)
{
    struct sim *s = sim_from(SCENE("0 0 0 m/s2"));
    ledger_start(s);
    while (s->t < s->run.end - 1e-9)
        step(s);
    check(s->traffic.inserted >= 99.0 && s->traffic.removed > 5.0,
          "at rest: %g grains came, %g went", s->traffic.inserted, s->traffic.removed);
    check_abs(fastest(s), 0.0, 1e-12, "at rest: the fluid rests while they come and go, m/s");
    sim_free(s);
    s = sim_from(SCENE("0 0 -9.81 m/s2"));
    ledger_start(s);
    while (s->t < s->run.end - 1e-9)
        step(s);
    check(fastest(s) > 1e-3, "falling: the fluid moves, %g m/s", fastest(s));
    check_abs(s->ledger.volume_error, 0.0, 1e-12, "falling: volume on the grid");
    check_abs(s->ledger.handover_error, 0.0, 1e-9, "falling: momentum handed over");
    check_abs(s->ledger.momentum_error, 0.0, 1e-9, "falling: momentum of the grains");
    sim_free(s);
    return check_end();
}
