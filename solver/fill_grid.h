/* fill_grid.h - spheres placed so far, and which of them are near a point.
 *
 * One search grid per size class, a factor of two wide each: looking around a grain costs the same
 * few cells per class however much the sizes differ, where a single grid of the largest size
 * would hold thousands of small grains a cell. */
#ifndef FILL_GRID_H
#define FILL_GRID_H

#include "domain.h"
#include "fill.h"

enum { FILL_LEVELS = 12 }; /* sizes of 4096:1 and more share the last */

struct fill_level {
    int cells[3];
    double edge[3];
    int *first;     /* per cell: a grain, or -1 */
    double largest; /* m, diameter of those on it */
    int n;
};

struct fill_grid {
    const struct domain *domain;
    double widest; /* m, diameter of the first level */
    int n_most;    /* grains expected: no more cells than a few for each */
    struct fill_level level[FILL_LEVELS];
    int n, capacity;
    struct placed *grain;
    int *next; /* the next grain of the cell, or -1 */
};

void fill_grid_open(struct fill_grid *b, const struct domain *d, double widest, int n_most);
void fill_grid_close(struct fill_grid *b); /* frees all of it, grains too */
void fill_grid_clear(struct fill_grid *b); /* forgets the grains */

void fill_grid_add(struct fill_grid *b, struct placed p);

/* Largest overlap of a sphere with those placed, as part of the smaller diameter; stops looking
 * at the first beyond `enough`. */
double fill_grid_overlap(const struct fill_grid *b, vec3 x, double diameter, double enough);

/* Indices of the grains whose surfaces are nearer than `gap` m to that of grain i, i itself left
 * out; up to `most` of them in `out`; returns how many there are. */
int fill_grid_near(const struct fill_grid *b, int i, double gap, int *out, int most);

struct sim;
/* fill_check.c: spheres that start too deep in a side of the box or in one another, on the scene's list
 * of errors; `names` of the species. */
void fill_check(const struct sim *s, struct scene *scene, const struct fill_grid *b,
                const char *const *names);

#endif
