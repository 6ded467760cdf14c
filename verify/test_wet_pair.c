/* verify/test_wet_pair.c - a liquid bridge in a run: two grains that touch are drawn apart; the bridge
 * forms, pulls across the gap and ruptures at its rupture distance; a pair that never touched has
 * none. The energy that the bridge took is the integral of its force. */
/* slots: contact/linear contact/cohesion/capillary */
#include "check.h"
#include <omp.h>
#include "harness.h"

static struct sim *drawn_apart(double gap, double v)
{
    char *const text = xprintf(
        "[grains a]\ndiameter = 2 mm\ndensity = 2500 kg/m3\nfill = point\nmaterial = m\n"
        "position = 10 10 10 mm\nfrozen = yes\n[grains b]\ndiameter = 3 mm\n"
        "density = 1e6 kg/m3\nfill = point\nmaterial = m\nposition = %.17g 0.01 0.01 m\n"
        "velocity = %g 0 0 m/s\n[domain]\nsize = 20 20 20 mm\ngravity = 0 0 0 m/s2\n[run]\n"
        "end = 1 s\ndt = 1 us\nsubsteps = 1\n[material m]\nstiffness = 1e4 N/m\n"
        "restitution = 1\nfriction = 0\nsurface_tension = 0.0719 N/m\ncontact_angle = 20 deg\n"
        "bridge_volume = 0.013 mm3\n",
        0.0125 + gap, v);
    omp_set_num_threads(1);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

int main(void)
{
    const double v = 0.3, theta = 20.0 * PI / 180.0, volume = 1.3e-11;
    const double rupture = (1.0 + 0.5 * theta) * cbrt(volume);
    struct sim *s = drawn_apart(-1e-9, v);
    const int b = grain_at(s, 1);
    const double start = s->grains.vel[b].x;
    double before = start, last = 0.0, pulled = 0.0;
    for (int k = 0; k < 3000; k++) {
        step(s);
        const double now = s->grains.vel[b].x, gap = s->grains.pos[b].x - 0.0125;
        if (now < before - 1e-15)
            last = gap;
        if (gap > 1e-6)
            pulled = fmax(pulled, before - now);
        before = now;
    }
    const double r = 2.0 * 1e-3 * 1.5e-3 / 2.5e-3, m = s->grains.mass[b];
    const double force = 2.0 * PI * r * 0.0719 * cos(theta), rate = sqrt(r / volume);
    check_rel(pulled * m / 1e-6, force, 2e-2, "pull just apart, N");
    check_rel(last, rupture, 5e-3, "ruptures at a gap of, m");
    /* integral of force/(1 + 1.05 s + 2.5 s^2) */
    const double root = sqrt(8.8975) * rate;
    const double work =
        force * 2.0 / root *
        (atan((5.0 * rate * rate * rupture + 1.05 * rate) / root) - atan(1.05 * rate / root));
    check_rel(0.5 * m * (start * start - before * before), work, 5e-3,
              "energy that the bridge took, J");
    sim_free(s);
    s = drawn_apart(1e-6, v);
    for (int k = 0; k < 1000; k++)
        step(s);
    check(s->grains.vel[grain_at(s, 1)].x == v, "without touch no bridge");
    sim_free(s);
    return check_end();
}
