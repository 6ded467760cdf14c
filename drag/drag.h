/* drag/drag.h - contract: what resists the flow through or past the grains?
 *
 * To add a law: copy none.c to drag/NAME.c and write `drag = NAME`. Every answer exports
 * exactly the symbols below.
 *
 * One normalisation for all laws (shared by both fluid solvers):
 *   F_d   drag on one grain, WITHOUT the pressure-gradient force (model A, form 27a)
 *   eps   fluid fraction; u_r interstitial slip speed |u_f - v_p|
 *   Re  = rho eps u_r d / mu   (superficial slip, volume-equivalent diameter)
 *   Fhat(eps, Re) = F_d / (3 pi mu d eps u_r)        -> 1 for an isolated sphere as Re -> 0
 *   beta = 18 mu eps (1 - eps) Fhat / d^2            kg/(m3 s), per volume of mixture
 *   k    = mu eps^2 / beta = eps d^2 / (18 (1 - eps) Fhat)   m2, permeability implied
 * A law must be finite and positive for every eps in (0, 1] and every Re >= 0 (evaluate C_D Re,
 * never C_D, at small Re). Laws are pure functions, called from parallel loops. */
#ifndef DRAG_H
#define DRAG_H

#include "../solver/scene.h"

struct drag_point {
    double eps; /* fluid fraction, (0, 1] */
    double re;  /* Reynolds number as above, >= 0 */
};

extern const struct about drag_about;
extern const struct key drag_keys[]; /* of section "drag" */

void drag_init(struct scene *s);
double drag_factor(const struct drag_point *p); /* Fhat; 0 for `none` */

/* kg/s: F_d = kappa (u_f - v_p) on one grain of diameter d. */
static inline double drag_kappa(double eps, double slip, double d, double rho, double mu)
{
    const struct drag_point p = {.eps = eps, .re = rho * eps * slip * d / mu};
    return 3.0 * 3.14159265358979323846 * mu * d * eps * drag_factor(&p);
}

#endif
