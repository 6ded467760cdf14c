/* shapes/level_set.c - a grain of any form, convex or not, given by its signed distance on a grid
 * [Kawamoto16]: the review's "virtual space" of pixels and voxels.
 *
 * The form comes from a file (grains.form): an STL surface, closed, whose distance is computed on a
 * grid of grains.form_cells over its longest edge; or netCDF with the voxels of a scan (`solid`) or
 * with the distance itself (`distance`). Its volume is that of grains.diameter. Grains touch where
 * nodes of the surface of one, grains.node_spacing apart, lie inside the other, both ways: the pair has one
 * depth, made of those of all nodes, such that the laws' elastic force is the gradient of an energy and
 * Hertz' law that of the curvature that the surfaces have there; radii for the contact law are the
 * volume-equivalent ones (solver/field_pair.c). Between nodes the surface is not felt: a depth is off by
 * about the square of the spacing over 8 radii of curvature. Walls are met by balls that cover the surface from
 * within, to 1 % of the size. */
#include "shape.h"

#include <string.h>
#include "../solver/bed_file.h"
#include "../solver/field_body.h"
#include "../solver/mesh.h"
#include "../solver/scene.h"
#include "../solver/shadow.h"

enum { PLACES = 32 }; /* points of contact of a pair, at most */

const struct about shape_about = {
    .name = "level_set",
    .summary = "grains of any form from an STL surface, voxels or a distance field",
    .equation = "overlap = -(distance field of j) at the nodes of i, and the other way round",
    .source = "[Kawamoto16]",
    .range = "features wider than 4 cells of the field; softer between nodes"};

const struct key shape_keys[] = {
    {"grains", "form", KEY_TEXT, "", "", NULL,
     "file with the form of the grain: NAME.stl, or netCDF with voxels or a distance"},
    {"grains", "form_cells", KEY_INT, "", "[8, 512]", "48",
     "nodes of the distance field over the longest edge of the form; STL"},
    {"grains", "node_spacing", KEY_REAL, "1", "[0.005, 0.5]", "0.06",
     "between the nodes of the surface, in volume-equivalent diameters"},
    {"grains", "voxel_smoothing", KEY_REAL, "1", "[0, 5]", "1",
     "standard deviation of the Gaussian that takes the stairs off voxels, in voxels"},
    {0}};

static struct form {
    struct field_body *body;
    struct shadow *shadow;
} * forms;
static int n_forms;

static struct distance_field *field_read(struct scene *scene, const char *name,
                                         const char *path, char **why)
{
    const size_t length = strlen(path);
    if (length < 4 ||
        (strcmp(path + length - 4, ".stl") != 0 && strcmp(path + length - 4, ".STL") != 0))
        return distance_read(path, scene_real(scene, "grains", name, "voxel_smoothing"), why);
    int n;
    vec3 *const corner = mesh_read_stl(path, &n, why);
    if (!corner)
        return NULL;
    struct distance_field *const f =
        distance_of_triangles(corner, n, scene_int(scene, "grains", name, "form_cells"), why);
    xfree(corner);
    return f;
}

/* Of the nodes' net, for the drag. */
static struct shadow *body_shadow(const struct field_body *b)
{
    const struct surface_net *const s = b->net;
    vec3 *const corner = xalloc(3 * (size_t)s->n_triangles + 1, sizeof *corner);
    for (int t = 0; t < s->n_triangles; t++)
        for (int k = 0; k < 3; k++)
            corner[3 * t + k] = s->at[s->triangle[t][k]];
    struct shadow *const shadow = shadow_create(corner, s->n_triangles, b->bounding);
    xfree(corner);
    return shadow;
}

static void read_form(struct scene *scene, const char *name, struct form *f,
                      struct shape_form *out)
{
    const char *const given = scene_text(scene, "grains", name, "form");
    char *why = NULL;
    if (given[0] == '\0')
        return; /* missing: it is on the list */
    char *const path = bed_file_path(given, scene_path(scene));
    struct distance_field *const field = field_read(scene, name, path, &why);
    xfree(path);
    if (field)
        f->body = field_body(field, scene_real(scene, "grains", name, "node_spacing"), &why);
    if (!f->body) {
        scene_error(scene, "grains", name, "form", "%s", why);
        xfree(why);
        return;
    }
    f->shadow = body_shadow(f->body);
    out->bounding = fmax(1.0, f->body->bounding * (1.0 + 1e-12));
    out->inertia = f->body->inertia;
    out->axes = f->body->axes;
    out->sphericity = fmin(1.0, 4.0 * 3.14159265358979323846 / f->body->area);
    out->points_most = f->body->n_balls > PLACES ? f->body->n_balls : PLACES;
}

static void init(struct scene *scene, const struct grains *g, struct shape_form *form)
{
    n_forms = g->n_species;
    forms = xalloc((size_t)n_forms + 1, sizeof *forms);
    for (int k = 0; k < n_forms; k++)
        read_form(scene, g->species[k].name, &forms[k], &form[k]);
}

static void end(void)
{
    for (int k = 0; k < n_forms; k++) {
        field_body_free(forms[k].body);
        shadow_free(forms[k].shadow);
    }
    xfree(forms);
    forms = NULL;
    n_forms = 0;
}

static int points(const struct shape_pair *p, int most, struct shape_point *out)
{
    const struct field_body *const bi = forms[p->i.species].body, *const bj =
                                                                      forms[p->j.species].body;
    const struct field_placed i = {.body = bi, .size = p->i.size, .turn = p->i.turn};
    const struct field_placed j = {.body = bj, .size = p->j.size, .turn = p->j.turn};
    struct field_touch touch[PLACES];
    double clear;
    const int n = field_meet(&i, &j, v3_scale(-1.0, p->j.centre), p->reach,
                             most < PLACES ? most : PLACES, touch, &clear);
    if (n == 0 && p->apart)
        *p->apart = clear;
    for (int k = 0; k < n; k++)
        out[k] =
            (struct shape_point){.id = touch[k].id,
                                 .depth = touch[k].depth,
                                 .normal = touch[k].normal,
                                 .at_i = touch[k].at,
                                 .at_j = v3_sub(touch[k].at, p->j.centre),
                                 .from_i = touch[k].at,
                                 .from_j = v3_sub(touch[k].at, p->j.centre),
                                 .r_i = p->i.size,
                                 .r_j = p->j.size,
                                 .scale = fmin(bi->thin * p->i.size, bj->thin * p->j.size) *
                                          (touch[k].depth / touch[k].deepest),
                                 .share = touch[k].share,
                                 .slope = touch[k].slope};
    return n;
}

static const struct shape_ball *balls(int species, int *n)
{
    *n = forms[species].body->n_balls;
    return forms[species].body->ball;
}

static void surface(int species, struct shape_canvas *c)
{
    const struct surface_net *const s = forms[species].body->net;
    for (int t = 0; t < s->n_triangles; t++)
        c->triangle(c, s->at[s->triangle[t][0]], s->at[s->triangle[t][1]],
                    s->at[s->triangle[t][2]]);
}

static struct shape_part *parts(int species, double spacing, int *n)
{
    return field_body_parts(forms[species].body, spacing, n);
}

static double crosswise(int species, vec3 flow)
{
    return 3.14159265358979323846 / shadow_area(forms[species].shadow, flow);
}

const struct shape shape = {.path = &contact_points,
                            .init = init,
                            .free = end,
                            .points = points,
                            .balls = balls,
                            .surface = surface,
                            .parts = parts,
                            .crosswise = crosswise};
