/* sample.h - values of the fluid between its cells and faces. */
#ifndef SAMPLE_H
#define SAMPLE_H

#include "sim.h"

/* Linear between the nearest eight values. x within the box. */
double sample_pressure(const struct sim *s, vec3 x);        /* Pa */
double sample_velocity(const struct sim *s, int a, vec3 x); /* m/s, interstitial */
double sample_porosity(const struct sim *s, vec3 x);        /* 1 without grains */

/* Means over the plane at `at` across the axis; linear between layers. */
double plane_pressure(const struct sim *s, int axis, double at);
double plane_flux(const struct sim *s, int axis, double at); /* m/s, superficial, along it */
double plane_porosity(const struct sim *s, int axis, double at);

#endif
