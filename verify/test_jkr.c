/* verify/test_jkr.c - adhesion in runs: a sphere hangs from the ceiling of a box and is pulled off by
 * a weight of 3/2 pi w R*; drawn apart at a given speed it comes off at the depth of the fold. */
/* slots: contact/hertz contact/cohesion/jkr */
#include "check.h"
#include <omp.h>
#include "harness.h"

int main(void)
{
    const double r = 1e-3, w = 0.05, young = 1e7, nu = 0.3, pull = 1.5 * PI * w * r;
    const double e = young / (2.0 * (1.0 - nu * nu)), m = 2500.0 * 4.0 / 3.0 * PI * r * r * r;
    const char *const text =
        "[grains a]\ndiameter = 2 mm\ndensity = 2500 kg/m3\nfill = point\nmaterial = m\n"
        "position = 10 10 0.999 mm\n[domain]\nsize = 20 20 20 mm\ngravity = 0 0 0 m/s2\n[run]\n"
        "end = 1 s\ndt = 1 us\nsubsteps = 1\n[material m]\nyoung = 10 MPa\npoisson = 0.3\n"
        "restitution = 0.5\nwork_of_adhesion = 0.05 J/m2\n[cohesion]\nlargest_radius = 1 mm\n";
    omp_set_num_threads(1);
    struct sim *s = sim_from(text);
    double off = 0.0;
    for (int k = 0; k < 200000 && off == 0.0; k++) {
        const double load =
            pull * (k < 100000 ? 0.95 * k / 100000 : 0.95 + 0.1 * (k - 100000) / 1e5);
        s->domain.gravity = v3(0.0, 0.0, load / m);
        step(s);
        s->grains.vel[0] = v3_scale(0.998, s->grains.vel[0]);
        if (s->grains.pos[0].z > r + 2e-6)
            off = load;
    }
    check_rel(off, pull, 1e-2, "pulled off by a weight of, N");
    sim_free(s);
    s = sim_from(text);
    double last = 0.0;
    for (int k = 0; k < 60000 && s->grains.pos[0].z < 1.04 * r; k++) {
        s->domain.gravity = v3(0.0, 0.0, 0.0);
        s->grains.vel[0] = v3(0.0, 0.0, 1e-3); /* drawn at this speed, whatever the force */
        step(s);
        if (fabs(s->grains.vel[0].z - 1e-3) > 1e-12)
            last = s->grains.pos[0].z - r;
    }
    const double fold = 0.75 * cbrt(PI * PI * w * w * r / (e * e));
    check_rel(last, fold, 1e-2, "comes off at a gap of, m");
    sim_free(s);
    return check_end();
}
