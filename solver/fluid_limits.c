/* fluid_limits.c - what bounds the fluid's step, from the scene alone; apart from the fluid, so that dry
 * binaries, whose feasibility asks too, need not hold one. */
#include "fluid_state.h"

double fluid_expected_velocity(const struct sim *s)
{
    double most = fmax(flow_most(&s->flow), v3_norm(s->flow.held_rate));
    for (int side = 0; side < 6; side++) {
        most = fmax(most, course_most(&s->domain.side[side].inflow));
        most = fmax(most, v3_norm(s->domain.side[side].velocity));
    }
    if (s->flow.profile == PROFILE_PARABOLIC)
        most *= 2.25; /* two pairs of walls */
    return most / (s->grains.n + s->traffic.n_sources > 0 ? 0.4 : 1.0);
}

double fluid_courant_limit(const struct sim *s)
{
    const double *const h = s->grid.h, u = fluid_expected_velocity(s);
    return u > 0.0 ? COURANT_MOST * fmin(h[0], fmin(h[1], h[2])) / u : (double)INFINITY;
}

double fluid_viscous_limit(const struct sim *s)
{
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        sum += s->grid.n[a] > 1 ? 1.0 / (s->grid.h[a] * s->grid.h[a]) : 0.0;
    sum *= 4.0 * s->fluid.mu / s->fluid.rho;
    return sum > 0.0 ? 1.0 / sum : (double)INFINITY;
}
