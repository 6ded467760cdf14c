/* sphere_box.h - exact volumes of parts of a ball cut by planes along the axes.
 *
 * Lengths are in radii, volumes in volumes of the ball (4 pi/3), the ball's centre is the
 * origin. The volume of a box's part of a ball is a difference of octants. Absolute error about
 * 1e-16, so that parts much smaller than that may come out slightly negative. Pure functions.
 */
#ifndef SPHERE_BOX_H
#define SPHERE_BOX_H

#include "vec3.h"

double ball_beyond(double a);                     /* part with x > a */
double ball_wedge(double a, double b);            /* part with x > a, y > b */
double ball_octant(double a, double b, double c); /* part with x > a, y > b, z > c */

/* What the parts beyond two planes have in common, for balls cut by many: found once per pair. */
struct ball_pair {
    double a, b;
    double w2; /* 1 - a^2 - b^2; where > 0 the edge of the planes crosses the ball */
    double w;  /* and leaves it at this coordinate */
    double at_a, at_b, at_corner; /* atan2(w, a), atan2(w, b), atan2(w, a b) */
    double wedge;                 /* ball_wedge(a, b) */
};

struct ball_pair ball_pair(double a, double b);

/* ball_octant(a, b, c) from its three pairs (a, b), (a, c), (b, c). */
double ball_octant_of(const struct ball_pair *ab, const struct ball_pair *ac,
                      const struct ball_pair *bc);

/* m3; volume that a sphere and the box lo..hi have in common, >= 0. */
double sphere_box_overlap(vec3 centre, double radius, vec3 lo, vec3 hi);

#endif
