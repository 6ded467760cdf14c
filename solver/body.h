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
    coordinate4 place; /* x y z; in double 1/(kg m2), 0 if frozen */
    real4 full;        /* m/s predicted for the full step; index of the material */
    real4 vel;         /* m/s at the half step; 1/mass, 0 if frozen */
    real4 spin;        /* rad/s at the half step; bounding radius, m */
};

#ifdef SILT_FLOAT
enum { BODY_IS_FLOAT = 1 };
typedef int64_t fine4 __attribute__((vector_size(4 * sizeof(int64_t)))); /* 2^-32 steps */

typedef uint32_t uint4 __attribute__((vector_size(4 * sizeof(uint32_t))));

/* What the motion knows of a grain beyond its body, so that its state is that of a build in double. */
struct body_rest {
    double4 vel;  /* m/s at the half step; 1/kg, 0 if frozen */
    double4 spin; /* rad/s at the half step; 1/(kg m2) */
    uint4 place;  /* 2^-32 steps of the place */
};
#else
enum { BODY_IS_FLOAT = 0 };
typedef double4 fine4; /* m */

struct body_rest {
    char nothing;
};
#endif

/* The state of a grain within the steps of a call. */
struct motion_state {
    fine4 place;  /* in double, 1/(kg m2) behind */
    double4 vel;  /* 1/kg behind */
    double4 spin; /* the radius behind; in float, 1/(kg m2) */
};

/* How places are written and their differences read back, from the box. */
struct frame {
    double4 origin;              /* float: place = (x - origin) per_metre */
    double4 per_metre, fine;     /* float: steps, 2^-32 steps, of a metre */
    double4 metre;               /* float: of a 2^-32 step */
    real scale[3];               /* m per step of a difference; 1 in double */
    real image[3], inv_image[3]; /* nearest image of a difference; 0 where not needed */
};

void frame_of(struct frame *f, const struct domain *d);

/* The place at x y z, m; what stands behind stays. */
static inline fine4 frame_place(const struct frame *f, double4 x)
{
#ifdef SILT_FLOAT
    const double4 steps = (x - f->origin) * f->per_metre;
    fine4 whole = __builtin_convertvector(steps, fine4);
    const double4 part = (steps - __builtin_convertvector(whole, double4)) * 0x1p32;
    return (whole << 32) + __builtin_convertvector(part, fine4); /* it goes round */
#else
    (void)f;
    return x;
#endif
}

/* m; x y z of a place. */
static inline double4 frame_metres(const struct frame *f, fine4 place)
{
#ifdef SILT_FLOAT
    return f->origin + __builtin_convertvector(place, double4) * f->metre;
#else
    (void)f;
    return place;
#endif
}

/* A way, m, 0 behind, as a difference of places. */
static inline fine4 frame_way(const struct frame *f, double4 way)
{
#ifdef SILT_FLOAT
    return __builtin_convertvector(way * f->fine, fine4);
#else
    (void)f;
    return way;
#endif
}

/* Spelt out, since gcc 12 makes two conversions and more of __builtin_convertvector here. */
static inline double4 body_wide(real4 a)
{
    return (double4){(double)a[0], (double)a[1], (double)a[2], (double)a[3]};
}

static inline struct motion_state body_state(const struct body *b, const struct body_rest *r)
{
    struct motion_state m;
#ifdef SILT_FLOAT
    const coordinate4 high = b->place;
    const uint4 low = r->place;
    m.place = ((fine4){high[0], high[1], high[2], high[3]} << 32) +
              (fine4){low[0], low[1], low[2], low[3]};
    m.vel = r->vel;
    m.spin = r->spin;
#else
    (void)r;
    m.vel = b->vel;
    m.spin = b->spin;
    m.place = b->place;
#endif
    return m;
}

/* 1/kg, 1/(kg m2) of a grain. */
static inline double body_per_mass(const struct body *b, const struct body_rest *r)
{
#ifdef SILT_FLOAT
    (void)b;
    return r->vel[3];
#else
    (void)r;
    return b->vel[3];
#endif
}

static inline double body_per_inertia(const struct body *b, const struct body_rest *r)
{
#ifdef SILT_FLOAT
    (void)b;
    return r->spin[3];
#else
    (void)r;
    return b->place[3];
#endif
}

static inline vec3 motion_pos(const struct frame *f, const struct motion_state *m)
{
    const double4 x = frame_metres(f, m->place);
    return v3(x[0], x[1], x[2]);
}

static inline vec3 motion_vel(const struct motion_state *m)
{
    return v3(m->vel[0], m->vel[1], m->vel[2]);
}

static inline vec3 motion_spin(const struct motion_state *m)
{
    return v3(m->spin[0], m->spin[1], m->spin[2]);
}

static inline void body_set_spin(struct body *b, struct body_rest *r, vec3 spin)
{
    const double exact[3] = {spin.x, spin.y, spin.z};
    for (int a = 0; a < 3; a++) {
        b->spin[a] = (real)exact[a];
#ifdef SILT_FLOAT
        r->spin[a] = exact[a];
#else
        (void)r;
#endif
    }
}

/* Writes the body of a grain in that state, but for its material and, in float, its radius; `full`:
 * velocity predicted for the full step. */
static inline void body_write(struct body *b, struct body_rest *r, const struct motion_state *m,
                              double4 full)
{
    const real4 vel = __builtin_convertvector(m->vel, real4);
    real4 spin = __builtin_convertvector(m->spin, real4);
    real4 predicted = __builtin_convertvector(full, real4);
    predicted[3] = b->full[3];
    b->full = predicted;
    if (BODY_IS_FLOAT)
        spin[3] = b->spin[3];
    b->vel = vel;
    b->spin = spin;
#ifdef SILT_FLOAT
    b->place = __builtin_convertvector(m->place >> 32, coordinate4);
    r->place = __builtin_convertvector(m->place, uint4);
    r->vel = m->vel;
    r->spin = m->spin;
#else
    (void)r;
    b->place = m->place;
#endif
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

/* The state of grain i by the arrays of the grains. */
struct motion_state bodies_state(const struct sim *s, int i);

/* Writes body i in that state, with full = vel. */
void bodies_write(struct sim *s, int i, const struct motion_state *m);

/* Writes every body from the arrays of the grains, with full = vel: at the start. */
void bodies_fill(struct sim *s);

/* The bodies in the order of the sorted grains (order[new] = old), at their wrapped positions.
 * Frozen grains from `listed` (old) on are new: theirs are written. */
void bodies_sort(struct sim *s, const int *order, int listed);

#endif
