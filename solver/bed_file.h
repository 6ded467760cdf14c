/* bed_file.h - a bed of grains from a file. */
#ifndef BED_FILE_H
#define BED_FILE_H

#include "base.h"

struct bed_file {
    int n;
    vec3 *pos;        /* m */
    double *diameter; /* m */
};

/* Reads a run.nc of silt (the grains of its last output) or a text file with "x y z diameter"
 * in metres on each line and # for comments. A relative path is looked up beside the scene
 * first, then from here. Returns NULL, or why it cannot (xfree it). */
char *bed_file_read(struct bed_file *b, const char *path, const char *scene_path);
void bed_file_free(struct bed_file *b);

#endif
