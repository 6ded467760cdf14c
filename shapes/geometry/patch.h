/* shapes/geometry/patch.h - where two convex polyhedra face each other: a few points for one pair.
 *
 * Seen along the normal n of the nearest points, the gap g between the two surfaces is a convex
 * function over the plane across n, with flat pieces: it has its corners where a vertex of one
 * body lies over a face of the other and where edges cross. Which corners share the contact, and
 * how? Tilt the normal a little, by a slope p: then one corner is the nearest, that of the least
 * g - p x. The share of a corner is the part of all slopes of size `tilt` for which it is the
 * nearest. So
 *   - the shares add up to 1: faces are as stiff as a vertex, and as damped;
 *   - of faces in parallel the corners of the common polygon share by its exterior angles (four
 *     corners of a square have a quarter each); of an edge on a face the two ends have a half
 *     each; tilted by more than `tilt`, the nearest corner has it all;
 *   - where corners part or merge as one body slides over the other, exterior angles add up: force
 *     and torque are continuous wherever the gap is.
 * In the plane the corners x with discs of radius C - g/tilt have a convex hull, and the share of
 * a corner is the arc of its disc on it, over 2 pi: that is how it is found, by walking round the
 * hull of discs as one wraps a gift [Jarvis73]. */
#ifndef PATCH_H
#define PATCH_H

#include "distance.h"

enum { PATCH_MOST = 32, PATCH_NEAR = 64 };

/* A polyhedron in the frame of the pair. */
struct patch_body {
    const struct polyhedron *p;
    struct points at;    /* its vertices in the frame of the pair */
    vec3 axes[3], place; /* x = place + scale (axes[0] x_own.x + ...) */
    double scale;
};

struct patch_point {
    int id;       /* which features: the same wherever the same meet */
    double share; /* of the contact; all add up to 1 */
    double gap;   /* m, between the cores along the normal */
    vec3 on_b;    /* m, place on the core of b; that on a is on_b + gap normal */
    vec3 lever;   /* m, from the middle of the patch */
};

/* Ids of points of the two are below this. */
int patch_ids(const struct polyhedron *a, const struct polyhedron *b);
/* Number of points, between 1 and `most`; the ones of the least shares are left out if there are
 * more. The gap is that of the bodies (distance.h). */
int patch_find(const struct patch_body *a, const struct patch_body *b, const struct gap *gap,
               double tilt, int most, struct patch_point *out);

#endif
