/* contact_block.h - a block of contacts in the making: filled contact by contact from the bodies,
 * worked through shape and laws as a structure of arrays, stored contact by contact.
 *
 * The rows of a block are copies of four numbers of a body (or their difference), one row a
 * contact; the laws want arrays, one entry a contact. Turning the one into the other is done by
 * plain loops over fixed strides, which the compiler does with shuffles. */
#ifndef CONTACT_BLOCK_H
#define CONTACT_BLOCK_H

#include "../shapes/shape.h"
#include "body.h"

struct sim;

/* What a run of grains reports of a step. */
struct report {
    double4 skeleton;     /* N, on frozen grains by the others, at this step */
    double4 skeleton_sum; /* N, over the steps since it was last collected */
    long touching;        /* contacts; when asked */
    double overlap;       /* largest, over the smaller radius; when asked */
    double energy;        /* J, when asked */
    bool too_deep;        /* a contact is deeper than run.overlap_max */
};

struct sums {              /* of the contacts of a grain in one run */
    double4 force, torque; /* N, N m */
};

struct block {
    int n;                              /* contacts so far, TOUCH at most */
    struct candidates c;                /* the same, as shapes see them */
    bool fresh, walls;                  /* some contact is new; some is with a wall */
    int from[TOUCH];                    /* grain i in the sums of the run */
    int to[TOUCH];                      /* grain j there; -1 - index of a wall */
    unsigned char *live[TOUCH];         /* of the slot */
    real *memory[TOUCH];                /* of the slot */
    coordinate4 d[TOUCH];               /* place i - place j */
    real4 v[TOUCH];                     /* vel i - vel j; sum of inverse masses */
    real4 full[TOUCH];                  /* full i - full j */
    real4 spin_i[TOUCH], spin_j[TOUCH]; /* with the radii */
    struct touch t;
    struct levers l;
    real history[HISTORY_MAX][TOUCH];
    real4 row[3][TOUCH]; /* force, torques on i and j, on their way out */
};

void block_open(struct block *b);

/* Works the block: shape, laws, memory. Adds forces to the sums of the run, to the report and to
 * those on the walls (N, per wall), and empties the block. `asked`: energy and counts are
 * wanted. */
void block_work(struct sim *s, struct block *b, struct sums *sums, struct report *report,
                double4 *wall_force, bool asked);

#endif
