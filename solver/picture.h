/* picture.h - a picture of a run, drawn by gnuplot through a pipe; for the tools. */
#ifndef PICTURE_H
#define PICTURE_H

#include <stdio.h>
#include "run_file.h"

enum { PICTURE_COLOURS = 8 };

struct picture {
    FILE *gnuplot;     /* takes commands */
    char *path, *part; /* its name, and its name until it is complete */
    int width, height; /* pixels */
};

extern const char *const picture_colour[PICTURE_COLOURS];

struct picture picture_open(const struct run_file *r, const char *name, int width, int height);
struct picture picture_open_in(const char *directory, const char *name, int width,
                               int height); /* likewise, of no run */
void picture_close(struct picture *p);      /* EXIT_WRITE where gnuplot could not draw */

char *picture_quoted(const char *text); /* as a string of gnuplot, in quotes; xfree it */
/* Sends: set WHAT 'text' OPTIONS */
void picture_text(FILE *to, const char *what, const char *text, const char *options);
char *
picture_scene(const struct run_file *r); /* "packed_bed" for scenes/packed_bed.ini; xfree it */

/* bed.png: the grains from the side at the first and the last output, and the porosity over
 * height. Draws nothing where there are no grains. */
void picture_bed(const struct run_file *r);

/* force_chains.png, where the run has listed its contacts (output.contacts = on). */
void picture_chains(const struct run_file *r);

/* velocity.png, pressure.png, porosity.png: slices through the fluid at the last output. Draws
 * nothing where there is no fluid, or where it is less than two cells wide in two directions. */
void picture_slices(const struct run_file *r);

#endif
