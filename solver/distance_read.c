/* distance_read.c - distance fields and voxels from netCDF, see distance_field.h. */
#include <netcdf.h>
#include <stdio.h>
#include <string.h>
#include "base.h"
#include "distance_make.h"

enum { NODES_MOST = 1024 };

struct source {
    int nc, var;
    int n[3]; /* x y z */
    double spacing;
};

/* Finds the variable; false: there is none. */
static bool source_find(struct source *s, const char *name, const char *path, char **why)
{
    int dims, dim[NC_MAX_VAR_DIMS];
    if (nc_inq_varid(s->nc, name, &s->var))
        return false;
    if (nc_inq_var(s->nc, s->var, NULL, NULL, &dims, dim, NULL) || dims != 3) {
        *why = xprintf("%s: %s has %d dimensions, where z y x are wanted", path, name, dims);
        return true;
    }
    for (int a = 0; a < 3; a++) {
        size_t length = 0;
        nc_inq_dimlen(s->nc, dim[2 - a], &length);
        if (length < 2 || length > NODES_MOST) {
            *why = xprintf("%s: %s has %zu entries in a direction, 2 to %d are allowed", path,
                           name, length, NODES_MOST);
            return true;
        }
        s->n[a] = (int)length;
    }
    if (nc_get_att_double(s->nc, s->var, "spacing", &s->spacing))
        s->spacing = 1.0;
    if (!(s->spacing > 0.0))
        *why = xprintf("%s: the attribute spacing of %s must be above 0", path, name);
    return true;
}

static struct distance_field *read_solid(const struct source *s, double smooth,
                                         const char *path, char **why)
{
    const size_t total = (size_t)s->n[0] * (size_t)s->n[1] * (size_t)s->n[2];
    float *const value = xalloc(total, sizeof *value);
    unsigned char *const solid = xalloc(total, 1);
    struct distance_field *f = NULL;
    size_t in = 0;
    if (nc_get_var_float(s->nc, s->var, value)) {
        *why = xprintf("%s: solid could not be read", path);
    } else {
        for (size_t c = 0; c < total; c++)
            in += solid[c] = value[c] != 0.0f;
        if (in == 0)
            *why = xprintf("%s: no voxel is solid", path);
        else
            f = distance_of_voxels(solid, s->n, s->spacing, smooth);
    }
    xfree(value);
    xfree(solid);
    return f;
}

/* As it is; it must hold the body with a positive layer about it. */
static struct distance_field *read_distance(const struct source *s, const char *path,
                                            char **why)
{
    struct distance_field *const f = distance_new(s->n, s->spacing, v3(0.0, 0.0, 0.0));
    const int *const n = f->n;
    bool inside = false, open = false, number = true;
    if (nc_get_var_float(s->nc, s->var, f->value)) {
        *why = xprintf("%s: distance could not be read", path);
        distance_free(f);
        return NULL;
    }
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int i = 0; i < n[0]; i++) {
                const float d =
                    f->value[(size_t)i + (size_t)n[0] * ((size_t)j + (size_t)n[1] * (size_t)k)];
                const bool edge = i == 0 || j == 0 || k == 0 || i == n[0] - 1 ||
                                  j == n[1] - 1 || k == n[2] - 1;
                number = number && isfinite(d);
                inside = inside || d < 0.0f;
                open = open || (edge && !(d > 0.0f));
            }
    if (!number || !inside || open) {
        *why = xprintf("%s: distance %s", path,
                       !number   ? "holds something that is no number"
                       : !inside ? "is nowhere negative: there is no inside"
                                 : "is not positive all over the edge of its grid");
        distance_free(f);
        return NULL;
    }
    distance_make_spline(f);
    return f;
}

struct distance_field *distance_read(const char *path, double smooth, char **why)
{
    struct source s = {0};
    struct distance_field *f = NULL;
    *why = NULL;
    const int status = nc_open(path, NC_NOWRITE, &s.nc);
    if (status) {
        *why = xprintf("%s: %s", path, nc_strerror(status));
        return NULL;
    }
    if (source_find(&s, "solid", path, why))
        f = *why ? NULL : read_solid(&s, smooth, path, why);
    else if (source_find(&s, "distance", path, why))
        f = *why ? NULL : read_distance(&s, path, why);
    else
        *why = xprintf("%s: no variable solid or distance", path);
    nc_close(s.nc);
    return f;
}
