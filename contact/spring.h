/* contact/spring.h - the spring in the plane of contact that laws of sliding, rolling and bonds
 * share: it turns with the plane, stretches, and is cut where it bears more than it may. It is
 * held as what it bears (N or N m), so that a stiffness that changes moves nothing.
 *
 * Everything is inline arithmetic on one contact, for use within `#pragma omp simd` loops. */
#ifndef SPRING_H
#define SPRING_H

#include <stdbool.h>
#include "touch.h"

#define SPRING_INLINE static inline __attribute__((always_inline))

struct arrow {
    real x, y, z;
};

SPRING_INLINE real arrow_dot(struct arrow a, struct arrow b)
{
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

SPRING_INLINE struct arrow arrow_cross(struct arrow a, struct arrow b)
{
    return (struct arrow){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* a + s b */
SPRING_INLINE struct arrow arrow_axpy(struct arrow a, real s, struct arrow b)
{
    return (struct arrow){fma(s, b.x, a.x), fma(s, b.y, a.y), fma(s, b.z, a.z)};
}

SPRING_INLINE struct arrow arrow_scale(real s, struct arrow a)
{
    return (struct arrow){s * a.x, s * a.y, s * a.z};
}

/* The part of a in the plane of unit normal n. */
SPRING_INLINE struct arrow arrow_in_plane(struct arrow a, struct arrow n)
{
    return arrow_axpy(a, -arrow_dot(a, n), n);
}

/* What the spring held, turned into the plane of n: its length is kept, times up/down. A
 * stiffness that falls takes what the spring holds down with it (up/down < 1), so that no energy
 * is made [Thornton13, sec. 3]; one that rises leaves it.
 *
 * With q the share of the square that points out of the plane, the length of the part in the
 * plane is to grow by 1/sqrt(1 - q): its series, bettered by Newton's step, exact to round-off for
 * turns below 1 degree a step and to 1e-6 below 17. One division in all; what is so small that its
 * square has no inverse counts as nothing. */
SPRING_INLINE struct arrow spring_turn(struct arrow held, struct arrow n, real up, real down)
{
    const real along = arrow_dot(held, n), before = arrow_dot(held, held);
    const real all = down * before, inverse = all > real_least ? 1.0 / all : 0.0;
    const real q = along * along * down * inverse;
    const real y = fma(q, fma(0.375, q, 0.5), 1.0);
    const real grow = y * fma(0.5 * (q - 1.0) * y, y, 1.5);
    return arrow_scale(grow * up * before * inverse, arrow_axpy(held, -along, n));
}

struct spring {
    struct arrow total; /* what spring and dashpot bear together, limit at most */
    struct arrow held;  /* what the spring is left with */
};

/* Where the two bear more than the limit, the contact slides: the total is cut to the limit, and
 * what the spring holds by the same factor. (To leave the spring with what gives the total at the
 * limit, total - dashpot, makes energy where the dashpot alone is beyond the limit.) */
SPRING_INLINE struct spring spring_cut(struct arrow held, struct arrow dashpot, real limit)
{
    const struct arrow q = arrow_axpy(held, 1.0, dashpot);
    const real square = arrow_dot(q, q);
    const real part = square > limit * limit ? limit * inverse_root(square) : 1.0;
    return (struct spring){.total = arrow_scale(part, q), .held = arrow_scale(part, held)};
}

/* Normal and relative velocity in the plane of contact c. */
SPRING_INLINE struct arrow touch_normal(const struct touch *t, int c)
{
    return (struct arrow){t->nx[c], t->ny[c], t->nz[c]};
}

SPRING_INLINE struct arrow touch_velocity(const struct touch *t, int c)
{
    return (struct arrow){t->vx[c], t->vy[c], t->vz[c]};
}

SPRING_INLINE struct arrow touch_spin(const struct touch *t, int c)
{
    return (struct arrow){t->wx[c], t->wy[c], t->wz[c]};
}

SPRING_INLINE void touch_add_force(struct touch *t, int c, struct arrow f)
{
    t->fx[c] += f.x;
    t->fy[c] += f.y;
    t->fz[c] += f.z;
}

SPRING_INLINE void touch_add_moment(struct touch *t, int c, struct arrow m)
{
    t->mx[c] += m.x;
    t->my[c] += m.y;
    t->mz[c] += m.z;
}

#endif
