/* fill.h - where the grains are at the start. */
#ifndef FILL_H
#define FILL_H

#include "rotation.h"
#include "scene.h"

struct sim;

/* How, in the order of the key grains.fill. */
enum {
    FILL_LATTICE,
    FILL_RANDOM,
    FILL_SETTLE,
    FILL_GROW,
    FILL_UNIT_CELL,
    FILL_POINT,
    FILL_FILE
};

struct placed {
    vec3 pos;        /* m */
    double diameter; /* m, of the bounding sphere */
    int species;
};

/* Grains at the start, all freed by fill_free. */
struct fill {
    int n;
    struct placed *grain;
    int n_motion;      /* the first grains, whose motion a file may give */
    vec3 *vel, *spin;  /* m/s, rad/s; vel.x is NAN where it does not */
    struct quat *turn; /* body's axes to the box's; w is NAN where it does not; or NULL */
};

/* Places the grains of every species. What cannot be placed (no room, no file, overlap) goes on
 * the scene's list of errors. */
void fill(struct sim *s, struct scene *scene, struct fill *f);
void fill_free(struct fill *f);

/* Whether a species asks for settling (fill = settle). */
bool fill_settles(struct sim *s, struct scene *scene);

#endif
