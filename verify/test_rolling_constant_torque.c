/* verify/test_rolling_constant_torque.c - the torque of constant size in runs: a sphere rolls from the
 * slope mu_r on, and slows down on the level as it should, but what rolls to a stop is kicked to and
 * fro by the torque of each step for ever. */
/* slots: contact/linear contact/rolling/constant_torque */
#include "rolling_runs.h"

/* A sphere or a disc (its inertia) of 10 mm on the level: time until it has lost half of its velocity. */
static void check_level(void)
{
    const struct csv *const t = csv_read("rolling_sphere.csv");
    for (int i = 0; i < t->n; i++) {
        const bool disc = strcmp(csv_text(t, i, "shape"), "disc") == 0;
        const double v = csv_value(t, i, "v0_m_s"), a = csv_value(t, i, "decel_m_s2");
        if (v / a > 3.0)
            continue; /* the same law over more steps */
        char *const material = xprintf("rolling_friction = %.17g\n", csv_value(t, i, "mu_r"));
        struct sim *const s = sphere_on_plane(v, 2e-5, material, "");
        if (disc)
            s->grains.inv_inertia[0] *= 0.8; /* m r^2/2 for 2/5 m r^2 */
        gain(s, 0.3 * v / a);
        const double lost = -gain(s, 0.3 * v / a);
        char *const what = xprintf("%s, %g m/s, mu_r = %s: deceleration, m/s2",
                                   disc ? "disc" : "sphere", v, csv_text(t, i, "mu_r"));
        const double steps = rint(0.3 * v / a / s->run.dt);
        check_rel(lost / (steps * s->run.dt), a, 2e-3, what);
        xfree(what);
        xfree(material);
        sim_free(s);
    }
}

int main(void)
{
    check_level();
    static const double angle[] = {4, 13, 24, 35};
    for (int i = 0; i < 4; i++) {
        const double slope = tan(angle[i] * PI / 180.0);
        char *const material = xprintf("rolling_friction = %.17g\n", slope);
        check_incline(slope, material, "");
        xfree(material);
    }
    const struct stop s = roll_out(0.2, 0.4, "rolling_friction = 0.3\n", "");
    check_rel(s.distance, 0.2 * 0.2 / (2.0 * 2.10214286), 5e-3, "rolls to a stop: distance, m");
    check(s.speed > 1e-7, "and does not come to rest: speed %.2g m/s", s.speed);
    return check_end();
}
