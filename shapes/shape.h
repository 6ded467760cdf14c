/* shapes/shape.h - contract: what is a grain?
 *
 * To add a shape: copy sphere.c (or clump.c) to shapes/NAME.c. Every answer exports shape_about,
 * shape_keys and `shape`, a table of what it can do; NULL where it has nothing to say. No other
 * file changes.
 *
 * A grain has a centre (of mass), an orientation (quaternion, body to lab) and a size, the radius
 * of the sphere of its volume: a species' `diameter` is the volume-equivalent one, and its grains
 * are alike in form. So a shape describes each species once, in the body's frame - origin at the
 * centre of mass, axes the principal ones - with the size as the unit of length; a grain's own
 * numbers are these times pose.size.
 *
 * The search finds pairs whose bounding spheres come close: a slot is such a pair. From there the
 * contact loop takes one of two paths, which the shape picks by `path`:
 *   contact_spheres  one contact a slot at most, found for a block of slots by `overlaps`; no
 *                    orientation (spheres, discs);
 *   contact_points   `points` gives 0 to `most` points of contact for a pair; all of them go through
 *                    the same laws. The grains have an orientation and a full inertia.
 *   contact_members  the body is a union of `balls`: each ball of one against each of the other, in the blocks
 *                    of spheres. `points` tells which come near; its id is ball of i times balls of j +
 *                    ball of j. As many overlaps as there are count; a pair of balls has its own memory.
 *   contact_round    the first where all grains are spheres (shape_form.bounding 1), else contact_members;
 *                    the shape has both `overlaps` and `points`.
 * Only the path that the shape names is linked.
 *
 * All functions but init and free are called from parallel loops: parameters are written in init
 * alone, scratch is on the stack. Geometry is in double whatever the precision of the loop. The
 * same input must give the same bits. */
#ifndef SHAPE_H
#define SHAPE_H

#include "../contact/touch.h"
#include "../solver/grains.h"
#include "../solver/rotation.h"
#include "../solver/walls/wall_kind.h"

struct wall;
struct contact_path;
extern const struct contact_path contact_spheres, contact_points, contact_members,
    contact_round;

/* ---- contact_spheres ---- */

/* Candidate pairs, up to TOUCH; for a wall contact j is i. */
struct candidates {
    int n;       /* a multiple of TOUCH_LANES */
    _Alignas(64) /* this and all arrays below, as in touch.h */
        int i[TOUCH],
        j[TOUCH];
    const struct wall *wall[TOUCH];       /* NULL: grain against grain */
    real dx[TOUCH], dy[TOUCH], dz[TOUCH]; /* m, x_i - x_j by the nearest image; wall: from the
                                             wall's nearest point to x_i */
};

/* Lever arms from the centres to the contact point. */
struct levers {
    real ix[TOUCH], iy[TOUCH], iz[TOUCH]; /* m, point - x_i */
    real jx[TOUCH], jy[TOUCH], jz[TOUCH]; /* m, point - x_j (0 for a wall) */
};

/* ---- contact_points ---- */

/* Where a grain is. */
struct shape_pose {
    int species;
    double size;      /* m */
    vec3 centre;      /* m, as seen from the pair's own origin, x_i: 0 for i */
    struct quat q;    /* body to lab */
    struct mat3 turn; /* the same */
};

struct shape_pair {
    struct shape_pose i, j;
    double reach; /* m; points with a gap up to this are wanted (negative depth) */
    real *memory; /* shape.memory reals that are the pair's own, kept from step to step for what
                     makes the answer faster (a separating direction, a start of an iteration);
                     zero for a new pair, and now and then zeroed again: the points must not depend
                     on it beyond round-off. */
    double *
        apart; /* m, NULL or where a shape that finds no points may leave a lower bound of how far
                      apart the bodies are: the pair is passed over until they may have moved by that.
                      It comes as 0, nothing is known. */
    double
        approached; /* m; by how much, at most, any two places of the bodies have come nearer to each
                          other since the shape was last asked about this pair, with this memory; 0: not
                          known */
};

