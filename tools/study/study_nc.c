/* study_nc.c - netCDF-4 with strings; CF attributes where they exist. */
#include "study_nc.h"

#include <errno.h>
#include <netcdf.h>
#include <string.h>
#include "../../solver/provenance_info.h"

static void nc(const struct study_nc *f, int status)
{
    if (status != NC_NOERR)
        die(EXIT_WRITE, "%s: %s", f->part, nc_strerror(status));
}

static void attribute(const struct study_nc *f, int var, const char *name, const char *text)
{
    if (text[0])
        nc(f, nc_put_att_text(f->nc, var, name, strlen(text), text));
}

/* A name of netCDF for an axis: "grains beads.count" becomes axis_grains_beads_count. */
static char *axis_variable(const char *prefix, const char *name)
{
    char *const v = xprintf("%s%s", prefix, name);
    for (char *c = v; *c; c++)
        if (*c == ' ' || *c == '.' || *c == '-' || *c == '+')
            *c = '_';
    return v;
}

struct study_nc study_nc_create(const struct study *s, const char *name, const char *dim,
                                size_t n)
{
    struct study_nc f = {.n = n, .path = study_path(s, name)};
    struct provenance line[PROVENANCE_LINES];
    f.part = xprintf("%s.part", f.path);
    nc(&f, nc_create(f.part, NC_NETCDF4 | NC_CLOBBER, &f.nc));
    nc(&f, nc_def_dim(f.nc, dim, n, &f.dim));
    attribute(&f, NC_GLOBAL, "Conventions", "CF-1.8");
    attribute(&f, NC_GLOBAL, "title", s->verb);
    attribute(&f, NC_GLOBAL, "scene", s->scene);
    const int lines = provenance(line);
    for (int i = 0; i < lines; i++)
        if (strncmp(line[i].key, "module_", 7) != 0 && strcmp(line[i].key, "threads") != 0)
            attribute(&f, NC_GLOBAL, line[i].key, line[i].value);
    for (int i = 0; i < s->n_base; i++) {
        char *const key = xprintf("override_%d", i + 1);
        attribute(&f, NC_GLOBAL, key, s->base[i]);
        xfree(key);
    }
    return f;
}

struct study_nc study_nc_dim(const struct study_nc *f, const char *dim, size_t n)
{
    struct study_nc other = *f;
    other.n = n;
    nc(f, nc_def_dim(f->nc, dim, n, &other.dim));
    return other;
}

void study_nc_real(struct study_nc *f, const char *name, const char *unit,
                   const char *long_name, const double *x)
{
    int var;
    nc(f, nc_def_var(f->nc, name, NC_DOUBLE, 1, &f->dim, &var));
    attribute(f, var, "units", unit);
    attribute(f, var, "long_name", long_name);
    if (f->n > 0)
        nc(f, nc_put_var_double(f->nc, var, x));
}

void study_nc_text(struct study_nc *f, const char *name, const char *long_name,
                   const char *const *text)
{
    int var;
    nc(f, nc_def_var(f->nc, name, NC_STRING, 1, &f->dim, &var));
    attribute(f, var, "long_name", long_name);
    if (f->n > 0)
        nc(f, nc_put_var_string(f->nc, var, (const char **)(uintptr_t)text));
}

void study_nc_variants(struct study_nc *f, const struct study *s)
{
    const char **const text = xalloc(f->n + 1, sizeof *text);
    double *const x = xalloc(f->n + 1, sizeof *x);
    for (int a = 0; a < s->n_axes; a++) {
        char *const name = axis_variable("axis_", s->axis[a].name);
        for (int i = 0; i < s->n; i++) {
            const int c = s->variant[i]->choice[a];
            text[i] = c < 0 ? "" : s->axis[a].value[c];
            x[i] = c < 0 ? (double)NAN : s->axis[a].number[c];
        }
        study_nc_text(f, name, s->axis[a].name, text);
        if (!s->axis[a].words) {
            char *const number = axis_variable("number_", s->axis[a].name);
            study_nc_real(f, number, "", "number of the axis, in the unit of its text", x);
            xfree(number);
        }
        xfree(name);
    }
    for (int i = 0; i < s->n; i++)
        text[i] = ending_name[s->variant[i]->ending];
    study_nc_text(f, "end", "how the run ended", text);
    for (int i = 0; i < s->n; i++)
        text[i] = s->variant[i]->reason;
    study_nc_text(f, "reason", "why it did not end well", text);
    for (int i = 0; i < s->n; i++)
        text[i] = s->variant[i]->command;
    study_nc_text(f, "command", "what runs it again", text);
    xfree(text);
    xfree(x);
}

void study_nc_close(struct study_nc *f)
{
    nc(f, nc_close(f->nc));
    if (rename(f->part, f->path) != 0)
        die(EXIT_WRITE, "%s: %s", f->path, strerror(errno));
    xfree(f->path);
    xfree(f->part);
}
