/* tools/plot.c - the pictures of a run, drawn by gnuplot from DIR/run.nc alone:
 *   one for each table that describes a figure; bed.png, the grains from the side before and after,
 *   with the porosity over height; series.png, the time series.
 * A picture is drawn under another name and renamed when it is complete. */
#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <stdbool.h>
#include "../solver/base.h"

enum { WIDTH = 1200, HEIGHT = 860, MOST_GRAINS = 20000, MOST_SERIES = 6 };

static const char *const colour[] = {"#1f5fa8", "#c8502b", "#3f8f4f", "#8a5aa8",
                                     "#b8912a", "#3a9aa8", "#777777", "#222222"};

struct run {
    int nc;
    const char *directory;
    char *title; /* "packed_bed, revision abc" */
};

/* One picture in the making. */
struct picture {
    FILE *gnuplot;
    char *path, *part;
};

static char *text_attribute(const struct run *r, int var, const char *name)
{
    size_t n = 0;
    if (nc_inq_attlen(r->nc, var, name, &n) != NC_NOERR)
        return xstrdup("");
    char *const text = xalloc(n + 1, 1);
    if (nc_get_att_text(r->nc, var, name, text) != NC_NOERR)
        text[0] = '\0';
    return text;
}

/* All of a variable; NULL if there is none. */
static double *read_all(const struct run *r, const char *name, size_t *n)
{
    int var, dims, dim[NC_MAX_VAR_DIMS];
    if (nc_inq_varid(r->nc, name, &var) != NC_NOERR || nc_inq_var(r->nc, var, NULL, NULL, &dims, dim,
                                                                 NULL) != NC_NOERR)
        return NULL;
    *n = 1;
    for (int i = 0; i < dims; i++) {
        size_t length = 0;
        nc_inq_dimlen(r->nc, dim[i], &length);
        *n *= length;
    }
    double *const x = xalloc(*n + 1, sizeof *x);
    if (nc_get_var_double(r->nc, var, x) == NC_NOERR)
        return x;
    xfree(x);
    return NULL;
}

static struct picture open_picture(const struct run *r, const char *name, int width, int height)
{
    struct picture p = {.path = xprintf("%s/%s", r->directory, name)};
    p.part = xprintf("%s.part", p.path);
    p.gnuplot = popen("gnuplot", "w");
    if (!p.gnuplot)
        die(EXIT_WRITE, "gnuplot cannot be started (package gnuplot-nox)");
    fprintf(p.gnuplot,
            "set terminal pngcairo size %d,%d enhanced font 'DejaVu Sans,13' background '#ffffff'\n"
            "set output '%s'\nset border 3 lc '#444444'\nset tics nomirror out tc '#333333'\n"
            "set grid lc '#e4e4e4' lw 1\nset key tc '#333333' spacing 1.25\n"
            "set label 1 at screen 0.995,0.012 right font ',9' tc '#999999' noenhanced '%s'\n",
            width, height, p.part, r->title);
    return p;
}

static void close_picture(struct picture *p)
{
    if (pclose(p->gnuplot) != 0 || rename(p->part, p->path) != 0)
        die(EXIT_WRITE, "%s: gnuplot could not draw it", p->path);
    printf("%s\n", p->path);
    xfree(p->path);
    xfree(p->part);
}

/* "column|style|title" in place. */
static void split_curve(char *text, char *part[3])
{
    part[0] = text;
    for (int i = 1; i < 3; i++) {
        part[i] = strchr(part[i - 1], '|');
        if (!part[i])
            die(EXIT_SCENE, "run.nc: a curve of a figure is not column|style|title");
        *part[i]++ = '\0';
    }
}

static double *read_column(const struct run *r, const char *table, const char *column, size_t *n)
{
    char *const name = xprintf("%s_%s", table, column);
    double *const x = read_all(r, name, n);
    if (!x)
        die(EXIT_SCENE, "run.nc: the figure of %s needs the column %s, which is not there", table,
            column);
    xfree(name);
    return x;
}

/* The data of a curve as block $name; entries that are not finite are left out. */
static void send_curve(FILE *to, const char *block, const double *x, const double *y, size_t n)
{
    fprintf(to, "$%s << END\n", block);
    for (size_t i = 0; i < n; i++)
        if (isfinite(x[i]) && isfinite(y[i]))
            fprintf(to, "%.10g %.10g\n", x[i], y[i]);
    fprintf(to, "END\n");
}

