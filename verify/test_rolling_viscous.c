/* verify/test_rolling_viscous.c - the torque proportional to the rolling velocity, in runs: on the
 * level the velocity falls as exp(-t/tau), tau = 1.4 m R^2/(mu_r R F_n R), on a slope a sphere rolls
 * at once, up to the velocity at which the torque holds the weight. */
/* slots: contact/linear contact/rolling/viscous */
#include "rolling_runs.h"

int main(void)
{
    const double mu = 0.83, r = 5e-3, tau = 1.4 * r / (mu * 9.81 * r);
    struct sim *s = sphere_on_plane(0.2, 1e-5, "rolling_viscosity = 0.83 s/m\n", "");
    for (int k = 0; k < 20000; k++)
        step(s);
    check_rel(s->grains.vel[0].x, 0.2 * exp(-0.2 / tau), 5e-3,
              "level: velocity after 0.2 s, m/s");
    sim_free(s);
    s = sphere_on_plane(0.0, 1e-5, "rolling_viscosity = 0.83 s/m\n", "");
    tilt(s, 0.1);
    for (int k = 0; k < 150000; k++)
        step(s);
    check_rel(s->grains.vel[0].x, tan(0.1) / mu, 5e-3, "slope of 0.1: final velocity, m/s");
    sim_free(s);
    return check_end();
}
