/* region.h - boxes over which stress, fabric, solid fraction and coordination are averaged:
 * [region NAME]. */
#ifndef REGION_H
#define REGION_H

#include "base.h"

struct sim;
struct contact_view;

struct region {
    char name[32];
    vec3 from, to; /* m; along a periodic direction perhaps the whole box */
    double volume; /* m3 */
    /* at the last sample */
    double stress[3][3];  /* Pa, compression > 0; contacts and fluctuations */
    double kinetic[3][3]; /* Pa, the part of the fluctuations */
    double fabric[3][3];  /* sum of n n over contacts / their number */
    double principal[3];  /* Pa, of the symmetric part; largest first */
    double pressure;      /* Pa, mean of the principal stresses */
    double deviator; /* Pa, von Mises: sqrt(3/2 s:s); axial less radial in a triaxial test */
    double ratio;    /* deviator / pressure */
    double friction_angle; /* degree, asin((s1 - s3)/(s1 + s3)) */
    double anisotropy;     /* sqrt(3/2 F':F') of the fabric: 0 isotropic, 1 all parallel */
    double solid;          /* solid fraction */
    double coordination;   /* contacts per grain with its centre inside */
    double grains, contacts;
    vec3 velocity; /* m/s, of mass */
};

struct regions {
    int n;
    struct region *region;
};

/* The region of that name, or NULL. */
const struct region *region_find(const struct sim *s, const char *name);

/* Averages over r->from .. r->to at the state at hand. */
void region_measure(const struct sim *s, const struct contact_view *v, struct region *r);

#endif
