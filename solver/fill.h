/* fill.h - where the grains are at the start. */
#ifndef FILL_H
#define FILL_H

#include "scene.h"

struct sim;

struct placed {
    vec3 pos;        /* m */
    double diameter; /* m */
    int species;
};

/* Places the grains of every species; returns how many, in an array to be freed with xfree.
 * What cannot be placed (no room, no file, overlap) goes on the scene's list of errors. */
int fill(struct sim *s, struct scene *scene, struct placed **out);

/* Whether a species asks for settling (fill = settle). */
bool fill_settles(struct sim *s, struct scene *scene);

#endif
