/* projection.h - the steps of the pressure-correction scheme on the faces, row by row. A face
 * field w holds the coefficient of the pressure equation, m g/A, with m = eps on the face,
 * A = rho m/dt + B, and g = m, or 1 in form 27c. Without grains A = rho/dt, and w is not kept
 * (NULL). */
#ifndef PROJECTION_H
#define PROJECTION_H

#include "momentum.h"

/* With grains: x = (rho m_old u/dt + now R + before old + g (drive - grad p) + S)/A on the faces
 * that are solved for; old = R. R and x may be the same. Then projection_coefficient into w unless that is
 * NULL; w may be R. */
void projection_predict(const struct sim *s, int a, double now, double before, const double *R,
                        double *old, double *x, double *w);

/* w of component a on all faces, those of the box included. */
void projection_coefficient(const struct sim *s, int a, double *w);

/* u -= w/m grad dp on the faces that are solved for; without grains also p += dp. */
void projection_correct(struct sim *s, double *const w[3], const double *dp);

/* stress (div tau so far) += drive - grad p, on every face, p = p + dp; then p += dp. */
void projection_stress(struct sim *s, const double *dp);

/* Holds the mean superficial velocity of flow.held_rate: adds to the gradient and to u what
 * it takes, before the projection (which shifts it again where w varies: then it is reached
 * in some steps). */
void projection_hold(struct sim *s, double *const w[3]);

/* m/s; largest difference of the mean superficial velocity to the one that is held. */
double projection_rate_off(const struct sim *s);

#endif
