/* solver/walls/mesh.c - a surface of triangles from an STL file, felt from both sides.
 *
 * x = shift + R (scale X): X in the file, R turns about x, then y, then z. Triangles longer than 0.4 of a
 * period are cut (mesh_split). */
#include "../bed_file.h"
#include "../mesh.h"

static const struct key keys[] = {
    {"wall", "file", KEY_TEXT, "", "", NULL,
     "STL file of a mesh, beside the scene or from here"},
    {"wall", "scale", KEY_REAL, "m", "(0, inf)", "1 m", "length that 1 stands for in the file"},
    {"wall", "rotation", KEY_VECTOR, "rad", "(-inf, inf)", "0 0 0 rad",
     "turns of the mesh about x, then y, then z"},
    {"wall", "shift", KEY_VECTOR, "m", "(-inf, inf)", "0 0 0 m",
     "shift of the mesh, after scale and rotation"},
    {0},
};

static vec3 turn(vec3 x, vec3 angle)
{
    const double a = cos(angle.x), b = sin(angle.x), c = cos(angle.y), d = sin(angle.y);
    const double e = cos(angle.z), f = sin(angle.z);
    x = v3(x.x, a * x.y - b * x.z, b * x.y + a * x.z);
    x = v3(c * x.x + d * x.z, x.y, c * x.z - d * x.x);
    return v3(e * x.x - f * x.y, f * x.x + e * x.y, x.z);
}

static void *read(struct scene *scene, const char *name, const struct domain *d)
{
    const char *const file = scene_text(scene, "wall", name, "file");
    const double scale = scene_real(scene, "wall", name, "scale");
    const vec3 angle = scene_vector(scene, "wall", name, "rotation");
    const vec3 shift = scene_vector(scene, "wall", name, "shift");
    const vec3 stand_in[3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    char *const path = bed_file_path(file, scene_path(scene));
    char *why = NULL;
    int n = 0;
    struct mesh *m = NULL;
    double longest[3];
    vec3 *corner = mesh_read_stl(path, &n, &why);
    for (int a = 0; a < 3; a++)
        longest[a] = d->periodic[a] ? 0.4 * d->size[a] : (double)INFINITY;
    for (int i = 0; corner && i < 3 * n; i++)
        corner[i] = v3_add(shift, turn(v3_scale(scale > 0.0 ? scale : 1.0, corner[i]), angle));
    if (corner) {
        const int found = n;
        m = mesh_create(corner, n, &why);
        corner = why ? corner : mesh_split(corner, &n, longest);
        if (n > found) {
            mesh_free(m);
            m = mesh_create(corner, n, &why);
        }
        if (why)
            scene_error(scene, "wall", name, "file", "%s: %s", path, why);
    } else if (file[0] != '\0') {
        scene_error(scene, "wall", name, "file", "%s", why);
    }
    xfree(corner);
    xfree(why);
    xfree(path);
    return m ? m : mesh_create(stand_in, 1, &why); /* an error is on the list */
}

static int elements(const void *shape)
{
    return ((const struct mesh *)shape)->n;
}

static void view(const void *shape, int element, const vec3 *x, struct wall_view *out)
{
    triangle_view(&((const struct mesh *)shape)->triangle[element], x, out);
}

static void views(const void *shape, struct wall_looks *l)
{
    mesh_views(shape, l);
}

static int patch(const void *shape, int element)
{
    return ((const struct mesh *)shape)->patch[element];
}

static bool flat(const void *shape, int element, const vec3 *x, struct wall_flat *plane,
                 double *within)
{
    return triangle_flat(&((const struct mesh *)shape)->triangle[element], x, plane, within);
}

static void near(const void *shape, vec3 x, double reach, struct found *out)
{
    mesh_near(shape, x, reach, out);
}

static void bounds(const void *shape, vec3 *low, vec3 *high)
{
    *low = ((const struct mesh *)shape)->low;
    *high = ((const struct mesh *)shape)->high;
}

static vec3 middle(const void *shape, int element)
{
    const struct triangle *const t = &((const struct mesh *)shape)->triangle[element];
    return v3_axpy(t->a, 1.0 / 3.0, v3_add(t->e1, t->e2));
}

static int corners(const void *shape, int element, vec3 out[4])
{
    const struct triangle *const t = &((const struct mesh *)shape)->triangle[element];
    out[0] = t->a;
    out[1] = v3_add(t->a, t->e1);
    out[2] = v3_add(t->a, t->e2);
    return 3;
}

static void draw(const void *shape, struct wall_canvas *c)
{
    const struct mesh *const m = shape;
    for (int i = 0; i < m->n; i++) {
        const struct triangle *const t = &m->triangle[i];
        c->triangle(c, t->a, v3_add(t->a, t->e1), v3_add(t->a, t->e2));
    }
}

const struct wall_kind wall_mesh = {.name = "mesh",
                                    .summary =
                                        "triangles of an STL file (file, scale, rotation, "
                                        "shift)",
                                    .keys = keys,
                                    .read = read,
                                    .free = mesh_free,
                                    .elements = elements,
                                    .view = view,
                                    .views = views,
                                    .patch = patch,
                                    .flat = flat,
                                    .near = near,
                                    .bounds = bounds,
                                    .middle = middle,
                                    .corners = corners,
                                    .draw = draw};
