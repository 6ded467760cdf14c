/* verify/test_rolling_epsd.c - the elastic-plastic spring against rolling in runs: a sphere rolls from
 * the slope mu_r on, at every slope rests, rolls or slips as a rigid body does, comes to rest after
 * v^2/(2 a) and stays, swings with the period and decay of a damped spring. */
/* slots: contact/linear contact/rolling/epsd */
#include "rolling_runs.h"

static char *material_of(double mu_r)
{
    return xprintf("rolling_friction = %.17g\n", mu_r);
}

/* Free swing about the contact, one row of the table: k_r through the factor q, the springs of the
 * contact 400 times stiffer. The first maximum and the third after it, of strong damping the next. */
static void check_swing(const struct csv *t, int row)
{
    const double eta = csv_value(t, row, "eta_r"), kr = csv_value(t, row, "k_r_Nm_per_rad");
    const double omega = csv_value(t, row, "omega0_rad_s"),
                 period = csv_value(t, row, "period_s");
    const double r = 0.01, kn = 400.0 * kr / (r * r), mu = 0.1, dt = period / 6000.0;
    const int n = eta > 0.5 ? 1 : 3;
    char *const more = xprintf("[rolling]\ndamping = %g\nstiffness_factor = %.17g\n", eta,
                               kr / (kn * mu * mu * r * r));
    char *const material =
        xprintf("friction = 0.9\nrolling_friction = %g\nstiffness_ratio = 1\n", mu);
    struct sim *const s =
        sphere_with((struct ball){r, 2500.0, kn},
                    0.3 * csv_value(t, row, "theta_m_rad") * omega * r, dt, material, more);
    double before = s->grains.vel[0].x, first = 0.0, last = 0.0, x = 0.0, peak[2] = {0.0, 0.0};
    int maxima = 0;
    for (int k = 1; k < 400000 && maxima <= n; k++) {
        step(s);
        const double v = s->grains.vel[0].x, end = x + v * dt;
        if (before > 0.0 && v <= 0.0) {
            const double at = (k - v / (v - before)) * dt;
            *(maxima == 0 ? &first : &last) = at;
            peak[maxima > 0] = x;
            maxima++;
        }
        x = end;
        before = v;
    }
    char *const text = xprintf("swing, k_r = %g N m, eta = %g: period, s", kr, eta);
    check_rel((last - first) / n, period, 5e-3, text);
    check_abs(pow(peak[1] / peak[0], 1.0 / n), csv_value(t, row, "ratio_successive_maxima"),
              5e-3, "  ratio of successive maxima");
    xfree(text);
    sim_free(s);
    xfree(more);
    xfree(material);
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
    check_slopes(material_of, "[rolling]\nplastic_damping = 0\n");
    const struct stop s = roll_out(0.2, 0.4, "rolling_friction = 0.3\n", "");
    check_rel(s.distance, 0.2 * 0.2 / (2.0 * 2.10214286), 1e-2, "rolls to rest: distance, m");
    check(s.speed < 1e-9 && fabs(s.drift) < 1e-10, "and stays: speed %.2g m/s, drift %.2g m",
          s.speed, s.drift);
    const struct csv *const t = csv_read("epsd_oscillation.csv");
    for (int i = 0; i < t->n; i++)
        check_swing(t, i);
    return check_end();
}