struct shape_point {
    int id; /* >= 0, < 2^22: what touches what (sphere a with sphere b, vertex 3 with face 5), the
               same from step to step: by it, the contact finds its memory. Unique within the pair.
               A point whose id is new takes over the memory of one that has just gone, where it
               stood close by. */
    double depth;    /* m, overlap; negative: a gap */
    vec3 normal;     /* unit, from j to i */
    vec3 at_i, at_j; /* m, place of the contact, as seen from x_i and from x_j */
    /* m, of either body a point on the line through the contact along the normal, as seen from x_i
     * and from x_j: where the normal velocity is taken. Mathematically any will do, at_i and at_j
     * too; the centre of a rounded edge keeps a sphere a sphere to the last bit. */
    vec3 from_i, from_j;
    /* m, radii of curvature, for r_eff of the laws; r_i > 0; r_j = 0: flat. (Where i is the flat
     * one, give the radius of j as r_i.) For faces on faces choose what stands for the stiffness
     * wanted, and say so in the shape's head. */
    double r_i, r_j;
    vec3
        lever; /* m, of one of several points that stand for a patch: from the patch's middle to it;
                   faces that rock on each other are damped by it (contact_rocking.c). 0: none */
    double scale; /* m; overlap over this is what run.overlap_max limits */
    double
        share; /* where several points share one stiffness (the corners of two faces in contact):
                     the part of this one, by which the laws' forces, couples and energy are
                     multiplied. 0 is taken as 1: a point of its own */
    double
        slope; /* where the depth is no length along the normal, but made of many: how fast it grows as
                     the bodies approach at this point; forces and couples are multiplied by it too, so
                     that they follow from the energy. 0 is taken as 1 */
};

/* The point at which two balls touch: the rounded vertices, edges and faces of shapes. Centres as
 * seen from x_i and x_j; `apart` = centre of ball i less centre of ball j. Written in place: copies of
 * the structure would cost more than the sums. */
static inline void shape_balls_touch(struct shape_point *restrict p, vec3 ci, double ri,
                                     vec3 cj, double rj, vec3 apart, int id)
{
    const double square = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
    const double inverse = (double)inverse_root((real)square), distance = square * inverse;
    const double half = 0.5 * (ri + rj - distance);
    const vec3 n = v3_scale(inverse, apart);
    p->id = id;
    p->depth = 2.0 * half;
    p->normal = n;
    p->at_i = v3_axpy(ci, half - ri, n);
    p->at_j = v3_axpy(cj, rj - half, n);
    p->from_i = ci;
    p->from_j = cj;
    p->r_i = ri;
    p->r_j = rj;
    p->lever = v3(0.0, 0.0, 0.0);
    p->scale = ri < rj ? ri : rj;
    p->share = 0.0;
    p->slope = 0.0;
}

static inline struct shape_point shape_balls_meet(vec3 ci, double ri, vec3 cj, double rj,
                                                  vec3 apart, int id)
{
    struct shape_point p;
    shape_balls_touch(&p, ci, ri, cj, rj, apart, id);
    return p;
}

/* Spheres: the contact point lies in the middle of the overlap. */
static inline void shape_spheres_overlap(const struct grains *g, const struct candidates *c,
                                         struct touch *t, struct levers *l)
{
    (void)g;
#pragma omp simd
    for (int k = 0; k < c->n; k++) {
        const real square = c->dx[k] * c->dx[k] + c->dy[k] * c->dy[k] + c->dz[k] * c->dz[k];
        const real inverse = inverse_root(square), distance = square * inverse;
        const real half = 0.5 * (t->r_i[k] + t->r_j[k] - distance);
        const real arm_i = half - t->r_i[k];
        const real arm_j = t->r_j[k] > 0.0 ? t->r_j[k] - half : 0.0;
        t->depth[k] = 2.0 * half;
        t->nx[k] = c->dx[k] * inverse;
        t->ny[k] = c->dy[k] * inverse;
        t->nz[k] = c->dz[k] * inverse;
        l->ix[k] = arm_i * t->nx[k];
        l->iy[k] = arm_i * t->ny[k];
        l->iz[k] = arm_i * t->nz[k];
        l->jx[k] = arm_j * t->nx[k];
        l->jy[k] = arm_j * t->ny[k];
        l->jz[k] = arm_j * t->nz[k];
    }
}

/* A ball of the species: body's frame, units of size. */
struct shape_ball {
    vec3 centre;
    double radius;
    double
        curve; /* radius of curvature for the laws' r_eff, where it is not `radius`; 0: it is */
};

