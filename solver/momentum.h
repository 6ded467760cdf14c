/* momentum.h - the explicit terms of the volume-averaged momentum equation, on the staggered
 * grid, row by row along x.
 *
 * A face of direction a is `inside` if it carries the whole equation: those between two cells.
 * The face of an open side carries a shorter one (momentum_open). Ghosts of the velocities must
 * be filled (fluid_velocity_sides). */
#ifndef MOMENTUM_H
#define MOMENTUM_H

#include "sim.h"

enum convection { CONVECTION_VAN_LEER, CONVECTION_CENTRED, CONVECTION_UPWIND }; /* of the key */
enum form { FORM_A, FORM_B, FORM_C };                                           /* of the key */

struct momentum {
    enum convection scheme;
    enum form form;
    bool implicit; /* the Laplacian of the velocity is left to diffusion.h */
    bool rate_off; /* continuity leaves d(eps)/dt out */
    bool skip[3];  /* one cell thick: nothing varies along it */
    int threads;
    size_t share;   /* doubles of scratch per thread */
    double *buffer; /* fluxes of a row and of a layer, per thread */
};

void momentum_create(struct momentum *m, const struct sim *s, enum convection scheme,
                     enum form form, bool implicit);
void momentum_free(struct momentum *m);

/* Without grains: out = u + dt/rho (now R + before old + drive - grad p) on inside and open
 * faces, m/s; old = R. R = -rho div(u u) + mu laplace(u), the latter unless it is implicit: then
 * out is u more, as diffusion_direct wants it. */
void momentum_plain(const struct sim *s, const struct momentum *m, double now, double before,
                    double *const old[3], double *const out[3]);

/* With grains: out = R, visc = div tau (for the grains), N/m3; on inside and open faces.
 * R = -rho div(eps u u) + eps div tau (form a), or + div(eps tau) (forms b, c). div: div u on
 * cells, ghosts filled. */
void momentum_porous(const struct sim *s, const struct momentum *m, const double *div,
                     double *const out[3], double *const visc[3]);

/* div = div u on cells, 1/s, ghosts filled. */
void momentum_dilatation(const struct sim *s, double *div);

/* First and last layer of inside faces in direction b, for faces of direction a. */
static inline int inside_first(const struct sim *s, int a, int b)
{
    return a == b && !s->domain.periodic[b] ? 2 : 1;
}

static inline int inside_last(const struct sim *s, int b)
{
    return s->grid.n[b];
}

#endif
