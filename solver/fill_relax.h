/* fill_relax.h - pushes overlapping spheres apart: the energy of soft repulsive springs, made
 * least. Without friction, inertia or gravity; for filling a box, and for measuring packings. */
#ifndef FILL_RELAX_H
#define FILL_RELAX_H

#include "fill_grid.h"

/* A box for whole grains. A side that is open (a periodic one) lets centres go up to it and past. */
struct fill_region {
    double from[3], to[3]; /* m */
    bool open[3];
};

/* When to stop. */
struct relax_goal {
    double swell;   /* diameters are taken this part larger, so that the real ones end apart */
    double overlap; /* of the real diameters, as part of the smaller: good enough */
    double
        balance; /* largest net force over the mean force of a contact: good enough; 0: never */
    int sweeps;  /* at most */
};

struct relaxed {
    double overlap; /* largest, of the real diameters, as part of the smaller diameter */
    double balance; /* see above */
    int sweeps;
};

/* Moves the grains from index `first` on, each within region[its species]; the others stay. Their
 * order changes: they are sorted by place. */
struct relaxed fill_relax(struct fill_grid *b, int first, const struct fill_region *region,
                          const struct relax_goal *goal);

#endif
