/* solver/walls/cylinder.c - a tube, felt from within and from without; without end, or of a length
 * and then with caps if wanted. */
#include "wall_tube.h"

static const struct key keys[] = {{0}};

static void *read(struct scene *scene, const char *name, const struct domain *d)
{
    const double radius = scene_real(scene, "wall", name, "radius");
    const bool endless = scene_word(scene, "wall", name, "length", "endless");
    return wall_tube_read(scene, name, d, radius, radius, endless);
}

const struct wall_kind wall_cylinder = {
    .name = "cylinder",
    .summary = "a tube (point, axis, radius, length, caps)",
    .keys = keys,
    .read = read,
    WALL_TUBE_REST,
};
