/* output_file.h - the inside of output*.c: a netCDF file that is made under a temporary name,
 * its definitions by the tables of table.h, and one record of the state at hand. */
#ifndef OUTPUT_FILE_H
#define OUTPUT_FILE_H

#include <stdio.h>
#include "sim.h"

enum {
    DIM_GRAIN,
    DIM_COMPONENT,
    DIM_QUATERNION,
    DIM_X,
    DIM_Y,
    DIM_Z,
    DIM_XF,
    DIM_YF,
    DIM_ZF,
    DIM_TIME,
    DIM_SAMPLE,
    DIMS
};

struct output_file {
    int nc;            /* -1: not open */
    char *path, *part; /* its name, and its name until it is complete */
    int dim[DIMS];
    int var_time, var_sample;
    int *var_field, *var_series;
    size_t n_time, n_sample;
    bool varies;   /* the number of grains: each record has its own sizes, species and ids */
    size_t *count; /* grains per record, where it varies */
    int wall_triangles;
};

/* Ends the run (EXIT_WRITE) with path and reason where a netCDF call has failed. */
void output_check(const struct output_file *f, int status);
void output_text(const struct output_file *f, int var, const char *key, const char *text);
int output_define(const struct output_file *f, const char *name, int type, int n,
                  const int *dims, const char *unit, const char *long_name);

/* Opens DIR/name.part with provenance, dimensions and fields defined; stays in define mode. */
void output_file_open(struct output_file *f, const struct sim *s, const char *name);
void output_file_begin(struct output_file *f, const struct sim *s);  /* ends define mode */
void output_file_record(struct output_file *f, const struct sim *s); /* the state, at s->t */
void output_file_close(struct output_file *f); /* complete: takes its name */

/* The tables with their figures; the lines of the summary as attributes. */
void output_tables(const struct output_file *f, const struct sim *s);
void output_summary(const struct output_file *f, const struct sim *s);

/* A text file under the same rule: written as path.part, renamed when it is complete. */
FILE *output_text_open(const char *path);
void output_text_close(FILE *file, const char *path);

#endif
