/* fill_patterns.h - the inside of fill*.c: one species to be placed, and the ways to place it
 * that leave nothing to chance. What cannot be placed goes on the scene's list of errors. */
#ifndef FILL_PATTERNS_H
#define FILL_PATTERNS_H

#include "fill_relax.h"
#include "size_distribution.h"

struct fill_task {
    struct scene *scene;
    const char *name; /* of the species */
    int species;      /* its index */
    const struct sizes *sizes;
    double bounding;  /* diameter of the bounding sphere over that of the sizes */
    struct quat axes; /* of the form, see grains.h */
    double widest;    /* m, bounding diameter of the largest */
    struct fill_region region;
    const struct sim *walls; /* of which its grains keep clear; NULL: none */
    double room;             /* m3 of the region that walls leave */
    int n;                   /* grains asked for (unit_cell, file: what there is) */
    double *diameter;        /* m, of the bounding spheres, n of them, in the order drawn */
    unsigned long seed;
};

/* Motion of the first n grains, where a file gives it; vel.x is NAN for those of no file. */
struct fill_motion {
    int n, capacity;
    vec3 *vel, *spin;  /* m/s, rad/s */
    struct quat *turn; /* as in fill.h */
};

/* Bounds of the centres of grains of radius r. */
static inline void region_bounds(const struct fill_region *g, double r, double lo[3],
                                 double hi[3])
{
    for (int a = 0; a < 3; a++) {
        lo[a] = g->open[a] ? g->from[a] : g->from[a] + r;
        hi[a] = g->open[a] ? g->to[a] : g->to[a] - r;
    }
    if (g->flat)
        lo[1] = hi[1] = g->middle;
}

static inline double region_volume(const struct fill_region *g)
{
    return (g->to[0] - g->from[0]) * (g->to[1] - g->from[1]) * (g->to[2] - g->from[2]);
}

void fill_lattice(struct fill_grid *b, const struct fill_task *t);
void fill_unit_cell(struct fill_grid *b, const struct fill_task *t);
void fill_point(struct fill_grid *b, const struct fill_task *t);
void fill_from_file(struct fill_grid *b, const struct fill_task *t, struct fill_motion *m);

#endif
