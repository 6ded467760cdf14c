/* surface.h - the free surface of grains, and the angle that it makes: [surface NAME].
 *
 * The box is cut into square columns along z; the top of the highest grain of each is a point of
 * the surface (grains that touch nothing fly and do not count, unless asked for). A straight line
 * is fitted to height over distance:
 *   heap   distance from the axis through the centre          h = c - tan(angle) r
 *   ridge  distance from the plane through the centre         h = c - tan(angle) |a|
 *   slope  place along the axis                               h = c + tan(angle) a
 * for a heap and a ridge between the distances where the mean height falls below `high` and below
 * `low` (parts of the highest mean, over the base); for a slope over the middle part of it. */
#ifndef SURFACE_H
#define SURFACE_H

#include <stdbool.h>
#include "contact_view.h"

enum surface_kind { SURFACE_HEAP, SURFACE_RIDGE, SURFACE_SLOPE };

struct surface {
    char name[32];
    enum surface_kind kind;
    int axis;         /* of a ridge or a slope: 0 x, 1 y */
    double centre[2]; /* m, x and y */
    double cell;      /* m, edge of a column */
    double base;      /* m, of a heap */
    double low, high; /* parts of the height that are fitted */
    double middle;    /* part of the extent of a slope that is fitted */
    vec3 from, to;  /* m; grains outside of this box are not looked at (a funnel over a heap) */
    bool flying;    /* grains that touch nothing count */
    double angle;   /* degree, at the last sample */
    double height;  /* m, highest point over the base */
    double width;   /* m, of what was fitted */
    double scatter; /* m, rms of the points about the line */
    int points;     /* that were fitted */
};

/* Measures the surface at the state at hand; the angle is NaN where there is none. Returns the
 * points, x y h per column that holds a grain, *n of them; free with xfree. */
double *surface_measure(const struct sim *s, const struct contact_view *v, struct surface *f,
                        int *n);

const struct surface *surface_find(const struct sim *s, const char *name);

#endif
