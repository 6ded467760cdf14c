/* run_file.c - reads a run.nc, for the tools. */
#include "run_file.h"

#include <netcdf.h>

static void run_check(const struct run_file *r, int status)
{
    if (status != NC_NOERR)
        die(EXIT_SCENE, "%s: cannot be read: %s", r->path, nc_strerror(status));
}

struct run_file run_open(const char *directory)
{
    struct run_file r = {.directory = directory, .path = xprintf("%s/run.nc", directory)};
    run_check(&r, nc_open(r.path, NC_NOWRITE, &r.nc));
    return r;
}

void run_close(struct run_file *r)
{
    nc_close(r->nc);
    xfree(r->path);
}

char *run_text(const struct run_file *r, int var, const char *name)
{
    size_t n = 0;
    nc_type type = NC_NAT;
    if (nc_inq_att(r->nc, var, name, &type, &n) != NC_NOERR || type != NC_CHAR)
        return xstrdup("");
    char *const text = xalloc(n + 1, 1);
    run_check(r, nc_get_att_text(r->nc, var, name, text));
    return text;
}

size_t run_length(const struct run_file *r, const char *dim)
{
    int id;
    size_t n = 0;
    if (nc_inq_dimid(r->nc, dim, &id) == NC_NOERR)
        run_check(r, nc_inq_dimlen(r->nc, id, &n));
    return n;
}

int run_variable(const struct run_file *r, const char *name)
{
    int var;
    return nc_inq_varid(r->nc, name, &var) == NC_NOERR ? var : -1;
}

/* A part of a variable: all of it, or record t of its first dimension. */
static double *read_part(const struct run_file *r, const char *name, bool whole, size_t t,
                         size_t *n)
{
    const int var = run_variable(r, name);
    int dims = 0, dim[NC_MAX_VAR_DIMS];
    size_t start[NC_MAX_VAR_DIMS] = {0}, count[NC_MAX_VAR_DIMS];
    *n = 1;
    if (var < 0)
        return NULL;
    run_check(r, nc_inq_var(r->nc, var, NULL, NULL, &dims, dim, NULL));
    for (int i = 0; i < dims; i++) {
        run_check(r, nc_inq_dimlen(r->nc, dim[i], &count[i]));
        if (i == 0 && !whole) {
            start[0] = t;
            count[0] = 1;
        }
        *n *= count[i];
    }
    double *const x = xalloc(*n + 1, sizeof *x);
    if (*n > 0)
        run_check(r, nc_get_vara_double(r->nc, var, start, count, x));
    return x;
}

double *run_all(const struct run_file *r, const char *name, size_t *n)
{
    return read_part(r, name, true, 0, n);
}

double *run_record(const struct run_file *r, const char *name, size_t t, size_t *n)
{
    return read_part(r, name, false, t, n);
}
