/* meter.h - what passes through a plane: [meter NAME]. */
#ifndef METER_H
#define METER_H

#include "base.h"

struct sim;

struct meter {
    char name[32];
    vec3 point, normal; /* m; unit: what passes along it counts > 0, against it < 0 */
    vec3 from, to;      /* m, only what passes inside of this box counts */
    double width;       /* m, of a periodic box along the normal; INFINITY */
    double *distance;   /* m, per grain, from the plane at the last step; 0: not seen yet */
    int n_species;
    double *count_of, *mass_of; /* per species */
    double count, mass;         /* passed since t = 0: grains, kg */
    double momentum;            /* kg m/s, along the normal, that they had as they passed */
    double rate;                /* kg/s, over the last interval between samples */
    int samples, room;
    double *time, *passed; /* s, kg: every sample */
};

/* The meter of that name, or NULL. */
const struct meter *meter_find(const struct sim *s, const char *name);

/* kg/s; slope of the straight line through the samples of t0 <= t <= t1 by least squares, and its
 * standard error. NaN where there are fewer than three. */
double meter_slope(const struct meter *m, double t0, double t1, double *error);

#endif
