/* verify/test_rolling_constant_torque.c - the torque of constant size in runs: a sphere rolls from the
 * slope mu_r on, and slows down on the level as it should, but what rolls to a stop is kicked to and
 * fro by the torque of each step for ever. */
/* slots: contact/linear contact/rolling/constant_torque */
#include "rolling_runs.h"

int main(void)
{
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
