/* solver/walls/disc.c - a flat disc, with a hole if wanted, felt from both sides. */
#include "wall_kind.h"

static const struct key keys[] = {
    {"wall", "hole", KEY_REAL, "m", "[0, inf)", "0 m", "inner radius of a disc"},
    {0},
};

static void *read(struct scene *scene, const char *name, const struct domain *d)
{
    struct wall_strip *const s = xalloc(1, sizeof *s);
    (void)d;
    s->foot = scene_vector(scene, "wall", name, "point");
    s->axis = wall_unit_vector(scene, name, "normal");
    s->r0 = scene_real(scene, "wall", name, "hole");
    s->r1 = scene_real(scene, "wall", name, "radius");
    if (s->r0 >= s->r1 && scene_given(scene, "wall", name, "hole"))
        scene_error(scene, "wall", name, "hole", "must be smaller than the radius, %g m",
                    s->r1);
    return s;
}

static void view(const void *shape, int element, const vec3 *x, struct wall_view *out)
{
    (void)element;
    wall_strip_view(shape, x, out);
}

static void views(const void *shape, struct wall_looks *l)
{
    wall_strip_views(shape, 1, l);
}

static bool flat(const void *shape, int element, const vec3 *x, struct wall_flat *plane,
                 double *within)
{
    (void)element;
    return wall_strip_flat(shape, x, plane, within);
}

static void bounds(const void *shape, vec3 *low, vec3 *high)
{
    wall_strip_bounds(shape, low, high);
}

static double sweep(const void *shape, vec3 point, vec3 axis)
{
    return wall_strip_sweep(shape, point, axis);
}

static void draw(const void *shape, struct wall_canvas *c)
{
    wall_strip_draw(shape, c);
}

const struct wall_kind wall_disc = {.name = "disc",
                                    .summary =
                                        "a flat disc or ring (point, normal, radius, hole)",
                                    .keys = keys,
                                    .read = read,
                                    .free = xfree,
                                    .elements = wall_single,
                                    .view = view,
                                    .views = views,
                                    .flat = flat,
                                    .bounds = bounds,
                                    .sweep = sweep,
                                    .draw = draw};
