/* bed_file.c - reads a bed of grains, from text or from netCDF. */
#include "bed_file.h"

#include <ctype.h>
#include <errno.h>
#include <netcdf.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void add(struct bed_file *b, int *capacity, vec3 x, double d, const double q[4])
{
    if (b->n == *capacity) {
        const int more = *capacity ? 2 * *capacity : 1024;
        b->pos = xrealloc(b->pos, (size_t)*capacity, (size_t)more, sizeof *b->pos);
        b->diameter =
            xrealloc(b->diameter, (size_t)*capacity, (size_t)more, sizeof *b->diameter);
        b->turn = xrealloc(b->turn, (size_t)*capacity, (size_t)more, sizeof *b->turn);
        *capacity = more;
    }
    b->pos[b->n] = x;
    b->turn[b->n] = (struct quat){q[0], q[1], q[2], q[3]};
    b->diameter[b->n++] = d;
}

static char *read_text(struct bed_file *b, FILE *file, const char *path)
{
    char line[512];
    int capacity = 0;
    bool header = false, turns = true;
    for (int number = 1; fgets(line, sizeof line, file); number++) {
        vec3 x;
        double d;
        char rest;
        line[strcspn(line, "#\r\n")] = '\0';
        const char *const text = line + strspn(line, " \t");
        if (*text == '\0')
            continue;
        char *number_end;
        strtod(text, &number_end);
        if (b->n == 0 && !header && number_end == text && isalpha((unsigned char)*text)) {
            header = true; /* names of the columns */
            continue;
        }
        for (char *c = line; *c; c++)
            if (*c == ',' || *c == ';')
                *c = ' ';
        double q[4] = {1.0, 0.0, 0.0, 0.0};
        const int got = sscanf(line, "%lf %lf %lf %lf %lf %lf %lf %lf %c", &x.x, &x.y, &x.z, &d,
                               &q[0], &q[1], &q[2], &q[3], &rest);
        const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        if ((got != 4 && got != 8) || !isfinite(x.x + x.y + x.z + d) || !(d > 0.0) ||
            !isfinite(square) || !(square > 0.0))
            return xprintf("%s:%d: must hold x y z diameter in m, and w x y z of a quaternion "
                           "if you wish; \"%.40s\" does not",
                           path, number, line);
        turns = turns && got == 8;
        add(b, &capacity, x, d, q);
        b->turn[b->n - 1] = quat_unit(b->turn[b->n - 1]);
    }
    b->described = true;
    if (!turns) {
        xfree(b->turn);
        b->turn = NULL;
    }
    return b->n > 0 ? NULL : xprintf("%s: holds no grain", path);
}

/* Variable `name` of the grains, at the last time if it has times: `per` values a grain. NULL if
 * the file has none, or not in this form. */
static double *read_variable(int nc, const char *name, size_t n, size_t per)
{
    int var, dims = 0, dim[NC_MAX_VAR_DIMS], time = -1;
    size_t start[3] = {0}, count[3] = {0}, times = 0;
    nc_inq_dimid(nc, "time", &time);
    if (nc_inq_varid(nc, name, &var) || nc_inq_var(nc, var, NULL, NULL, &dims, dim, NULL))
        return NULL;
    const int first = dims > 0 && dim[0] == time, want = first + (per > 1 ? 2 : 1);
    if (dims != want || (first && (nc_inq_dimlen(nc, time, &times) || times == 0)))
        return NULL;
    start[0] = first ? times - 1 : 0;
    count[0] = 1;
    count[first] = n;
    if (per > 1)
        count[first + 1] = per;
    double *const x = xalloc(n * per + 1, sizeof *x);
    if (nc_get_vara_double(nc, var, start, count, x) == NC_NOERR)
        return x;
    xfree(x);
    return NULL;
}

static vec3 *read_vectors(int nc, const char *name, size_t n)
{
    double *const x = read_variable(nc, name, n, 3);
    vec3 *const v = x ? xalloc(n, sizeof *v) : NULL;
    for (size_t i = 0; x && i < n; i++)
        v[i] = v3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    xfree(x);
    return v;
}

static struct quat *read_turns(int nc, size_t n)
{
    double *const x = read_variable(nc, "orientation", n, 4);
    struct quat *const q = x ? xalloc(n, sizeof *q) : NULL;
    for (size_t i = 0; x && i < n; i++)
        q[i] = (struct quat){x[4 * i], x[4 * i + 1], x[4 * i + 2], x[4 * i + 3]};
    xfree(x);
    return q;
}

