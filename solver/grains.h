/* grains.h - the state of the grains (structure of arrays), their species and materials.
 *
 * Grains are kept sorted by search cell, so a grain's index changes at a list rebuild; `id`
 * (0..n-1, in order of creation) does not. All arrays have `capacity` entries, of which n are
 * used; every one of them is in the field table, by which sorting, output and restart walk. */
#ifndef GRAINS_H
#define GRAINS_H

#include "domain.h"

struct sim;

enum { NAME_LENGTH = 32 };

struct material {
    char name[NAME_LENGTH];
};

struct species {
    char name[NAME_LENGTH];
    int material;    /* index */
    double diameter; /* m, volume-equivalent */
    double density;  /* kg/m3 */
    int count;
    bool frozen; /* never moves: a fixed skeleton */
};

struct grains {
    int n, capacity;
    int n_frozen;
    int *id;
    int *kind;           /* index of the species */
    vec3 *pos;           /* m; up to half a skin outside a periodic box between rebuilds */
    vec3 *vel;           /* m/s; at the half step while forces are computed */
    vec3 *vel_full;      /* m/s, predicted for the full step, for dashpots */
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

    int n_species, n_materials;
    struct species *species;
    struct material *materials;
};

extern const struct key grains_keys[];

/* Reads [grains *] and the names of the materials, fills the box (see fill.h), checks that the
 * grains fit. Arrays belong to the sim. */
void grains_create(struct sim *s, struct scene *scene);
void grains_free(struct sim *s);

static inline int grain_material(const struct grains *g, int i)
{
    return g->species[g->kind[i]].material;
}

#endif
