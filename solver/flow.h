/* flow.h - what drives the fluid: [flow].
 *
 * The superficial velocity through the inflow sides is a staircase from `velocity` to
 * `velocity_end` in `steps` levels, each held for `hold`; or constant. A periodic scene is
 * driven by a pressure gradient. */
#ifndef FLOW_H
#define FLOW_H

#include "scene.h"

struct flow {
    double start;                  /* s, when the fluid begins to flow */
    double velocity, velocity_end; /* m/s, superficial, into the box */
    int steps;
    double hold;   /* s */
    vec3 gradient; /* Pa/m, mean -grad p that drives a periodic direction */
};

extern const struct key flow_keys[];

void flow_read(struct flow *f, struct scene *s);
double flow_velocity(const struct flow *f, double t); /* m/s at time t */
int flow_level(const struct flow *f, double t);       /* 0..steps-1 */

#endif
