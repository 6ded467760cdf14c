/* shares_grain.c - grains of any shape on the grid, see shares_grain.h. */
#include "shares_grain.h"

#include "../shapes/shape.h"
#include "scene.h"
#include "volume_parts.h"

const struct key shares_grain_keys[] = {
    {"porosity", "parts", KEY_INT, "", "[2, 100]", "12",
     "parts across the volume-equivalent diameter of a grain that is no sphere, in which its "
     "volume is put on the grid"},
    {0},
};

static double widest = 1.0; /* of all species: reach of the parts over the bounding radius */

void shares_grain_create(struct grains *g, struct scene *scene)
{
    if (!shape.parts || g->parts)
        return;
    scene_declare(scene, shares_grain_keys);
    const double spacing = 2.0 / scene_int(scene, "porosity", NULL, "parts");
    g->parts = xalloc((size_t)g->n_species + 1, sizeof *g->parts);
    widest = 1.0;
    for (int k = 0; k < g->n_species && scene_errors(scene) == 0; k++) {
        int n = 0;
        struct shape_part *const part = shape.parts(k, spacing, &n);
        g->parts[k] = parts_of(part, n);
        xfree(part);
        widest = fmax(widest, g->parts[k].reach / g->species[k].form.bounding);
    }
}

void shares_grain_free(struct grains *g)
{
    for (int k = 0; g->parts && k < g->n_species; k++)
        parts_free(&g->parts[k]);
    xfree(g->parts);
    g->parts = NULL;
}

int shares_grain_most(const struct grid *grid, double radius)
{
    return shares_ball_most(grid, widest * radius);
}

int shares_grain(const struct grid *grid, const struct domain *d, const struct grains *g, int i,
                 double scale, struct share *out)
{
    const struct parts *const p = g->parts ? &g->parts[g->kind[i]] : NULL;
    if (!p || p->n == 0)
        return shares_ball(grid, d, g->pos[i], scale * g->radius[i], out);
    const struct mat3 turn = quat_matrix(g->orientation ? g->orientation[i] : quat_one());
    const double size = scale * g->radius[i] / g->species[g->kind[i]].form.bounding;
    return shares_parts(grid, d, p, g->pos[i], &turn, size, out);
}
