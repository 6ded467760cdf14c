/* picture_bed.c - bed.png: the grains from the side, to scale, at the first and the last
 * output, and beside them the porosity over height (the mean of each layer of cells) on the
 * same axis of height. The viewer looks along y; the nearest grains are drawn last. Colour is
 * speed, or the species where all is at rest. Walls as of picture_walls.h. */
#include "picture_shapes.h"
#include "picture_speed.h"
#include "picture_walls.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_GRAINS = 20000,
    LEFT = 85,
    GAP = 60,
    TOP = 95,
    BOTTOM = 165,
    PROFILE = 300,
    LEAST_WIDE = 560
};

struct bed {
    size_t n[2], times, shown[2];
    int panels;
    double size[3];         /* m, of the box */
    double low[2], high[2]; /* m, range of x and z shown */
    double *radius[2], *species[2], *time;
    bool shaped; /* the grains are no spheres */
    struct shapes_seen shapes;
    double *turn[2];
    double period;           /* m, of x; 0: none */
    double *pos[2], *vel[2]; /* n x 3 */
    double fastest; /* m/s, the 99th percentile: a few outliers do not rule the scale */
    bool profile;
    struct picture_walls walls[2];
    int x0, z0;     /* pixels: where the panels begin */
    int across, up; /* pixels: size of a panel */
};

