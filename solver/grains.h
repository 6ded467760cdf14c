/* grains.h - the state of the grains (structure of arrays), their species and materials.
 *
 * Grains are kept sorted by search cell, so a grain's index changes at a list rebuild; `id` does
 * not: 0, 1, 2 ... in order of creation, never given twice. All arrays have `capacity` entries,
 * of which n are used; every one of them is in the field table, by which sorting, output and
 * restart walk. Grains may come and go between steps (insert.h): arrays that others keep per
 * grain are made by grains_follow, and grow with these. */
#ifndef GRAINS_H
#define GRAINS_H

#include "domain.h"
#include "rotation.h"
#include "size_distribution.h"

struct sim;
struct parts;

enum { NAME_LENGTH = 32 };

struct material {
    char name[NAME_LENGTH];
};

/* What the grains of a species are alike in (shapes/shape.h); lengths in units of their size, the
 * radius of the sphere of their volume. */
struct shape_form {
    double bounding;   /* radius of the sphere about the centre of mass that holds it, >= 1 */
    vec3 inertia;      /* principal, over m size^2 */
    struct quat axes;  /* turns the principal axes to those in which the shape is described */
    double sphericity; /* area of the sphere of its volume over its own; NAN: unknown */
    int points_most;   /* most points of contact with a grain of any species, or with a wall's
                          element */
};

struct species {
    char name[NAME_LENGTH];
    int material;    /* index */
    double diameter; /* m, volume-equivalent; the median where sizes differ */
    double largest;  /* m, of its diameters */
    struct sizes sizes;
    struct shape_form form;
    bool turned;             /* starts with the orientation given, not with a random one */
    struct quat orientation; /* turns the axes of the description to those of the box */
    double density;          /* kg/m3 */
    int count;
    int n_made, room;
    double *made; /* m, diameters of all grains that it ever had */
    bool frozen;  /* never moves: a fixed skeleton */
};

/* An array kept per grain outside of the field table: scratch, not sorted. */
struct follower {
    void **data; /* address of the owner's pointer */
    size_t size; /* bytes per grain */
};

struct grains {
    int n, capacity;
    int n_frozen;
    int next_id; /* of the next grain that comes */
    int n_followers;
    struct follower *follower;
    int *id;
    int *kind;           /* index of the species */
    vec3 *pos;           /* m; up to half a skin outside a periodic box between rebuilds */
    vec3 *vel;           /* m/s; at the half step while forces are computed (body.h) */
    vec3 *spin;          /* rad/s, in the frame of the laboratory */
    vec3 *force;         /* N, all of it but the weight */
    vec3 *torque;        /* N m */
    vec3 *load;          /* N, from the fluid, constant over the sub-steps of a fluid step */
    vec3 *load_torque;   /* N m */
    double *radius;      /* m, of the bounding sphere (of the grain itself, for a sphere) */
    double *mass;        /* kg; real, for a frozen grain too */
    double *inv_mass;    /* 1/kg; 0 for a frozen grain */
    double *inv_inertia; /* 1/(kg m2); 0 for a frozen grain */
    double *volume;      /* m3 */
    /* Of shapes that turn (turning.h); else NULL. */
    struct quat
        *orientation; /* body's frame, that of the principal axes, to the laboratory's */
    vec3 *inertia;    /* kg m2, principal; real, for a frozen grain too */
    vec3 *momentum;   /* kg m2/s, angular, in the laboratory: within the steps of a call */
    vec3 *full_spin;  /* rad/s, predicted for the full step */

    struct parts *parts; /* of each species' volume (shares_grain.h); NULL: spheres */

    int n_species, n_materials;
    struct species *species;
    struct material *materials;
};

extern const struct key grains_keys[];

/* Reads [grains *] and the names of the materials, fills the box (see fill.h), checks that the
 * grains fit. Arrays belong to the sim. */
void grains_create(struct sim *s, struct scene *scene);
void grains_free(struct sim *s);

/* Makes *data an array of capacity + 1 entries of `size` bytes, zero, which is kept and enlarged
 * when the capacity grows. The owner frees it. */
void grains_follow(struct grains *g, void **data, size_t size);
/* Room for n grains at least, in every array kept per grain. Indices stay, pointers do not. */
void grains_reserve(struct sim *s, int n);
/* The indices of the grains in order of id; xfree it. */
int *grains_order(const struct grains *g);
/* Sets radius, volume, mass and inertia of grain i from its species and its volume-equivalent
 * diameter, m. */
void grains_body(struct grains *g, int i, double diameter);
double grains_volume(int species, double diameter); /* m3 */
/* Notes that the species has one grain more. */
void species_count(struct species *k, double diameter);
/* m; radius of the widest grain that there is or that a species may still bring. */
double grains_widest(const struct grains *g);

/* J; energy of the rotation of a grain that moves. */
static inline double grain_rotation(const struct grains *g, int i)
{
    if (!g->orientation)
        return 0.5 * v3_dot(g->spin[i], g->spin[i]) / g->inv_inertia[i];
    const struct mat3 m = quat_matrix(g->orientation[i]);
    return 0.5 * v3_dot(g->spin[i], rotation_momentum(&m, g->spin[i], g->inertia[i]));
}

static inline int grain_material(const struct grains *g, int i)
{
    return g->species[g->kind[i]].material;
}

#endif
