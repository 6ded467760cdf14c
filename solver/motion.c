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

#include <omp.h>
#include "contact_loop.h"
#include "contact_path.h"
#include "sim.h"
#include "turning.h"

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

/* What the kicks of a step need besides the state of a grain. */
struct kicks {
    double half;     /* s */
    double4 dt;      /* s, 0 behind */
    double4 gravity; /* m/s2 */
    bool loaded;     /* some grain bears a load */
};

/* Force and torque on a grain, or what they make of velocity and spin; 0 behind. */
struct wrench {
    double4 force, torque;
};

void motion_sense_loads(struct sim *s)
{
    const struct grains *const g = &s->grains;
    bool loaded = false;
#pragma omp parallel for schedule(static) reduction(|| : loaded)
    for (int i = 0; i < g->n; i++) {
        const vec3 f = g->load[i], t = g->load_torque[i];
        loaded = loaded || f.x != 0.0 || f.y != 0.0 || f.z != 0.0 || t.x != 0.0 || t.y != 0.0 ||
                 t.z != 0.0;
    }
    s->loaded = loaded;
}

static struct kicks kicks_of(const struct sim *s)
{
    const double dt = s->run.dt;
    const vec3 g = s->domain.gravity;
    return (struct kicks){.half = 0.5 * dt,
                          .dt = {dt, dt, dt, 0.0},
                          .gravity = {g.x, g.y, g.z, 0.0},
                          .loaded = s->loaded};
}

/* All forces on a grain but its weight. Clears the sums of its contacts for the next step. */
static inline struct wrench forces(const struct sim *s, const struct kicks *k,
                                   struct sums *of_grain, int i)
{
    const struct grains *const g = &s->grains;
    const double4 zero = {0.0};
    struct wrench sum = {.force = of_grain->force, .torque = of_grain->torque};
    of_grain->force = of_grain->torque = zero;
    if (k->loaded) {
        sum.force += (double4){g->load[i].x, g->load[i].y, g->load[i].z, 0.0};
        sum.torque +=
            (double4){g->load_torque[i].x, g->load_torque[i].y, g->load_torque[i].z, 0.0};
    }
    return sum;
}

/* What half a step makes of velocity and spin. */
static inline struct wrench kick_of(const struct kicks *k, const struct body *b,
                                    const struct body_rest *r, struct wrench f)
{
    return (struct wrench){.force = k->half * (k->gravity + body_per_mass(b, r) * f.force),
                           .torque = k->half * (body_per_inertia(b, r) * f.torque)};
}

/* Half a kick and the drift; writes the body. */
static inline void kick_drift(const struct frame *frame, const struct kicks *k, struct body *b,
                              struct body_rest *r, struct motion_state *m, struct wrench kick)
{
    m->vel += kick.force;
    m->spin += kick.torque;
    m->place += frame_way(frame, k->dt * m->vel);
    body_write(b, r, m, m->vel + kick.force);
}

/* The second half of a kick, the first of the next and the drift, by the forces at hand. */
static inline struct motion_state kicks_drift(const struct frame *frame, const struct kicks *k,
                                              struct body *b, struct body_rest *r,
                                              struct wrench f)
{
    struct motion_state m = body_state(b, r);
    const struct wrench kick = kick_of(k, b, r, f);
    m.vel += kick.force;
    m.spin += kick.torque;
    kick_drift(frame, k, b, r, &m, kick);
    return m;
}

/* The pace of grain i. */
static inline double pace_of(const struct sim *s, int i, const struct motion_state *m)
{
    const struct neighbours *const nb = &s->neighbours;
    return neighbours_pace(nb->drift, nb->pace[i], m->vel);
}

/* Runs of grains, shared out like those of the contact loop, so that a thread moves what it has
 * at hand. */
static int run_end(const struct sim *s, int run)
{
    return (run + 1) * s->neighbours.run < s->grains.n ? (run + 1) * s->neighbours.run
                                                       : s->grains.n;
}

