/* walls.h - what bounds the grains: planes, from the sides of the box and from [wall NAME]. */
#ifndef WALLS_H
#define WALLS_H

#include "domain.h"

struct sim;

enum { WALLS_MAX = 64 };

struct wall {
    char name[32];
    vec3 point, normal; /* m; unit, towards the grains */
    vec3 velocity;      /* m/s, in its own plane (conveyor) */
    int material;
    vec3 force;   /* N, by the grains on the wall, at the last step */
    vec3 sum;     /* N, over the steps since it was last turned into an impulse */
    vec3 impulse; /* N s, its integral over time */
};

struct walls {
    int n;
    struct wall wall[WALLS_MAX];
    vec3 skeleton_force; /* N, by the other grains on frozen ones, at the last step */
    vec3 skeleton_sum, skeleton_impulse; /* N, N s, as of a wall */
};

extern const struct key wall_keys[];
void walls_create(struct sim *s, struct scene *scene);

enum { WALLS_NEAR = WALLS_MAX }; /* most elements of walls that a grain can be near */

/* The elements of walls that grain i may touch within `margin`, into `out`; returns how many. */
int walls_near(const struct sim *s, int i, double margin, int *out);

/* Turns the sum of the forces of the last steps into an impulse: each step takes half of the force
 * at either end, as the kicks do. `now` is the force at the last of them. */
void walls_impulse(vec3 *force, vec3 *sum, vec3 *impulse, vec3 now, int steps, double dt);

/* From the nearest point of an element to x, m. */
vec3 wall_distance(const struct sim *s, int element, vec3 x);

#endif
