/* body.h - a grain as the contact loop reads it: 16 numbers on two cache lines (one in float),
 * written by the motion at each step from the state of the grains, which stays in double.
 *
 * In a float build the place is a fixed-point number, 2^32 steps over the box (over twice the
 * box along a direction with sides): the difference of two places is then exact and its nearest
 * image comes by itself, where the difference of two floats would lose the overlap. */
#ifndef BODY_H
#define BODY_H

#include "domain.h"
#include "real.h"

struct sim;

#ifdef SILT_FLOAT
typedef int32_t coordinate; /* steps */
#else
typedef double coordinate; /* m */
#endif

typedef coordinate coordinate4 __attribute__((vector_size(4 * sizeof(coordinate))));
typedef real real4 __attribute__((vector_size(4 * sizeof(real))));
typedef real real8 __attribute__((vector_size(8 * sizeof(real))));
typedef double double4 __attribute__((vector_size(4 * sizeof(double))));
typedef double double8 __attribute__((vector_size(8 * sizeof(double))));

struct body {
    coordinate4 place; /* x y z, and nothing */
    real4 full;        /* m/s predicted for the full step; index of the material */
    real4 vel;         /* m/s at the half step; 1/mass, 0 if frozen */
    real4 spin;        /* rad/s at the half step; bounding radius, m */
};

/* Position, and velocity and spin with what stands behind them in a body. */
struct motion_state {
    double4 pos;
    double8 vel_spin;
};

/* How places are written and their differences read back, from the box. */
struct frame {
    double4 origin, per_metre;   /* float: place = (x - origin) per_metre */
    real scale[3];               /* m per step of a difference; 1 in double */
    real image[3], inv_image[3]; /* nearest image of a difference; 0 where not needed */
};

void frame_of(struct frame *f, const struct domain *d);

/* The place at x y z and 0. */
static inline coordinate4 frame_place(const struct frame *f, double4 x)
{
#ifdef SILT_FLOAT
    typedef int64_t long4 __attribute__((vector_size(4 * sizeof(int64_t))));
    const long4 steps = __builtin_convertvector((x - f->origin) * f->per_metre, long4);
    return __builtin_convertvector(steps, coordinate4); /* the lower halves: it goes round */
#else
    (void)f;
    return x;
#endif
}

/* Within the steps of a call the velocities are those of the bodies in double, which hold them in
 * full, and those of the arrays, kept up beside the bodies, in float. */
#ifdef SILT_FLOAT
enum { BODY_IS_FLOAT = 1 };
#else
enum { BODY_IS_FLOAT = 0 };
#endif

static inline struct motion_state body_state(const struct body *b, const vec3 *pos,
                                             const vec3 *vel, const vec3 *spin)
{
    struct motion_state m = {.pos = {pos->x, pos->y, pos->z, 0.0}};
    if (BODY_IS_FLOAT) {
        m.vel_spin = (double8){vel->x,  vel->y,  vel->z,  (double)b->vel[3],
                               spin->x, spin->y, spin->z, (double)b->spin[3]};
    } else {
        real8 vel_spin;
        __builtin_memcpy(&vel_spin, &b->vel, sizeof vel_spin);
        m.vel_spin = __builtin_convertvector(vel_spin, double8);
    }
    return m;
}

static inline vec3 motion_pos(const struct motion_state *m)
{
    return v3(m->pos[0], m->pos[1], m->pos[2]);
}

static inline vec3 motion_vel(const struct motion_state *m)
{
    return v3(m->vel_spin[0], m->vel_spin[1], m->vel_spin[2]);
}

static inline vec3 motion_spin(const struct motion_state *m)
{
    return v3(m->vel_spin[4], m->vel_spin[5], m->vel_spin[6]);
}

/* Writes the body of a grain in that state; `full`: velocity predicted for the full step, and the
 * material. */
static inline void body_write(struct body *b, const struct frame *f,
                              const struct motion_state *m, double4 full)
{
    real8 vel_spin;
    b->place = frame_place(f, m->pos);
    b->full = __builtin_convertvector(full, real4);
    vel_spin = __builtin_convertvector(m->vel_spin, real8);
    __builtin_memcpy(&b->vel, &vel_spin, sizeof vel_spin);
}

/* Place of i less that of j in one direction, in steps of the frame; in single precision places are
 * whole numbers that wrap around. */
static inline real body_along(const struct body *i, const struct body *j, int a)
{
#ifdef SILT_FLOAT
    return (real)(int)((unsigned)i->place[a] - (unsigned)j->place[a]);
#else
    return i->place[a] - j->place[a];
#endif
}

/* place and full of i less those of j, each with a number of no meaning behind; places in steps
 * of the frame, not yet by the nearest image. */
static inline real8 body_apart(const struct body *i, const struct body *j)
{
#ifdef SILT_FLOAT
    const real4 place = __builtin_convertvector(i->place - j->place, real4);
    const real4 full = i->full - j->full;
    return __builtin_shufflevector(place, full, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    real8 a, b;
    __builtin_memcpy(&a, i, sizeof a);
    __builtin_memcpy(&b, j, sizeof b);
    return a - b;
#endif
}

/* Writes every body from the arrays of the grains, with full = vel: at the start. */
void bodies_fill(struct sim *s);

/* The bodies in the order of the sorted grains (order[new] = old), at their wrapped positions.
 * Frozen grains from `listed` (old) on are new: theirs are written. */
void bodies_sort(struct sim *s, const int *order, int listed);

#endif
