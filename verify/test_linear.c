/* verify/test_linear.c - the linear law in whole runs: restitution, energy, momentum, oblique
 * impact against the closed form. */
/* slots: contact/linear */
#include "two_bodies.h"

#define MATERIAL "stiffness = 2.3e5 N/m\n"

/* Sphere on plane, no slip, no damping: v_c'/v_c = cos(pi sqrt(3.5 k_t/k_n))
 * (reference/linear_oblique.csv). */
static void check_oblique(double ratio)
{
    const double vt = 0.31, vn = 0.27, r = 5e-3;
    char *const text = xprintf(
        "[grains a]\ndiameter = 10 mm\ndensity = 2385 kg/m3\nfill = point\n"
        "position = 50 50 5.05 mm\nvelocity = %g 0 %g m/s\nmaterial = m\n[domain]\n"
        "size = 100 100 100 mm\ngravity = 0 0 0 m/s2\nx = periodic\ny = periodic\n"
        "[run]\nend = 1 s\nsubsteps = 1\ndt = 2 ns\n[material m]\nstiffness = 4.6e7 N/m\n"
        "stiffness_ratio = %g\nrestitution = 1\nfriction = 1e6\n",
        vt, -vn, ratio);
    struct sim *const s = sim_from(text);
    bool touched = false;
    for (;;) {
        step(s);
        touched = touched || s->neighbours.touching > 0;
        if (touched && s->neighbours.touching == 0)
            break;
    }
    const double contact = s->grains.vel[0].x - r * s->grains.spin[0].y;
    char *const what = xprintf("oblique impact, k_t/k_n = %g: contact velocity ratio", ratio);
    check_abs(contact / vt, cos(PI * sqrt(3.5 * ratio)), 5e-3, what);
    xfree(what);
    sim_free(s);
    xfree(text);
}

int main(void)
{
    check_restitution(MATERIAL, 5e-7);
    check_energy(MATERIAL, 2e-6);
    check_momentum(MATERIAL, 1e-6);
    check_oblique(0.1);
    check_oblique(2.0 / 7.0);
    check_oblique(0.6666666667);
    return check_end();
}
