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
    vec3 impulse; /* N s, its integral over time */
};

struct walls {
    int n;
    struct wall wall[WALLS_MAX];
    vec3 skeleton_force;   /* N, by the other grains on frozen ones, at the last step */
    vec3 skeleton_impulse; /* N s */
};

extern const struct key wall_keys[];
void walls_create(struct sim *s, struct scene *scene);

#endif
