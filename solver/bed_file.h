/* bed_file.h - a bed of grains from a file, and to one. */
#ifndef BED_FILE_H
#define BED_FILE_H

#include <stdbool.h>
#include "base.h"
#include "rotation.h"

struct bed_file {
    int n;
    vec3 *pos; /* m */
    double *
        diameter; /* m; of the bounding sphere, or, if described, of the sphere of its volume */
    bool described; /* sizes and turns are those of text, not of a file of silt */
    struct quat
        *turn; /* body's axes to the box's; described: the axes of the description; or NULL */
    vec3 *vel, *spin; /* m/s, rad/s; NULL: the file does not say */
    int *kind;        /* index of the species' name; NULL likewise */
    int n_species;
    char **species;
};

/* A file that a scene names: a relative path is looked up beside the scene first, then from here.
 * xfree it. */
char *bed_file_path(const char *path, const char *scene_path);

/* Reads a bed.nc or a run.nc of silt (the grains of its last output) to the last bit, or a text
 * file with x y z diameter in metres on each line, and w x y z of a quaternion if all have one,
 * between blanks or commas, with # for comments and one line of column names at most. Path as above. Returns NULL, or why it cannot (xfree). */
char *bed_file_read(struct bed_file *b, const char *path, const char *scene_path);
void bed_file_free(struct bed_file *b);

struct sim;
/* Writes the grains at hand to DIR/bed.nc, in order of id: positions, velocities, spins, sizes and
 * species, from which fill = file starts another run (springs of contacts start anew). */
void bed_file_write(const struct sim *s);

#endif
