/* shapes/geometry/dilated.h - a grain of convex polyhedra dilated by a ball: what it is, and where
 * two of them touch. All in the units of shapes/shape.h: the body's frame, its size as the unit.
 *
 * Parts may overlap; they are one rigid body. Contact between bodies is contact between their
 * parts. Per pair of parts the laws see one contact of depth r_i + r_j - gap (crown.h), spread over
 * points that share its stiffness. */
#ifndef DILATED_H
#define DILATED_H

#include "../shape.h"
#include "crown.h"
#include "forms.h"
#include "patch.h"

enum { PARTS_MOST = 64 };

struct dilated_part {
    struct polyhedron *core;
    double *log_weight; /* of its vertices, see crown.h */
    vec3 middle, half;  /* of its box, dilated; sides along the body's axes */
    double radius;      /* of the ball about `middle` that holds it, dilated */
};

struct dilated {
    int n_parts;
    struct dilated_part part[PARTS_MOST];
    double r;         /* of the ball */
    double radius;    /* bounding, about the centre of mass */
    double surface;   /* area */
    vec3 inertia;     /* principal, over the mass */
    struct quat axes; /* turns the principal axes to those in which the solid is described */
    double
        volume_error; /* of the grid: its volume over that of Steiner's formula, less 1; one part */
    int n_balls;
    struct shape_ball *ball; /* at the vertices */
    int n_shadows;
    double *shadow; /* areas of the shadow of several parts, see dilated_shadow.c */
};

enum detector { DETECTOR_GJK, DETECTOR_ENVELOPE };

/* How contacts are found: of all species alike. */
struct detection {
    enum detector detector;
    double tilt;       /* patch.h */
    double smoothness; /* k of the envelope */
};

/* The body of one solid: scaled to the volume 4/3 pi with a ball of radius r, moved to its centre
 * of mass, turned to its principal axes. One part: exact. Several: over a grid of cells of that
 * spacing. NULL, and why (free with xfree). */
struct dilated *dilated_create(const struct solid *s, double r, double spacing, char **why);
void dilated_free(struct dilated *d);

/* Inside of it? */
bool dilated_holds(const struct dilated *d, vec3 x);
bool dilated_part_holds(const struct dilated *d, int part, vec3 x);
/* How far a point is outside of the surface of the nearest part, less than 0 inside; infinity beyond
 * the reach. */
double dilated_out(const struct dilated *d, vec3 x, double reach);
struct shape_part *dilated_parts(const struct dilated *d, double spacing, int *n);
void dilated_surface(const struct dilated *d, struct shape_canvas *c);
double dilated_shadow(const struct dilated *d, vec3 along);
void dilated_make_shadows(struct dilated *d);

/* Points of contact of a pair, see shapes/shape.h. The memory: how far apart pairs of parts are, the first
 * DILATED_LEFT of them, a real each; then DILATED_MEMORY reals for each of `kept` pairs of parts. One
 * part a body: the latter alone, once. */
enum { DILATED_LEFT = 144, DILATED_KEPT = 36, DILATED_MEMORY = 7 };
int dilated_points(const struct dilated *i, const struct dilated *j,
                   const struct detection *how, const struct shape_pair *p, int kept, int most,
                   struct shape_point *out);
/* Where a part lies nearest to a flat piece of a wall, see shapes/shape.h. */
int dilated_flat(const struct dilated *d, const struct shape_pose *i, int part,
                 const struct shape_facet *f, double reach, vec3 *core,
                 struct shape_point out[4]);

#endif
