/* attitude.h - how a grain is turned, as the loop of member spheres (contact_members.c) reads it beside its
 * body: 8 numbers on one cache line, written when the grain turns (turning.c). */
#ifndef ATTITUDE_H
#define ATTITUDE_H

#include "body.h"
#include "rotation.h"

struct attitude {
    real4 turn; /* w x y z, body to lab */
    real4 spin; /* rad/s predicted for the full step; m, the size (shape.h), which stays */
};

static inline void attitude_write(struct attitude *a, struct quat q, vec3 spin)
{
    a->turn = (real4){(real)q.w, (real)q.x, (real)q.y, (real)q.z};
    a->spin = (real4){(real)spin.x, (real)spin.y, (real)spin.z, a->spin[3]};
}

#endif
