/* drag_grains.c - the grains as the laws of drag see them, see drag_grains.h. */
#include "drag_grains.h"

#include <stdlib.h>
#include <string.h>
#include "../drag/drag.h"
#include "../shapes/shape.h"
#include "shadow.h"
#include "sim.h"

#define SHAPE_AUTO "auto | (0, inf)"

const struct key drag_grains_keys[] = {
    {"grains", "sphericity", KEY_REAL, "1", "auto | (0, 1]", "auto",
     "surface of the sphere of equal volume over the grain's own, for the drag; auto: of its "
     "shape"},
    {"grains", "crosswise_sphericity", KEY_REAL, "1", SHAPE_AUTO, "auto",
     "section of that sphere over the area of the grain seen along the flow; auto: of its "
     "shape as "
     "it lies"},
    {"grains", "lengthwise_sphericity", KEY_REAL, "1", SHAPE_AUTO, "auto",
     "section of that sphere over (half the grain's surface - mean area seen along the flow); "
     "auto: of its shape as it lies; of a sphere with a crosswise one, that"},
    {"grains", "circularity", KEY_REAL, "1", "auto | [1, inf)", "auto",
     "of its outline, for the drag; auto: 1"},
    {0},
};

/* The number of shape asked for, or `standard` for auto. One that the law does not read is
 * refused: silence would be a wrong answer. */
static double shape_number(struct scene *scene, const char *species, const char *key,
                           enum drag_shape which, double standard)
{
    if (!(drag_limits.shape & which) && scene_given(scene, "grains", species, key))
        scene_error(scene, "grains", species, key, "drag = %s does not depend on it%s",
                    drag_about.name,
                    drag_limits.shape ? "" : ": it takes every grain for a sphere");
    if (scene_word(scene, "grains", species, key, "auto"))
        return standard;
    return scene_real(scene, "grains", species, key);
}

/* Of the species' shape. */
static double own_sphericity(const struct sim *s, struct scene *scene, int k)
{
    const double own = k < s->grains.n_species ? s->grains.species[k].form.sphericity : 1.0;
    if (isfinite(own))
        return own;
    const char *const name = s->grains.species[k].name;
    if ((drag_limits.shape & DRAG_SPHERICITY) &&
        scene_word(scene, "grains", name, "sphericity", "auto"))
        scene_error(scene, "grains", name, "sphericity", "is not known of shape = %s; give it",
                    shape_about.name);
    return 1.0;
}

static double crosswise_of(const void *species, vec3 way)
{
    return shape.crosswise(*(const int *)species, way);
}

struct seen_along {
    const struct shadow *across;
    double sphericity;
};

/* Section of the sphere, pi, over half the surface, 2 pi/sphericity, less the mean shadow along
 * directions across the flow [HoelzerSommerfeld08]. */
static double lengthwise_of(const void *data, vec3 way)
{
    enum { AROUND = 12 };
    const struct seen_along *const a = data;
    const vec3 u = fabs(way.z) < 0.7 ? v3(-way.y, way.x, 0.0) : v3(0.0, -way.z, way.y);
    const vec3 e = v3_scale(1.0 / v3_norm(u), u), f = v3_cross(way, e);
    double mean = 0.0;
    for (int k = 0; k < AROUND; k++) {
        const double angle = 3.14159265358979323846 * k / AROUND;
        mean += 1.0 / AROUND /
                shadow_area(a->across, v3_axpy(v3_scale(cos(angle), e), sin(angle), f));
    }
    return 1.0 / fmax(2.0 / a->sphericity - mean, 0.1);
}

/* Tables of the directions of species k, where the law reads such numbers and none is given. */
static void by_direction(struct drag_grains *g, struct scene *scene, const char *name, int k)
{
    const unsigned wanted = drag_limits.shape & (DRAG_CROSSWISE | DRAG_LENGTHWISE);
    if (!wanted || !shape.crosswise || scene_errors(scene) > 0 ||
        !scene_word(scene, "grains", name, "crosswise_sphericity", "auto"))
        return;
    g->across[k] = shadow_of(crosswise_of, &k);
    const struct seen_along a = {.across = g->across[k], .sphericity = g->kind[k].sphericity};
    if ((wanted & DRAG_LENGTHWISE) &&
        scene_word(scene, "grains", name, "lengthwise_sphericity", "auto"))
        g->along[k] = shadow_of(lengthwise_of, &a);
}