static void read_species(struct bed_file *b, int nc)
{
    int var;
    size_t length = 0;
    double *const kind = read_variable(nc, "grain_species", (size_t)b->n, 1);
    if (!kind || nc_inq_varid(nc, "grain_species", &var) ||
        nc_inq_attlen(nc, var, "flag_meanings", &length)) {
        xfree(kind);
        return;
    }
    char *const names = xalloc(length + 1, 1);
    nc_get_att_text(nc, var, "flag_meanings", names);
    for (char *at = names; *at;) {
        const size_t word = strcspn(at, " ");
        b->species = xrealloc(b->species, (size_t)b->n_species, (size_t)b->n_species + 1,
                              sizeof *b->species);
        b->species[b->n_species++] = xprintf("%.*s", (int)word, at);
        at += word + strspn(at + word, " ");
    }
    b->kind = xalloc((size_t)b->n, sizeof *b->kind);
    for (int i = 0; i < b->n; i++)
        b->kind[i] = (int)kind[i];
    xfree(names);
    xfree(kind);
}

/* Grains of the last output: all of the dimension, or as many as the file says. */
static size_t count_grains(int nc)
{
    int dim, var;
    size_t n = 0, times = 0;
    if (nc_inq_dimid(nc, "grain", &dim) || nc_inq_dimlen(nc, dim, &n))
        return 0;
    if (nc_inq_varid(nc, "grain_count", &var) == NC_NOERR && !nc_inq_dimid(nc, "time", &dim) &&
        !nc_inq_dimlen(nc, dim, &times) && times > 0) {
        const size_t last = times - 1;
        int count = 0;
        if (nc_get_var1_int(nc, var, &last, &count) == NC_NOERR && count >= 0 &&
            (size_t)count <= n)
            return (size_t)count;
    }
    return n;
}

static char *read_netcdf(struct bed_file *b, const char *path)
{
    int nc;
    if (nc_open(path, NC_NOWRITE, &nc) != NC_NOERR)
        return xprintf("%s: is not a readable netCDF file", path);
    char *why = NULL;
    const size_t n = count_grains(nc);
    b->pos = n > 0 ? read_vectors(nc, "position", n) : NULL;
    b->diameter = n > 0 ? read_variable(nc, "radius", n, 1) : NULL;
    if (!b->pos || !b->diameter) {
        why = xprintf("%s: holds no grains as a bed.nc or run.nc does", path);
    } else {
        b->n = (int)n;
        for (size_t i = 0; i < n; i++)
            b->diameter[i] *= 2.0;
        b->vel = read_vectors(nc, "velocity", n);
        b->spin = read_vectors(nc, "spin", n);
        if (!b->vel || !b->spin) {
            xfree(b->vel);
            xfree(b->spin);
            b->vel = b->spin = NULL;
        }
        b->turn = read_turns(nc, n);
        read_species(b, nc);
    }
    nc_close(nc);
    return why;
}

char *bed_file_path(const char *path, const char *scene_path)
{
    const char *const slash = scene_path ? strrchr(scene_path, '/') : NULL;
    char *const beside = slash && path[0] != '/'
                             ? xprintf("%.*s/%s", (int)(slash - scene_path), scene_path, path)
                             : xstrdup(path);
    struct stat info;
    if (stat(beside, &info) == 0)
        return beside;
    xfree(beside);
    return xstrdup(path);
}

char *bed_file_read(struct bed_file *b, const char *path, const char *scene_path)
{
    *b = (struct bed_file){0};
    if (path[0] == '\0')
        return xstrdup("must name a file, for fill = file");
    char *const beside = bed_file_path(path, scene_path);
    struct stat info;
    char *why = NULL;
    FILE *const file = fopen(beside, "r");
    if (!file || stat(beside, &info) != 0 || !S_ISREG(info.st_mode)) {
        why = xprintf("%s: %s", path, file ? "is not a file" : strerror(errno));
    } else {
        char magic[4] = {0};
        const size_t got = fread(magic, 1, sizeof magic, file);
        rewind(file);
        const bool netcdf =
            got == 4 && (memcmp(magic, "\211HDF", 4) == 0 || memcmp(magic, "CDF", 3) == 0);
        why = netcdf ? read_netcdf(b, beside) : read_text(b, file, beside);
    }
    if (file)
        fclose(file);
    xfree(beside);
    if (why)
        bed_file_free(b);
    return why;
}

void bed_file_free(struct bed_file *b)
{
    for (int k = 0; k < b->n_species; k++)
        xfree(b->species[k]);
    void *const all[] = {b->pos, b->diameter, b->vel, b->spin, b->kind, b->species, b->turn};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    *b = (struct bed_file){0};
}
