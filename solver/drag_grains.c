/* drag_grains.c - the grains as the laws of drag see them, see drag_grains.h. */
#include "drag_grains.h"

#include <stdlib.h>
#include <string.h>
#include "../drag/drag.h"
#include "sim.h"

#define SHAPE_AUTO "auto | (0, inf)"

const struct key drag_grains_keys[] = {
    {"grains", "sphericity", KEY_REAL, "1", "auto | (0, 1]", "auto",
     "surface of the sphere of equal volume over the grain's own, for the drag; auto: of its "
     "shape"},
    {"grains", "crosswise_sphericity", KEY_REAL, "1", SHAPE_AUTO, "auto",
     "section of that sphere over the area of the grain seen along the flow; auto: 1"},
    {"grains", "lengthwise_sphericity", KEY_REAL, "1", SHAPE_AUTO, "auto",
     "section of that sphere over (half the grain's surface - mean area seen along the flow); "
     "auto: the crosswise one"},
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

void drag_grains_read(struct sim *s, struct scene *scene)
{
    struct drag_grains *const g = &s->coupling.drag_of;
    const char *const *names;
    scene_declare(scene, drag_grains_keys);
    const int n = scene_names(scene, "grains", &names);
    g->kind = xalloc((size_t)n + 1, sizeof *g->kind);
    for (int k = 0; k < n; k++) {
        const char *const name = names[k];
        struct drag_grain *const d = &g->kind[k];
        d->sphericity = shape_number(scene, name, "sphericity", DRAG_SPHERICITY, 1.0);
        d->crosswise = shape_number(scene, name, "crosswise_sphericity", DRAG_CROSSWISE, 1.0);
        d->lengthwise =
            shape_number(scene, name, "lengthwise_sphericity", DRAG_LENGTHWISE, d->crosswise);
        d->circularity = shape_number(scene, name, "circularity", DRAG_CIRCULARITY, 1.0);
        d->density_ratio = scene_real(scene, "grains", name, "density") / s->fluid.rho;
    }
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
    xfree(s->coupling.drag_of.kind);
    xfree(s->coupling.drag_of.sauter);
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
