/* contact/rolling/rolling_spring.h - the springs, elastic up to a limit and then plastic, that
 * laws of rolling and twisting share. */
#ifndef ROLLING_SPRING_H
#define ROLLING_SPRING_H

#include "../spring.h"

/* Of one spring at one contact. */
struct rolling_spring {
    real stiffness; /* N m, per rad */
    real keep;      /* what is left of the moment where the stiffness has fallen, or 1 */
    real damping;   /* N m s, of the dashpot beside the spring */
    real plastic;   /* part of the dashpot that acts at the limit */
    real limit;     /* N m */
    bool whole;     /* the limit is that of spring and dashpot together, not of the spring */
};

struct rolled {
    struct arrow moment; /* N m, on i */
    struct arrow held;   /* N m, what the spring bears */
};

/* The spring turns with the contact plane of normal n, stretches by roll dt (roll: the part of
 * the relative spin in the plane), yields at its limit. */
SPRING_INLINE struct rolled rolling_spring(struct rolling_spring k, struct arrow held,
                                           struct arrow n, struct arrow roll, real dt)
{
    const struct arrow turned = spring_turn(held, n, k.keep * k.keep, 1.0);
    const struct arrow to = arrow_axpy(turned, -k.stiffness * dt, roll);
    const real size = sqrt(arrow_dot(to, to));
    const bool full = size >= k.limit;
    const struct arrow spring = arrow_scale(size > k.limit ? k.limit / size : 1.0, to);
    const real damping = full ? k.plastic * k.damping : k.damping;
    const struct arrow both = arrow_axpy(spring, -damping, roll);
    if (!k.whole)
        return (struct rolled){.moment = both, .held = spring};
    const real all = sqrt(arrow_dot(both, both));
    return (struct rolled){.moment = arrow_scale(all > k.limit ? k.limit / all : 1.0, both),
                           .held = spring};
}

struct twisted {
    real moment, held; /* N m, about the normal */
};

/* The same about the normal: the twist. */
SPRING_INLINE struct twisted twisting_spring(struct rolling_spring k, real held, real twist,
                                             real dt)
{
    const real to = k.keep * held - k.stiffness * dt * twist;
    const real low = to < -k.limit ? -k.limit : to, spring = low > k.limit ? k.limit : low;
    const bool full = to >= k.limit || to <= -k.limit;
    const real damping = full ? k.plastic * k.damping : k.damping;
    const real both = spring - damping * twist;
    const real lower = both < -k.limit ? -k.limit : both;
    return (struct twisted){.moment = k.whole ? (lower > k.limit ? k.limit : lower) : both,
                            .held = spring};
}

#endif
