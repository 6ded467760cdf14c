/* turning.h - grains that have an orientation: how it starts and how it goes on.
 *
 * The angular momentum is kicked in the laboratory's frame as the velocity is (motion.c), and between
 * the kicks the grain turns freely (rotation.c). Springs see the steady spin that turns it as far;
 * dashpots the spin predicted for the full step. A grain whose principal moments are alike keeps its
 * spin as a sphere does, in the same bits, and carries its orientation along. */
#ifndef TURNING_H
#define TURNING_H

#include "scene.h"

struct sim;
struct grains;

struct turning {
    const struct key *keys; /* of section "grains" */
    void (*read)(struct grains *g, struct scene *scene);
    /* The orientation of grain i at the start, from its species, id and the seed. */
    void (*place)(struct grains *g, int i, unsigned long seed);
    /* Like the parts of motion.c, whose work on the velocity has been done: the first half of a kick
     * and the drift, from the spin of the full step; a whole kick and the drift; the second half.
     * Torque: N m. */
    void (*start)(struct sim *s, int i, vec3 spin, vec3 torque);
    void (*turn)(struct sim *s, int i, vec3 torque);
    void (*end)(struct sim *s, int i, vec3 torque);
};

extern const struct turning turning;

#endif
