/* slots: drag/holzer_sommerfeld porosity/centre solver/fluid/navier_stokes */
/* verify/test_drag_shape.c - numbers of shape that a scene gives reach the law of drag, by species;
 * what is not given is a sphere's, or follows from what is. */
#include "../drag/drag.h"
#include "check.h"
#include "harness.h"

int main(void)
{
    const double mu = 1.37e-3, d = 0.9e-3;
    struct sim *const s = sim_from(
        "[grains a]\ndiameter = 0.9 mm\ndensity = 2650 kg/m3\nfill = point\nfrozen = yes\n"
        "position = 0.9 1.1 1.2 mm\n"
        "[grains b]\ndiameter = 0.9 mm\ndensity = 2450 kg/m3\nfill = point\nfrozen = yes\n"
        "position = 5.4 5.3 5.4 mm\nsphericity = 0.737\ncrosswise_sphericity = 0.643\n"
        "[grains c]\ndiameter = 0.9 mm\ndensity = 2650 kg/m3\nfill = point\nfrozen = yes\n"
        "position = 7.3 7.6 7.4 mm\nsphericity = 0.837\ncrosswise_sphericity = 0.943\n"
        "lengthwise_sphericity = 1.137\n"
        "[domain]\nsize = 9 9 9 mm\ncells = 3 3 3\nx = periodic\ny = periodic\nz = periodic\n"
        "[fluid]\ndensity = 913 kg/m3\nviscosity = 1.37 mPa s\ndt = 1 ms\n[run]\nend = 1 s\n");
    static const double sphericity[] = {1.0, 0.737, 0.837}, lengthwise[] = {1.0, 0.643, 1.137};
    const struct coupling *const c = &s->coupling;
    step(s);
    for (int id = 0; id < 3; id++) {
        const int i = grain_at(s, id);
        const double creeping = 1.0 / sqrt(lengthwise[id]) + 2.0 / sqrt(sphericity[id]);
        const double eps = 1.0 - PI / 6.0 * d * d * d / 27e-9;
        check_rel(c->drag_of.kind[id].lengthwise, lengthwise[id], 1e-15,
                  "lengthwise sphericity");
        check_rel(c->part[(size_t)i * (size_t)c->reach], PI * mu * d * eps * creeping, 1e-12,
                  "drag of a fluid at rest over slip, kg/s");
    }
    check(c->drag_of.outside == 3, "all three outside: eps is 0.986, below 0.99");
    sim_free(s);
    return check_end();
}
