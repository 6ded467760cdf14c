/* shapes/geometry/distance.h - distance of two convex polyhedra, and from a point.
 *
 * Both bodies stand in one frame. The distance is that of Gilbert, Johnson and Keerthi [Gilbert88]:
 * the nearest point to the origin of the set of differences a - b, found over simplices of its
 * vertices; it ends at a simplex of the polyhedra's own vertices, so it is exact to round-off.
 * Polyhedra that touch or overlap have a distance <= 0: minus the least displacement that parts
 * them, over the directions of all faces and pairs of edges [GottschalkLinManocha96]. */
#ifndef DISTANCE_H
#define DISTANCE_H

#include "polyhedron.h"

/* Vertices of a body in the frame of the pair; room: a whole number of lanes. */
struct points {
    int room;
    const double *x, *y, *z; /* m */
};

/* What is remembered of a pair between steps: where the search begins. All zero at first. */
struct gap_memory {
    int n, a[3], b[3]; /* the simplex of the nearest points */
};

struct gap {
    double distance; /* m; < 0: overlap */
    vec3 normal;     /* unit, from b to a */
    vec3 on_a, on_b; /* m, a pair of nearest points */
};

/* Vertex of the points that lies furthest along, or furthest against, the direction. */
int points_highest(const struct points *p, vec3 along, double *height);
int points_lowest(const struct points *p, vec3 along, double *height);

static inline vec3 points_at(const struct points *p, int k)
{
    return v3(p->x[k], p->y[k], p->z[k]);
}

/* A lower bound of the distance: how far they are apart along a unit vector from b to a. */
double gap_along(const struct points *a, const struct points *b, vec3 direction);

/* The distance where it is below `reach`; a lower bound of it >= reach where it is not (then the
 * points are not set, and the normal is the direction in which they are so far apart). Polyhedra
 * without the faces that tell how deep they overlap may be NULL: then overlap is distance 0, and
 * no normal. */
void gap_find(const struct points *a, const struct polyhedron *pa, const struct points *b,
              const struct polyhedron *pb, const vec3 axes_b[3], double reach,
              struct gap_memory *memory, struct gap *out);

/* m, of a point from the polyhedron; 0 inside. */
double polyhedron_distance(const struct polyhedron *p, vec3 x);

#endif
