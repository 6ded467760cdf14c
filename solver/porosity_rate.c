/* porosity_rate.c - see porosity_rate.h. The sum over all cells is zero to round-off, so that a
 * closed box loses no volume. Sums to the grid go in the order of the grains. */
#include "porosity_rate.h"

#include <string.h>
#include "sim.h"

/* out = phi v_a, m/s, of each cell. */
static void solid_flux(const struct sim *s, int a, double *out)
{
    const struct coupling *const c = &s->coupling;
    const double inverse = 1.0 / s->grid.volume;
#pragma omp parallel if (s->grid.total > GRID_SMALL)
    {
        int lo, hi;
        grid_slab(&s->grid, &lo, &hi);
        memset(out + lo, 0, (size_t)(hi - lo) * sizeof *out);
        for (int i = 0; i < s->grains.n; i++) {
            const struct share *const w = &c->shares[(size_t)i * c->reach];
            const vec3 v = s->grains.vel[i];
            const double along = a == 0 ? (double)v.x : a == 1 ? (double)v.y : (double)v.z;
            for (int k = 0; k < c->n_shares[i]; k++)
                if (w[k].cell >= lo && w[k].cell < hi)
                    out[w[k].cell] +=
                        (double)w[k].weight * (double)s->grains.volume[i] * along * inverse;
        }
    }
    grid_ghosts(&s->grid, &s->domain, out);
}

void porosity_rate(const struct sim *s, double *scratch, double *out)
{
    const struct grid *const g = &s->grid;
    for (int a = 0; a < 3; a++) {
        const int step = g->s[a], last = g->n[a];
        const bool wrap = s->domain.periodic[a];
        const double scale = 0.5 / g->h[a];
        solid_flux(s, a, scratch);
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
        for (int k = 1; k <= g->n[2]; k++)
            for (int j = 1; j <= g->n[1]; j++)
                for (int i = 1; i <= g->n[0]; i++) {
                    const int c = cell(g, i, j, k), n = a == 0 ? i : a == 1 ? j : k;
                    const double lo = n > 1 || wrap ? scratch[c] + scratch[c - step] : 0.0;
                    const double hi = n < last || wrap ? scratch[c] + scratch[c + step] : 0.0;
                    out[c] = (a == 0 ? 0.0 : out[c]) + scale * (hi - lo);
                }
    }
}
