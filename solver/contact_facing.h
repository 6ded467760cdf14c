/* contact_facing.h - which of the elements of a wall that a ball touches count.
 *
 * Of the elements of one wall (the triangles of a mesh, the sides of a box, a tube and its caps) a
 * ball touches the surface where its distance to the whole of them is least, nearby: at each inner
 * point of a face whose normal goes through the centre, and at an edge or vertex only if no other
 * element that has this point too comes nearer. So
 *   - nearest points that coincide are one contact: that of the face, if one of them is a face;
 *   - that of an edge or vertex which lies on another element does not count if the ball is nearer to
 *     that one, or if that one is met on its face. */
#ifndef CONTACT_FACING_H
#define CONTACT_FACING_H

#include "real.h"
#include "walls.h"

struct sim;

/* An element that a ball touches, or has just left. */
struct facing {
    int slot, wall, local;
    vec3 centre;     /* m, of the ball */
    vec3 away;       /* m, from its nearest point to the centre */
    double distance; /* m */
    double curvature;
    vec3 arm; /* m, from the wall's pivot to the centre */
    enum wall_part part;
    bool counts, live;
};

/* Element `element` from the centre of a ball. */
struct facing facing_look(const struct sim *s, int slot, int element, vec3 centre);

/* Whether another of the n elements that the ball is near takes the place of k. `tolerance`: m, points
 * nearer than this coincide. */
bool facing_hidden(const struct sim *s, const struct facing *f, int n, int k, double tolerance);

/* Radius of a sphere on a plane that touches like this one on a surface that is curved one way, by
 * the geometric mean of the two radii of curvature [Johnson85, eq. 4.28]. */
double facing_matched(double radius, double curvature);

/* A vector that the contact remembers turns with the wall about the normal. */
void facing_turn(const struct sim *s, const struct facing *f, const struct wall *w,
                 real *history);

#endif
