/* solver/walls/cone.c - a cone or frustum, felt from within and from without, with caps if wanted. */
#include "wall_tube.h"

static const struct key keys[] = {
    {"wall", "radius_end", KEY_REAL, "m", "[0, inf)", NULL,
     "radius of a cone at the end of its length; `radius` is that at `point`"},
    {0},
};

static void *read(struct scene *scene, const char *name, const struct domain *d)
{
    const double foot = scene_real(scene, "wall", name, "radius");
    const double end = scene_real(scene, "wall", name, "radius_end");
    if (scene_word(scene, "wall", name, "length", "endless"))
        scene_error(scene, "wall", name, "length", "a cone has an end");
    return wall_tube_read(scene, name, d, foot, end, false);
}

const struct wall_kind wall_cone = {
    .name = "cone",
    .summary = "a cone or frustum (point, axis, radius, radius_end, length, caps)",
    .keys = keys,
    .read = read,
    WALL_TUBE_REST,
};
