/* contact_points_walls.h - what a grain of any shape meets of the walls. */
#ifndef CONTACT_POINTS_WALLS_H
#define CONTACT_POINTS_WALLS_H

#include "contact_facing.h"
#include "contact_points.h"

/* A contact with an element, or one that may be. */
struct meeting {
    struct facing f;
    struct shape_point p;
    vec3 place;   /* m, of the contact in the body's frame */
    real *record; /* NULL: none yet */
    bool new;
};

/* What a part of the body meets of one flat element. */
struct flat_meeting {
    int points;
    struct shape_point p[4];
};

/* The meetings of a grain. */
struct meetings {
    int n, room;
    struct meeting *m;
    int facings; /* room of the buffers */
    struct facing *seen;
    double *radius;
    struct flat_meeting *met;
    bool *flat;
    size_t taken_room;
    real *taken;
};

/* The active wall slots of a grain. */
struct around {
    int i, n;
    const int *slot;
    struct shape_pose pose;
};

/* Gives every meeting a record of its slot; what has ended is cleared. */
void meetings_remember(struct sim *s, const struct cut *cut, struct meetings *all,
                       const struct around *a, struct report *report);

#endif
