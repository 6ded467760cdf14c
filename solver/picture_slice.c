/* picture_slice.c - slices through the fluid at the last output: velocity.png, the speed with
 * arrows; pressure.png; porosity.png. Which slice: output.slice and output.slice_at of the scene,
 * which run.nc carries as resolved. */
#include "picture.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>
#include "units.h"

enum { ARROWS = 26, LEFT = 95, RIGHT = 165, TOP = 80, BOTTOM = 80 };
enum { LETTER = 10, TICK_ACROSS = 60, TICK_UP = 35 }; /* pixels of a letter, between ticks */

struct slice {
    size_t n[3], times;
    double size[3], h[3], time;
    int axis, across, up; /* the slice's normal; its horizontal and vertical */
    size_t layer;
    double unit;          /* of the axes: 1 or 1000 (mm) */
    double *u[2], *speed; /* m/s, in the plane, and all of it; of each cell */
};

/* The value of a key in the scene as resolved; "" if it is not there. xfree it. */
static char *scene_value_of(const struct run_file *r, const char *key)
{
    char *const scene = run_text(r, NC_GLOBAL, "scene"), *const head = xprintf("%s = ", key);
    const char *at = scene;
    while (at && strncmp(at, head, strlen(head)) != 0) {
        at = strchr(at, '\n');
        at = at ? at + 1 : NULL;
    }
    at = at ? at + strlen(head) : "";
    char *const value = xprintf("%.*s", (int)strcspn(at, "\n"), at);
    xfree(scene);
    xfree(head);
    return value;
}

static size_t cell_at(const struct slice *f, const size_t at[3])
{
    return (at[2] * f->n[1] + at[1]) * f->n[0] + at[0];
}

/* Which way to look: as asked; or along a direction of one cell; or along y. */
static bool choose_axis(const struct run_file *r, struct slice *f)
{
    char *const word = scene_value_of(r, "output.slice");
    char *const at = scene_value_of(r, "output.slice_at");
    int thin = -1, wide = 0;
    for (int a = 0; a < 3; a++) {
        wide += f->n[a] > 1;
        thin = f->n[a] == 1 ? a : thin;
    }
    f->axis = word[0] >= 'x' && word[0] <= 'z' && word[1] == '\0' ? word[0] - 'x'
              : thin >= 0                                         ? thin
                                                                  : 1;
    const bool draw = strcmp(word, "off") != 0 && wide >= 2;
    f->across = f->axis == 0 ? 1 : 0;
    f->up = f->axis == 2 ? 1 : 2;
    char *end;
    double where = strtod(at, &end), factor = 1.0, offset = 0.0;
    if (end != at && units_convert(end + strspn(end, " "), "m", &factor, &offset) == UNIT_GOOD)
        where = factor * where + offset;
    const double place = end != at ? where / f->h[f->axis] : 0.5 * (double)f->n[f->axis];
    f->layer = place <= 0.0 ? 0 : (size_t)place;
    f->layer = f->layer < f->n[f->axis] ? f->layer : f->n[f->axis] - 1;
    xfree(word);
    xfree(at);
    return draw && f->n[f->across] > 1 && f->n[f->up] > 1;
}

/* Adds the component of direction a, at centres, to the slice. */
static bool add_velocity(const struct run_file *r, struct slice *f, int a)
{
    static const char *const names[3] = {"fluid_velocity_x", "fluid_velocity_y",
                                         "fluid_velocity_z"};
    size_t count = 0, n[3] = {f->n[0], f->n[1], f->n[2]};
    double *const face = run_record(r, names[a], f->times - 1, &count);
    n[a]++;
    if (!face || count != n[0] * n[1] * n[2]) {
        xfree(face);
        return false;
    }
    const size_t step = a == 0 ? 1 : a == 1 ? n[0] : n[0] * n[1];
    size_t at[3];
    at[f->axis] = f->layer;
    for (size_t k = 0; k < f->n[f->up]; k++)
        for (size_t j = 0; j < f->n[f->across]; j++) {
            at[f->across] = j;
            at[f->up] = k;
            const size_t c = (at[2] * n[1] + at[1]) * n[0] + at[0];
            const double u = 0.5 * (face[c] + face[c + step]);
            const size_t m = k * f->n[f->across] + j;
            f->speed[m] = hypot(f->speed[m], u);
            if (a == f->across)
                f->u[0][m] = u;
            if (a == f->up)
                f->u[1][m] = u;
        }
    xfree(face);
    return true;
}

