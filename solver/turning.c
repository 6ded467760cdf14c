/* turning.c - see turning.h. */
#include "turning.h"

#include <stdlib.h>
#include <string.h>
#include "attitude.h"
#include "sim.h"

static const struct key keys[] = {
    {"grains", "orientation", KEY_TEXT, "", "", "random",
     "at the start: random, aligned, or w x y z, the quaternion that turns the axes in which "
     "the "
     "shape is described to those of the box"},
    {0},
};

static void read(struct grains *g, struct scene *scene)
{
    for (int k = 0; k < g->n_species; k++) {
        struct species *const sp = &g->species[k];
        const char *const text = scene_text(scene, "grains", sp->name, "orientation");
        double q[4] = {1.0, 0.0, 0.0, 0.0};
        char rest;
        sp->orientation = quat_one();
        sp->turned = strcmp(text, "random") != 0;
        sp->orientation = quat_one();
        if (!sp->turned || strcmp(text, "aligned") == 0)
            continue;
        const bool four =
            sscanf(text, "%lf %lf %lf %lf %c", &q[0], &q[1], &q[2], &q[3], &rest) == 4;
        const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        if (!four || !isfinite(square) || !(square > 0.0)) {
            scene_error(scene, "grains", sp->name, "orientation",
                        "must be random, aligned or the four numbers of a quaternion, w x y z");
            q[0] = 1.0;
            q[1] = q[2] = q[3] = 0.0;
        }
        sp->orientation = quat_unit((struct quat){q[0], q[1], q[2], q[3]});
    }
}

/* [0, 1), from a seed and a counter [Steele14, SplitMix64]. */
static double uniform(unsigned long seed, unsigned long k)
{
    uint64_t z = seed * 0x9e3779b97f4a7c15u + k * 0xd1b54a32d192ed03u + 0x632be59bd9b4e019u;
    for (int round = 0; round < 2; round++) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
    }
    return (double)(z >> 11) * 0x1p-53;
}

static void place(struct grains *g, int i, unsigned long seed)
{
    const struct species *const sp = &g->species[g->kind[i]];
    const unsigned long k = 3 * (unsigned long)g->id[i];
    const double u[3] = {uniform(seed, k), uniform(seed, k + 1), uniform(seed, k + 2)};
    const struct quat described = sp->turned ? sp->orientation : quat_random(u);
    g->orientation[i] = quat_mul(described, sp->form.axes);
}

static bool round_body(const struct grains *g, int i)
{
    const vec3 j = g->inertia[i];
    return j.x == j.y && j.y == j.z;
}

/* The spin is the motion's. */
static void turn_round(struct sim *s, int i, vec3 torque)
{
    struct grains *const g = &s->grains;
    const double dt = s->run.dt, kick = 0.5 * dt * g->inv_inertia[i];
    const struct motion_state state = body_state(&s->bodies[i], &s->rests[i]);
    const vec3 spin = motion_spin(&state);
    const vec3 half = v3_scale(0.5 * dt, spin);
    g->full_spin[i] = v3_axpy(spin, kick, torque);
    g->orientation[i] =
        quat_unit(quat_mul((struct quat){1.0, half.x, half.y, half.z}, g->orientation[i]));
    if (s->attitudes)
        attitude_write(&s->attitudes[i], g->orientation[i], g->full_spin[i]);
}

/* Turns freely with the angular momentum at hand; writes the spins. */
static void drift(struct sim *s, int i, vec3 torque)
{
    struct grains *const g = &s->grains;
    const double dt = s->run.dt;
    const vec3 inertia = g->inertia[i];
    const struct rotated r = rotation_free(g->orientation[i], g->momentum[i], inertia, dt);
    const struct mat3 m = quat_matrix(r.q);
    g->orientation[i] = r.q;
    g->full_spin[i] = rotation_spin(&m, v3_axpy(g->momentum[i], 0.5 * dt, torque), inertia);
    body_set_spin(&s->bodies[i], &s->rests[i], r.spin);
    if (s->attitudes)
        attitude_write(&s->attitudes[i], r.q, g->full_spin[i]);
}

static void start(struct sim *s, int i, vec3 spin, vec3 torque)
{
    struct grains *const g = &s->grains;
    if (round_body(g, i)) {
        turn_round(s, i, torque);
        return;
    }
    /* the momentum at hand, if it is that of the spin: a run that is cut in two keeps its bits */
    const struct mat3 m = quat_matrix(g->orientation[i]);
    const vec3 same = rotation_spin(&m, g->momentum[i], g->inertia[i]);
    if (same.x != spin.x || same.y != spin.y || same.z != spin.z)
        g->momentum[i] = rotation_momentum(&m, spin, g->inertia[i]);
    g->momentum[i] = v3_axpy(g->momentum[i], 0.5 * s->run.dt, torque);
    drift(s, i, torque);
}

static void turn(struct sim *s, int i, vec3 torque)
{
    struct grains *const g = &s->grains;
    if (round_body(g, i)) {
        turn_round(s, i, torque);
        return;
    }
    const double half = 0.5 * s->run.dt; /* twice, as `end` and `start` do */
    g->momentum[i] = v3_axpy(v3_axpy(g->momentum[i], half, torque), half, torque);
    drift(s, i, torque);
}

static void end(struct sim *s, int i, vec3 torque)
{
    struct grains *const g = &s->grains;
    if (round_body(g, i))
        return;
    const struct mat3 m = quat_matrix(g->orientation[i]);
    g->momentum[i] = v3_axpy(g->momentum[i], 0.5 * s->run.dt, torque);
    g->spin[i] = rotation_spin(&m, g->momentum[i], g->inertia[i]);
}

const struct turning turning = {
    .keys = keys, .read = read, .place = place, .start = start, .turn = turn, .end = end};
