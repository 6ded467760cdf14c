/* insert.h - grains that come and go during a run: [insert NAME], [delete NAME], open sides.
 *
 * Sources. What is due follows from the clock alone: floor(rate x time) grains, or mass_flow x
 * time to half a grain; what found no room is a debt that is served first, largest or not, so that
 * no size is favoured. Every grain is drawn from seed, source and its number: the same on any
 * number of threads, and after a restart. A debt older than the source's patience stops the run.
 * Grains come in batches between steps, so that the pair list is not made anew for each.
 *
 * Sinks. A grain whose centre is in a sink, or that has left through an open side, is removed. It
 * takes along the half kick of its contacts that its partners receive at the start of the next
 * step, so that the momentum of the rest still adds up. Ids are not given again.
 *
 * The fluid takes the place of a grain that goes, and makes room for one that comes, without being
 * pushed: the change of the fluid fraction is not part of d(eps)/dt. */
#ifndef INSERT_H
#define INSERT_H

#include <stdbool.h>
#include "base.h"
#include "scene.h"

struct sim;

enum region_shape { REGION_BOX, REGION_SPHERE, REGION_CYLINDER, REGION_DISC, REGION_PLANE };

/* A place where grains come or go. */
struct insert_region {
    enum region_shape shape;
    vec3 from, to;         /* m, box */
    vec3 centre, axis;     /* m, unit; of a plane: a point and its normal */
    vec3 across[2];        /* unit, at right angles to the axis */
    double radius, length; /* m */
};

struct source {
    char name[32];
    int species;
    struct insert_region region;
    double rate, mass_flow;       /* 1/s, kg/s; one of them is 0 */
    double count_most, mass_most; /* 1, kg */
    double start, end;            /* s */
    double patience;              /* s */
    vec3 velocity;                /* m/s */
    double scatter;               /* m/s, each component within +- this */
    double every_time;            /* s between batches; < 0: by steps */
    double next_batch;            /* s */
    double asked, done; /* grains due by now, and come; with a mass flow `asked` is what
                                       has come and the one that waits */
    double asked_mass, done_mass; /* kg */
    double waits;    /* s, since when there is a debt for want of room; < 0: there is none */
    char *series[2]; /* names of its time series */
};

struct sink {
    char name[32];
    struct insert_region region;
    bool outside;                 /* what is not in the region goes */
    int side;                     /* of the box, or -1 */
    int species;                  /* -1: any */
    double removed, removed_mass; /* 1, kg */
};

struct traffic {
    int n_sources, n_sinks;
    struct source *source;
    struct sink *sink;
    double grains;                  /* at hand */
    double inserted, removed;       /* since the start */
    double mass_in, mass_out;       /* kg */
    vec3 momentum_in, momentum_out; /* kg m/s */
    double energy_in, energy_out;   /* J, kinetic and potential */
};

extern const struct key insert_keys[];

/* Reads [insert *], [delete *] and the open sides; once grains and walls exist. */
void insert_create(struct sim *s, struct scene *scene);
void insert_free(struct sim *s);
bool insert_changes(const struct sim *s); /* the number of grains may change */

/* Between steps: removes what has left, brings what is due by the end of the step to come. Costs
 * nothing in a scene without sources and sinks. */
void insert_step(struct sim *s);
void insert_expect(FILE *out,
                   const struct sim *s);     /* what the sources will have been asked for */
double insert_expected(const struct sim *s); /* grains, of all sources */
void insert_report(struct sim *s); /* asked and done, removed, sizes: to the summary */

/* A grain of this species as the last one, at rest in nothing; returns its index. */
int insert_grain(struct sim *s, int species, vec3 pos, double diameter, vec3 vel);

/* insert_region.c */
void insert_region_read(struct sim *s, struct scene *scene, const char *section,
                        const char *name, struct insert_region *r);
bool insert_region_holds(const struct sim *s, const struct insert_region *r, vec3 x);
double insert_region_volume(const struct insert_region *r); /* m3; of a disc: 0 */
/* A point for the centre of a grain of this radius, wholly inside, from three numbers in [0, 1). */
vec3 insert_region_point(const struct insert_region *r, double radius, const double u[3]);
double insert_region_room(const struct insert_region *r); /* m, radius of the widest grain */
/* Box around all points that insert_region_point may give. */
void insert_region_bounds(const struct insert_region *r, vec3 *lo, vec3 *hi);

#endif
