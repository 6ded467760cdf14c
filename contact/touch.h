/* contact/touch.h - a block of contacts, the unit in which laws work.
 *
 * The contact loop gathers contacts into blocks of up to TOUCH, structure of arrays, and hands
 * each block in turn to contact_forces, cohesion_forces, lubrication_forces, rolling_moments, bond_forces. A law is
 * thereby one plain loop over arrays in the first-level cache, which the compiler vectorises (a
 * lane is a contact); the call costs nothing per contact, so no law needs inlining.
 *
 * Convention: i is the grain that owns the contact, j the other grain or the wall; the normal
 * points from j to i; velocities are those of i relative to j at the contact point; forces and
 * couples act on i, the opposite on j. */
#ifndef TOUCH_H
#define TOUCH_H

#include "../solver/real.h"

enum {
    TOUCH = 32,       /* contacts per block, at most */
    TOUCH_LANES = 16, /* n is a multiple of this: the last contact repeated */
    HISTORY_MAX = 24  /* reals of memory per contact, all laws together */
};

/* What a law may ask for beyond the rest, by its constant ..._needs; not set unless asked. */
enum {
    TOUCH_SPIN = 1,    /* sx, sy, sz */
    TOUCH_INERTIA = 2, /* inertia */
    TOUCH_COUPLES = 4  /* it adds to mx, my, mz */
};

enum { BROKE_TENSION = 1, BROKE_SHEAR = 2 }; /* how a bond broke at this step */

struct touch {
    /* given */
    int n;
    double dt;           /* s, the grains' step */
    double time;         /* s, of the state at hand; settling is before 0 */
    _Alignas(64)         /* this and all arrays below: no vector straddles lines of the cache */
        int pair[TOUCH]; /* material_i * n_materials + material_j, for tables of parameters */
    real depth[TOUCH];   /* m, overlap; negative: a gap, within the range of a law */
    real r_eff[TOUCH];   /* m, 1/(1/r_i + 1/r_j); r_i against a plane */
    real m_eff[TOUCH];   /* kg, 1/(1/m_i + 1/m_j); m_i against a wall or a frozen grain */
    real r_i[TOUCH], r_j[TOUCH];          /* m, radii of curvature; r_j = 0 for a plane */
    real nx[TOUCH], ny[TOUCH], nz[TOUCH]; /* unit normal */
    real vx[TOUCH], vy[TOUCH], vz[TOUCH]; /* m/s, at the half step: what moves springs */
    real vn[TOUCH];    /* m/s, normal (> 0: separating), at the full step: for dashpots */
    real start[TOUCH]; /* factor of dashpots: 1; at the first step of a contact, which began
                          within it, the part of the step that it was on (0.5 to 1.5) */
    real wx[TOUCH], wy[TOUCH], wz[TOUCH]; /* rad/s, spin of i minus spin of j, half step */
    real sx[TOUCH], sy[TOUCH], sz[TOUCH]; /* rad/s, spin of i (TOUCH_SPIN) */
    real inertia[TOUCH]; /* kg m2, reduced inertia about the contact point, 1/(1/I_i + 1/I_j)
                            with I = inertia of the grain + m r^2 (TOUCH_INERTIA) */
    /* to be filled: contact_forces sets fx..fz, fn, kn; the others add to fx..fz, mx..mz,
     * which start as zero */
    real fx[TOUCH], fy[TOUCH], fz[TOUCH]; /* N, on i */
    real mx[TOUCH], my[TOUCH], mz[TOUCH]; /* N m, couple on i besides the lever of the force */
    real fn[TOUCH];             /* N, repulsive normal force (>= 0), for limits of other laws */
    real kn[TOUCH];             /* N/m, secant normal stiffness, elastic force over depth */
    unsigned char broke[TOUCH]; /* bond: 0, BROKE_TENSION or BROKE_SHEAR; starts as 0 */
    double energy[TOUCH];       /* J stored, set by contact_energy, added to by the others' */
};

#endif
