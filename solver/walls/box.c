/* solver/walls/box.c - the six sides of a box along the axes, felt from within and from without. */
#include "wall_kind.h"

struct box {
    double low[3], high[3]; /* m */
    int side;
};

enum { SIDE_BOTH, SIDE_IN, SIDE_OUT };

static const struct key keys[] = {
    {"wall", "from", KEY_VECTOR, "m", "(-inf, inf)", NULL, "lowest corner of the box"},
    {"wall", "to", KEY_VECTOR, "m", "(-inf, inf)", NULL, "highest corner of the box"},
    {0},
};

static void *read(struct scene *scene, const char *name, const struct domain *d)
{
    struct box *const b = xalloc(1, sizeof *b);
    const vec3 low = scene_vector(scene, "wall", name, "from");
    const vec3 high = scene_vector(scene, "wall", name, "to");
    (void)d;
    *b = (struct box){{low.x, low.y, low.z}, {high.x, high.y, high.z}, 0};
    b->side = scene_choice(scene, "wall", name, "side");
    for (int a = 0; a < 3; a++)
        if (scene_given(scene, "wall", name, "to") && !(b->high[a] > b->low[a])) {
            scene_error(scene, "wall", name, "to",
                        "must be above `from` in %c: the box is "
                        "inside out",
                        'x' + a);
            break;
        }
    return b;
}

static int elements(const void *shape)
{
    (void)shape;
    return 6;
}

static vec3 corner(const struct box *b, int side, vec3 edge[2])
{
    const int axis = side / 2, p = (axis + 1) % 3, q = (axis + 2) % 3;
    double at[3] = {b->low[0], b->low[1], b->low[2]}, e[3] = {0.0}, f[3] = {0.0};
    at[axis] = side % 2 ? b->high[axis] : b->low[axis];
    e[p] = b->high[p] - b->low[p];
    f[q] = b->high[q] - b->low[q];
    edge[0] = v3(e[0], e[1], e[2]);
    edge[1] = v3(f[0], f[1], f[2]);
    return v3(at[0], at[1], at[2]);
}

static void view(const void *shape, int element, const vec3 *x, struct wall_view *out)
{
    vec3 edge[2];
    const vec3 at = corner(shape, element, edge);
    wall_rectangle_view(&at, &edge[0], &edge[1], x, out);
}

/* Like rectangles along the axes: across its own axis a face lies at one height, along the others it
 * ends at the edges. */
static void views(const void *shape, struct wall_looks *l)
{
    const struct box *const b = shape;
    const double lx = b->low[0], ly = b->low[1], lz = b->low[2];
    const double hx = b->high[0], hy = b->high[1], hz = b->high[2];
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const int axis = l->element[c] / 2, end = l->element[c] % 2;
        const double x = l->x[c], y = l->y[c], z = l->z[c];
        const double px = axis == 0 ? (end ? hx : lx) : x < lx ? lx : x > hx ? hx : x;
        const double py = axis == 1 ? (end ? hy : ly) : y < ly ? ly : y > hy ? hy : y;
        const double pz = axis == 2 ? (end ? hz : lz) : z < lz ? lz : z > hz ? hz : z;
        const int beside =
            ((axis != 0) & (px != x)) + ((axis != 1) & (py != y)) + ((axis != 2) & (pz != z));
        l->ax[c] = x - px;
        l->ay[c] = y - py;
        l->az[c] = z - pz;
        l->curvature[c] = 0.0;
        l->part[c] = beside;
    }
}

static bool flat(const void *shape, int element, const vec3 *x, struct wall_flat *plane,
                 double *within)
{
    vec3 edge[2];
    const vec3 at = corner(shape, element, edge);
    return wall_rectangle_flat(&at, &edge[0], &edge[1], x, plane, within);
}

static bool behind(const void *shape, vec3 x)
{
    const struct box *const b = shape;
    const double at[3] = {x.x, x.y, x.z};
    bool inside = true;
    for (int a = 0; a < 3; a++)
        inside = inside && at[a] > b->low[a] && at[a] < b->high[a];
    return b->side == SIDE_IN ? !inside : b->side == SIDE_OUT && inside;
}

static int corners(const void *shape, int element, vec3 out[4])
{
    vec3 edge[2];
    out[0] = corner(shape, element, edge);
    out[1] = v3_add(out[0], edge[0]);
    out[2] = v3_add(out[1], edge[1]);
    out[3] = v3_add(out[0], edge[1]);
    return 4;
}

static void bounds(const void *shape, vec3 *low, vec3 *high)
{
    const struct box *const b = shape;
    *low = v3(b->low[0], b->low[1], b->low[2]);
    *high = v3(b->high[0], b->high[1], b->high[2]);
}

static void draw(const void *shape, struct wall_canvas *canvas)
{
    for (int side = 0; side < 6; side++) {
        vec3 edge[2];
        const vec3 at = corner(shape, side, edge), a = v3_add(at, edge[0]),
                   b = v3_add(at, edge[1]);
        canvas->triangle(canvas, at, a, b);
        canvas->triangle(canvas, a, v3_add(a, edge[1]), b);
    }
}

const struct wall_kind wall_box = {.name = "box",
                                   .summary = "the six sides of a box (from, to)",
                                   .keys = keys,
                                   .read = read,
                                   .free = xfree,
                                   .elements = elements,
                                   .view = view,
                                   .views = views,
                                   .flat = flat,
                                   .behind = behind,
                                   .corners = corners,
                                   .bounds = bounds,
                                   .draw = draw};
