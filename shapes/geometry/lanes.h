/* shapes/geometry/lanes.h - as many vertices side by side as a polyhedron's arrays are padded to. */
#ifndef LANES_H
#define LANES_H

#include <string.h>
#include "polyhedron.h"

typedef double lanes __attribute__((vector_size(POLYHEDRON_LANES * sizeof(double))));
typedef long long counts __attribute__((vector_size(POLYHEDRON_LANES * sizeof(long long))));

static inline lanes lanes_load(const double *x)
{
    lanes out;
    memcpy(&out, x, sizeof out);
    return out;
}

/* The greater of two in each lane. */
static inline lanes lanes_greater(lanes a, lanes b)
{
    const counts first = a > b;
    return (lanes)(((counts)a & first) | ((counts)b & ~first));
}

#endif
