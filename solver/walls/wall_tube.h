/* solver/walls/wall_tube.h - what cylinder and cone share: a strip of revolution with caps. */
#ifndef WALL_TUBE_H
#define WALL_TUBE_H

#include "wall_kind.h"

/* Reads point, axis, length, caps and side. */
void *wall_tube_read(struct scene *scene, const char *name, const struct domain *d, double foot,
                     double end, bool endless);
int wall_tube_elements(const void *shape);
void wall_tube_view(const void *shape, int element, const vec3 *x, struct wall_view *out);
void wall_tube_views(const void *shape, struct wall_looks *l);
bool wall_tube_flat(const void *shape, int element, const vec3 *x, struct wall_flat *plane,
                    double *within);
bool wall_tube_behind(const void *shape, vec3 x);
void wall_tube_bounds(const void *shape, vec3 *low, vec3 *high);
double wall_tube_sweep(const void *shape, vec3 point, vec3 axis);
void wall_tube_draw(const void *shape, struct wall_canvas *c);

#define WALL_TUBE_REST                                                                         \
    .free = xfree, .elements = wall_tube_elements, .view = wall_tube_view,                     \
    .views = wall_tube_views, .flat = wall_tube_flat, .behind = wall_tube_behind,              \
    .bounds = wall_tube_bounds, .sweep = wall_tube_sweep, .draw = wall_tube_draw

#endif