static bool read_slice(const struct run_file *r, struct slice *f)
{
    f->n[0] = run_length(r, "x");
    f->n[1] = run_length(r, "y");
    f->n[2] = run_length(r, "z");
    f->times = run_length(r, "time");
    if (f->n[0] * f->n[1] * f->n[2] == 0 || f->times == 0 ||
        nc_get_att_double(r->nc, NC_GLOBAL, "domain_size", f->size) != NC_NOERR)
        return false;
    for (int a = 0; a < 3; a++)
        f->h[a] = f->size[a] / (double)f->n[a];
    if (!choose_axis(r, f))
        return false;
    size_t n = 0;
    double *const time = run_all(r, "time", &n);
    f->time = time[f->times - 1];
    xfree(time);
    f->unit = fmax(f->size[f->across], f->size[f->up]) < 1.0 ? 1e3 : 1.0;
    const size_t cells = f->n[f->across] * f->n[f->up];
    f->u[0] = xalloc(cells, sizeof(double));
    f->u[1] = xalloc(cells, sizeof(double));
    f->speed = xalloc(cells, sizeof(double));
    for (int a = 0; a < 3; a++)
        if (!add_velocity(r, f, a))
            return false;
    return true;
}

static void send_values(FILE *to, const struct slice *f, const double *value, double range[2])
{
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    fprintf(to, "$v << END\n");
    for (size_t k = 0; k < f->n[f->up]; k++)
        for (size_t j = 0; j < f->n[f->across]; j++) {
            const double x = value[k * f->n[f->across] + j];
            fprintf(to, "%.8g %.8g %.6g\n", f->unit * ((double)j + 0.5) * f->h[f->across],
                    f->unit * ((double)k + 0.5) * f->h[f->up], x);
            range[0] = x < range[0] ? x : range[0];
            range[1] = x > range[1] ? x : range[1];
        }
    fprintf(to, "END\n");
}

/* An arrow every few cells, as long as the cells between for the largest speed. */
static void send_arrows(FILE *to, const struct slice *f, double fastest)
{
    const size_t nb = f->n[f->across], nd = f->n[f->up];
    const double wide = f->h[f->across] * (double)nb, high = f->h[f->up] * (double)nd;
    const double gap = fmax(wide, high) / ARROWS;
    const size_t step_b = (size_t)fmax(1.0, rint(gap / f->h[f->across]));
    const size_t step_d = (size_t)fmax(1.0, rint(gap / f->h[f->up]));
    const double most =
        0.95 * fmin((double)step_b * f->h[f->across], (double)step_d * f->h[f->up]);
    fprintf(to, "$a << END\n");
    for (size_t k = step_d / 2; k < nd; k += step_d)
        for (size_t j = step_b / 2; j < nb; j += step_b) {
            const size_t m = k * nb + j;
            const double scale = most / fastest;
            const double dx = scale * f->u[0][m], dy = scale * f->u[1][m];
            if (hypot(dx, dy) > 0.04 * most)
                fprintf(to, "%.8g %.8g %.6g %.6g\n",
                        f->unit * (((double)j + 0.5) * f->h[f->across] - 0.5 * dx),
                        f->unit * (((double)k + 0.5) * f->h[f->up] - 0.5 * dy), f->unit * dx,
                        f->unit * dy);
        }
    fprintf(to, "END\n");
}

/* What is drawn: its file, its name with its unit, its colours. */
struct look {
    const char *file, *what, *unit, *palette;
    bool from_zero, arrows;
};

/* Ticks of one axis of this length, 1, 2 or 5 times a power of ten apart, no more than `most`. */
static void send_ticks(FILE *to, char axis, double length, int most)
{
    const double least = length / (most > 1 ? most : 1), ten = pow(10.0, floor(log10(least)));
    const double times = least / ten;
    fprintf(to, "set %ctics %.10g\n", axis,
            ten * (times <= 1.0   ? 1.0
                   : times <= 2.0 ? 2.0
                   : times <= 5.0 ? 5.0
                                  : 10.0));
}

