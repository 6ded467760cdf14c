/* contact/touch.h - a block of contacts, the unit in which laws work.
 *
 * The contact loop gathers contacts into blocks of up to TOUCH, structure of arrays, and hands
 * each block in turn to contact_forces, cohesion_forces, rolling_moments, bond_forces. A law is
 * thereby one plain loop over arrays in the first-level cache, which the compiler vectorises (a
 * lane is a contact); the call costs nothing per contact, so no law needs inlining.
 *
 * Convention: i is the grain that owns the contact, j the other grain or the wall; the normal
 * points from j to i; velocities are those of i relative to j at the contact point; forces and
 * couples act on i, the opposite on j. */
#ifndef TOUCH_H
#define TOUCH_H

enum {
    TOUCH = 128,     /* contacts per block */
    HISTORY_MAX = 24 /* doubles of memory per contact, all laws together */
};

struct touch {
    /* given */
    int n;
    double dt;           /* s, the grains' step */
    int pair[TOUCH];     /* material_i * n_materials + material_j, for tables of parameters */
    double depth[TOUCH]; /* m, overlap; negative: a gap, within the range of a law */
    double r_eff[TOUCH]; /* m, 1/(1/r_i + 1/r_j); r_i against a plane */
    double m_eff[TOUCH]; /* kg, 1/(1/m_i + 1/m_j); m_i against a wall or a frozen grain */
    double r_i[TOUCH], r_j[TOUCH];          /* m; r_j = 0 for a plane */
    double nx[TOUCH], ny[TOUCH], nz[TOUCH]; /* unit normal */
    double vx[TOUCH], vy[TOUCH], vz[TOUCH]; /* m/s, at the half step: what moves springs */
    double vn[TOUCH];    /* m/s, normal (> 0: separating), at the full step: for dashpots */
    double start[TOUCH]; /* factor of dashpots: 1; at the first step of a contact, which began
                                within it, the part of the step that it was on (0.5 to 1.5) */
    double wx[TOUCH], wy[TOUCH], wz[TOUCH]; /* rad/s, spin of i minus spin of j, half step */
    /* to be filled: contact_forces sets, the others add */
    double fx[TOUCH], fy[TOUCH], fz[TOUCH]; /* N, on i */
    double mx[TOUCH], my[TOUCH],
        mz[TOUCH];        /* N m, couple on i besides the lever of the force */
    double fn[TOUCH];     /* N, repulsive normal force (>= 0), for limits of other laws */
    double energy[TOUCH]; /* J, stored in the springs */
};

#endif
