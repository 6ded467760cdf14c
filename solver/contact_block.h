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
    /* Of contact_points.c: contacts of a slot, where they are more than it has room for; of the last
     * contact that is too deep the grains (j = -1 - wall), its overlap and that of run.overlap_max. */
    int points, i, j;
    double deep, allowed; /* m */
};

struct sums { /* of the contacts of a grain in one run */
    union {
        double8 both;
        struct {
            double4 force, torque; /* N, N m; 0 behind each */
        };
    };
};

/* Through memory that the compiler does not look into: with gcc 12.2 at -O3, torque.x came out as
 * force.z where the lanes of a vector went straight into two vec3 that lie in a row (at -O1 it did
 * not). verify/test_wall_motion.c tells. */
static inline void sums_part(double8 both, vec3 *force, vec3 *torque)
{
    volatile double a[8];
    for (int k = 0; k < 8; k++)
        a[k] = both[k];
    *force = v3(a[0], a[1], a[2]);
    *torque = v3(a[4], a[5], a[6]);
}

struct block {
    int n;                        /* contacts so far, TOUCH at most */
    bool walls;                   /* of wall slots */
    _Alignas(64) int slot[TOUCH]; /* of the list */
    struct candidates c;
    struct touch t;
    struct levers l;
    _Alignas(64) real history[HISTORY_MAX][TOUCH];
    int wall[TOUCH];   /* of a wall contact: its wall */
    vec3 arm[TOUCH];   /* of a wall contact: m, from the wall's pivot to x_i */
    real curve[TOUCH]; /* of a wall contact: 1/m, 1/r_eff - 1/r_i */
    real inv_m[TOUCH]; /* 1/kg, of both */
    real vx[TOUCH], vy[TOUCH], vz[TOUCH]; /* m/s, full step, i less j */
    real px[TOUCH], py[TOUCH], pz[TOUCH]; /* rad/s, spin of i */
    real qx[TOUCH], qy[TOUCH], qz[TOUCH]; /* rad/s, spin of j */
    real4 row[TOUCH];                     /* memory on its way in and out */
    real on[2][TOUCH][8];                 /* force and torque on i, on j, on their way out */
    /* of the spheres of contact_block.c */
    real (*kept)[TOUCH]; /* what the laws remember, where it is kept; NULL: history */
    real arm_i[TOUCH], arm_j[TOUCH]; /* m, from the centres along the line to the point */
    /* of the points of contact_points.c */
    real *memory[TOUCH]; /* rows of the laws */
    bool was[TOUCH];     /* it overlapped at the step before */
    real share[TOUCH];   /* of the stiffness of its pair: factor of forces, couples, energy */
    real slope[TOUCH];   /* of its depth: another factor of forces and couples */
    real scale[TOUCH];   /* m, that overlap is measured by */
    bool rocks;          /* some contact has a lever */
    vec3 lever[TOUCH];   /* m, from the middle of its patch */
    vec3 couple[TOUCH];  /* N m, on i, of the dashpot of rocking */
};

/* Where the forces of a run go. */
struct target {
    int first;         /* grain of the run */
    struct sums *sums; /* of its grains and of its halo */
    struct sums *wall; /* on each wall, with the torque about its pivot */
    struct report *report;
    double time; /* s, of the state at hand */
    bool asked;  /* energy, counts and overlaps are wanted */
};

#endif
