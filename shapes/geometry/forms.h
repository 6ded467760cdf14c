/* shapes/geometry/forms.h - solids by name: the corners of convex parts, in no unit of length.
 *
 * A solid is one or several convex parts that overlap, each the hull of its points. */
#ifndef FORMS_H
#define FORMS_H

#include <stdbool.h>
#include "../../solver/base.h"

struct solid {
    int n;      /* parts */
    int *count; /* points of each */
    vec3 **point;
};

void solid_add(struct solid *s, const vec3 *point, int n);
void solid_free(struct solid *s);
/* Every coordinate times a factor of its own. */
void solid_stretch(struct solid *s, vec3 factor);

/* The names, as the words of a key: "cube | tetrahedron | ..."; FORMS_CONVEX is the beginning of
 * FORMS_ALL. */
#define FORMS_CONVEX                                                                           \
    "cube | tetrahedron | octahedron | icosahedron | dodecahedron | prism | pyramid | wedge"
#define FORMS_ALL                                                                              \
    FORMS_CONVEX " | cone_pair | tetrapod | dolos | cross | hollow_box | O | T | Z | K | A | " \
                 "C"

/* The solid that stands at that place of FORMS_ALL. `sides`: of the base of prism and pyramid. */
void solid_named(struct solid *s, int which, int sides);

#endif
