/* tools/plot.c - the pictures of a run, drawn from DIR/run.nc alone: one for each table that
 * describes a figure; bed.png, the grains from the side and the porosity over height;
 * series.png, the time series. */
#include <netcdf.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../solver/picture.h"

enum { MOST_CURVES = 8, MOST_SERIES = 6 };

struct curve {
    char *text, *column, *style, *title; /* the latter three lie in text */
    double *y;
};

struct figure {
    const char *table;
    int n, log[2];
    size_t rows;
    double *x;
    struct curve curve[MOST_CURVES];
};

static double *read_column(const struct run_file *r, const struct figure *f, const char *column)
{
    char *const name = xprintf("%s_%s", f->table, column);
    size_t n = 0;
    double *const x = run_all(r, name, &n);
    if (!x || n != f->rows)
        die(EXIT_SCENE, "%s: the figure of %s needs the column %s, which is not there", r->path,
            f->table, column);
    xfree(name);
    return x;
}

static void read_curves(const struct run_file *r, int var, struct figure *f)
{
    for (int i = 0; i < MOST_CURVES; i++) {
        struct curve *const c = &f->curve[f->n];
        char *const key = xprintf("curve_%d", i);
        c->column = c->text = run_text(r, var, key);
        xfree(key);
        if (c->text[0] == '\0') {
            xfree(c->text);
            continue;
        }
        c->style = strchr(c->text, '|');
        c->title = c->style ? strchr(c->style + 1, '|') : NULL;
        if (!c->title)
            die(EXIT_SCENE, "%s: a curve of figure_%s is not column|style|title", r->path,
                f->table);
        *c->style++ = *c->title++ = '\0';
        c->y = read_column(r, f, c->column);
        f->n++;
    }
}

/* Range of a linear axis: from 0 where the data come near it, else with a margin. What varies
 * by round-off only counts as constant. */
static void send_range(FILE *to, const char *axis, double least, double most)
{
    const double size = fmax(fabs(least), fabs(most));
    const double span = most - least > 1e-6 * size ? most - least : size;
    const bool zero = least >= 0.0 && least <= 0.4 * most;
    fprintf(to, "set %srange [%.10g:%.10g]\n", axis, zero ? 0.0 : least - 0.04 * span,
            size > 0.0 ? most + 0.04 * span : 1.0);
}

static void send_ranges(FILE *to, const struct figure *f)
{
    double least[2] = {HUGE_VAL, HUGE_VAL}, most[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < f->n; i++)
        for (size_t k = 0; k < f->rows; k++) {
            const double at[2] = {f->x[k], f->curve[i].y[k]};
            for (int a = 0; a < 2 && isfinite(at[0]) && isfinite(at[1]); a++) {
                least[a] = fmin(least[a], at[a]);
                most[a] = fmax(most[a], at[a]);
            }
        }
    for (int a = 0; a < 2; a++) {
        if (f->log[a])
            fprintf(to, "set logscale %s\nset format %s '10^{%%L}'\n", a ? "y" : "x",
                    a ? "y" : "x");
        else if (most[a] >= least[a])
            send_range(to, a ? "y" : "x", least[a], most[a]);
    }
}

/* Entries that are not finite are left out. */
static void send_block(FILE *to, const char *block, const double *x, const double *y, size_t n)
{
    fprintf(to, "$%s << END\n", block);
    for (size_t i = 0; i < n; i++)
        if (isfinite(x[i]) && isfinite(y[i]))
            fprintf(to, "%.10g %.10g\n", x[i], y[i]);
    fprintf(to, "END\n");
}

/* Few points lie on the lines, many points under them. Of lines that coincide, the later is
 * thinner and dashed, so that both are seen. */
static void send_curves(FILE *to, const struct figure *f)
{
    static const char *const dash[] = {"1", "(14,6)", "(3,5)", "(14,5,3,5)"};
    const bool many = f->rows > 60;
    const char *between = "plot ";
    for (int i = 0; i < f->n; i++) {
        char block[16];
        snprintf(block, sizeof block, "c%d", i);
        send_block(to, block, f->x, f->curve[i].y, f->rows);
    }
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0, line = 0; i < f->n; i++) {
            const bool points = strcmp(f->curve[i].style, "points") == 0;
            char *const title = picture_quoted(f->curve[i].title);
            if (points == (pass == (many ? 0 : 1))) {
                fprintf(to, "%s$c%d using 1:2 with ", between, i);
                if (points)
                    fprintf(to, "points pt 7 ps %g lc '%s'", many ? 0.8 : 1.5,
                            picture_colour[i]);
                else
                    fprintf(to, "lines lw %g dt %s lc '%s'",
                            many ? 1.8 : fmax(1.8, 3.0 - 0.5 * line), dash[line % 4],
                            picture_colour[i]);
                fprintf(to, " title %s", title);
                between = ", ";
            }
            line += !points;
            xfree(title);
        }
    fprintf(to, "\n");
}

