/* shapes/geometry/dilated_species.c - the keys of [grains NAME] for shapes of dilated polyhedra. */
#include "dilated_species.h"

#include <string.h>

#define PI   3.14159265358979323846
#define TILT 0.1 /* patch.h, for the envelope where cores overlap: a few degrees */

enum { FORM_MESH_CONVEX = 8, FORM_MESH_ALL = 19, POINTS_ONE = 16 };

/* Least room for points of several parts, and for each part, as bars of hollow boxes cross many. */
enum { POINTS_SEVERAL = 64, POINTS_PART = 16 };

static void refuse(struct scene *scene, const char *name, const char *key, char *why)
{
    scene_error(scene, "grains", name, key, "%s", why);
    xfree(why);
}

/* The solid of a species, in no unit. */
static bool read_solid(struct scene *scene, const char *name, bool convex, struct solid *out)
{
    const int form = scene_choice(scene, "grains", name, "form");
    const vec3 stretch = scene_vector(scene, "grains", name, "proportions");
    const char *const path = scene_text(scene, "grains", name, "mesh");
    const bool mesh = form == (convex ? FORM_MESH_CONVEX : FORM_MESH_ALL);
    char *why = NULL;
    if (!mesh) {
        if (path[0] != '\0')
            scene_error(scene, "grains", name, "mesh", "needs form = mesh");
        solid_named(out, form, scene_int(scene, "grains", name, "sides"));
    } else if (path[0] == '\0') {
        scene_error(scene, "grains", name, "form", "needs mesh = FILE");
        return false;
    } else if (!solid_of_mesh(out, path, convex, &why)) {
        refuse(scene, name, "mesh", why);
        return false;
    }
    solid_stretch(out, stretch);
    return true;
}

static double read_dilation(struct scene *scene, const char *name, double size)
{
    if (scene_word(scene, "grains", name, "dilation", "auto"))
        return 0.1;
    const double r = scene_real(scene, "grains", name, "dilation") / size;
    if (r > 1.0 + 1e-12)
        scene_error(scene, "grains", name, "dilation",
                    "must be at most half the species' diameter, %g m", size);
    return fmin(r, 1.0);
}

static double read_spacing(struct scene *scene, const char *name, bool convex, double size)
{
    if (convex || scene_word(scene, "grains", name, "mass_spacing", "auto"))
        return 0.04;
    const double h = scene_real(scene, "grains", name, "mass_spacing") / size;
    if (h > 0.5 || h < 0.004)
        scene_error(scene, "grains", name, "mass_spacing",
                    "must lie between 0.002 and 0.25 of the species' diameter, %g m",
                    2.0 * size);
    return fmin(fmax(h, 0.004), 0.5);
}

static long ids_of(const struct dilated *d)
{
    long n = 0;
    for (int a = 0; a < d->n_parts; a++)
        for (int b = 0; b < d->n_parts; b++)
            n += patch_ids(d->part[a].core, d->part[b].core);
    return n;
}

static struct dilated *read_body(struct scene *scene, const char *name, bool convex,
                                 double size)
{
    struct solid solid = {0};
    struct dilated *d = NULL;
    char *why = NULL;
    const double r = read_dilation(scene, name, size),
                 h = read_spacing(scene, name, convex, size);
    if (read_solid(scene, name, convex, &solid)) {
        d = dilated_create(&solid, r, h, &why);
        if (!d)
            refuse(scene, name, "form", why);
    }
    solid_free(&solid);
    if (d && ids_of(d) >= 1 << 21) {
        scene_error(scene, "grains", name, "mesh", "has too many parts, vertices and edges");
        dilated_free(d);
        d = NULL;
    }
    return d;
}

/* Corners that two faces can have in common. */
static int corners_of(const struct dilated *d)
{
    int most = 0;
    for (int k = 0; k < d->n_parts; k++) {
        const struct polyhedron *const p = d->part[k].core;
        for (int f = 0; f < p->n_faces; f++)
            most = p->loop_begin[f + 1] - p->loop_begin[f] > most
                       ? p->loop_begin[f + 1] - p->loop_begin[f]
                       : most;
    }
    return 2 * most < 8 ? 8 : 2 * most;
}

static void fill_form(struct dilated *d, struct shape_form *f)
{
    const int corners = corners_of(d);
    dilated_make_shadows(d);
    f->bounding = d->radius;
    f->inertia = d->inertia;
    f->axes = d->axes;
    f->sphericity = fmin(4.0 * PI / d->surface, 1.0);
    if (d->n_parts == 1)
        f->points_most = corners < POINTS_ONE ? corners : POINTS_ONE;
    else
        f->points_most = d->n_parts * POINTS_PART > POINTS_SEVERAL ? d->n_parts * POINTS_PART
                                                                   : POINTS_SEVERAL;
}

static void read_detection(struct dilated_species *s, struct scene *scene,
                           const struct grains *g)
{
    for (int k = 0; k < g->n_species; k++) {
        const char *const name = g->species[k].name;
        const struct detection d = {
            (enum detector)scene_choice(scene, "grains", name, "detector"), TILT,
            scene_real(scene, "grains", name, "smoothness")};
        if (k > 0 && (d.detector != s->how.detector || d.smoothness != s->how.smoothness))
            scene_error(scene, "grains", name, "detector",
                        "detector and smoothness must be those of every species");
        s->how = d;
    }
}

void dilated_species_read(struct dilated_species *s, bool convex, struct scene *scene,
                          const struct grains *g, struct shape_form *form)
{
    dilated_species_free(s);
    s->n = g->n_species;
    s->body = xalloc((size_t)s->n + 1, sizeof *s->body);
    s->kept = convex ? 1 : DILATED_KEPT;
    read_detection(s, scene, g);
    for (int k = 0; k < s->n; k++) {
        const struct species *const of = &g->species[k];
        if (!(of->diameter > 0.0))
            continue; /* is on the list already */
        s->body[k] = read_body(scene, of->name, convex, 0.5 * of->diameter);
        if (s->body[k])
            fill_form(s->body[k], &form[k]);
    }
}

void dilated_species_free(struct dilated_species *s)
{
    for (int k = 0; k < s->n; k++)
        dilated_free(s->body[k]);
    xfree(s->body);
    *s = (struct dilated_species){0};
}
