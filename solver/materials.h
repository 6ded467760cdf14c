/* materials.h - names of materials and the reading of parameters of pairs of them.
 *
 * A species is made of the material it names ([grains beads] material = glass), or of the one
 * of its own name. Walls are made of `[wall floor] material`, or of the material "wall" if the
 * scene has a [material wall], or else of the first species' material. */
#ifndef MATERIALS_H
#define MATERIALS_H

#include "scene.h"

enum { MATERIALS_MAX = 16, PAIRS_MAX = MATERIALS_MAX * MATERIALS_MAX };

struct materials {
    int n;                   /* MATERIALS_MAX at most, see materials_fit */
    const char *const *name; /* n names */
};

/* Whether tables of PAIRS_MAX pairs hold them; if not, that goes on the scene's list. */
bool materials_fit(struct scene *s, const struct materials *m);

/* How two materials' values make that of their pair. */
enum mix {
    MIX_GEOMETRIC, /* sqrt(a b); a for like materials */
    MIX_MEAN,      /* (a + b)/2 */
    MIX_SERIES     /* springs in series: a b/(a + b); a/2 for like materials */
};

/* A value of each pair of materials, out[a * n + b], symmetric: from [pair A-B] or [pair B-A]
 * if given there, else mixed from [material A] and [material B]. The key must be in tables of
 * both sections; in "pair" it allows the word "mixed", which is its standard. */
void materials_pair_values(struct scene *s, const struct materials *m, const char *key,
                           enum mix mix, double *out);

/* The same for a key whose materials may have `word` instead of a number: NAN where a pair has
 * it, or where one of two materials has. own[pair], if not NULL: the pair gave it, word or not. */
void materials_pair_optional(struct scene *s, const struct materials *m, const char *key,
                             const char *word, enum mix mix, double *out, bool *own);

#endif
