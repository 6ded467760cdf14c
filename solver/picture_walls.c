/* picture_walls.c - the walls of a run in its pictures, seen along y: what lies beyond the middle of
 * the box as a pale surface behind the grains, and the cut through the middle as a dark line before
 * them, as an engineer's drawing shows a vessel. */
#include "picture_walls.h"

#include <math.h>
#include <netcdf.h>

struct picture_walls picture_walls_read(const struct run_file *r, size_t t)
{
    struct picture_walls w = {0};
    const int var = run_variable(r, "wall_position");
    int dims = 0;
    size_t got = 0;
    if (var < 0 || nc_inq_varndims(r->nc, var, &dims) != NC_NOERR)
        return w;
    w.at =
        dims == 3 ? run_record(r, "wall_position", t, &got) : run_all(r, "wall_position", &got);
    w.n = w.at ? got / 9 : 0;
    return w;
}

void picture_walls_free(struct picture_walls *w)
{
    xfree(w->at);
    *w = (struct picture_walls){0};
}

bool picture_walls_range(const struct picture_walls *w, double size, double *low, double *high)
{
    bool any = false;
    for (size_t i = 0; i < w->n; i++) {
        double lo = HUGE_VAL, hi = -HUGE_VAL;
        for (int c = 0; c < 3; c++) {
            lo = fmin(lo, w->at[9 * i + 3 * c + 2]);
            hi = fmax(hi, w->at[9 * i + 3 * c + 2]);
        }
        if (lo <= 1e-6 * size && hi >= size * (1.0 - 1e-6))
            continue;
        *low = any ? fmin(*low, lo) : lo;
        *high = any ? fmax(*high, hi) : hi;
        any = true;
    }
    return any;
}

/* The line in which a triangle cuts the plane; its ends, or false. */
static bool cut(const double *t, double y, double from[2], double to[2])
{
    int n = 0;
    for (int c = 0; c < 3 && n < 2; c++) {
        const double *const p = t + 3 * c, *const q = t + 3 * ((c + 1) % 3);
        if ((p[1] < y) == (q[1] < y))
            continue;
        const double part = (y - p[1]) / (q[1] - p[1]);
        double *const end = n++ == 0 ? from : to;
        end[0] = p[0] + part * (q[0] - p[0]);
        end[1] = p[2] + part * (q[2] - p[2]);
    }
    return n == 2;
}

void picture_walls_send(FILE *to, const char *name, const struct picture_walls *w, double y)
{
    fprintf(to, "$%sb << END\n", name);
    for (size_t i = 0; i < w->n; i++) {
        const double *const t = &w->at[9 * i];
        if (t[1] < y && t[4] < y && t[7] < y)
            continue;
        for (int c = 0; c < 3; c++)
            fprintf(to, "%.6g %.6g\n", 1e3 * t[3 * c], 1e3 * t[3 * c + 2]);
        fprintf(to, "%.6g %.6g\n\n", 1e3 * t[0], 1e3 * t[2]);
    }
    fprintf(to, "END\n$%ss << END\n", name);
    for (size_t i = 0; i < w->n; i++) {
        double a[2], b[2];
        if (cut(&w->at[9 * i], y, a, b))
            fprintf(to, "%.6g %.6g\n%.6g %.6g\n\n", 1e3 * a[0], 1e3 * a[1], 1e3 * b[0],
                    1e3 * b[1]);
    }
    fprintf(to, "END\n");
}

void picture_walls_behind(FILE *to, const char *name)
{
    fprintf(to,
            "$%sb using 1:2 with filledcurves closed fs solid noborder fc '#f0ece4', "
            "$%sb using 1:2 with lines lw 0.3 lc '#dcd5c8', ",
            name, name);
}

void picture_walls_cut(FILE *to, const char *name)
{
    fprintf(to, ", $%ss using 1:2 with lines lw 2.4 lc '#7a4a1e'", name);
}