static void draw_figure(const struct run *r, int var, const char *table)
{
    char *const file = text_attribute(r, var, "file"), *const title = text_attribute(r, var, "title");
    char *const x_name = text_attribute(r, var, "x");
    char *const label[2] = {text_attribute(r, var, "x_label"), text_attribute(r, var, "y_label")};
    int log[2] = {0, 0};
    size_t n = 0;
    nc_get_att_int(r->nc, var, "log", log);
    double *const x = read_column(r, table, x_name, &n);
    struct picture p = open_picture(r, file, WIDTH, HEIGHT);
    FILE *const to = p.gnuplot;
    fprintf(to, "set title '%s' font ',15' noenhanced\nset xlabel '%s'\nset ylabel '%s'\n"
                "set key outside bottom center horizontal noenhanced\n%s%s",
            title, label[0], label[1], log[0] ? "set logscale x\n" : "",
            log[1] ? "set logscale y\n" : "");
    if (!log[1])
        fprintf(to, "set yrange [*:*]\nset offsets graph 0.02, graph 0.02, graph 0.05, graph 0.02\n");
    char *plot = xstrdup("plot ");
    for (int i = 0; i < 8; i++) {
        char key[32], block[32], *part[3];
        snprintf(key, sizeof key, "curve_%d", i);
        snprintf(block, sizeof block, "c%d", i);
        char *const text = text_attribute(r, var, key);
        if (text[0] != '\0') {
            split_curve(text, part);
            double *const y = read_column(r, table, part[0], &n);
            send_curve(to, block, x, y, n);
            char *const longer =
                strcmp(part[1], "points") == 0
                    ? xprintf("%s%s$%s using 1:2 with points pt 7 ps 1.5 lc '%s' title '%s'", plot,
                              i ? ", " : "", block, colour[i], part[2])
                    : xprintf("%s%s$%s using 1:2 with lines lw 2.2 dt %d lc '%s' title '%s'",
                              plot, i ? ", " : "", block, i % 4 + 1, colour[i], part[2]);
            xfree(plot);
            plot = longer;
            xfree(y);
        }
        xfree(text);
    }
    fprintf(to, "%s\n", plot);
    close_picture(&p);
    void *const all[] = {plot, x, file, title, x_name, label[0], label[1]};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

static void draw_figures(const struct run *r)
{
    int n = 0;
    nc_inq_nvars(r->nc, &n);
    for (int var = 0; var < n; var++) {
        char name[NC_MAX_NAME + 1] = "";
        nc_inq_varname(r->nc, var, name);
        if (strncmp(name, "figure_", 7) == 0)
            draw_figure(r, var, name + 7);
    }
}

/* The grains at one output time. */
struct grains_at {
    size_t n;
    double *pos, *vel; /* n x 3 */
    const double *radius;
    int *order;        /* the farthest from the viewer first */
    double time;
};

static const double *sort_depth;
static int by_depth(const void *a, const void *b)
{
    const double x = sort_depth[3 * *(const int *)a + 1], y = sort_depth[3 * *(const int *)b + 1];
    return x < y ? 1 : x > y ? -1 : 0;
}

static bool read_grains(const struct run *r, size_t t, const double *times, const double *radius,
                        size_t n, struct grains_at *g)
{
    const size_t start[3] = {t, 0, 0}, count[3] = {1, n, 3};
    int pos, vel;
    if (nc_inq_varid(r->nc, "position", &pos) || nc_inq_varid(r->nc, "velocity", &vel))
        return false;
    *g = (struct grains_at){.n = n, .radius = radius, .time = times[t]};
    g->pos = xalloc(3 * n, sizeof *g->pos);
    g->vel = xalloc(3 * n, sizeof *g->vel);
    g->order = xalloc(n, sizeof *g->order);
    if (nc_get_vara_double(r->nc, pos, start, count, g->pos) ||
        nc_get_vara_double(r->nc, vel, start, count, g->vel))
        return false;
    for (size_t i = 0; i < n; i++)
        g->order[i] = (int)i;
    sort_depth = g->pos;
    qsort(g->order, n, sizeof *g->order, by_depth);
    return true;
}

static void free_grains(struct grains_at *g)
{
    xfree(g->pos);
    xfree(g->vel);
    xfree(g->order);
}

static double speed(const struct grains_at *g, int i)
{
    const double *const v = &g->vel[3 * i];
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Discs in mm, coloured by speed in mm/s. Of a large bed only the front is drawn: what lies more
 * than a few grains behind it is hidden. */
static void send_grains(FILE *to, const struct grains_at *g, const char *block, double depth,
                        const double size[3])
{
    double largest = 0.0;
    for (size_t i = 0; i < g->n; i++)
        largest = fmax(largest, g->radius[i]);
    const double limit = g->n > 2000 ? 12.0 * largest : 2.0 * depth;
    fprintf(to, "$%s << END\n", block);
    int sent = 0;
    for (size_t k = 0; k < g->n && sent < MOST_GRAINS; k++) {
        const int i = g->order[k];
        const double *const x = &g->pos[3 * i];
        if (x[1] > limit)
            continue;
        const double across = x[0] - size[0] * floor(x[0] / size[0]);
        fprintf(to, "%.6g %.6g %.6g %.5g\n", 1e3 * across, 1e3 * x[2], 1e3 * g->radius[i],
                1e3 * speed(g, i));
        sent++;
    }
    fprintf(to, "END\n");
}

/* Porosity over height at one time: the mean over each layer. */
static bool send_profile(const struct run *r, FILE *to, size_t t, const char *block)
{
    int var, dim[4];
    size_t n[4], size = 0;
    if (nc_inq_varid(r->nc, "fluid_fraction", &var) || nc_inq_vardimid(r->nc, var, dim))
        return false;
    for (int i = 0; i < 4; i++)
        nc_inq_dimlen(r->nc, dim[i], &n[i]);
    const size_t layer = n[2] * n[3], start[4] = {t, 0, 0, 0}, count[4] = {1, n[1], n[2], n[3]};
    double *const eps = xalloc(n[1] * layer, sizeof *eps), *const z = read_all(r, "z", &size);
    if (nc_get_vara_double(r->nc, var, start, count, eps))
        return false;
    fprintf(to, "$%s << END\n", block);
    for (size_t k = 0; k < n[1]; k++) {
        double sum = 0.0;
        for (size_t i = 0; i < layer; i++)
            sum += eps[k * layer + i];
        fprintf(to, "%.8g %.8g\n", sum / (double)layer, 1e3 * z[k]);
    }
    fprintf(to, "END\n");
    xfree(eps);
    xfree(z);
    return true;
}

static void draw_bed(const struct run *r)
{
    size_t n = 0, times = 0;
    double size[3], *const radius = read_all(r, "radius", &n);
    double *const time = read_all(r, "time", &times);
    struct grains_at g[2];
    if (!radius || !time || n == 0 || times == 0 ||
        nc_get_att_double(r->nc, NC_GLOBAL, "domain_size", size))
        return;
    const size_t shown[2] = {0, times - 1};
    const int panels = times > 1 ? 2 : 1;
    double fastest = 0.0, top = 0.0;
    for (int i = 0; i < panels; i++) {
        if (!read_grains(r, shown[i], time, radius, n, &g[i]))
            return;
        for (size_t k = 0; k < n; k++) {
            fastest = fmax(fastest, 1e3 * speed(&g[i], (int)k));
            top = fmax(top, g[i].pos[3 * k + 2] + radius[k]);
        }
    }
    if (n > 1) /* the empty part of the box is not shown */
        size[2] = fmin(size[2], fmax(1.25 * top, 0.2 * size[2]));
    const double aspect = size[0] / size[2];
    const int panel = (int)fmin(fmax(620.0 * aspect + 150.0, 300.0), 640.0);
    const int height = (int)fmin(fmax((panel - 110.0) / aspect + 230.0, 520.0), 860.0);
    int var;
    const bool profile = nc_inq_varid(r->nc, "fluid_fraction", &var) == NC_NOERR;
    struct picture p = open_picture(r, "bed.png", panels * panel + (profile ? 420 : 0) + 110, height);
    FILE *const to = p.gnuplot;
    const int columns = panels + profile;
    fprintf(to, "set multiplot layout 1,%d margins 0.07,%g,0.17,0.92 spacing 0.07,0.05\n"
                "set palette defined (0 '#6f97c4', 0.5 '#b9d3ea', 1 '#e8a83a')\n"
                "set cbrange [0:%g]\nset label 2 at screen 0.30,0.062 'speed, mm/s'\n"
                "set colorbox horizontal user origin screen 0.07,0.055 size screen 0.22,0.016\n"
                "set xlabel 'x, mm'\n"
                "set ylabel 'z, mm'\nset yrange [0:%g]\nset xrange [0:%g]\n"
                "set style fill solid 1.0 border lc '#1b2c4a'\nunset key\nset size ratio -1\n",
            columns, 0.93, fastest > 0.0 ? fastest : 1.0, 1e3 * size[2], 1e3 * size[0]);
    for (int i = 0; i < panels; i++) {
        char block[16];
        snprintf(block, sizeof block, "g%d", i);
        send_grains(to, &g[i], block, size[1], size);
        fprintf(to, "%s\nset title 't = %.4g s' font ',14'\n"
                    "plot $%s using 1:2:3:4 with circles lc palette lw 0.3\n",
                i > 0 ? "unset colorbox\nunset ylabel" : "", g[i].time, block);
        free_grains(&g[i]);
    }
    if (profile) {
        fprintf(to, "set size noratio\nset key at graph 0.98,0.98 right top\nset xrange [0:1.02]\n"
                    "set xlabel 'fluid fraction (mean of the layer)'\nset ylabel 'z, mm'\nset title 'porosity over height' "
                    "font ',14'\nunset colorbox\n");
        for (int i = 0; i < panels; i++) {
            char block[16];
            snprintf(block, sizeof block, "p%d", i);
            send_profile(r, to, shown[i], block);
        }
        if (panels == 2)
            fprintf(to, "plot $p0 using 1:2 with linespoints pt 7 ps 0.6 lw 2 lc '%s' title 't = %.3g "
                        "s', $p1 using 1:2 with linespoints pt 6 ps 0.8 lw 2 lc '%s' title 't = %.3g "
                        "s'\n", colour[0], time[0], colour[1], time[times - 1]);
        else
            fprintf(to, "plot $p0 using 1:2 with linespoints pt 7 ps 0.6 lw 2 lc '%s' notitle\n",
                    colour[0]);
    }
    fprintf(to, "unset multiplot\n");
    close_picture(&p);
    xfree(radius);
    xfree(time);
}

/* Names of the variables on the dimension `sample`; returns how many. */
static int list_series(const struct run *r, int most, int *list)
{
    int n = 0, vars = 0, sample;
    nc_inq_nvars(r->nc, &vars);
    if (nc_inq_dimid(r->nc, "sample", &sample) != NC_NOERR)
        return 0;
    for (int var = 0; var < vars && n < most; var++) {
        int dims = 0, dim[NC_MAX_VAR_DIMS];
        char name[NC_MAX_NAME + 1] = "";
        nc_inq_var(r->nc, var, name, NULL, &dims, dim, NULL);
        if (dims == 1 && dim[0] == sample && strcmp(name, "sample_time") != 0)
            list[n++] = var;
    }
    return n;
}

static void draw_series(const struct run *r)
{
    int list[MOST_SERIES];
    size_t samples = 0;
    const int n = list_series(r, MOST_SERIES, list);
    double *const time = read_all(r, "sample_time", &samples);
    if (n == 0 || !time || samples < 2)
        return;
    const int rows = n > 3 ? 2 : 1, columns = (n + rows - 1) / rows;
    struct picture p = open_picture(r, "series.png", 460 * columns, 400 * rows + 40);
    FILE *const to = p.gnuplot;
    fprintf(to, "set multiplot layout %d,%d\nunset key\nset xlabel 'time, s'\nset format y '%%.3g'\n",
            rows, columns);
    for (int i = 0; i < n; i++) {
        char name[NC_MAX_NAME + 1] = "";
        nc_inq_varname(r->nc, list[i], name);
        char *const unit = text_attribute(r, list[i], "units");
        char *const title = text_attribute(r, list[i], "long_name");
        double *const y = read_all(r, name, &samples);
        send_curve(to, "s", time, y, samples);
        fprintf(to, "set title '%s' font ',12' noenhanced\nset ylabel '%s' noenhanced\n"
                    "plot $s using 1:2 with lines lw 1.8 lc '%s'\n", title,
                strcmp(unit, "1") == 0 ? "" : unit, colour[i % 8]);
        xfree(unit);
        xfree(title);
        xfree(y);
    }
    fprintf(to, "unset multiplot\n");
    close_picture(&p);
    xfree(time);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: plot DIR\n");
        return EXIT_SCENE;
    }
    struct run r = {.directory = argv[1]};
    char *const path = xprintf("%s/run.nc", argv[1]);
    const int status = nc_open(path, NC_NOWRITE, &r.nc);
    if (status != NC_NOERR)
        die(EXIT_SCENE, "%s: cannot be read: %s", path, nc_strerror(status));
    if (system("command -v gnuplot > /dev/null") != 0)
        die(EXIT_WRITE, "there is no gnuplot (package gnuplot-nox)");
    char *const file = text_attribute(&r, NC_GLOBAL, "scene_file");
    char *const revision = text_attribute(&r, NC_GLOBAL, "revision");
    r.title = xprintf("silt %s, %s", revision, file);
    draw_figures(&r);
    draw_bed(&r);
    draw_series(&r);
    nc_close(r.nc);
    void *const all[] = {path, file, revision, r.title};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    return EXIT_GOOD;
}
