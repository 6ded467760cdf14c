/* shares.h - in which cells does a body lie, and with which parts of it? For the answers of
 * porosity/.
 *
 * Bodies may lie partly outside the box: along a periodic direction they are wrapped, at a wall they
 * are mirrored, so that nothing is lost and bodies spread evenly up to the wall give an even field. */
#ifndef SHARES_H
#define SHARES_H

#include "grid.h"
#include "rotation.h"

struct share {
    int cell;      /* interior cell, index in a grid field */
    double weight; /* part of the body, >= 0; all of a body's sum to 1 to round-off */
};

/* Weights of the trilinear interpolation from the eight cell centres around x; a field that is linear
 * in space is met exactly, but for the half cell next to a wall. At most 8 shares. */
int shares_trilinear(const struct grid *g, const struct domain *d, vec3 x, struct share *out);

/* Exact parts of a ball in the cells that it overlaps. A ball wider than the box names a cell more
 * than once. */
int shares_ball_most(const struct grid *g, double radius); /* shares, at most */
int shares_ball(const struct grid *g, const struct domain *d, vec3 x, double radius,
                struct share *out);

/* A body in parts, each taken for a cube along the axes of the grid (of the same volume, at the same
 * place); lengths in units of the body's size, in its frame. */
struct parts {
    int n;
    double reach; /* of the farthest corner of a cube from the origin, however turned */
    vec3 *at;     /* centres */
    double *half; /* half edges */
    double *inv_half;
    double *weight; /* parts of the volume, sum 1 */
};

/* Parts of the body in cells: of the body of that size (m) whose origin is at x, turned by `turn`
 * (body to lab). */
int shares_parts_most(const struct grid *g, double reach); /* m: size times parts.reach */
int shares_parts(const struct grid *g, const struct domain *d, const struct parts *p, vec3 x,
                 const struct mat3 *turn, double size, struct share *out);

#endif
