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

struct record { /* of a pair slot, for its other grain */
    real4 force, torque;
};

struct sums { /* of the contacts that a grain owns */
    double4 force, torque;
};

struct block {
    int n;                              /* contacts so far, TOUCH at most */
    struct candidates c;                /* the same, as shapes see them */
    int to[TOUCH];                      /* place of the record; -1 - index of a wall */
    unsigned char *live[TOUCH];         /* of the slot */
    real *memory[TOUCH];                /* of the slot */
    coordinate4 d[TOUCH];               /* place i - place j */
    real4 v[TOUCH];                     /* vel i - vel j; sum of inverse masses */
    real4 full[TOUCH];                  /* full i - full j */
    real4 spin_i[TOUCH], spin_j[TOUCH]; /* with the radii */
    int pair[TOUCH];                    /* pair of materials */
    struct touch t;
    struct levers l;
    real history[HISTORY_MAX][TOUCH];
    real4 row[3][TOUCH]; /* force, torques on i and j, on their way out */
};

/* Works the block: shape, laws, memory. Adds forces to own[i - first], to the records, to the
 * report and to those on the walls (N, per wall), and empties the block. `asked`: energy and counts are wanted. */
void block_work(struct sim *s, struct block *b, int first, struct sums *own,
                struct report *report, double4 *wall_force, bool asked);

#endif
