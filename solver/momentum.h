/* momentum.h - the explicit terms of the volume-averaged momentum equation, on the staggered
 * grid. */
#ifndef MOMENTUM_H
#define MOMENTUM_H

#include "sim.h"

enum convection {
    CONVECTION_VAN_LEER,
    CONVECTION_CENTRED,
    CONVECTION_UPWIND
}; /* order of the key */

/* Scratch of the kernels; freed with xfree by their owner. */
struct momentum {
    enum convection scheme;
    double *slope; /* a grid field */
    double *div;   /* div u at centres, a grid field */
};

void momentum_create(struct momentum *m, const struct grid *g, enum convection scheme);
void momentum_free(struct momentum *m);

/* out = -rho div(eps u u_a) on the faces of direction a that are solved for, N/m3. Ghosts of
 * the velocities must be filled. */
void momentum_convection(const struct sim *s, struct momentum *m, int a, double *out);

/* out = (div tau)_a on the faces of direction a, N/m3; momentum_dilatation first. */
void momentum_dilatation(const struct sim *s, struct momentum *m);
void momentum_viscous(const struct sim *s, const struct momentum *m, int a, double *out);

/* Whether the face at layer i of direction a carries an equation of its own: those inside,
 * those of a periodic direction, those of an open side. */
bool face_solved(const struct sim *s, int a, int i);

#endif
