/* verify/test_rolling_epsd.c - the elastic-plastic spring against rolling in runs: a sphere rolls from
 * the slope mu_r on, comes to rest after v^2/(2 a) and stays, swings with the period and decay of a
 * damped spring (reference/06: I_r w^2 = k_r). */
/* slots: contact/linear contact/rolling/epsd */
#include "rolling_runs.h"

/* Free swing about the contact: (I + m R^2) theta'' + C theta' + k_r theta = 0. */
static void check_swing(double eta)
{
    const double mu = 0.02, r = 5e-3, m = 1056.0 * 4.0 / 3.0 * PI * r * r * r, kn = 1e4;
    const double kr = 2.25 * kn * mu * mu * r * r, omega = sqrt(kr / (1.4 * m * r * r));
    const double limit = mu * r * m * 9.81 / kr;
    char *const more = xprintf("[rolling]\ndamping = %g\n", eta);
    struct sim *const s = sphere_on_plane(
        0.3 * limit * omega * r, 2e-6, "rolling_friction = 0.02\nstiffness_ratio = 1\n", more);
    double before = s->grains.vel[0].x, first = 0.0, last = 0.0;
    double x = 0.0, peak[2] = {0.0, 0.0};
    int crossings = 0;
    for (int k = 1; k < 400000 && crossings < 4; k++) {
        step(s);
        const double v = s->grains.vel[0].x;
        x += v * 2e-6;
        if (before > 0.0 && v <= 0.0) { /* a maximum */
            const double at = (k - v / (v - before)) * 2e-6;
            if (crossings == 0) {
                first = at;
                peak[0] = x;
            }
            if (crossings == 3) {
                last = at;
                peak[1] = x;
            }
            crossings++;
        }
        before = v;
    }
    char *const text = xprintf("swing with eta = %g: period, s", eta);
    check_rel((last - first) / 3.0, 2.0 * PI / (omega * sqrt(1.0 - eta * eta)), 5e-3, text);
    xfree(text);
    check_abs(pow(peak[1] / peak[0], 1.0 / 3.0), exp(-2.0 * PI * eta / sqrt(1.0 - eta * eta)),
              5e-3, "ratio of successive maxima");
    sim_free(s);
    xfree(more);
}

int main(void)
{
    static const double angle[] = {4, 8, 15, 25, 35};
    for (int i = 0; i < 5; i++) {
        const double slope = tan(angle[i] * PI / 180.0);
        char *const material = xprintf("rolling_friction = %.17g\n", slope);
        check_incline(slope, material, "");
        xfree(material);
    }
    const struct stop s = roll_out(0.2, 0.4, "rolling_friction = 0.3\n", "");
    check_rel(s.distance, 0.2 * 0.2 / (2.0 * 2.10214286), 1e-2, "rolls to rest: distance, m");
    check(s.speed < 1e-9 && fabs(s.drift) < 1e-10, "and stays: speed %.2g m/s, drift %.2g m",
          s.speed, s.drift);
    check_swing(0.0);
    check_swing(0.05);
    return check_end();
}
