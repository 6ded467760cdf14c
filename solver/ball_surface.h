/* ball_surface.h - the surface of a union of balls as triangles, its volume in small parts. */
#ifndef BALL_SURFACE_H
#define BALL_SURFACE_H

#include "../shapes/shape.h"
#include "disc_union.h"

/* Triangles of every ball that are not inside another; where balls meet they run a little into each
 * other. */
void ball_surface(const struct ball *b, int n, struct shape_canvas *c);

/* Parts as shape.h has them, of a union whose volume is that of the unit sphere. */
struct shape_part *ball_parts(const struct ball *b, int n, double spacing, int *count);

#endif