/* A flat element of a wall as seen by a grain: m, from x_i, in the lab. */
struct shape_facet {
    int n;          /* corners, 3 or 4 */
    vec3 corner[4]; /* in order */
    vec3 normal;    /* unit, of its plane towards the side of x_i */
};

/* Takes the triangles of a surface, body's frame, units of size; counter-clockwise from outside. */
struct shape_canvas {
    void (*triangle)(struct shape_canvas *c, vec3 a, vec3 b, vec3 p);
};

/* A small part of a species' volume: body's frame, units of size; the volumes of all add up to 4/3
 * pi. */
struct shape_part {
    vec3 at;
    double volume;
};

struct shape {
    const struct contact_path *path;
    /* Reads the keys of [grains NAME] of every species (g->species, by name), keeps what it needs,
     * fills form[species] (grains.h; it comes as that of a sphere); what is wrong goes on the scene's
     * list. NULL: nothing to read. */
    void (*init)(struct scene *scene, const struct grains *g, struct shape_form *form);
    void (*free)(void);
    double (*volume)(int species, double diameter); /* m3; NULL: of the sphere */
    bool
        flat; /* two dimensions: all centres lie in the plane halfway between the sides in y, and
                  nothing moves along y nor turns about x and z */

    /* contact_spheres: sets depth, normal and levers of each candidate. r_i, r_j and r_eff are
     * there already, from the bounding radii (r_j = 0 for a wall). A pair that does not overlap gets
     * a negative depth (its gap). Asked for contacts with walls and for views of contacts; of pairs in
     * the loop contact_block.c takes every grain for the sphere of its bounding radius, so this path
     * is for shapes that are that. contact_members asks it too, of a ball (r_i) and a wall. */
    void (*overlaps)(const struct grains *g, const struct candidates *c, struct touch *t,
                     struct levers *l);

    /* contact_points: writes the points of contact of a pair, at most `most` of them (the largest
     * points_most of all species), in a fixed order; returns how many. If there are more, it returns
     * their number, and the run stops and says so. */
    int (*points)(const struct shape_pair *p, int most, struct shape_point *out);
    int memory; /* reals of shape_pair.memory */

    /* Walls are met in one of two ways. Either by balls: their union must reach as far
     * as the body at every vertex, and a ball must be thicker than overlaps get, since the side of
     * the wall that its centre is on is its side. *n of them; the array stays. Radii of curvature
     * and ids of the contacts are those of the balls and their numbers. */
    const struct shape_ball *(*balls)(int species, int *n);
    /* Or, for a convex body without vertices (balls NULL), by its farthest point along the unit
     * vector `way` (lab): m, from x_i; *radius: m, of its curvature there. */
    vec3 (*support)(const struct shape_pose *i, vec3 way, double *radius);
    /* Flat elements of walls may be met by the convex parts of the body in place of the balls: where
     * such a part lies nearest to the element. Up to 4 points (0: out of reach) that share one
     * stiffness; j is the wall: id, depth, normal, at_i, from_i, r_i, scale and share count; ids from
     * the number of balls on, other ones for each part. *core: m, from x_i, a point inside of the body
     * from which the element is seen along the normal. The corners are none for a plane without end,
     * then corner[0] is a point of it. NULL: the balls meet all. */
    int (*convex_parts)(int species);
    int (*meet_flat)(const struct shape_pose *i, int part, const struct shape_facet *f,
                     double reach, vec3 *core, struct shape_point out[4]);

    /* The surface, for pictures. NULL: a sphere. */
    void (*surface)(int species, struct shape_canvas *c);
    /* The volume in parts no wider than `spacing` (units of size) or a little more. *n of them in an
     * array that the caller frees by xfree. NULL: a sphere, which has formulas of its own. */
    struct shape_part *(*parts)(int species, double spacing, int *n);
    /* Crosswise sphericity for drag: area of the sphere's section over the area of the body's
     * shadow along the unit vector `flow` (body's frame). NULL: 1. */
    double (*crosswise)(int species, vec3 flow);
};

extern const struct about shape_about;
extern const struct key shape_keys[]; /* of section "grains" */
extern const struct shape shape;

#endif
