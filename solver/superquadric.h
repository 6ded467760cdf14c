/* superquadric.h - convex bodies that are given by their support function: superquadrics, and
 * ellipsoids among them.
 *
 * A superquadric [Barr81] is the set f(x) <= 0 with the inside-outside function
 *   f = ((|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1)^(1/n1) - 1,   n1, n2 >= 2
 * in the frame of its principal axes. f + 1 is a norm of p-norms, so the support function, the
 * farthest that the body reaches along n, is the dual norm, with 1/n + 1/q = 1 [Rockafellar70,
 * sect. 15]:
 *   h(n) = ((|a nx|^q2 + |b ny|^q2)^(q1/q2) + |c nz|^q1)^(1/q1)
 * Its gradient is the point of the surface whose outward normal is n, and the eigenvalues of its
 * Hessian on the plane across n are the radii of curvature there [Schneider14, sect. 2.5].
 *
 * Lengths in m (or in units of the caller's), vectors in the frame of the body unless said. */
#ifndef SUPERQUADRIC_H
#define SUPERQUADRIC_H

#include <stdbool.h>
#include "rotation.h"

struct superquadric {
    double a[3];   /* m, half axes */
    double n1, n2; /* blockiness; 2: round */
    double q1, q2; /* of the dual norms, n/(n - 1) */
    double inv_q1, inv_q2;
    bool ellipsoid; /* n1 = n2 = 2 */
    bool one;       /* n1 = n2 */
};

/* xx yy zz xy xz yz of a symmetric matrix */
struct symmetric {
    double xx, yy, zz, xy, xz, yz;
};

void superquadric_set(struct superquadric *s, const double half_axes[3], double n1, double n2);

/* f(x): < 0 inside, 0 on the surface. */
double superquadric_inside(const struct superquadric *s, vec3 x);
/* Outward unit normal of the surface through x/(f + 1); x not 0. */
vec3 superquadric_normal(const struct superquadric *s, vec3 x);

/* m2; area of the shadow that falls along the unit vector `way`, and of the surface, to 2e-3. */
double superquadric_shadow(const struct superquadric *s, vec3 way);
double superquadric_area(const struct superquadric *s);

/* The point of the surface with the outward normal n (any length but 0), and the Hessian of h
 * there (for |n| = 1), finite: radii of curvature beyond 1e8 half axes are cut. */
vec3 superquadric_support(const struct superquadric *s, vec3 n);
vec3 superquadric_support_curved(const struct superquadric *s, vec3 n,
                                 struct symmetric *hessian);

/* An upper bound of h that takes no powers: within 6 %. */
double superquadric_reach(const struct superquadric *s, vec3 n);

double superquadric_volume(const struct superquadric *s); /* m3 */
double superquadric_radius(const struct superquadric *s); /* m, of the bounding sphere */
void superquadric_inertia(const struct superquadric *s, double i[3]); /* m5, per unit density */

/* m; the root of the product of the radii of curvature where the outward normal is the unit n. */
double superquadric_curvature_radius(const struct superquadric *s, vec3 n);

/* A body at its place, its half axes times `size`. */
struct superquadric_placed {
    const struct superquadric *shape;
    double size;
    struct mat3 turn; /* body to lab */
};

/* Where two bodies come closest, or overlap most shallowly. */
struct superquadric_touch {
    vec3 normal;     /* unit, from j to i */
    double gap;      /* m, < 0: the depth of the overlap */
    vec3 at_i, at_j; /* m, points of the two surfaces from the centres of i and j; both on the
                          common normal once converged */
    double r_i, r_j; /* m, roots of the Gaussian curvatures' inverses */
    double r_eff;    /* m, 1/sqrt(det(K_i + K_j)), K the tensors of curvature */
    int tries;       /* evaluations of the pair of support functions */
};

/* Finds the direction n that maximises the gap g(n) = n . (x_i - x_j) - h_i(-n) - h_j(n) of the
 * two bodies' shadows on it (local maximum next to the start): the common normal of their nearest
 * points where they are apart, of the shallowest overlap where they are not. `apart` = x_i - x_j.
 * touch->normal is the start (zero vector: none is known, the line of centres serves). False, and
 * only normal and gap set, as soon as a direction shows that they are farther apart than `reach`
 * (>= 0): gap is then a lower bound. */
bool superquadric_meet(const struct superquadric_placed *i, const struct superquadric_placed *j,
                       vec3 apart, double reach, struct superquadric_touch *touch);

#endif
