/* materials.h - names of materials and the reading of parameters of pairs of them.
 *
 * A species is made of the material it names ([grains beads] material = glass), or of the one
 * of its own name. Walls are made of `[wall floor] material`, or of the material "wall" if the
 * scene has a [material wall], or else of the first species' material. */
#ifndef MATERIALS_H
#define MATERIALS_H

#include "scene.h"

struct materials {
    int n;
    const char *const *name; /* n names */
};

/* How two materials' values make that of their pair. */
enum mix {
    MIX_GEOMETRIC, /* sqrt(a b); a for like materials */
    MIX_SERIES     /* springs in series: a b/(a + b); a/2 for like materials */
};

/* A value of each pair of materials, out[a * n + b], symmetric: from [pair A-B] or [pair B-A]
 * if given there, else mixed from [material A] and [material B]. The key must be in tables of
 * both sections; in "pair" it allows the word "mixed", which is its standard. */
void materials_pair_values(struct scene *s, const struct materials *m, const char *key,
                           enum mix mix, double *out);

#endif
