/* motion.c - velocity Verlet [Swope82]:
 *   v(t + dt/2) = v(t) + a(t) dt/2,  x(t + dt) = x(t) + v(t + dt/2) dt,
 *   v(t + dt)   = v(t + dt/2) + a(t + dt) dt/2.
 * Springs see the velocity of the half step, which keeps their energy; dashpots see v(t) + a(t)
 * dt, which keeps them second order. Spins likewise (the inertia of every grain here is a
 * number).
 *
 * The second kick of a step and the first of the next go together in one pass over the grains,
 * with the gathering of the forces: the pass reads and writes each grain once a step. */
#include "motion.h"

#include "contact_loop.h"
#include "sim.h"

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

/* All forces on a grain but its weight. */
static struct sums forces(const struct sim *s, int i)
{
    const struct grains *const g = &s->grains;
    struct sums sum = contact_sums(s->contacts, &s->neighbours, i);
    sum.force += (double4){g->load[i].x, g->load[i].y, g->load[i].z, 0.0};
    sum.torque += (double4){g->load_torque[i].x, g->load_torque[i].y, g->load_torque[i].z, 0.0};
    return sum;
}

static inline vec3 acceleration(const struct sim *s, int i, vec3 force)
{
    return v3_axpy(s->domain.gravity, s->grains.inv_mass[i], force);
}

static inline void kick(struct sim *s, int i, vec3 a, vec3 torque)
{
    struct grains *const g = &s->grains;
    const double half = 0.5 * s->run.dt;
    g->vel[i] = v3_axpy(g->vel[i], half, a);
    g->spin[i] = v3_axpy(g->spin[i], half * g->inv_inertia[i], torque);
}

/* Returns the square of the speed. */
static inline double kick_drift(struct sim *s, int i, vec3 a, vec3 torque)
{
    struct grains *const g = &s->grains;
    struct body *const b = &s->bodies[i];
    kick(s, i, a, torque);
    g->pos[i] = v3_axpy(g->pos[i], s->run.dt, g->vel[i]);
    const vec3 v = g->vel[i], w = g->spin[i], full = v3_axpy(v, 0.5 * s->run.dt, a);
    b->place = frame_place(&s->frame, g->pos[i]);
    b->vel = (real4){(real)v.x, (real)v.y, (real)v.z, (real)g->inv_mass[i]};
    b->full = (real4){(real)full.x, (real)full.y, (real)full.z, (real)grain_material(g, i)};
    b->spin = (real4){(real)w.x, (real)w.y, (real)w.z, (real)g->radius[i]};
    return v3_dot(v, v);
}

static void set_forces(struct grains *g, int i, struct sums sum)
{
    g->force[i] = v3(sum.force[0], sum.force[1], sum.force[2]);
    g->torque[i] = v3(sum.torque[0], sum.torque[1], sum.torque[2]);
}

/* Runs of grains, shared out like those of the contact loop, so that a thread moves what it has
 * at hand. */
static int run_end(const struct sim *s, int run)
{
    return (run + 1) * RUN < s->grains.n ? (run + 1) * RUN : s->grains.n;
}

void motion_start(struct sim *s, int parity)
{
    const struct grains *const g = &s->grains;
    double fastest = 0.0;
#pragma omp for schedule(static) nowait
    for (int run = 0; run < (g->n + RUN - 1) / RUN; run++)
        for (int i = run * RUN; i < run_end(s, run); i++) {
            if (g->inv_mass[i] == 0.0)
                continue;
            const double square =
                kick_drift(s, i, acceleration(s, i, g->force[i]), g->torque[i]);
            fastest = square <= fastest ? fastest : square; /* not a number counts as fast */
        }
    neighbours_speed(s, parity, fastest);
#pragma omp barrier
}

static void end_steps(struct sim *s)
{
    struct grains *const g = &s->grains;
#pragma omp for schedule(static) nowait
    for (int run = 0; run < s->neighbours.runs; run++)
        for (int i = run * RUN; i < run_end(s, run); i++) {
            set_forces(g, i, forces(s, i));
            if (g->inv_mass[i] != 0.0)
                kick(s, i, acceleration(s, i, g->force[i]), g->torque[i]);
        }
}

void motion_turn(struct sim *s, bool last, int parity)
{
    struct grains *const g = &s->grains;
    double fastest = 0.0;
    if (last) {
        end_steps(s);
        return;
    }
#pragma omp for schedule(static) nowait
    for (int run = 0; run < s->neighbours.runs; run++)
        for (int i = run * RUN; i < run_end(s, run); i++) {
            if (g->inv_mass[i] == 0.0)
                continue;
            const struct sums sum = forces(s, i);
            const vec3 force = v3(sum.force[0], sum.force[1], sum.force[2]);
            const vec3 torque = v3(sum.torque[0], sum.torque[1], sum.torque[2]);
            const vec3 a = acceleration(s, i, force);
            kick(s, i, a, torque);
            const double square = kick_drift(s, i, a, torque);
            fastest = square <= fastest ? fastest : square;
        }
    neighbours_speed(s, parity, fastest);
#pragma omp barrier
}

void motion_forces(struct sim *s)
{
#pragma omp for schedule(static)
    for (int run = 0; run < s->neighbours.runs; run++)
        for (int i = run * RUN; i < run_end(s, run); i++)
            set_forces(&s->grains, i, forces(s, i));
}

void motion_guard(const struct sim *s)
{
    if (!isfinite(s->neighbours.moved) && s->neighbours.builds > 0)
        die_lost(s);
}
