/* run_file.h - reads a run.nc, for the tools. What is not there is told apart from what cannot
 * be read: the former returns nothing, the latter ends the program (EXIT_SCENE). */
#ifndef RUN_FILE_H
#define RUN_FILE_H

#include <stdbool.h>
#include "base.h"

struct run_file {
    int nc;
    const char *directory;
    char *path;
};

struct run_file run_open(const char *directory);
void run_close(struct run_file *r);

/* A text attribute, "" if there is none; var NC_GLOBAL or a variable. Free with xfree. */
char *run_text(const struct run_file *r, int var, const char *name);
size_t run_length(const struct run_file *r, const char *dim); /* 0 if there is none */
int run_variable(const struct run_file *r, const char *name); /* -1 if there is none */

/* All of a variable; NULL if there is none. Free with xfree. */
double *run_all(const struct run_file *r, const char *name, size_t *n);
/* One record (output time t) of a variable. */
double *run_record(const struct run_file *r, const char *name, size_t t, size_t *n);

#endif
