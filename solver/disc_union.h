/* disc_union.h - the union of discs in a plane, exactly; and of balls, slice by slice. */
#ifndef DISC_UNION_H
#define DISC_UNION_H

#include "vec3.h"

struct disc {
    double x, y, r;
};

/* Of the union of discs; also the arcs of the discs that bound it. */
struct disc_union {
    double area, x, y, xx, yy, xy; /* integrals of 1, x, y, x^2, y^2, x y */
};

/* arc[i], if not NULL: rad, how much of disc i's rim bounds the union. */
struct disc_union disc_union(const struct disc *d, int n, double *arc);

struct ball {
    vec3 centre;
    double r;
};

/* Of the union of balls, of unit density; about its own centre. */
struct ball_union {
    double volume, area;
    vec3 centre;
    double
        inertia[6]; /* xx yy zz xy yz zx of the tensor of inertia (products with their sign) */
};

struct ball_union ball_union(const struct ball *b, int n);

#endif
