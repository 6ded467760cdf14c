/* verify/test_squeeze.c - the film in runs: a sphere is pressed through a viscous fluid towards a
 * plane by a constant force; its gap falls as the film's resistance says, integrated here, and it
 * slows down long before it touches. */
/* slots: contact/linear contact/lubrication/squeeze */
#include "check.h"
#include <omp.h>
#include "harness.h"

int main(void)
{
    const double r = 1e-3, mu = 0.5, range = 2e-4, force = 1e-3;
    const char *const text =
        "[grains a]\ndiameter = 2 mm\ndensity = 1100 kg/m3\nfill = point\nmaterial = m\n"
        "position = 10 10 1.15 mm\n[domain]\nsize = 20 20 20 mm\ngravity = 0 0 0 m/s2\n[run]\n"
        "end = 1 s\ndt = 0.5 us\nsubsteps = 1\n[material m]\nstiffness = 1e4 N/m\n"
        "restitution = 0.5\nfriction = 0\n[fluid]\nviscosity = 0.5 Pa s\n[lubrication]\n"
        "gap_min = 0.1 um\nrange = 0.2 mm\n";
    omp_set_num_threads(1);
    struct sim *const s = sim_from(text);
    double gap = 0.0;
    s->domain.gravity = v3(0.0, 0.0, -force / s->grains.mass[0]);
    int k = 0;
    for (; k < 400000 && s->grains.pos[0].z - r > 4e-5; k++)
        step(s);
    gap =
        s->grains.pos[0].z - r; /* inertia is over: from here on the film balances the force */
    for (int i = 0; i < 40000; i++)
        step(s);
    const double end = s->grains.pos[0].z - r;
    for (int i = 0; i < 40000; i++)
        gap -= 0.5e-6 * force /
               (6.0 * PI * mu * r * (r / gap - r / range + 0.2 * log(range / gap)));
    check(end < 0.5e-4, "the gap has fallen to %.3g m", end);
    check_rel(end, gap, 1e-2, "gap under a constant force, m");
    sim_free(s);
    return check_end();
}
