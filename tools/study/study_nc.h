/* study_nc.h - the netCDF file of a study: variables over one dimension, its variants. */
#ifndef STUDY_NC_H
#define STUDY_NC_H

#include "study.h"

struct study_nc {
    int nc, dim;
    size_t n;
    char *path, *part;
};

struct study_nc study_nc_create(const struct study *s, const char *name, const char *dim,
                                size_t n);
/* The same file with another dimension, for what does not go by variant; not to be closed. */
struct study_nc study_nc_dim(const struct study_nc *f, const char *dim, size_t n);
/* n values; the unit "" is left out. */
void study_nc_real(struct study_nc *f, const char *name, const char *unit,
                   const char *long_name, const double *x);
void study_nc_text(struct study_nc *f, const char *name, const char *long_name,
                   const char *const *text);
/* Axes ("axis_cell_d": as text; numbers besides), end, reason, command of each variant. */
void study_nc_variants(struct study_nc *f, const struct study *s);
void study_nc_close(struct study_nc *f); /* takes its name now that it is complete */

#endif