/* The pace of those parts of a grain that move fastest by its spin. */
static inline double tip_pace(const struct sim *s, int i)
{
    const double4 w = body_wide(s->bodies[i].spin);
    return (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) * (w[3] * w[3]) *
           (double)s->neighbours.pace[i];
}

void motion_start(struct sim *s, int parity)
{
    const struct grains *const g = &s->grains;
    const struct turning *const turns = shape.path->turning;
    const struct kicks k = kicks_of(s);
    double fastest = 0.0, tip = 0.0;
#pragma omp for schedule(static) nowait
    for (int run = 0; run < (g->n + s->neighbours.run - 1) / s->neighbours.run; run++)
        for (int i = run * s->neighbours.run; i < run_end(s, run); i++) {
            if (g->inv_mass[i] == 0.0)
                continue;
            struct body *const b = &s->bodies[i];
            struct body_rest *const r = &s->rests[i];
            const vec3 f = g->force[i], t = g->torque[i], spin = g->spin[i];
            const struct wrench at_hand = {{f.x, f.y, f.z, 0.0}, {t.x, t.y, t.z, 0.0}};
            struct motion_state m = bodies_state(s, i);
            bodies_write(s, i, &m);
            kick_drift(&s->frame, &k, b, r, &m, kick_of(&k, b, r, at_hand));
            g->pos[i] = motion_pos(&s->frame, &m);
            const double pace = pace_of(s, i, &m);
            fastest = larger(fastest, pace);
            if (turns) {
                turns->start(s, i, spin, t);
                const double own = tip_pace(s, i);
                tip = larger(tip, own);
            }
        }
    neighbours_speed(s, parity, fastest, tip);
#pragma omp barrier
}

/* The sums of a run's contacts, gathered from all runs; the master's time for it is not motion's. */
static struct sums *gather(struct sim *s, int run)
{
    const bool master = omp_get_thread_num() == 0;
    const double since = master ? wall_clock() : 0.0;
    struct sums *const sums = contact_gather(s->contacts, &s->neighbours, run);
    if (master) {
        const double took = wall_clock() - since;
        s->timers.seconds[TIME_GATHER] += took;
        s->timers.seconds[TIME_MOTION] -= took;
    }
    return sums;
}

/* Through memory that the compiler does not look into, see sums_part. */
static vec3 narrow(double4 x)
{
    volatile double a[3];
    for (int k = 0; k < 3; k++)
        a[k] = x[k];
    return v3(a[0], a[1], a[2]);
}

static void end_steps(struct sim *s)
{
    struct grains *const g = &s->grains;
    const struct kicks k = kicks_of(s);
#pragma omp for schedule(static) nowait
    for (int run = 0; run < s->neighbours.runs; run++) {
        struct sums *const sums = gather(s, run);
        for (int i = run * s->neighbours.run; i < run_end(s, run); i++) {
            const struct wrench f = forces(s, &k, &sums[i - run * s->neighbours.run], i);
            struct motion_state m = body_state(&s->bodies[i], &s->rests[i]);
            g->force[i] = narrow(f.force);
            g->torque[i] = narrow(f.torque);
            if (g->inv_mass[i] == 0.0)
                continue;
            const struct wrench kick = kick_of(&k, &s->bodies[i], &s->rests[i], f);
            m.vel += kick.force;
            m.spin += kick.torque;
            g->pos[i] = motion_pos(&s->frame, &m);
            g->vel[i] = motion_vel(&m);
            g->spin[i] = motion_spin(&m);
            if (shape.path->turning)
                shape.path->turning->end(s, i, g->torque[i]);
        }
    }
}

/* Kicks and drifts a run whose sums are gathered; its largest pace. `places`: someone
 * asks where the grains are before the steps end. */
