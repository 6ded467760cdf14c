/* coupling.h - the exchange between grains and fluid; called by the fluid solvers only.
 *
 * With the shares w_pc of grain p in cell c and the diffusion D, symmetric, the identity for most
 * answers (porosity.h), V the volume of a cell:
 *   eps_c  = 1 - D sum_p w_pc V_p / V             fluid fraction
 *   eps_f  = (eps_lo + eps_hi)/2                  on a face (boundary: the cell inside)
 *   U_c    = (eps_f u_f of low face + of high face)/2    superficial velocity, each direction
 *   kappa_pc = drag_kappa at (D eps)_c, |(D U/eps)_c - v_p|, d_p
 * Each half cell passes its share to the face beside it, so that on a face (volume V inside, V/2 on
 * the boundary)
 *   K_c    = (D sum_p w_pc kappa'_pc)_c / eps_c^2
 *   B_f    = eps_f^2 (K_lo + K_hi)/2 / V          drag coefficient
 *   S_f    = the same with kappa'_pc v'_p
 * so the resistance to the superficial velocity, B/eps_f^2, is the mean of the two cells: a layered
 * column is exact. The force on grain p is the sum of its parts of B_f u_f - S_f, through the same D,
 * so the momentum handed over cancels to round-off. The pressure and viscous forces, V_p G, are
 * handed over with the same weights.
 *
 * Form 27c (fluid.whole_pressure) passes drag over eps: eps_f in place of eps_f^2 here and in M
 * below; and no G.
 *
 * kappa is taken at the velocity at hand; but where that swings about the one it was taken at
 * before, at the mean of the two: for a law that is quadratic in the velocity this is Newton's
 * step, where the velocity at hand alone would swing for ever once dt B/rho is large.
 *
 * Drag is implicit on both phases. For a grain that is free to move, with
 *   theta = (dt/m) sum_c w_pc kappa_pc (D M/eps^2)_c   in each direction, M_c the mean of eps_f^2
 *           over the two faces of the cell (so theta = dt kappa/m where the porosity is uniform)
 *   kappa' = kappa/(1 + theta),   v' = v + (dv - dt F_d/m)
 * dv being its change of velocity over the last fluid step (with the other explicit forces of forces.h
 * of this step in place of that one's) and F_d the drag then: v' is the velocity
 * that it will have without drag. Stable for any theta, right for grains that others hold, and F_d is
 * constant over the sub-steps. `coupling.drag = explicit` sets theta = 0. */
#ifndef COUPLING_H
#define COUPLING_H

#include "../porosity/porosity.h"
#include "diffuse.h"
#include "drag_grains.h"
#include "forces.h"
#include "spread.h"

struct sim;

struct coupling {
    int ways; /* 2; 1: the fluid does not feel the grains */
    bool implicit;
    double eps_min;             /* smaller fluid fractions stop the run */
    long calls;                 /* of coupling_load since the start */
    int reach;                  /* shares per grain, at most */
    int *n_shares;              /* per grain */
    struct share *shares;       /* n x reach */
    struct spread spread;       /* of the shares, to cells */
    struct diffuse *diffuse;    /* D; NULL: the identity */
    struct fluid_forces forces; /* besides drag */
    struct drag_grains drag_of; /* the grains as the drag law sees them */
    double by_volume;           /* Pa/m; > 0: kappa is that of a conductivity of
                                                  1 m/s, by the volume of the grain */
    vec3 resistance;            /* factor of kappa in each direction */
    double *part;               /* n x reach, w kappa, kg/s */
    double *values;             /* n x SPREAD_STRIDE, what a grain adds to its cells */
    vec3 *slack;                /* 1/(1 + theta) per direction: kappa' over kappa */
    vec3 *drag;                 /* N per grain, the last drag force (a grain field) */
    vec3 *vel_old;              /* m/s at the last fluid step (a grain field) */
    int *coupled;      /* 1 once the grain has felt the fluid; newcomers: 0 (a grain field) */
    vec3 *pos_load;    /* m at the last fluid step (a grain field), for the ledger's work */
    vec3 *v_ref;       /* m/s, v' */
    double *u_drag[3]; /* m/s on faces, superficial, at which kappa was taken (state) */
    unsigned char
        *swing; /* how it wished to change the last time, two bits for each direction (state) */
    double *eps;      /* fluid fraction, ghosts filled; two-way that of the fluid */
    double *eps_seen; /* D eps, as the grains see it; eps itself where D is the identity */
    double
        *seen[3]; /* on cells, D of the velocity U/eps; of the mean of eps_f^2 u_f, over eps^2.
                          The fluid's scratch while neither drag nor load is under way */
    double *M[3]; /* on cells, D of the mean of eps_f^2 over eps^2; NULL where D is the
                          identity: then by coupling_square */
    double *K[3]; /* on cells, D of the stress; the fluid's scratch too */
    vec3 to_grains, from_fluid; /* N, drag + stress on all grains / lost by the fluid */
    double eps_least;           /* smallest fluid fraction at this step */
    double relaxation;          /* largest dt kappa/m at this step */
    double volume_error;        /* |volume of the grains on the grid / their volume - 1| */
};

extern const struct key coupling_keys[];

void coupling_read(struct sim *s,
                   struct scene *scene); /* [coupling], and the keys of drag/, porosity/ */
void coupling_create(struct sim *s);     /* once grid and grains exist */
void coupling_free(struct sim *s);

/* M of coupling.h of a cell where D is the identity: the mean of eps_f^2 (form 27c: of eps_f) over the
 * faces of direction a, over eps^2. */
static inline double coupling_square(const double *eps, int at, int step, bool whole)
{
    const double e = eps[at], lo = 0.5 * (e + eps[at - step]), hi = 0.5 * (e + eps[at + step]);
    return 0.5 * (whole ? lo + hi : lo * lo + hi * hi) / (e * e);
}

void coupling_volume(struct sim *s); /* shares, fluid->eps, eps_f; keeps eps_old */
void coupling_drag(struct sim *s);   /* fluid->drag, drag_s from the velocities at hand */
void coupling_load(struct sim *s);   /* grains->load from u and stress at hand */

#endif
