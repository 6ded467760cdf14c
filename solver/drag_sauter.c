/* drag_sauter.c - the mean diameter of the grains of each cell, by volume over surface; a file of its own
 * so that a dry scene, which reports on its grains' drag too, links neither sums over cells nor
 * transforms. */
#include "drag_grains.h"

#include "diffuse.h"
#include "sim.h"
#include "spread.h"

void drag_grains_sauter(struct sim *s, const double *volume)
{
    struct coupling *const c = &s->coupling;
    double *const out = c->drag_of.sauter;
    if (!out)
        return;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++)
        c->values[(size_t)i * SPREAD_STRIDE] = s->grains.volume[i] / drag_grains_diameter(s, i);
    spread_columns(&c->spread, NULL, c->values, 1, &c->drag_of.sauter);
    if (c->diffuse)
        diffuse_apply(c->diffuse, out);
#pragma omp parallel for schedule(static)
    for (size_t at = 0; at < s->grid.total; at++)
        out[at] = out[at] > 0.0 ? volume[at] / out[at] : 1.0;
}
