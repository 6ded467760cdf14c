/* shapes/geometry/dilated_species.h - the bodies of all species, read from the scene: what the answers
 * dilated_polyhedron and multi_dilated_polyhedron have in common. */
#ifndef DILATED_SPECIES_H
#define DILATED_SPECIES_H

#include "dilated.h"

struct dilated_species {
    int n;
    struct dilated **body; /* of each species */
    struct detection how;
    int kept; /* pairs of parts of which something is remembered */
};

/* The keys that both have; `forms` is the list of names (forms.h). */
#define DILATED_KEYS(forms)                                                                    \
    {"grains",                                                                                 \
     "form",                                                                                   \
     KEY_CHOICE,                                                                               \
     "",                                                                                       \
     forms " | mesh",                                                                          \
     "cube",                                                                                   \
     "solid whose corners and edges are rounded by the dilation"},                             \
        {"grains",                                                                             \
         "proportions",                                                                        \
         KEY_VECTOR,                                                                           \
         "1",                                                                                  \
         "(0, inf)",                                                                           \
         "1 1 1",                                                                              \
         "stretches the form along its three directions"},                                     \
        {"grains", "sides", KEY_INT, "", "[3, 64]", "3", "of the base of prism and pyramid"},  \
        {"grains",                                                                             \
         "dilation",                                                                           \
         KEY_REAL,                                                                             \
         "m",                                                                                  \
         "auto | (0, inf)",                                                                    \
         "auto",                                                                               \
         "radius of the ball that rounds a grain of the species' diameter; larger grains "     \
         "have a larger one; auto: a twentieth of the diameter"},                              \
        {"grains",                                                                             \
         "mesh",                                                                               \
         KEY_TEXT,                                                                             \
         "",                                                                                   \
         "",                                                                                   \
         "",                                                                                   \
         "form = mesh: STL or OBJ file of the core; its size does not matter"},                \
        {"grains",                                                                             \
         "detector",                                                                           \
         KEY_CHOICE,                                                                           \
         "",                                                                                   \
         "gjk | envelope",                                                                     \
         "gjk",                                                                                \
         "gjk: distance of the cores, their faces a little crowned; envelope: one point "      \
         "of contact by optimisation; of all species alike"},                                  \
    {                                                                                          \
        "grains", "smoothness", KEY_REAL, "1", "(0, 1)", "0.01",                               \
            "k of the envelope: 0 the dilated polyhedron, 1 a ball"                            \
    }

/* Makes the bodies and fills the forms; what is wrong goes on the scene's list. convex: one part. */
void dilated_species_read(struct dilated_species *s, bool convex, struct scene *scene,
                          const struct grains *g, struct shape_form *form);
void dilated_species_free(struct dilated_species *s);

/* Parts of the solid of a file: of STL all of it, of OBJ one per object or group; each closed, outward,
 * without folds, convex. False, and why (free with xfree). */
bool solid_of_mesh(struct solid *s, const char *path, bool convex, char **why);

#endif
