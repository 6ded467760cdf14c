/* grid.c - the regular grid: its strides, its fields, their ghosts. */
#include "grid.h"

#include <omp.h>

void grid_create(struct grid *g, const struct domain *d)
{
    g->volume = 1.0;
    g->total = 1;
    for (int a = 0; a < 3; a++) {
        g->n[a] = d->cells[a];
        g->h[a] = d->size[a] / d->cells[a];
        g->volume *= g->h[a];
        g->total *= (size_t)g->n[a] + 2;
    }
    g->sj = g->n[0] + 2;
    g->sk = g->sj * (g->n[1] + 2);
    g->s[0] = 1;
    g->s[1] = g->sj;
    g->s[2] = g->sk;
}

double *grid_field(const struct grid *g)
{
    return xalloc(g->total, sizeof(double));
}

/* Copies layer `from` to layer `to` of direction a, ghosts of the directions before it
 * included. */
static void copy_layer(const struct grid *g, double *f, int a, int to, int from)
{
    const int near = a == 0 ? 1 : 0,
              far = a == 2 ? 1 : 2; /* the other two, as memory has them */
#pragma omp parallel for schedule(static) if (g->total > GRID_SMALL)
    for (int k = 0; k <= g->n[far] + 1; k++)
        for (int j = 0; j <= g->n[near] + 1; j++) {
            const int at = j * g->s[near] + k * g->s[far];
            f[at + to * g->s[a]] = f[at + from * g->s[a]];
        }
}

void grid_ghosts(const struct grid *g, const struct domain *d, double *field)
{
    for (int a = 0; a < 3; a++) { /* the later directions fill edges and corners */
        copy_layer(g, field, a, 0, d->periodic[a] ? g->n[a] : 1);
        copy_layer(g, field, a, g->n[a] + 1, d->periodic[a] ? 1 : g->n[a]);
    }
}

void grid_face_mean(const struct grid *g, const struct domain *dom, const double *cells, int a,
                    double *faces)
{
    const int step = g->s[a], b = (a + 1) % 3, d = (a + 2) % 3;
#pragma omp parallel for schedule(static)
    for (int k = 0; k <= g->n[d] + 1; k++)
        for (int j = 0; j <= g->n[b] + 1; j++) {
            const int at = j * g->s[b] + k * g->s[d];
            for (int i = g->n[a] + 1; i >= 1; i--) /* downwards: in place too */
                faces[at + i * step] =
                    0.5 * (cells[at + i * step] + cells[at + (i - 1) * step]);
            faces[at] = faces[at + (dom->periodic[a] ? g->n[a] : 1) * step];
        }
}

void grid_slab(const struct grid *g, int *lo, int *hi)
{
    const int threads = omp_get_num_threads(), me = omp_get_thread_num(), layers = g->n[2] + 2;
    *lo = g->sk * (int)((long)layers * me / threads);
    *hi = g->sk * (int)((long)layers * (me + 1) / threads);
}
