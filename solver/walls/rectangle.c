/* solver/walls/rectangle.c - a flat plate with a rim, felt from both sides. */
#include "wall_kind.h"

struct plate {
    vec3 corner, edge[2]; /* m */
};

static const struct key keys[] = {
    {"wall", "corner", KEY_VECTOR, "m", "(-inf, inf)", NULL, "a corner of the rectangle"},
    {"wall", "edge1", KEY_VECTOR, "m", "(-inf, inf)", NULL, "from the corner along one edge"},
    {"wall", "edge2", KEY_VECTOR, "m", "(-inf, inf)", NULL,
     "from the corner along the other edge, at a right angle"},
    {0},
};

static void *read(struct scene *scene, const char *name, const struct domain *d)
{
    struct plate *const p = xalloc(1, sizeof *p);
    (void)d;
    p->corner = scene_vector(scene, "wall", name, "corner");
    wall_unit_vector(scene, name, "edge1"); /* not zero */
    wall_unit_vector(scene, name, "edge2");
    p->edge[0] = scene_vector(scene, "wall", name, "edge1");
    p->edge[1] = scene_vector(scene, "wall", name, "edge2");
    const double lengths = v3_norm(p->edge[0]) * v3_norm(p->edge[1]);
    if (fabs(v3_dot(p->edge[0], p->edge[1])) > 1e-9 * lengths)
        scene_error(scene, "wall", name, "edge2", "must be at a right angle to edge1");
    return p;
}

static void view(const void *shape, int element, const vec3 *x, struct wall_view *out)
{
    const struct plate *const p = shape;
    (void)element;
    wall_rectangle_view(&p->corner, &p->edge[0], &p->edge[1], x, out);
}

static void views(const void *shape, struct wall_looks *l)
{
    const struct plate *const p = shape;
    wall_rectangle_views(&p->corner, &p->edge[0], &p->edge[1], l);
}

static bool flat(const void *shape, int element, const vec3 *x, struct wall_flat *plane,
                 double *within)
{
    const struct plate *const p = shape;
    (void)element;
    return wall_rectangle_flat(&p->corner, &p->edge[0], &p->edge[1], x, plane, within);
}

static void bounds(const void *shape, vec3 *low, vec3 *high)
{
    const struct plate *const p = shape;
    const vec3 e = p->edge[0], f = p->edge[1], c = p->corner;
    *low = v3(c.x + fmin(0.0, e.x) + fmin(0.0, f.x), c.y + fmin(0.0, e.y) + fmin(0.0, f.y),
              c.z + fmin(0.0, e.z) + fmin(0.0, f.z));
    *high = v3(c.x + fmax(0.0, e.x) + fmax(0.0, f.x), c.y + fmax(0.0, e.y) + fmax(0.0, f.y),
               c.z + fmax(0.0, e.z) + fmax(0.0, f.z));
}

static int corners(const void *shape, int element, vec3 out[4])
{
    const struct plate *const p = shape;
    (void)element;
    out[0] = p->corner;
    out[1] = v3_add(p->corner, p->edge[0]);
    out[2] = v3_add(out[1], p->edge[1]);
    out[3] = v3_add(p->corner, p->edge[1]);
    return 4;
}

static void draw(const void *shape, struct wall_canvas *canvas)
{
    const struct plate *const p = shape;
    const vec3 a = v3_add(p->corner, p->edge[0]), b = v3_add(p->corner, p->edge[1]);
    canvas->triangle(canvas, p->corner, a, b);
    canvas->triangle(canvas, a, v3_add(a, p->edge[1]), b);
}

const struct wall_kind wall_rectangle = {.name = "rectangle",
                                         .summary = "a flat plate (corner, edge1, edge2)",
                                         .keys = keys,
                                         .read = read,
                                         .free = xfree,
                                         .elements = wall_single,
                                         .view = view,
                                         .views = views,
                                         .flat = flat,
                                         .corners = corners,
                                         .bounds = bounds,
                                         .draw = draw};
