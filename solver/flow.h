/* flow.h - what drives the fluid: [flow].
 *
 * The superficial velocity through the inflow sides is a staircase from `velocity` to
 * `velocity_end` in `steps` levels, each held for `hold`; or constant, ramped, or from a table
 * in time; a side may have its own ([side z-] inflow). Its profile over the side is uniform, or
 * parabolic between the sides across it that are walls. A periodic scene is driven by a
 * pressure gradient, steady or swinging, or is held at a flow rate. */
#ifndef FLOW_H
#define FLOW_H

#include "course.h"

enum profile { PROFILE_UNIFORM, PROFILE_PARABOLIC }; /* order of the key */

struct flow {
    double start;                  /* s, when the fluid begins to flow */
    double velocity, velocity_end; /* m/s, superficial, into the box */
    int steps;
    double hold;          /* s */
    struct course course; /* m/s; ramp and table of the velocity */
    enum profile profile;
    vec3 steady;     /* Pa/m, as asked for */
    double period;   /* s, of the swing of the gradient, cos(2 pi t/period); INFINITY: steady */
    bool held;       /* the flow rate is held */
    vec3 held_rate;  /* m/s, mean superficial velocity, along periodic directions */
    vec3 gradient;   /* Pa/m, mean -grad p at hand that drives periodic directions (state) */
    double rate_off; /* m/s, largest difference to the rate that is held */
};

extern const struct key flow_keys[];

void flow_read(struct flow *f, struct scene *s);
void flow_free(struct flow *f);
double flow_velocity(const struct flow *f, double t); /* m/s at time t */
double flow_most(const struct flow *f);               /* m/s, the largest of the run */
int flow_level(const struct flow *f, double t);       /* 0..steps-1 */

/* Sets `gradient` to that of time t, unless a flow rate is held. */
void flow_drive(struct flow *f, double t);

#endif
