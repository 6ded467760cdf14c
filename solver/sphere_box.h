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

/* What the parts beyond two planes have in common, for balls cut by many: of all pairs of planes at
 * once, BALL_LANES at a time. */
enum { BALL_LANES = 8, BALL_PAIRS = 680 };

struct ball_pairs {
    int n; /* set with a and b */
    double a[BALL_PAIRS], b[BALL_PAIRS];
    double
        w2[BALL_PAIRS];   /* 1 - a^2 - b^2; where > 0 the edge of the planes crosses the ball */
    double w[BALL_PAIRS]; /* and leaves it at this coordinate */
    double at_a[BALL_PAIRS], at_b[BALL_PAIRS],
        at_corner[BALL_PAIRS]; /* atan2(w, a), (w, b), (w, a b) */
    double wedge[BALL_PAIRS];  /* ball_wedge(a, b) */
};

void ball_pairs_find(struct ball_pairs *p);

/* ball_octant(a, b, c) from its three pairs (a, b), (a, c), (b, c). */
double ball_octant_of(const struct ball_pairs *p, int ab, int ac, int bc);

/* m3; volume that a sphere and the box lo..hi have in common, >= 0. */
double sphere_box_overlap(vec3 centre, double radius, vec3 lo, vec3 hi);

#endif
