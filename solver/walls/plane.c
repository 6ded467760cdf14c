/* solver/walls/plane.c - a plane without end; grains are on the side of its normal.
 * (rectangle.c is the kind to copy.) */
#include "wall_kind.h"

static const struct key keys[] = {{0}};

static void *read(struct scene *scene, const char *name, const struct domain *d)
{
    struct wall_flat *const p = xalloc(1, sizeof *p);
    p->point = scene_vector(scene, "wall", name, "point");
    p->normal = wall_unit_vector(scene, name, "normal");
    const double n[3] = {p->normal.x, p->normal.y, p->normal.z};
    for (int a = 0; a < 3; a++)
        if (d->periodic[a] && n[a] != 0.0 && scene_given(scene, "wall", name, "normal"))
            scene_error(scene, "wall", name, "normal",
                        "a plane without end across periodic %c; take a rectangle", 'x' + a);
    return p;
}

const struct wall_kind wall_plane = {.name = "plane",
                                     .summary = "a plane without end (point, normal)",
                                     .keys = keys,
                                     .read = read,
                                     .free = xfree,
                                     .elements = wall_single,
                                     .view = wall_flat_view,
                                     .views = wall_flat_views,
                                     .near = wall_flat_near,
                                     .behind = wall_flat_behind,
                                     .bounds = wall_flat_bounds,
                                     .sweep = wall_flat_sweep,
                                     .draw = wall_flat_draw};
