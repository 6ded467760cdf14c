/* wells.h - volume of fluid put in or taken out along lines inside the box: [well NAME]. */
#ifndef WELLS_H
#define WELLS_H

#include "course.h"
#include "grid.h"

struct well {
    double from[3], to[3]; /* m, the ends of its screen; the same: a point */
    struct course rate;    /* m3/s, positive into the box */
    int n;                 /* cells that it passes through */
    int *cell;
    double *share; /* of the rate, sum 1 */
};

struct wells {
    int n;
    struct well *well;
};

/* The keys of a well, for the table of keys of an answer that has wells. */
#define WELL_KEYS                                                                              \
    {"well",                                                                                   \
     "from",                                                                                   \
     KEY_VECTOR,                                                                               \
     "m",                                                                                      \
     "[0, inf)",                                                                               \
     NULL,                                                                                     \
     "where the screen of the well begins; its name names the section"},                       \
        {"well", "to", KEY_VECTOR, "m", "from | [0, inf)", "from", "where it ends"},           \
        {"well",                                                                               \
         "rate",                                                                               \
         KEY_REAL,                                                                             \
         "m3 s-1",                                                                             \
         "(-inf, inf)",                                                                        \
         "0 m3/s",                                                                             \
         "volume of fluid put in per time; negative: taken out"},                              \
        {"well",                                                                               \
         "ramp",                                                                               \
         KEY_REAL,                                                                             \
         "s",                                                                                  \
         "[0, inf)",                                                                           \
         "0 s",                                                                                \
         "time in which the rate grows from 0 at t = 0"},                                      \
    {                                                                                          \
        "well", "table", KEY_TEXT, "", "", "", "CSV file of the rate: time in s, rate in m3/s" \
    }

/* Reads [well *]; what is wrong goes on the scene's list. */
void wells_read(struct wells *w, struct scene *s, const struct domain *d);
void wells_place(struct wells *w, const struct grid *g); /* once the grid exists */
void wells_free(struct wells *w);

/* out += the rates at time t over the volume of a cell, 1/s */
void wells_add(const struct wells *w, const struct grid *g, double t, double *out);

#endif
