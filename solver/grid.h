/* grid.h - the regular staggered grid of the fluid.
 *
 * Interior cells 1..n in each direction, one ghost layer (0 and n+1). A field is a flat array
 * of `total` doubles; cell (i,j,k) has index c = cell(g,i,j,k), its neighbours c-1, c+1 (x),
 * c-sj, c+sj (y), c-sk, c+sk (z): u[c] - u[c-1] reads as a stencil. x is contiguous.
 *
 * Staggering: scalars at cell centres; face fields (u, v, w, and any coefficient on faces) at
 * the LOW face of their cell: u[c] is the face between c-1 and c. So x faces run from i = 1 to
 * n[0]+1; in a periodic direction face n+1 is a copy of face 1.
 *
 * Cell centre of (i,j,k): ((i - 0.5) h[0], (j - 0.5) h[1], (k - 0.5) h[2]). */
#ifndef GRID_H
#define GRID_H

#include "domain.h"

enum {
    GRID_SMALL = 16384
}; /* entries of a field, to which one thread is quicker than a team */

struct grid {
    int n[3];      /* cells */
    double h[3];   /* m */
    double volume; /* m3 of a cell */
    int sj, sk;    /* strides of j and k */
    int s[3];      /* {1, sj, sk} */
    size_t total;  /* entries of a field, ghosts included */
};

static inline int cell(const struct grid *g, int i, int j, int k)
{
    return i + g->sj * j + g->sk * k;
}

void grid_create(struct grid *g, const struct domain *d); /* owns nothing */
double *grid_field(const struct grid *g);                 /* zeroed; free with xfree */

/* Fills the ghost cells of a cell-centred field: periodic copies, else the nearest interior
 * value (zero gradient). Edges and corners too. */
void grid_ghosts(const struct grid *g, const struct domain *d, double *field);

/* Means of the two cells beside each face of direction a, ghosts of the others included; the ghosts
 * of `cells` must be filled. Beyond the first face a periodic copy, or the first face again. `faces` may be `cells`. */
void grid_face_mean(const struct grid *g, const struct domain *dom, const double *cells, int a,
                    double *faces);

/* The same of one face: of direction a for step = g->s[a]. */
static inline double grid_face(const double *cells, int c, int step)
{
    return 0.5 * (cells[c] + cells[c - step]);
}

/* The entries [lo, hi) of a field that this thread of a team owns: whole layers. */
void grid_slab(const struct grid *g, int *lo, int *hi);

#endif
