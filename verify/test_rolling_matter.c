/* verify/test_rolling_matter.c - rolling and torsion springs of constant stiffness, in runs: a sphere
 * rolls from the slope mu_r on; with dashpots it comes to rest and stays, without them, as published,
 * it swings on. */
/* slots: contact/linear contact/rolling/matter */
#include "rolling_runs.h"

#define SPRINGS                                                                                \
    "torsion_friction = 0.1\nrolling_stiffness = 0.01 N m\ntorsion_stiffness = 0.01 N m\n"
#define DAMPED "[rolling]\ndamping = 0.3\n"

int main(void)
{
    static const double angle[] = {4, 13, 24, 35};
    for (int i = 0; i < 4; i++) {
        const double slope = tan(angle[i] * PI / 180.0);
        char *const material = xprintf("rolling_friction = %.17g\n" SPRINGS, slope);
        check_incline(slope, material, DAMPED);
        xfree(material);
    }
    struct stop s = roll_out(0.2, 0.4, "rolling_friction = 0.3\n" SPRINGS, DAMPED);
    check_rel(s.distance, 0.2 * 0.2 / (2.0 * 2.10214286), 1e-2, "rolls to rest: distance, m");
    check(s.speed < 1e-9 && fabs(s.drift) < 1e-10, "and stays: speed %.2g m/s, drift %.2g m",
          s.speed, s.drift);
    s = roll_out(0.2, 0.4, "rolling_friction = 0.3\n" SPRINGS, "");
    check(s.speed > 1e-6, "as published it swings on: speed %.2g m/s", s.speed);
    return check_end();
}
