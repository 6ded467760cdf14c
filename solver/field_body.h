/* field_body.h - a grain given by its distance field: its mass, the nodes of its surface, its contact
 * with another.
 *
 * In the body's frame: origin at the centre of mass, axes the principal ones, the radius of the sphere
 * of its volume as the unit of length. */
#ifndef FIELD_BODY_H
#define FIELD_BODY_H

#include "distance_field.h"
#include "rotation.h"

struct shape_ball;
struct shape_part;

/* Nodes that lie together. */
struct field_leaf {
    vec3 centre;
    double radius;
    int first, n;
};

struct field_body {
    struct distance_field *field; /* in units of the size, along the axes of its source */
    struct mat3 to_field;         /* body's frame to those axes */
    struct quat axes;             /* the same */
    vec3 centre;                  /* of mass, in the field */
    double volume;                /* of the source, in its units */
    vec3 inertia;                 /* principal, over m size^2 */
    double bounding, area;
    double thin;    /* deepest point */
    double spacing; /* of the nodes */
    int n, n_leaves, n_balls;
    vec3 *at, *normal;
    double *weight; /* area of each node */
    struct field_leaf *leaf;
    struct shape_ball *ball; /* cover the surface from within: for walls */
    struct surface_net *net; /* of the same nodes */
};

/* Takes the field over; nodes `spacing` apart, in diameters. NULL and *why (xfree) where the body is too
 * small for its grid. */
struct field_body *field_body(struct distance_field *field, double spacing, char **why);
void field_body_free(struct field_body *b);

/* > 0 inside; b is a field_body. */
double field_body_depth(const void *b, vec3 x);
struct shape_part *field_body_parts(const struct field_body *b, double spacing, int *n);

struct field_placed {
    const struct field_body *body;
    double size;      /* m */
    struct mat3 turn; /* body to lab */
};

/* Where two bodies overlap: points, each of which takes part in the pair's one depth (field_pair.c). */
struct field_touch {
    int id;
    double depth;   /* m, of the pair: the same for all points */
    double deepest; /* m, of its nodes */
    vec3 normal;    /* unit, from j to i */
    vec3 at;        /* m, from x_i, midway in the overlap */
    double share;   /* of the pair's energy; those of all points add up to 1 */
    double slope;   /* -d(depth)/d(x_i along the normal), of this point, over its share */
};

/* Up to `most` of them, 4 or more, in a fixed order; returns how many. If none overlaps but a node
 * comes within `reach` of the other body, that node with its gap as a negative depth; if none does, 0, and
 * *clear is a bound of how far apart the bodies are (m; 0: none is known). apart = x_i - x_j. */
int field_meet(const struct field_placed *i, const struct field_placed *j, vec3 apart,
               double reach, int most, struct field_touch *out, double *clear);

#endif