static void draw_figure(const struct run_file *r, int var, const char *table)
{
    struct figure f = {.table = table};
    char *const file = run_text(r, var, "file"), *const title = run_text(r, var, "title");
    char *const x = run_text(r, var, "x"), *const x_label = run_text(r, var, "x_label");
    char *const y_label = run_text(r, var, "y_label"), *const scene = picture_scene(r);
    char *const rows = xprintf("%s_row", table), *const head = xprintf("%s: %s", scene, title);
    f.rows = run_length(r, rows);
    f.x = read_column(r, &f, x);
    nc_get_att_int(r->nc, var, "log", f.log);
    read_curves(r, var, &f);
    if (f.n > 0 && f.rows > 0 && strchr(file, '/') == NULL && file[0] != '\0') {
        struct picture p = picture_open(r, file, 1200, 900);
        FILE *const to = p.gnuplot;
        const double strip = 26.0 + 27.0 * ((f.n + 1) / 2); /* the legend, two a line */
        picture_text(to, "title", head, "font ',16' noenhanced");
        picture_text(to, "xlabel", x_label, "");
        picture_text(to, "ylabel", y_label, "");
        fprintf(to,
                "set bmargin at screen %g\nset tmargin at screen 0.93\n"
                "set lmargin at screen 0.1\nset rmargin at screen 0.965\n"
                "set key at screen 0.53,%g center top horizontal maxcols 2 width 3\n",
                (strip + 66.0) / p.height, strip / p.height);
        send_ranges(to, &f);
        send_curves(to, &f);
        picture_close(&p);
    }
    for (int i = 0; i < f.n; i++) {
        xfree(f.curve[i].text);
        xfree(f.curve[i].y);
    }
    void *const all[] = {f.x, file, title, x, x_label, y_label, scene, rows, head};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

static void draw_figures(const struct run_file *r)
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

/* The first variables on the dimension `sample`; returns how many. */
static int list_series(const struct run_file *r, int list[MOST_SERIES])
{
    int n = 0, vars = 0, sample;
    nc_inq_nvars(r->nc, &vars);
    if (nc_inq_dimid(r->nc, "sample", &sample) != NC_NOERR)
        return 0;
    for (int var = 0; var < vars && n < MOST_SERIES; var++) {
        int dims = 0, dim[NC_MAX_VAR_DIMS];
        char name[NC_MAX_NAME + 1] = "";
        nc_inq_var(r->nc, var, name, NULL, &dims, dim, NULL);
        if (dims == 1 && dim[0] == sample && strcmp(name, "sample_time") != 0)
            list[n++] = var;
    }
    return n;
}

static void draw_one_series(const struct run_file *r, FILE *to, int var, const double *time,
                            int i)
{
    char name[NC_MAX_NAME + 1] = "";
    nc_inq_varname(r->nc, var, name);
    char *const unit = run_text(r, var, "units"), *const title = run_text(r, var, "long_name");
    size_t n = 0;
    double *const y = run_all(r, name, &n), least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t k = 0; k < n; k++) {
        least = isfinite(y[k]) ? fmin(least, y[k]) : least;
        most = isfinite(y[k]) ? fmax(most, y[k]) : most;
    }
    if (!(least <= most)) /* nothing finite */
        least = most = 0.0;
    send_block(to, "s", time, y, n);
    char *const head =
        strcmp(unit, "1") == 0 ? xstrdup(title) : xprintf("%s / %s", title, unit);
    picture_text(to, "title", head, "font ',12' noenhanced");
    send_range(to, "y", least, most);
    fprintf(to, "plot $s using 1:2 with lines lw 1.5 lc '%s'\n",
            picture_colour[i % PICTURE_COLOURS]);
    xfree(unit);
    xfree(title);
    xfree(head);
    xfree(y);
}

static void draw_series(const struct run_file *r)
{
    int list[MOST_SERIES];
    size_t samples = 0;
    const int n = list_series(r, list);
    double *const time = run_all(r, "sample_time", &samples);
    if (n > 0 && time && samples > 1) {
        const int rows = n > 3 ? 2 : 1, columns = (n + rows - 1) / rows;
        const int width = columns > 1 ? 440 * columns : 800, height = 390 * rows + 70;
        char *const scene = picture_scene(r), *const head = xprintf("%s: time series", scene);
        struct picture p = picture_open(r, "series.png", width, height);
        FILE *const to = p.gnuplot;
        fprintf(to, "set multiplot layout %d,%d margins %g,%g,%g,%g spacing %g,%g\n", rows,
                columns, 95.0 / width, 1.0 - 25.0 / width, 75.0 / height, 1.0 - 85.0 / height,
                105.0 / width, 120.0 / height);
        picture_text(to, "label 2", head, "at screen 0.5,0.97 center font ',15' noenhanced");
        fprintf(to, "unset key\nset xlabel 'time, s'\nset xrange [%.10g:%.10g]\n",
                fmin(0.0, time[0]), time[samples - 1]);
        fprintf(to, "set format y '%%.5g'\n");
        for (int i = 0; i < n; i++) {
            draw_one_series(r, to, list[i], time, i);
            fprintf(to, "unset label\n");
        }
        fprintf(to, "unset multiplot\n");
        picture_close(&p);
        xfree(scene);
        xfree(head);
    }
    xfree(time);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: plot DIR\n");
        return EXIT_SCENE;
    }
    struct run_file r = run_open(argv[1]);
    if (system("command -v gnuplot > /dev/null") != 0)
        die(EXIT_WRITE, "there is no gnuplot (package gnuplot-nox)");
    signal(SIGPIPE, SIG_IGN); /* a gnuplot that ends early shows in its status */
    draw_figures(&r);
    picture_bed(&r);
    picture_chains(&r);
    picture_slices(&r);
    draw_series(&r);
    run_close(&r);
    return EXIT_GOOD;
}
