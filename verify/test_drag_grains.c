/* slots: drag/beetstra porosity/centre solver/fluid/navier_stokes */
/* verify/test_drag_grains.c - what a law of drag is told of the grains: Sauter's mean diameter of
 * the cell, D10 of all grains, and how many of them are outside of its range. */
#include "../drag/drag.h"
#include "check.h"
#include "harness.h"

/* Two sizes in one cell of 3 mm (eps 0.891: the law holds), the larger alone in another (eps
 * 0.905: it does not). */
static void test_mixture(void)
{
    const double coarse = 1.7e-3, fine = 0.9e-3, mu = 1.37e-3;
    struct sim *const s = sim_from(
        "[grains a]\ndiameter = 1.7 mm\ndensity = 2650 kg/m3\nfill = point\nfrozen = yes\n"
        "position = 0.9 1.1 1.2 mm\n"
        "[grains b]\ndiameter = 0.9 mm\ndensity = 2450 kg/m3\nfill = point\nfrozen = yes\n"
        "position = 2.4 2.3 2.4 mm\n"
        "[grains c]\ndiameter = 1.7 mm\ndensity = 2650 kg/m3\nfill = point\nfrozen = yes\n"
        "position = 7.3 7.6 7.4 mm\n"
        "[domain]\nsize = 9 9 9 mm\ncells = 3 3 3\nx = periodic\ny = periodic\nz = periodic\n"
        "[fluid]\ndensity = 913 kg/m3\nviscosity = 1.37 mPa s\ndt = 1 ms\n[run]\nend = 1 s\n");
    step(s);
    const struct coupling *const c = &s->coupling;
    const double a2 = coarse * coarse, b2 = fine * fine;
    const double mean = (a2 * coarse + b2 * fine) / (a2 + b2);
    check_rel(c->drag_of.sauter[cell(&s->grid, 1, 1, 1)], mean, 1e-13,
              "Sauter's mean of 1.7 and 0.9 mm, m");
    check_rel(c->drag_of.sauter[cell(&s->grid, 3, 3, 3)], coarse, 1e-13,
              "and of 1.7 mm alone, m");
    check_rel(c->drag_of.kind[1].density_ratio, 2450.0 / 913.0, 1e-14, "density ratio");
    check_rel(c->drag_of.kind[0].d10, coarse, 1e-14,
              "D10: the fine grain is 7 % of the volume, m");
    const double eps = 1.0 - PI / 6.0 * (a2 * coarse + b2 * fine) / 27e-9, phi = 1.0 - eps;
    for (int id = 0; id < 2; id++) {
        const double d = id ? fine : coarse;
        const int i = grain_at(s, id);
        check_rel(c->part[(size_t)i * (size_t)c->reach],
                  3.0 * PI * mu * d * eps * d / mean *
                      (10.0 * phi / (eps * eps) + eps * eps * (1.0 + 1.5 * sqrt(phi))),
                  1e-12, "drag of a fluid at rest over slip, mixed sizes, kg/s");
    }
    check(c->drag_of.outside == 1, "%d of 3 grains outside the range, where eps = 0.905",
          c->drag_of.outside);
    drag_grains_report(s);
    const struct summary_line *const line = summary_find(&s->summary, "drag_outside_range");
    check(line && line->number == 1.0, "the summary says so");
    sim_free(s);
}

int main(void)
{
    test_mixture();
    return check_end();
}