static inline __attribute__((always_inline)) double
turn_run(struct sim *s, const struct kicks *k, int run, struct sums *sums, bool places)
{
    const struct frame frame = s->frame;
    struct body *const restrict bodies = &s->bodies[run * s->neighbours.run];
    struct body_rest *const restrict rests = &s->rests[run * s->neighbours.run];
    vec3 *const restrict pos = &s->grains.pos[run * s->neighbours.run];
    const float *const restrict paces = &s->neighbours.pace[run * s->neighbours.run];
    const double4 drift = s->neighbours.drift;
    const int n = run_end(s, run) - run * s->neighbours.run;
    double fastest = 0.0;
    for (int i = 0; i < n; i++) {
        struct body *const b = &bodies[i];
        struct body_rest *const r = &rests[i];
        const struct wrench f = forces(s, k, &sums[i], run * s->neighbours.run + i);
        if (b->vel[3] == (real)0.0)
            continue;
        const struct motion_state m = kicks_drift(&frame, k, b, r, f);
        if (places)
            pos[i] = motion_pos(&frame, &m);
        const double pace = neighbours_pace(drift, paces[i], m.vel);
        fastest = larger(fastest, pace);
    }
    return fastest;
}

/* The same of grains that have an orientation; tip: the largest pace of a part by spin. */
static double turn_bodies(struct sim *s, const struct kicks *k, int run, struct sums *sums,
                          double *tip)
{
    double fastest = 0.0;
    for (int i = run * s->neighbours.run; i < run_end(s, run); i++) {
        struct body *const b = &s->bodies[i];
        struct body_rest *const r = &s->rests[i];
        const struct wrench f = forces(s, k, &sums[i - run * s->neighbours.run], i);
        if (b->vel[3] == (real)0.0)
            continue;
        const struct motion_state m = kicks_drift(&s->frame, k, b, r, f);
        s->grains.pos[i] = motion_pos(&s->frame, &m);
        const double pace = pace_of(s, i, &m);
        fastest = larger(fastest, pace);
        shape.path->turning->turn(s, i, narrow(f.torque));
        const double own = tip_pace(s, i);
        *tip = larger(*tip, own);
    }
    return fastest;
}

void motion_turn(struct sim *s, bool last, int parity)
{
    const struct kicks k = kicks_of(s);
    double fastest = 0.0, tip = 0.0;
    if (last) {
        end_steps(s);
        return;
    }
#pragma omp for schedule(static) nowait
    for (int run = 0; run < s->neighbours.runs; run++) {
        struct sums *const sums = gather(s, run);
        const double pace = shape.path->turning           ? turn_bodies(s, &k, run, sums, &tip)
                            : contact_asks_places(s, run) ? turn_run(s, &k, run, sums, true)
                                                          : turn_run(s, &k, run, sums, false);
        fastest = larger(fastest, pace);
    }
    neighbours_speed(s, parity, fastest, tip);
#pragma omp barrier
}

void motion_places(struct sim *s)
{
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++)
        if (s->grains.inv_mass[i] != 0.0) {
            const struct motion_state m = body_state(&s->bodies[i], &s->rests[i]);
            s->grains.pos[i] = motion_pos(&s->frame, &m);
        }
}

void motion_forces(struct sim *s)
{
    const struct kicks k = kicks_of(s);
#pragma omp for schedule(static)
    for (int run = 0; run < s->neighbours.runs; run++) {
        struct sums *const sums = contact_gather(s->contacts, &s->neighbours, run);
        for (int i = run * s->neighbours.run; i < run_end(s, run); i++) {
            const struct wrench f = forces(s, &k, &sums[i - run * s->neighbours.run], i);
            s->grains.force[i] = narrow(f.force);
            s->grains.torque[i] = narrow(f.torque);
        }
    }
}

void motion_guard(const struct sim *s)
{
    if (!isfinite(s->neighbours.moved) && s->neighbours.builds > 0)
        die_lost(s);
}
