/* contact_block.h - a block of contacts in the making: a list of slots, worked through shape and
 * laws as a structure of arrays, one entry a contact.
 *
 * What the laws want of the two bodies is gathered by plain loops over the contacts, which the
 * compiler turns into gathers; what they give is turned into rows of four and added to the sums
 * of the run contact by contact. */
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

struct sums {     /* of the contacts of a grain in one run */
    double8 both; /* force, N, and nothing; torque, N m, and nothing */
};

struct block {
    int n;           /* contacts so far, TOUCH at most */
    bool walls;      /* of a list of wall slots */
    int slot[TOUCH]; /* of the list */
    struct candidates c;
    struct touch t;
    struct levers l;
    _Alignas(64) real history[HISTORY_MAX][TOUCH];
    real inv_m[TOUCH];                    /* 1/kg, of both */
    real vx[TOUCH], vy[TOUCH], vz[TOUCH]; /* m/s, full step, i less j */
    real px[TOUCH], py[TOUCH], pz[TOUCH]; /* rad/s, spin of i */
    real qx[TOUCH], qy[TOUCH], qz[TOUCH]; /* rad/s, spin of j */
    real4 row[TOUCH];                     /* memory on its way in and out */
    real on[2][TOUCH][8];                 /* force and torque on i, on j, on their way out */
};

/* Where the forces of a run go. */
struct target {
    int first;         /* grain of the run */
    struct sums *sums; /* of its grains and of its halo */
    double4 *wall;     /* N, per wall */
    struct report *report;
    double time; /* s, of the state at hand */
    bool asked;  /* energy, counts and overlaps are wanted */
};

/* Works `count` slots of a list (those of pairs, or those of walls if `walls`) through shape and
 * laws, in blocks. */
void block_work(struct sim *s, struct block *b, bool walls, const int *slot, int count,
                const struct target *to);

#endif