static double speed(const double *vel, size_t i)
{
    const double *const v = &vel[3 * i];
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double percentile_99(const double *vel, size_t n)
{
    double *const v = xalloc(n, sizeof *v);
    for (size_t i = 0; i < n; i++)
        v[i] = speed(vel, i);
    qsort(v, n, sizeof *v, ascending);
    const double out = v[(n - 1) - (n - 1) / 100];
    xfree(v);
    return out;
}

/* The part of the box that is shown: its empty top is not. */
static void choose_range(struct bed *b, const int periodic[3])
{
    double top = 0.0, widest = 0.0;
    for (int k = 0; k < b->panels; k++)
        for (size_t i = 0; i < b->n[k]; i++) {
            widest = fmax(widest, b->radius[k][i]);
            top = fmax(top, b->pos[k][3 * i + 2] + b->radius[k][i]);
        }
    const double edge =
        periodic[0] ? widest : 0.0; /* grains may stick out of a periodic side */
    b->low[0] = -edge;
    b->high[0] = b->size[0] + edge;
    b->low[1] = periodic[2] ? -widest : 0.0;
    b->high[1] = b->size[2] - b->low[1];
    for (int k = 0; k < b->panels; k++) {
        double low, high;
        if (picture_walls_range(&b->walls[k], b->size[2], &low, &high))
            top = fmax(top, fmin(high / 1.12, b->size[2]));
    }
    if (b->n[0] > 1)
        b->high[1] = fmin(b->high[1], 1.15 * top);
}

/* Pixels: as large as fits, never lower than the profile can be read. */
static void choose_pixels(struct bed *b)
{
    const double wide = b->high[0] - b->low[0];
    const double scale =
        fmin(640.0 / (b->high[1] - b->low[1]), (b->panels > 1 ? 520.0 : 800.0) / wide);
    b->across = (int)(wide * scale);
    b->up = (int)((b->high[1] - b->low[1]) * scale);
    if (b->up < 300) {
        b->up = 300;
        b->high[1] = b->low[1] + 300.0 / scale;
    }
    b->x0 = LEFT;
    if (b->across < 260) /* room for the title of the panel */
        b->x0 += (260 - b->across) / 2;
}

static int panel_step(const struct bed *b)
{
    return (b->across < 260 ? 260 : b->across) + GAP;
}

/* Grains of panel k with their sizes: the same at all times, or those of its output. */
static bool read_sizes(const struct run_file *r, struct bed *b, int k, const double *count)
{
    size_t n = 0;
    const size_t t = b->shown[k];
    b->radius[k] =
        count ? run_record(r, "radius", t, &b->n[k]) : run_all(r, "radius", &b->n[k]);
    b->species[k] =
        count ? run_record(r, "grain_species", t, &n) : run_all(r, "grain_species", &n);
    const bool good = b->radius[k] && b->species[k] && n == b->n[k];
    if (count)
        b->n[k] = count[t] < (double)n ? (size_t)count[t] : n;
    return good && b->n[k] > 0;
}

static bool read_bed(const struct run_file *r, struct bed *b)
{
    int periodic[3];
    size_t got[2] = {0, 0}, n = 0;
    b->time = run_all(r, "time", &b->times);
    if (b->times == 0 || !b->time ||
        nc_get_att_double(r->nc, NC_GLOBAL, "domain_size", b->size) != NC_NOERR ||
        nc_get_att_int(r->nc, NC_GLOBAL, "domain_periodic", periodic) != NC_NOERR)
        return false;
    b->shown[1] = b->times - 1;
    double *const count = run_all(r, "grain_count", &n);
    b->panels = b->times > 1 ? 2 : 1;
    if (count && count[0] < 1.0) { /* nothing to see at the start */
        b->panels = 1;
        b->shown[0] = b->times - 1;
    }
    bool good = true;
    b->shaped = picture_shapes_read(r, &b->shapes);
    b->period = periodic[0] ? b->size[0] : 0.0;
    for (int k = 0; k < b->panels; k++)
        good = read_sizes(r, b, k, count) && good;
    xfree(count);
    for (int k = 0; k < b->panels && good; k++) {
        b->pos[k] = run_record(r, "position", b->shown[k], &got[0]);
        b->vel[k] = run_record(r, "velocity", b->shown[k], &got[1]);
        good = b->pos[k] && b->vel[k] && got[0] >= 3 * b->n[k] && got[1] >= 3 * b->n[k];
        b->turn[k] = b->shaped ? run_record(r, "orientation", b->shown[k], &n) : NULL;
        good = good && (!b->shaped || (b->turn[k] && n >= 4 * b->n[k]));
        if (good)
            b->fastest = fmax(b->fastest, percentile_99(b->vel[k], b->n[k]));
    }
    for (int k = 0; k < b->panels && good; k++)
        b->walls[k] = picture_walls_read(r, b->shown[k]);
    if (!good)
        return false;
    b->profile = run_variable(r, "fluid_fraction") >= 0 && run_length(r, "z") > 1;
    choose_range(b, periodic);
    choose_pixels(b);
    return true;
}

struct depth {
    double y;
    size_t i;
};

static int farthest_first(const void *a, const void *b)
{
    const struct depth *const p = a, *const q = b;
    return p->y < q->y ? 1 : p->y > q->y ? -1 : (p->i < q->i) - (p->i > q->i);
}

/* Discs: x, z, radius in mm; speed in mm/s or the species. */
static void send_grains(FILE *to, const struct bed *b, int k)
{
    struct depth *const order = xalloc(b->n[k], sizeof *order);
    for (size_t i = 0; i < b->n[k]; i++)
        order[i] = (struct depth){b->pos[k][3 * i + 1], i};
    qsort(order, b->n[k], sizeof *order, farthest_first);
    fprintf(to, "$g%d << END\n", k);
    for (size_t m = b->n[k] > MOST_GRAINS ? b->n[k] - MOST_GRAINS : 0; m < b->n[k]; m++) {
        const size_t i = order[m].i;
        const double *const x = &b->pos[k][3 * i];
        const double at = b->low[0] < 0.0 ? x[0] - b->size[0] * floor(x[0] / b->size[0]) : x[0];
        fprintf(to, "%.6g %.6g %.6g %.5g\n", 1e3 * at, 1e3 * x[2], 1e3 * b->radius[k][i],
                b->fastest > 0.0 ? 1e3 * speed(b->vel[k], i) : b->species[k][i]);
    }
    fprintf(to, "END\n");
    xfree(order);
}

/* Porosity over height: the mean over each layer, at height z in mm. */
static void send_profile(const struct run_file *r, FILE *to, const struct bed *b, int k)
{
    size_t n = 0, layers = 0;
    double *const eps = run_record(r, "fluid_fraction", b->shown[k], &n);
    double *const z = run_all(r, "z", &layers);
    const size_t layer = n / layers;
    fprintf(to, "$p%d << END\n", k);
    for (size_t l = 0; l < layers; l++)
        fprintf(to, "%.8g %.8g\n", sum_blocks(&eps[l * layer], layer) / (double)layer,
                1e3 * z[l]);
    fprintf(to, "END\n");
    xfree(eps);
    xfree(z);
}

/* Margins of panel number k, `across` pixels wide. */
static void set_margins(const struct picture *p, const struct bed *b, int from, int across)
{
    fprintf(p->gnuplot,
            "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\n"
            "set tmargin at screen %g\n",
            (double)from / p->width, (double)(from + across) / p->width,
            (double)BOTTOM / p->height, (double)(BOTTOM + b->up) / p->height);
}

/* What the colours mean: a scale of speed, or the names of the species; below the first panel.
 */
static void set_colours(const struct run_file *r, const struct picture *p, const struct bed *b)
{
    FILE *const to = p->gnuplot;
    if (b->fastest > 0.0) {
        speed_bar(p, LEFT, 62, b->fastest, b->n[b->panels - 1] >= 100);
        return;
    }
    char *const names = run_text(r, run_variable(r, "grain_species"), "flag_meanings");
    int k = 0;
    fprintf(to, "unset colorbox\nset cbrange [0:%d]\nset palette maxcolors %d defined (",
            PICTURE_COLOURS, PICTURE_COLOURS);
    for (int c = 0; c < PICTURE_COLOURS; c++)
        fprintf(to, "%s%d '%s', %d '%s'", c ? ", " : "", c, picture_colour[c], c + 1,
                picture_colour[c]);
    fprintf(to, ")\n");
    for (char *name = strtok(names, " "); name && k < PICTURE_COLOURS;
         name = strtok(NULL, " "), k++) {
        char *const what = xprintf("label %d", 10 + k);
        char *const where =
            xprintf("at screen %g,%g left noenhanced point pt 7 ps 1.6 lc '%s' offset 1.2,0",
                    (LEFT + 10.0 + 150.0 * k) / p->width, 62.0 / p->height, picture_colour[k]);
        picture_text(to, what, name, where);
        xfree(what);
        xfree(where);
    }
    xfree(names);
}

/* Grains that are no spheres, as an image: x, z in mm, red, green, blue. */
static void send_shapes(FILE *to, const struct bed *b, int k)
{
    double *const colour = xalloc(3 * b->n[k] + 1, sizeof *colour);
    for (size_t i = 0; i < b->n[k]; i++)
        if (b->fastest > 0.0)
            speed_colour(speed(b->vel[k], i) / b->fastest, &colour[3 * i]);
        else
            hex_colour(picture_colour[(int)b->species[k][i] % PICTURE_COLOURS], &colour[3 * i]);
    const struct shapes_view v = {.n = b->n[k],
                                  .pos = b->pos[k],
                                  .radius = b->radius[k],
                                  .species = b->species[k],
                                  .turn = b->turn[k],
                                  .colour = colour,
                                  .low = {b->low[0], b->low[1]},
                                  .high = {b->high[0], b->high[1]},
                                  .period = b->period,
                                  .across = b->across,
                                  .up = b->up};
    fprintf(to, "$g%d << END\n", k);
    picture_shapes_send(to, &b->shapes, &v);
    fprintf(to, "END\n");
    xfree(colour);
}

static void draw_grains(const struct picture *p, const struct bed *b, int k)
{
    FILE *const to = p->gnuplot;
    const double half = b->fastest > 0.0 ? 0.0 : 0.5; /* middle of a species' colour */
    char name[16];
    snprintf(name, sizeof name, "w%d", k);
    if (b->shaped)
        send_shapes(to, b, k);
    else
        send_grains(to, b, k);
    if (b->walls[k].n > 0)
        picture_walls_send(to, name, &b->walls[k], PICTURE_CUT * b->size[1]);
    set_margins(p, b, b->x0 + k * panel_step(b), b->across);
    fprintf(to,
            "set title 't = %.4g s' font ',14'\nset xrange [%.8g:%.8g]\nset xtics %g\nplot ",
            b->time[b->shown[k]], 1e3 * b->low[0], 1e3 * b->high[0],
            tick_step(1e3 * b->low[0], 1e3 * b->high[0], b->across));
    if (b->walls[k].n > 0)
        picture_walls_behind(to, name);
    if (b->shaped) /* the second plot draws nothing but has a scale of colours */
        fprintf(to,
                "$g%d using 1:2:3:4:5:6 with rgbalpha, '+' using (-1e9):(-1e9):(0) with points "
                "palette",
                k);
    else
        fprintf(to, "$g%d using 1:2:3:($4+%g) with circles lc palette lw 0.4", k, half);
    if (b->walls[k].n > 0)
        picture_walls_cut(to, name);
    fprintf(to, "\nunset label\nunset colorbox\nset ylabel ''\n");
}

static void draw_profile(const struct run_file *r, const struct picture *p, const struct bed *b)
{
    FILE *const to = p->gnuplot;
    const int from = LEFT + b->panels * panel_step(b) + 20;
    for (int k = 0; k < b->panels; k++)
        send_profile(r, to, b, k);
    set_margins(p, b, from, PROFILE);
    fprintf(to,
            "set title 'porosity over height' font ',14'\nset xlabel 'porosity'\n"
            "set ylabel 'z, mm'\nset border 3\nset xrange [0:1.03]\nset xtics 0.2\n"
            "set key at screen %g,%g center top maxrows 1\n",
            (from + 0.5 * PROFILE) / p->width, 84.0 / p->height);
    for (int k = 0; k < b->panels; k++)
        fprintf(
            to,
            "%s $p%d using 1:2 with linespoints pt %d ps 0.8 lw 2 lc '%s' title 't = %.4g s'%s",
            k ? "" : "plot", k, k ? 7 : 6, picture_colour[k], b->time[b->shown[k]],
            k + 1 < b->panels ? "," : "\n");
}

static void draw(const struct run_file *r, const struct bed *b)
{
    const int width =
        LEFT + b->panels * panel_step(b) + (b->profile ? 20 + PROFILE + 30 : -GAP + 30);
    struct picture p = picture_open(r, "bed.png", width < LEAST_WIDE ? LEAST_WIDE : width,
                                    TOP + b->up + BOTTOM);
    FILE *const to = p.gnuplot;
    char *const scene = picture_scene(r);
    char *const head = xprintf("%s: %zu grain%s, from the side", scene, b->n[b->panels - 1],
                               b->n[b->panels - 1] > 1 ? "s" : "");
    fprintf(to, "set multiplot\n");
    picture_text(to, "label 2", head, "at screen 0.5,0.965 center font ',16' noenhanced");
    set_colours(r, &p, b);
    fprintf(to,
            "set xlabel 'x, mm'\nset ylabel 'z, mm'\nset yrange [%.8g:%.8g]\nset border 15\n"
            "set style fill solid 1.0 border lc '#24364d'\nunset key\n",
            1e3 * b->low[1], 1e3 * b->high[1]);
    for (int k = 0; k < b->panels; k++)
        draw_grains(&p, b, k);
    if (b->profile)
        draw_profile(r, &p, b);
    fprintf(to, "unset multiplot\n");
    picture_close(&p);
    xfree(scene);
    xfree(head);
}

void picture_bed(const struct run_file *r)
{
    struct bed b = {0};
    if (read_bed(r, &b))
        draw(r, &b);
    picture_walls_free(&b.walls[0]);
    picture_walls_free(&b.walls[1]);
    picture_shapes_free(&b.shapes);
    void *const all[] = {b.turn[0],    b.turn[1],    b.radius[0], b.radius[1],
                         b.species[0], b.species[1], b.time,      b.pos[0],
                         b.pos[1],     b.vel[0],     b.vel[1]};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}
