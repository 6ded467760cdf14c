/* fill_grow.h - a dense packing, by grains that grow to their size while they push each other apart. */
#ifndef FILL_GROW_H
#define FILL_GROW_H

#include "fill_relax.h"
#include "progress.h"

struct grow_goal {
    double overlap;          /* of the smaller diameter, that may be left at the end */
    double solid;            /* fraction of the region that the grown grains fill */
    const struct sim *walls; /* or NULL */
};

struct grown {
    double scale;   /* of the diameters, that was reached: 1 if all are grown */
    double overlap; /* the largest left then */
    int sweeps;     /* of relaxation */
    int taps;       /* growths beyond the first */
    struct progress progress;
};

/* Grows the grains from index `first` on, wherever they are and however they overlap, each within
 * region[its species], from little ones to their full diameters; the others stay. If they jam on the
 * way, scale is below 1 and they are left as they were then. */
struct grown fill_grow(struct fill_grid *b, int first, const struct fill_region *region,
                       const struct grow_goal *goal);

#endif
