/* verify/test_rolling_jiang.c - rolling and twisting over a contact of finite radius, in runs: on a
 * plane the limit is zeta_c beta/2 of the weight times r, so a sphere rolls from that slope on; it
 * comes to rest and stays; a spin about the normal is braked by 0.65 mu F_n 2 beta r. */
/* slots: contact/linear contact/rolling/jiang */
#include "rolling_runs.h"

static char *material_of(double slope)
{
    return xprintf("crushing = 2.1\nshape_parameter = %.17g\n", 2.0 * slope / 2.1);
}

static void check_twist(void)
{
    const double r = 5e-3, beta = 0.2, m = 1056.0 * 4.0 / 3.0 * PI * r * r * r, w = 40.0;
    struct sim *const s =
        sphere_on_plane(0.0, 1e-5, "crushing = 2.1\nshape_parameter = 0.2\n", "");
    s->grains.spin[0].z = w;
    const double torque = 0.65 * 0.9 * m * 9.81 * 2.0 * beta * r, inertia = 0.4 * m * r * r;
    const double want = w - torque / inertia * 0.02;
    for (int k = 0; k < 2000; k++)
        step(s);
    check_rel(s->grains.spin[0].z, want, 5e-3, "twisting: spin after 0.02 s, rad/s");
    for (int k = 0; k < 40000; k++)
        step(s);
    check_abs(s->grains.spin[0].z, 0.0, 1e-9, "twisting: spin at rest, rad/s");
    sim_free(s);
}

int main(void)
{
    static const double angle[] = {4, 13, 24, 35};
    for (int i = 0; i < 4; i++) {
        const double slope = tan(angle[i] * PI / 180.0);
        char *const material = material_of(slope);
        check_incline(slope, material, "");
        xfree(material);
    }
    check_slopes(material_of, "");
    check_incline(0.2, "shape_parameter = 0.6\n", "[rolling]\nform = disc\n"); /* beta/3 */
    char *const material = material_of(0.3);
    const struct stop s = roll_out(0.2, 0.4, material, "");
    check_rel(s.distance, 0.2 * 0.2 / (2.0 * 2.10214286), 1e-2, "rolls to rest: distance, m");
    check(s.speed < 1e-9 && fabs(s.drift) < 1e-10, "and stays: speed %.2g m/s, drift %.2g m",
          s.speed, s.drift);
    xfree(material);
    check_twist();
    return check_end();
}
