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
    double4 dt;      /* s, 0 behind the position */
    double8 gravity; /* m/s2, 0 but for the velocity */
    bool loaded;     /* some grain bears a load */
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
                          .gravity = {g.x, g.y, g.z, 0.0, 0.0, 0.0, 0.0, 0.0},
                          .loaded = s->loaded};
}

/* All forces on a grain but its weight; torque behind. */
static inline double8 forces(const struct sim *s, const struct kicks *k, int i)
{
    const struct grains *const g = &s->grains;
    double8 sum = contact_take_sums(s->contacts, &s->neighbours, i).both;
    if (k->loaded)
        sum += (double8){g->load[i].x,        g->load[i].y,        g->load[i].z,        0.0,
                         g->load_torque[i].x, g->load_torque[i].y, g->load_torque[i].z, 0.0};
    return sum;
}

/* Accelerations of grain i, linear and angular; 0 behind each. */
static inline double8 rates(const struct sim *s, const struct kicks *k, int i, double8 forces)
{
    const double m = s->grains.inv_mass[i], j = s->grains.inv_inertia[i];
    return k->gravity + (double8){m, m, m, 0.0, j, j, j, 0.0} * forces;
}

static inline struct motion_state state_of(const struct grains *g, int i)
{
    const vec3 x = g->pos[i], v = g->vel[i], w = g->spin[i];
    return (struct motion_state){
        .pos = {x.x, x.y, x.z, 0.0},
        .vel_spin = {v.x, v.y, v.z, g->inv_mass[i], w.x, w.y, w.z, g->radius[i]}};
}

/* Half a kick and the drift; writes body and position. Returns the grain's pace. */
static inline double kick_drift(struct sim *s, const struct kicks *k, int i,
                                struct motion_state m, double8 rate)
{
    struct grains *const g = &s->grains;
    m.vel_spin += k->half * rate;
    const double8 full = m.vel_spin + k->half * rate;
    const double4 v = {m.vel_spin[0], m.vel_spin[1], m.vel_spin[2], 0.0};
    m.pos += k->dt * v;
    g->pos[i] = motion_pos(&m);
    if (BODY_IS_FLOAT) {
        g->vel[i] = motion_vel(&m);
        g->spin[i] = motion_spin(&m);
    }
    const double material = (double)s->bodies[i].full[3];
    body_write(&s->bodies[i], &s->frame, &m, (double4){full[0], full[1], full[2], material});
    return neighbours_pace(&s->neighbours, i, v);
}

/* Runs of grains, shared out like those of the contact loop, so that a thread moves what it has
 * at hand. */
static int run_end(const struct sim *s, int run)
{
    return (run + 1) * RUN < s->grains.n ? (run + 1) * RUN : s->grains.n;
}

/* The pace of those parts of a grain that move fastest by its spin. */
static inline double tip_pace(const struct sim *s, int i)
{
    const struct body *const b = &s->bodies[i];
    const double4 w = __builtin_convertvector(b->spin, double4);
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
    for (int run = 0; run < (g->n + RUN - 1) / RUN; run++)
        for (int i = run * RUN; i < run_end(s, run); i++) {
            if (g->inv_mass[i] == 0.0)
                continue;
            const vec3 f = g->force[i], t = g->torque[i], spin = g->spin[i];
            const double8 at_hand = {f.x, f.y, f.z, 0.0, t.x, t.y, t.z, 0.0};
            s->bodies[i].full[3] = (real)grain_material(g, i);
            const double square =
                kick_drift(s, &k, i, state_of(g, i), rates(s, &k, i, at_hand));
            fastest = square <= fastest ? fastest : square; /* not a number counts as fast */
            if (turns) {
                turns->start(s, i, spin, t);
                const double own = tip_pace(s, i);
                tip = own <= tip ? tip : own;
            }
        }
    neighbours_speed(s, parity, fastest, tip);
#pragma omp barrier
}

/* Through memory that the compiler does not look into, see sums_part. */
static vec3 torque_of(double8 f)
{
    volatile double a[3];
    for (int k = 0; k < 3; k++)
        a[k] = f[4 + k];
    return v3(a[0], a[1], a[2]);
}

static void set_forces(struct grains *g, int i, double8 f)
{
    g->force[i] = v3(f[0], f[1], f[2]);
    g->torque[i] = v3(f[4], f[5], f[6]);
}

static void end_steps(struct sim *s)
{
    struct grains *const g = &s->grains;
    const struct kicks k = kicks_of(s);
#pragma omp for schedule(static) nowait
    for (int run = 0; run < s->neighbours.runs; run++)
        for (int i = run * RUN; i < run_end(s, run); i++) {
            const double8 f = forces(s, &k, i);
            set_forces(g, i, f);
            if (g->inv_mass[i] == 0.0)
                continue;
            struct motion_state m =
                body_state(&s->bodies[i], &g->pos[i], &g->vel[i], &g->spin[i]);
            m.vel_spin += k.half * rates(s, &k, i, f);
            g->vel[i] = motion_vel(&m);
            g->spin[i] = motion_spin(&m);
            if (shape.path->turning)
                shape.path->turning->end(s, i, g->torque[i]);
        }
}

void motion_turn(struct sim *s, bool last, int parity)
{
    struct grains *const g = &s->grains;
    const struct turning *const turns = shape.path->turning;
    const struct kicks k = kicks_of(s);
    double fastest = 0.0, tip = 0.0;
    if (last) {
        end_steps(s);
        return;
    }
#pragma omp for schedule(static) nowait
    for (int run = 0; run < s->neighbours.runs; run++)
        for (int i = run * RUN; i < run_end(s, run); i++) {
            const double8 f = forces(s, &k, i), rate = rates(s, &k, i, f);
            if (g->inv_mass[i] == 0.0)
                continue;
            struct motion_state m =
                body_state(&s->bodies[i], &g->pos[i], &g->vel[i], &g->spin[i]);
            m.vel_spin += k.half * rate;
            const double square = kick_drift(s, &k, i, m, rate);
            fastest = square <= fastest ? fastest : square;
            if (turns) {
                turns->turn(s, i, torque_of(f));
                const double own = tip_pace(s, i);
                tip = own <= tip ? tip : own;
            }
        }
    neighbours_speed(s, parity, fastest, tip);
#pragma omp barrier
}

void motion_forces(struct sim *s)
{
    const struct kicks k = kicks_of(s);
#pragma omp for schedule(static)
    for (int run = 0; run < s->neighbours.runs; run++)
        for (int i = run * RUN; i < run_end(s, run); i++)
            set_forces(&s->grains, i, forces(s, &k, i));
}

void motion_guard(const struct sim *s)
{
    if (!isfinite(s->neighbours.moved) && s->neighbours.builds > 0)
        die_lost(s);
}
