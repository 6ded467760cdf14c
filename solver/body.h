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
typedef double double4 __attribute__((vector_size(4 * sizeof(double))));

struct body {
    coordinate4 place; /* x y z, and nothing */
    real4 vel;         /* m/s at the half step; 1/mass, 0 if frozen */
    real4 full;        /* m/s predicted for the full step; index of the material */
    real4 spin;        /* rad/s at the half step; bounding radius, m */
};

/* How places are written and their differences read back, from the box. */
struct frame {
    double origin[3], per_step[3]; /* float: place = (x - origin) / per_step */
    real scale[3];                 /* m per step of a difference; 1 in double */
    real image[3], inv_image[3];   /* nearest image of a difference; 0 where not needed */
};

void frame_of(struct frame *f, const struct domain *d);

static inline coordinate4 frame_place(const struct frame *f, vec3 x)
{
#ifdef SILT_FLOAT
    const double at[3] = {(x.x - f->origin[0]) / f->per_step[0],
                          (x.y - f->origin[1]) / f->per_step[1],
                          (x.z - f->origin[2]) / f->per_step[2]};
    return (coordinate4){(int32_t)(uint32_t)(int64_t)at[0], (int32_t)(uint32_t)(int64_t)at[1],
                         (int32_t)(uint32_t)(int64_t)at[2], 0};
#else
    (void)f;
    return (coordinate4){x.x, x.y, x.z, 0.0};
#endif
}

/* Writes every body from the state of the grains, with full = vel: at the start, and for grains
 * that are new. */
void bodies_fill(struct sim *s);

/* The bodies in the order of the sorted grains (order[new] = old), at their wrapped positions. */
void bodies_sort(struct sim *s, const int *order);

#endif
