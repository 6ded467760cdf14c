/* bed_file.c - reads positions and diameters of grains, from text or from a run.nc. */
#include "bed_file.h"

#include <errno.h>
#include <netcdf.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static void add(struct bed_file *b, int *capacity, vec3 x, double d)
{
    if (b->n == *capacity) {
        const int more = *capacity ? 2 * *capacity : 1024;
        b->pos = xrealloc(b->pos, (size_t)*capacity, (size_t)more, sizeof *b->pos);
        b->diameter =
            xrealloc(b->diameter, (size_t)*capacity, (size_t)more, sizeof *b->diameter);
        *capacity = more;
    }
    b->pos[b->n] = x;
    b->diameter[b->n++] = d;
}

static char *read_text(struct bed_file *b, FILE *file, const char *path)
{
    char line[512];
    int capacity = 0;
    for (int number = 1; fgets(line, sizeof line, file); number++) {
        vec3 x;
        double d;
        char rest;
        line[strcspn(line, "#\r\n")] = '\0';
        if (line[strspn(line, " \t")] == '\0')
            continue;
        const int got = sscanf(line, "%lf %lf %lf %lf %c", &x.x, &x.y, &x.z, &d, &rest);
        if (got != 4 || !isfinite(x.x + x.y + x.z + d) || !(d > 0.0))
            return xprintf("%s:%d: must hold x y z diameter in m, \"%.40s\" does not", path,
                           number, line);
        add(b, &capacity, x, d);
    }
    return b->n > 0 ? NULL : xprintf("%s: holds no grain", path);
}

static char *read_netcdf(struct bed_file *b, const char *path)
{
    int nc, var, radius, dim_grain, dim_time;
    size_t n = 0, times = 0;
    if (nc_open(path, NC_NOWRITE, &nc) != NC_NOERR)
        return xprintf("%s: is not a readable netCDF file", path);
    char *why = NULL;
    if (nc_inq_dimid(nc, "grain", &dim_grain) || nc_inq_dimlen(nc, dim_grain, &n) ||
        nc_inq_dimid(nc, "time", &dim_time) || nc_inq_dimlen(nc, dim_time, &times) || n == 0 ||
        times == 0 || nc_inq_varid(nc, "position", &var) ||
        nc_inq_varid(nc, "radius", &radius)) {
        why = xprintf("%s: holds no grains as a run.nc does", path);
    } else {
        b->n = (int)n;
        b->pos = xalloc(n, sizeof *b->pos);
        b->diameter = xalloc(n, sizeof *b->diameter);
        const size_t start[3] = {times - 1, 0, 0}, count[3] = {1, n, 3};
        if (nc_get_vara_double(nc, var, start, count, &b->pos[0].x) ||
            nc_get_var_double(nc, radius, b->diameter))
            why = xprintf("%s: its grains cannot be read", path);
        for (size_t i = 0; i < n; i++)
            b->diameter[i] *= 2.0;
    }
    nc_close(nc);
    return why;
}

char *bed_file_read(struct bed_file *b, const char *path, const char *scene_path)
{
    *b = (struct bed_file){0};
    if (path[0] == '\0')
        return xstrdup("must name a file, for fill = file");
    const char *const slash = scene_path ? strrchr(scene_path, '/') : NULL;
    char *beside = slash && path[0] != '/'
                       ? xprintf("%.*s/%s", (int)(slash - scene_path), scene_path, path)
                       : xstrdup(path);
    struct stat info;
    if (stat(beside, &info) != 0) {
        xfree(beside);
        beside = xstrdup(path);
    }
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
    xfree(b->pos);
    xfree(b->diameter);
    *b = (struct bed_file){0};
}
