/* domain.h - the box: its size, its six sides, gravity.
 *
 * The box spans 0..size in each direction. A direction is periodic (both sides) or has two
 * sides, each with a kind. For the grains every side that is not periodic is a plane wall,
 * whatever the fluid does there (see walls.h). */
#ifndef DOMAIN_H
#define DOMAIN_H

#include <stdbool.h>
#include "course.h"

enum side_kind { /* order of the words in the keys of [domain] */
                 SIDE_PERIODIC,
                 SIDE_WALL, /* no slip; the wall may move in its own plane ([side z+] velocity)
                             */
                 SIDE_SLIP, /* no flow through, no shear */
                 SIDE_INFLOW,  /* superficial velocity given ([flow]) */
                 SIDE_OUTFLOW, /* pressure 0 (its part above the hydrostatic one) */
                 SIDE_HEAD,    /* total head given ([side z-] head); darcy */
                 SIDE_FLUX     /* flux into the box given ([side z-] flux); darcy */
};

enum { X_LO, X_HI, Y_LO, Y_HI, Z_LO, Z_HI }; /* sides; names "x-" "x+" ... */

struct side {
    enum side_kind kind;
    vec3 velocity;        /* m/s, of a wall, in its plane */
    struct course head;   /* m, of a side of kind head */
    struct course flux;   /* m/s, positive into the box, of a side of kind flux */
    struct course inflow; /* m/s, superficial, into the box, of a side of kind inflow */
    bool open;            /* for grains: no wall, what leaves is gone */
    bool own_inflow;      /* else the inflow is that of [flow] */
};

struct domain {
    double size[3]; /* m */
    int cells[3];   /* cells of the fluid grid; 0 0 0 when the scene has none */
    bool periodic[3];
    double image[3], inv_image[3]; /* m, 1/m: the size and its inverse; 0 where not periodic */
    struct side side[6];
    vec3 gravity; /* m/s2 */
};

extern const struct key domain_keys[];
extern const char *const side_name[6];     /* "x-", "x+", ... */
extern const char *const side_kind_name[]; /* "periodic", "wall", ... */

void domain_free(struct domain *d);

/* Reads [domain] and [side *]; contradictory sides go on the scene's list of errors. */
void domain_read(struct domain *d, struct scene *s);

/* The vector from b to a, by the nearest image. Every position may be up to half a box outside.
 */
static inline vec3 domain_minimum_image(const struct domain *d, vec3 ab)
{
    ab.x -= d->image[0] * rint(ab.x * d->inv_image[0]);
    ab.y -= d->image[1] * rint(ab.y * d->inv_image[1]);
    ab.z -= d->image[2] * rint(ab.z * d->inv_image[2]);
    return ab;
}

/* The position moved back into the box along periodic directions. */
vec3 domain_wrap(const struct domain *d, vec3 x);

#endif