void drag_grains_read(struct sim *s, struct scene *scene)
{
    struct drag_grains *const g = &s->coupling.drag_of;
    const char *const *names;
    scene_declare(scene, drag_grains_keys);
    const int n = scene_names(scene, "grains", &names);
    g->kind = xalloc((size_t)n + 1, sizeof *g->kind);
    g->across = xalloc((size_t)n + 1, sizeof(struct shadow *));
    g->along = xalloc((size_t)n + 1, sizeof(struct shadow *));
    g->n_kinds = n;
    for (int k = 0; k < n; k++) {
        const char *const name = names[k];
        struct drag_grain *const d = &g->kind[k];
        d->sphericity = shape_number(scene, name, "sphericity", DRAG_SPHERICITY,
                                     own_sphericity(s, scene, k));
        d->crosswise = shape_number(scene, name, "crosswise_sphericity", DRAG_CROSSWISE, 1.0);
        d->lengthwise =
            shape_number(scene, name, "lengthwise_sphericity", DRAG_LENGTHWISE, d->crosswise);
        d->circularity = shape_number(scene, name, "circularity", DRAG_CIRCULARITY, 1.0);
        d->density_ratio = scene_real(scene, "grains", name, "density") / s->fluid.rho;
        by_direction(g, scene, name, k);
    }
}

const struct drag_grain *drag_grains_seen(const struct sim *s, int i, vec3 slip,
                                          struct drag_grain *own)
{
    const struct drag_grains *const g = &s->coupling.drag_of;
    const int k = s->grains.kind[i];
    const double speed = v3_norm(slip);
    if (!g->across[k] || !s->grains.orientation)
        return &g->kind[k];
    const struct mat3 turn = quat_matrix(s->grains.orientation[i]);
    const vec3 way =
        speed > 0.0 ? v3_scale(1.0 / speed, mat3_back(&turn, slip)) : v3(0.0, 0.0, 1.0);
    *own = g->kind[k];
    own->crosswise = shadow_area(g->across[k], way);
    if (g->along[k])
        own->lengthwise = shadow_area(g->along[k], way);
    drag_prepare(own);
    return own;
}

double drag_grains_diameter(const struct sim *s, int i)
{
    return cbrt(6.0 / 3.14159265358979323846 * s->grains.volume[i]);
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* m; 10 % of the volume of the grains is of smaller diameter. */
static double d10(const struct sim *s)
{
    const int n = s->grains.n;
    double *const volume = xalloc((size_t)n + 1, sizeof *volume), total = 0.0, sum = 0.0;
    int i = 0;
    for (int k = 0; k < n; k++)
        total += volume[k] = s->grains.volume[k];
    qsort(volume, (size_t)n, sizeof *volume, by_size);
    while (i < n - 1 && (sum += volume[i]) < 0.1 * total)
        i++;
    const double d = n > 0 ? cbrt(6.0 / 3.14159265358979323846 * volume[i]) : 1.0;
    xfree(volume);
    return d;
}

void drag_grains_create(struct sim *s)
{
    struct drag_grains *const g = &s->coupling.drag_of;
    const double effective = d10(s);
    for (int k = 0; k < s->grains.n_species; k++) {
        g->kind[k].d10 = effective;
        drag_prepare(&g->kind[k]);
    }
    if (drag_limits.sauter)
        g->sauter = grid_field(&s->grid);
}

void drag_grains_free(struct sim *s)
{
    struct drag_grains *const g = &s->coupling.drag_of;
    for (int k = 0; k < g->n_kinds; k++) {
        shadow_free(g->across[k]);
        shadow_free(g->along[k]);
    }
    xfree(g->across);
    xfree(g->along);
    xfree(g->kind);
    xfree(g->sauter);
}

void drag_grains_warn(struct sim *s)
{
    struct drag_grains *const g = &s->coupling.drag_of;
    if (g->told || g->outside == 0)
        return;
    g->told = true;
    fprintf(stderr,
            "silt: warning: at t = %g s %d of %d grains are outside the range of drag = %s "
            "(%s); told once, the summary counts them at the end\n",
            s->t, g->outside, s->grains.n, drag_about.name, drag_about.range);
}

void drag_grains_report(struct sim *s)
{
    if (s->fluid.exists)
        summary_number(&s->summary, "drag_outside_range", s->coupling.drag_of.outside, "1");
}
