/* picture_shapes.h - grains that are no spheres, from the side: their surfaces drawn into an image with
 * a buffer of depths. */
#ifndef PICTURE_SHAPES_H
#define PICTURE_SHAPES_H

#include <stdbool.h>
#include <stdio.h>
#include "run_file.h"

/* Surfaces of the species, as surface_file.h writes them. */
struct shapes_seen {
    size_t corners;
    double *corner, *species; /* corners x 3; corners */
};

/* False where the grains of the run are spheres. */
bool picture_shapes_read(const struct run_file *r, struct shapes_seen *s);
void picture_shapes_free(struct shapes_seen *s);

/* What to draw: n grains; lengths in m; an image of `across` x `up` points over [low, high]. */
struct shapes_view {
    size_t n;
    const double *pos, *radius, *species, *turn; /* n x 3, n, n, n x 4 */
    const double *colour;                        /* n x 3, in [0, 255] */
    double low[2], high[2];
    double period; /* of x; 0: none */
    int across, up;
};

/* Sends "x y red green blue opacity" of all points, x and y in mm. */
void picture_shapes_send(FILE *to, const struct shapes_seen *s, const struct shapes_view *v);

#endif
