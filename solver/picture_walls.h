/* picture_walls.h - the walls of a run in its pictures, seen along y. */
#ifndef PICTURE_WALLS_H
#define PICTURE_WALLS_H

#include "picture.h"

/* Where along y the walls are cut, of the box: beside the middle, which many vertices lie on. */
#define PICTURE_CUT 0.5002

struct picture_walls {
    size_t n;   /* triangles */
    double *at; /* m, 9 n: x y z of the three corners */
};

/* The walls at output t; n is 0 where there are none. */
struct picture_walls picture_walls_read(const struct run_file *r, size_t t);
void picture_walls_free(struct picture_walls *w);

/* Highest and lowest z of walls that end inside of the box of this height; or false. */
bool picture_walls_range(const struct picture_walls *w, double size, double *low, double *high);

/* Sends the surfaces beyond the plane at y as block $NAMEb, and the lines in which they cut that
 * plane as $NAMEs; mm. */
void picture_walls_send(FILE *to, const char *name, const struct picture_walls *w, double y);
/* Parts of a plot command that draw them, to go before and behind what lies between. */
void picture_walls_behind(FILE *to, const char *name); /* ends with a comma */
void picture_walls_cut(FILE *to, const char *name);    /* begins with one */

#endif
