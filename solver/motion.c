/* motion.c - velocity Verlet [Swope82]:
 *   v(t + dt/2) = v(t) + a(t) dt/2,  x(t + dt) = x(t) + v(t + dt/2) dt,
 *   v(t + dt)   = v(t + dt/2) + a(t + dt) dt/2.
 * Springs see the velocity of the half step, which keeps their energy; dashpots see v(t) + a(t)
 * dt, which keeps them second order. Spins likewise (the inertia of every grain here is a
 * number). */
#include "motion.h"

#include "sim.h"

/* a = F/m + g, for a grain that moves */
static vec3 acceleration(const struct sim *s, int i)
{
    return v3_axpy(s->domain.gravity, s->grains.inv_mass[i], s->grains.force[i]);
}

static void die_lost(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    for (int i = 0; i < g->n; i++) {
        const vec3 x = g->pos[i];
        if (isfinite(x.x + x.y + x.z))
            continue;
        die(EXIT_UNSTABLE,
            "the position of grain %d is not finite at t = %.9g s (velocity %g %g %g m/s, "
            "force %g "
            "%g %g N); take a shorter run.dt",
            g->id[i], s->t, g->vel[i].x, g->vel[i].y, g->vel[i].z, g->force[i].x, g->force[i].y,
            g->force[i].z);
    }
}

void motion_kick_drift(struct sim *s)
{
    struct grains *const g = &s->grains;
    const double dt = s->run.dt, half = 0.5 * dt;
    const vec3 *const built = s->neighbours.pos_built;
    double farthest = 0.0;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < g->n; i++) {
        if (g->inv_mass[i] == 0.0)
            continue;
        const vec3 a = acceleration(s, i);
        g->vel[i] = v3_axpy(g->vel[i], half, a);
        g->vel_full[i] = v3_axpy(g->vel[i], half, a);
        g->spin[i] = v3_axpy(g->spin[i], half * g->inv_inertia[i], g->torque[i]);
        g->pos[i] = v3_axpy(g->pos[i], dt, g->vel[i]);
        const vec3 moved = v3_sub(g->pos[i], built[i]);
        const double square = v3_dot(moved, moved);
        farthest = square <= farthest ? farthest : square; /* not a number counts as far */
    }
    neighbours_moved(s, sqrt(farthest));
#pragma omp barrier
}

void motion_guard(const struct sim *s)
{
    if (!isfinite(s->neighbours.moved) && s->neighbours.builds > 0)
        die_lost(s);
}

void motion_kick(struct sim *s)
{
    struct grains *const g = &s->grains;
    const double half = 0.5 * s->run.dt;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < g->n; i++) {
        if (g->inv_mass[i] == 0.0)
            continue;
        g->vel[i] = v3_axpy(g->vel[i], half, acceleration(s, i));
        g->spin[i] = v3_axpy(g->spin[i], half * g->inv_inertia[i], g->torque[i]);
    }
}