static void draw_slice(const struct run_file *r, const struct slice *f, const struct look *l,
                       const double *value)
{
    const double wide = f->unit * f->size[f->across], high = f->unit * f->size[f->up];
    const double scale = fmin(900.0 / wide, 700.0 / high);
    const int across = (int)fmax(120.0, wide * scale), up = (int)fmax(120.0, high * scale);
    double range[2];
    char *const scene = picture_scene(r);
    const bool pure = strcmp(l->unit, "1") == 0;
    char *const title =
        xprintf("%s: %s%s%s, t = %.4g s, %c = %.4g %s", scene, l->what, pure ? "" : ", ",
                pure ? "" : l->unit, f->time, 'x' + f->axis,
                f->unit * ((double)f->layer + 0.5) * f->h[f->axis], f->unit > 1.0 ? "mm" : "m");
    const int words = LETTER * (int)strlen(title) + 40, all = across + LEFT + RIGHT;
    const int width = words > all ? words : all;
    const int height = up + TOP + BOTTOM, from = (width - all) / 2 + LEFT;
    struct picture p = picture_open(r, l->file, width, height);
    FILE *const to = p.gnuplot;
    send_values(to, f, value, range);
    const double span = range[1] - range[0];
    const double size = fmax(fabs(range[0]), fabs(range[1]));
    if (!(span > 1e-9 * size)) { /* constant */
        range[0] -= size > 0.0 ? 0.5 * size : 0.5;
        range[1] += size > 0.0 ? 0.5 * size : 0.5;
    }
    if (l->from_zero && range[0] >= 0.0)
        range[0] = 0.0;
    char *const place =
        xprintf("at screen 0.5,%g center font ',14' noenhanced", 1.0 - 36.0 / height);
    picture_text(to, "label 2", title, place);
    xfree(place);
    fprintf(to,
            "set xlabel '%c, %s'\nset ylabel '%c, %s'\nset palette defined (%s)\n"
            "set cbrange [%.10g:%.10g]\nset xrange [0:%.10g]\nset yrange [0:%.10g]\n"
            "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\n"
            "set tmargin at screen %g\nunset grid\nunset key\nset border 15\n",
            'x' + f->across, f->unit > 1.0 ? "mm" : "m", 'x' + f->up,
            f->unit > 1.0 ? "mm" : "m", l->palette, range[0], range[1], wide, high,
            (double)from / width, (double)(from + across) / width, (double)BOTTOM / height,
            (double)(BOTTOM + up) / height);
    send_ticks(to, 'x', wide, across / TICK_ACROSS);
    send_ticks(to, 'y', high, up / TICK_UP);
    const bool arrows = l->arrows && range[1] > 0.0 && span > 0.0;
    if (arrows)
        send_arrows(to, f, range[1]);
    fprintf(to, "plot $v using 1:2:3 with image%s\n",
            arrows ? ", $a using 1:2:3:4 with vectors head filled size screen 0.008,20 lw 1.1 "
                     "lc '#202020'"
                   : "");
    picture_close(&p);
    xfree(scene);
    xfree(title);
}

static void draw_cells(const struct run_file *r, const struct slice *f, const char *name,
                       const struct look *l)
{
    size_t count = 0, at[3];
    double *const all =
        run_variable(r, name) < 0 ? NULL : run_record(r, name, f->times - 1, &count);
    if (all && count == f->n[0] * f->n[1] * f->n[2]) {
        double *const value = xalloc(f->n[f->across] * f->n[f->up], sizeof *value);
        at[f->axis] = f->layer;
        for (size_t k = 0; k < f->n[f->up]; k++)
            for (size_t j = 0; j < f->n[f->across]; j++) {
                at[f->across] = j;
                at[f->up] = k;
                value[k * f->n[f->across] + j] = all[cell_at(f, at)];
            }
        if (max_abs(value, f->n[f->across] * f->n[f->up]) > 0.0) /* else there is none */
            draw_slice(r, f, l, value);
        xfree(value);
    }
    xfree(all);
}

void picture_slices(const struct run_file *r)
{
    static const struct look velocity = {
        "velocity.png", "speed of the fluid",
        "m/s",          "0 '#f4f6f8', 0.3 '#9cc3e0', 0.65 '#4288c4', 1 '#0c3a78'",
        true,           true};
    static const struct look pressure = {
        "pressure.png", "pressure", "Pa", "0 '#2a5f9e', 0.5 '#f2f2ee', 1 '#b8472a'",
        false,          false};
    static const struct look porosity = {
        "porosity.png", "fluid fraction", "1", "0 '#5b4a32', 0.5 '#c9b892', 1 '#f5f9fc'", false,
        false};
    struct slice f = {.times = 0};
    if (read_slice(r, &f)) {
        draw_slice(r, &f, &velocity, f.speed);
        draw_cells(r, &f, "pressure", &pressure);
        draw_cells(r, &f, "fluid_fraction", &porosity);
    }
    void *const all[] = {f.u[0], f.u[1], f.speed};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}
