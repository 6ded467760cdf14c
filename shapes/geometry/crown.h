/* shapes/geometry/crown.h - convex polyhedra with crowned faces, and how far apart they are.
 *
 * The distance of polyhedra has a kink where faces, or edges and faces, lie in parallel: a force that
 * follows from it jumps from corner to corner. So the core of a grain is not the polyhedron of
 * vertices v_k itself, with the support function max_k (m v_k), but the convex body whose support
 * function is smooth,
 *   s(m) = log(sum_k w_k exp(B m v_k)) / B     for unit vectors m, sharp vertices for B -> infinity:
 * its faces are crowned, of radius of curvature B a^2 in a direction in which the vertices of the face
 * have the variance a^2, and its edges and vertices lie inside of those of the polyhedron by
 * log(1/w)/B. With w_k = 1/(most vertices of the faces round vertex k) the tops of faces lie where the
 * faces do. Its point with the normal m is the mean of the vertices by their parts
 * p_k ~ w_k exp(B m v_k): the face's middle for its own normal, the vertex when tilted by more than a
 * few 1/(B a).
 *
 * The gap of two such bodies is the greatest over m of
 *   H(m) = m (x_a - x_b) - s_a(-m) - s_b(m),
 * a smooth, concave problem of two unknowns, solved by Newton's method; there the line through both
 * points lies along m. A force F(gap) along m through them is the gradient of an energy whatever the
 * law F, so that elastic collisions keep energy, and it acts along one line, so that they keep angular
 * momentum. Of all this only the maximum of smooth functions is used [Boyd04, sections 3.1.5, 9.5]. */
#ifndef CROWN_H
#define CROWN_H

#include "distance.h"

struct crown {
    struct points at;
    const double *log_weight; /* of each vertex; CROWN_NONE for padding */
    double sharp;             /* 1/m, B */
};

#define CROWN_NONE   (-1e4)
#define CROWN_SHARP  200.0 /* B times the size */
#define CROWN_NARROW 1e-2  /* sizes; a patch less wide than this counts as a point */
#define CROWN_SLACK                                                                            \
    1e-2 /* sizes; the gap is less than that of the polyhedra by less than this */

/* Where a body lies furthest along a unit vector. */
struct crown_top {
    double height; /* m, s */
    vec3 at;
    double xx, yy, zz, xy, xz, yz; /* m2, variance of the vertices by their parts */
};

struct crown_gap {
    double gap;  /* m, H */
    vec3 normal; /* from b to a */
    vec3 on_a, on_b;
    vec3 e1, e2; /* unit vectors across the normal */
    /* m, how far the patch reaches: the root of the parallel sum (A^-1 + B^-1)^-1 of the variances
     * across the normal, symmetric; nothing for a vertex and for edges that cross */
    double r11, r12, r22;
};

/* Logarithms of the weights, vertex_room of them. */
void crown_weights(const struct polyhedron *p, double *log_weight);
void crown_find_top(const struct crown *c, vec3 along, struct crown_top *top);
/* The patch of a flat wall: that of the body itself; needs the normal. */
void crown_set_flat(const struct crown_top *top, struct crown_gap *out);
/* From a direction near that of the gap; false: the gap is not below `reach`, then out->gap is a lower
 * bound of it and out->normal tells along what. `line`: m is sought across this unit vector alone, for
 * a straight line in place of b; zero: none. */
bool crown_find_gap(const struct crown *a, const struct crown *b, vec3 line, double reach,
                    vec3 start, struct crown_gap *out);

#endif
