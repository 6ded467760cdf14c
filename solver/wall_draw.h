/* wall_draw.h - the walls of a scene as triangles, where they are now: for outputs and pictures. */
#ifndef WALL_DRAW_H
#define WALL_DRAW_H

#include "domain.h"

struct sim;

struct wall_drawing {
    int n;     /* triangles */
    vec3 *at;  /* m, 3 n corners */
    int *wall; /* per triangle: index among the named walls, in the order of the scene */
    int room;
};

/* Of the named walls (the sides of the box are none); what has no end ends at the box. Free with
 * wall_drawing_free. */
struct wall_drawing walls_draw(const struct sim *s);
void wall_drawing_free(struct wall_drawing *d);

#endif
