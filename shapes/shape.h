/* shapes/shape.h - contract: what is a grain?
 *
 * To add a shape: copy sphere.c to shapes/NAME.c. Every answer exports exactly the symbols
 * below. The contact loop finds pairs whose bounding spheres come close; the shape says where
 * and how deep they overlap, for a block of pairs at a time. Called from parallel loops. */
#ifndef SHAPE_H
#define SHAPE_H

#include "../contact/touch.h"
#include "../solver/grains.h"

struct wall;

/* Candidate pairs, up to TOUCH; for a wall contact j is i. */
struct candidates {
    int n; /* a multiple of TOUCH_LANES */
    int i[TOUCH], j[TOUCH];
    const struct wall *wall[TOUCH];       /* NULL: grain against grain */
    real dx[TOUCH], dy[TOUCH], dz[TOUCH]; /* m, x_i - x_j by the nearest image; wall: from the
                                             wall's nearest point to x_i */
};

/* Lever arms from the centres to the contact point. */
struct levers {
    real ix[TOUCH], iy[TOUCH], iz[TOUCH]; /* m, point - x_i */
    real jx[TOUCH], jy[TOUCH], jz[TOUCH]; /* m, point - x_j (0 for a wall) */
};

extern const struct about shape_about;
extern const struct key shape_keys[]; /* of section "grains" */

/* Sets radius (bounding), volume, mass and inertia of grain i from its species' diameter and
 * density. */
void shape_body(struct grains *g, int i, double diameter, double density);

/* Sets depth, normal and levers of each candidate. r_i, r_j and r_eff are there already, from the
 * bounding radii (r_j = 0 for a wall); a shape whose surface curves otherwise sets them anew. A
 * pair that does not overlap gets a negative depth (its gap). */
void shape_overlaps(const struct grains *g, const struct candidates *c, struct touch *t,
                    struct levers *l);

#endif
