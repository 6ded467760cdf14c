/* volume_parts.h - the volume of a body in small parts, for the grid and for integrals.
 *
 * Parts that lie wholly inside the body are bricks of a lattice, those at the surface are what the body
 * holds of a brick, at their own centre. Lengths in units of the caller's, in the body's frame. */
#ifndef VOLUME_PARTS_H
#define VOLUME_PARTS_H

#include "shares.h"

struct shape_part;

/* > 0 where the point is inside the body, < 0 outside; a distance or anything that is smooth next to
 * the surface, where it is 0. */
typedef double volume_depth(const void *body, vec3 x);

/* Cuts a body, which lies in the box lo..hi, into parts no wider than `spacing`; their centre is moved
 * to `centre` (NULL: is left where it is). Free with parts_free. */
struct parts volume_parts(volume_depth *depth, const void *body, vec3 lo, vec3 hi,
                          double spacing, const vec3 *centre);

/* The same parts with volumes that add up to `volume` (0: left as they are), as an answer of shapes/ gives them: *n of
 * them, free with xfree. */
struct shape_part *volume_shape_parts(volume_depth *depth, const void *body, vec3 lo, vec3 hi,
                                      double spacing, double volume, const vec3 *centre,
                                      int *n);

/* What the grid takes of an answer's parts. */
struct parts parts_of(const struct shape_part *part, int n);
void parts_free(struct parts *p);

#endif
