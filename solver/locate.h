/* locate.h - which cell of the grid holds a point?
 *
 * Positions may lie outside the box: along a periodic direction they are wrapped, beyond a wall
 * they belong to the nearest cell inside. */
#ifndef LOCATE_H
#define LOCATE_H

#include "grid.h"

/* Interior index 1..n in direction `axis` of the interval i (counted from 0 at the low side,
 * and on beyond the box). */
int locate_index(const struct grid *g, const struct domain *d, int axis, int i);

/* Index in a grid field of the cell that holds x. */
int locate_cell(const struct grid *g, const struct domain *d, vec3 x);

#endif
