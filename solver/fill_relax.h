/* fill_relax.h - pushes overlapping spheres apart: the energy of soft repulsive springs, made
 * least. Without friction, inertia or gravity; for filling a box, and for measuring packings. */
#ifndef FILL_RELAX_H
#define FILL_RELAX_H

#include "fill_grid.h"

/* A box for whole grains. A side that is open (a periodic one) lets centres go up to it and past. */
struct fill_region {
    double from[3], to[3]; /* m */
    bool open[3];
    bool flat;     /* y of all centres is the middle of the box (shape.flat) */
    double middle; /* m, that y */
};

/* At what size, and when to stop. */
struct relax_goal {
    double scale;   /* of the diameters: 1, or less while they grow */
    double swell;   /* they are taken this part larger, so that they themselves end apart */
    double overlap; /* without the swelling, as part of the smaller: good enough */
    double
        balance; /* largest net force over the mean force of a contact: good enough; 0: never */
    int sweeps;  /* at most */
    const struct sim *walls; /* whose walls they keep clear of; NULL: of none */
};

struct relaxed {
    double overlap; /* largest, without the swelling, as part of the smaller diameter */
    double balance; /* see above */
    int sweeps;
};

/* Moves the grains from index `first` on, each within region[its species]; the others stay. Their
 * order changes: they are sorted by place. A grain that does not touch a wall when this begins is
 * never pushed through it: a step is a tenth of its diameter at most, and what enters a wall is put
 * back on its surface. */
struct relaxed fill_relax(struct fill_grid *b, int first, const struct fill_region *region,
                          const struct relax_goal *goal);

#endif
