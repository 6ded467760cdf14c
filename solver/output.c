/* output.c - run.nc, by walking the tables of table.h. The file is written as run.nc.part and takes
 * its name when it is complete; it is synced after every output, so that a run that ends badly
 * leaves what it had. */
#include "output.h"

#include <errno.h>
#include <netcdf.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include "provenance_info.h"
#include "sim.h"
#include "xdmf.h"

enum { DIM_GRAIN, DIM_COMPONENT, DIM_X, DIM_Y, DIM_Z, DIM_XF, DIM_YF, DIM_ZF, DIM_TIME, DIM_SAMPLE,
       DIMS };

/* The file being written. */
struct file {
    int nc;
    char *path, *part;
    int dim[DIMS];
    int var_time, var_sample;
    int *var_field, *var_series;
    size_t n_time, n_sample;
};

static struct file out = {.nc = -1};

static void check(const struct file *f, int status)
{
    if (status == NC_NOERR)
        return;
    const int error = errno;
    die(EXIT_WRITE, "%s: cannot be written: %s%s%s", f->part, nc_strerror(status),
        error ? ": " : "", error ? strerror(error) : "");
}

static void put_text(const struct file *f, int var, const char *key, const char *text)
{
    check(f, nc_put_att_text(f->nc, var, key, strlen(text), text));
}

static void describe(const struct file *f, int var, const char *unit, const char *long_name)
{
    put_text(f, var, "units", unit);
    put_text(f, var, "long_name", long_name);
}

static int define(const struct file *f, const char *name, int type, int n, const int *dims,
                  const char *unit, const char *long_name)
{
    int var;
    check(f, nc_def_var(f->nc, name, type, n, dims, &var));
    describe(f, var, unit, long_name);
    return var;
}

/* Makes a folder and those above it. */
static void make_folder(const char *path)
{
    char *const copy = xstrdup(path);
    for (char *c = copy + 1;; c++) {
        const char was = *c;
        if (was != '/' && was != '\0')
            continue;
        *c = '\0';
        if (mkdir(copy, 0777) != 0 && errno != EEXIST)
            die(EXIT_WRITE, "%s: the folder cannot be made: %s", copy, strerror(errno));
        *c = was;
        if (was == '\0')
            break;
    }
    struct stat info;
    if (stat(path, &info) != 0 || !S_ISDIR(info.st_mode))
        die(EXIT_WRITE, "%s: is not a folder", path);
    xfree(copy);
}

static void define_axes(struct file *f, const struct sim *s)
{
    static const char *const centre[3] = {"x", "y", "z"}, *const face[3] = {"xf", "yf", "zf"};
    static const char *const axis[3] = {"X", "Y", "Z"};
    for (int a = 0; a < 3; a++) {
        check(f, nc_def_dim(f->nc, centre[a], (size_t)s->grid.n[a], &f->dim[DIM_X + a]));
        check(f, nc_def_dim(f->nc, face[a], (size_t)s->grid.n[a] + 1, &f->dim[DIM_XF + a]));
        int var = define(f, centre[a], NC_DOUBLE, 1, &f->dim[DIM_X + a], "m", "centre of the cell");
        put_text(f, var, "axis", axis[a]);
        var = define(f, face[a], NC_DOUBLE, 1, &f->dim[DIM_XF + a], "m", "face of the cell");
        put_text(f, var, "axis", axis[a]);
    }
}

static void write_axes(struct file *f, const struct sim *s)
{
    static const char *const name[2][3] = {{"x", "y", "z"}, {"xf", "yf", "zf"}};
    for (int face = 0; face < 2; face++)
        for (int a = 0; a < 3; a++) {
            const int n = s->grid.n[a] + face;
            double *const x = xalloc((size_t)n, sizeof *x);
            int var;
            for (int i = 0; i < n; i++)
                x[i] = (i + (face ? 0.0 : 0.5)) * s->grid.h[a];
            check(f, nc_inq_varid(f->nc, name[face][a], &var));
            check(f, nc_put_var_double(f->nc, var, x));
            xfree(x);
        }
}

/* Dimensions of a field's variable, after time; returns how many. */
static int field_dims(const struct file *f, const struct field *field, int dims[4])
{
    int n = 0;
    dims[n++] = f->dim[DIM_TIME];
    if (field->place == PLACE_GRAIN) {
        dims[n++] = f->dim[DIM_GRAIN];
        if (field->kind == KIND_VEC3)
            dims[n++] = f->dim[DIM_COMPONENT];
        return n;
    }
    for (int a = 2; a >= 0; a--)
        dims[n++] = f->dim[(int)field->place - PLACE_FACE_X == a ? DIM_XF + a : DIM_X + a];
    return n;
}

static bool is_written(const struct sim *s, const struct field *field)
{
    return field->flags & FIELD_OUTPUT && (field->place != PLACE_GRAIN || s->grains.n > 0);
}

static void define_fields(struct file *f, const struct sim *s)
{
    f->var_field = xalloc((size_t)s->fields.n + 1, sizeof *f->var_field);
    for (int i = 0; i < s->fields.n; i++) {
        const struct field *const field = &s->fields.field[i];
        int dims[4];
        if (!is_written(s, field))
            continue;
        const int n = field_dims(f, field, dims);
        f->var_field[i] = define(f, field->name, field->kind == KIND_INT ? NC_INT : NC_DOUBLE, n,
                                 dims, field->unit, field->long_name);
    }
}

static void define_grains(struct file *f, const struct sim *s)
{
    const struct grains *const g = &s->grains;
    char names[1024] = "";
    check(f, nc_def_dim(f->nc, "grain", (size_t)g->n, &f->dim[DIM_GRAIN]));
    check(f, nc_def_dim(f->nc, "component", 3, &f->dim[DIM_COMPONENT]));
    const int *const dim = &f->dim[DIM_GRAIN];
    define(f, "radius", NC_DOUBLE, 1, dim, "m", "bounding radius of the grain");
    define(f, "grain_mass", NC_DOUBLE, 1, dim, "kg", "mass of the grain");
    const int var = define(f, "grain_species", NC_INT, 1, dim, "1", "index of the species");
    for (int k = 0; k < g->n_species; k++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", k ? " " : "",
                 g->species[k].name);
    put_text(f, var, "flag_meanings", names);
}

static void write_grains(struct file *f, const struct sim *s)
{
    const struct grains *const g = &s->grains;
    double *const x = xalloc((size_t)g->n, sizeof *x);
    int *const k = xalloc((size_t)g->n, sizeof *k), var;
    for (int i = 0; i < g->n; i++)
        x[g->id[i]] = g->radius[i];
    check(f, nc_inq_varid(f->nc, "radius", &var));
    check(f, nc_put_var_double(f->nc, var, x));
    for (int i = 0; i < g->n; i++) {
        x[g->id[i]] = g->mass[i];
        k[g->id[i]] = g->kind[i];
    }
    check(f, nc_inq_varid(f->nc, "grain_mass", &var));
    check(f, nc_put_var_double(f->nc, var, x));
    check(f, nc_inq_varid(f->nc, "grain_species", &var));
    check(f, nc_put_var_int(f->nc, var, k));
    xfree(x);
    xfree(k);
}

static void put_provenance(struct file *f)
{
    struct provenance line[PROVENANCE_LINES];
    const int n = provenance(line);
    put_text(f, NC_GLOBAL, "Conventions", "CF-1.10");
    for (int i = 0; i < n; i++)
        put_text(f, NC_GLOBAL, line[i].key, line[i].value);
}

static void put_domain(struct file *f, const struct sim *s)
{
    const int periodic[3] = {s->domain.periodic[0], s->domain.periodic[1], s->domain.periodic[2]};
    check(f, nc_put_att_double(f->nc, NC_GLOBAL, "domain_size", NC_DOUBLE, 3, s->domain.size));
    check(f, nc_put_att_int(f->nc, NC_GLOBAL, "domain_periodic", NC_INT, 3, periodic));
}

/* Opens DIR/NAME.part and defines what does not change; leaves define mode. */
static void open_file(struct file *f, const struct sim *s, const char *name)
{
    *f = (struct file){.path = xprintf("%s/%s", s->run.directory, name)};
    f->part = xprintf("%s.part", f->path);
    errno = 0;
    check(f, nc_create(f->part, NC_NETCDF4 | NC_CLOBBER, &f->nc));
    errno = 0;
    put_provenance(f);
    put_domain(f, s);
    check(f, nc_def_dim(f->nc, "time", NC_UNLIMITED, &f->dim[DIM_TIME]));
    f->var_time = define(f, "time", NC_DOUBLE, 1, &f->dim[DIM_TIME], "s", "simulated time");
    put_text(f, f->var_time, "axis", "T");
    if (s->grains.n > 0)
        define_grains(f, s);
    if (s->fluid.exists)
        define_axes(f, s);
    define_fields(f, s);
}

static void finish_definitions(struct file *f, const struct sim *s)
{
    check(f, nc_enddef(f->nc));
    if (s->grains.n > 0)
        write_grains(f, s);
    if (s->fluid.exists)
        write_axes(f, s);
}

void output_create(struct sim *s, struct scene *scene)
{
    struct file *const f = &out;
    make_folder(s->run.directory);
    open_file(f, s, "run.nc");
    char *const text = scene_resolved(scene);
    put_text(f, NC_GLOBAL, "scene", text);
    put_text(f, NC_GLOBAL, "scene_file", scene_path(scene));
    xfree(text);
    check(f, nc_def_dim(f->nc, "sample", NC_UNLIMITED, &f->dim[DIM_SAMPLE]));
    f->var_sample =
        define(f, "sample_time", NC_DOUBLE, 1, &f->dim[DIM_SAMPLE], "s", "time of the sample");
    finish_definitions(f, s);
}

/* The interior of a grid field, packed; faces of their direction have one layer more. */
static double *pack(const struct sim *s, const struct field *field, size_t count[4])
{
    const struct grid *const g = &s->grid;
    const int more = (int)field->place - PLACE_FACE_X; /* direction with n + 1 layers, or < 0 */
    const int n[3] = {g->n[0] + (more == 0), g->n[1] + (more == 1), g->n[2] + (more == 2)};
    const double *const from = *field->data;
    double *const x = xalloc((size_t)n[0] * n[1] * n[2], sizeof *x);
    size_t m = 0;
    for (int k = 1; k <= n[2]; k++)
        for (int j = 1; j <= n[1]; j++)
            for (int i = 1; i <= n[0]; i++)
                x[m++] = from[cell(g, i, j, k)];
    for (int a = 0; a < 3; a++)
        count[1 + a] = (size_t)n[2 - a];
    return x;
}

/* The entries of the grains in order of id. */
static void *by_id(const struct sim *s, const struct field *field, size_t count[4])
{
    const size_t size = kind_size(field->kind);
    char *const x = xalloc((size_t)s->grains.n, size);
    const char *const from = *field->data;
    for (int i = 0; i < s->grains.n; i++)
        memcpy(x + (size_t)s->grains.id[i] * size, from + (size_t)i * size, size);
    count[1] = (size_t)s->grains.n;
    count[2] = 3;
    return x;
}

static void write_fields(struct file *f, const struct sim *s)
{
    const size_t start[4] = {f->n_time, 0, 0, 0};
    check(f, nc_put_var1_double(f->nc, f->var_time, start, &s->t));
    for (int i = 0; i < s->fields.n; i++) {
        const struct field *const field = &s->fields.field[i];
        size_t count[4] = {1, 1, 1, 1};
        if (!is_written(s, field))
            continue;
        void *const x = field->place == PLACE_GRAIN ? by_id(s, field, count) : pack(s, field, count);
        if (field->kind == KIND_INT)
            check(f, nc_put_vara_int(f->nc, f->var_field[i], start, count, x));
        else
            check(f, nc_put_vara_double(f->nc, f->var_field[i], start, count, x));
        xfree(x);
    }
    f->n_time++;
    check(f, nc_sync(f->nc));
}

void output_fields(struct sim *s)
{
    write_fields(&out, s);
}

void output_sample(struct sim *s)
{
    struct file *const f = &out;
    if (!f->var_series) { /* the series are complete when the first is asked for */
        f->var_series = xalloc((size_t)s->series.n + 1, sizeof *f->var_series);
        check(f, nc_redef(f->nc));
        for (int i = 0; i < s->series.n; i++) {
            const struct series_entry *const e = &s->series.entry[i];
            f->var_series[i] = define(f, e->name, NC_DOUBLE, 1, &f->dim[DIM_SAMPLE], e->unit,
                                      e->long_name);
            put_text(f, f->var_series[i], "coordinates", "sample_time");
        }
        check(f, nc_enddef(f->nc));
    }
    check(f, nc_put_var1_double(f->nc, f->var_sample, &f->n_sample, &s->t));
    for (int i = 0; i < s->series.n; i++)
        check(f, nc_put_var1_double(f->nc, f->var_series[i], &f->n_sample,
                                    s->series.entry[i].value));
    f->n_sample++;
}

/* The figure of a table as attributes of a scalar variable figure_<table>. */
static void define_figure(struct file *f, const struct table *t)
{
    const struct figure *const g = &t->figure;
    char *const name = xprintf("figure_%s", t->name), key[32];
    const char *const keys[] = {"file", "title", "x", "x_label", "y_label"};
    const char *const texts[] = {g->file, g->title, g->x, g->x_label, g->y_label};
    int var;
    check(f, nc_def_var(f->nc, name, NC_INT, 0, NULL, &var));
    for (int i = 0; i < 5; i++)
        put_text(f, var, keys[i], texts[i] ? texts[i] : "");
    const int log[2] = {g->log_x, g->log_y};
    check(f, nc_put_att_int(f->nc, var, "log", NC_INT, 2, log));
    for (int i = 0; i < g->n_curves; i++) {
        char *const text =
            xprintf("%s|%s|%s", g->curve[i].column, g->curve[i].style, g->curve[i].title);
        snprintf(key, sizeof key, "curve_%d", i);
        put_text(f, var, key, text);
        xfree(text);
    }
    xfree(name);
}

static void write_table(struct file *f, const struct table *t)
{
    int dim, var[TABLE_COLUMNS];
    char *name = xprintf("%s_row", t->name);
    check(f, nc_redef(f->nc));
    check(f, nc_def_dim(f->nc, name, (size_t)t->n_rows, &dim));
    xfree(name);
    for (int c = 0; c < t->n_columns; c++) {
        name = xprintf("%s_%s", t->name, t->column[c].name);
        var[c] = define(f, name, NC_DOUBLE, 1, &dim, t->column[c].unit, t->column[c].long_name);
        xfree(name);
    }
    if (t->figure.file)
        define_figure(f, t);
    check(f, nc_enddef(f->nc));
    double *const x = xalloc((size_t)t->n_rows, sizeof *x);
    for (int c = 0; c < t->n_columns; c++) {
        for (int r = 0; r < t->n_rows; r++)
            x[r] = t->row[(size_t)r * t->n_columns + c];
        check(f, nc_put_var_double(f->nc, var[c], x));
    }
    xfree(x);
}

static void close_file(struct file *f)
{
    check(f, nc_close(f->nc));
    if (rename(f->part, f->path) != 0)
        die(EXIT_WRITE, "%s: cannot be renamed: %s", f->part, strerror(errno));
    xfree(f->path);
    xfree(f->part);
    xfree(f->var_field);
    xfree(f->var_series);
    *f = (struct file){.nc = -1};
}

static void write_summary(const struct sim *s)
{
    char *const path = xprintf("%s/summary.txt", s->run.directory);
    FILE *const file = fopen(path, "w");
    bool good = file != NULL;
    for (int i = 0; i < s->summary.n && good; i++) {
        const struct summary_line *const l = &s->summary.line[i];
        good = fprintf(file, "%s = %s%s%s\n", l->key, l->value, l->unit[0] ? " " : "", l->unit) > 0;
    }
    if (!file || fclose(file) != 0 || !good)
        die(EXIT_WRITE, "%s: cannot be written: %s", path, strerror(errno));
    xfree(path);
}

void output_close(struct sim *s)
{
    struct file *const f = &out;
    for (int i = 0; i < s->tables.n; i++)
        if (s->tables.table[i]->n_rows > 0)
            write_table(f, s->tables.table[i]);
    check(f, nc_redef(f->nc));
    for (int i = 0; i < s->summary.n; i++) {
        const struct summary_line *const l = &s->summary.line[i];
        char *const key = xprintf("summary_%s", l->key);
        if (isnan(l->number))
            put_text(f, NC_GLOBAL, key, l->value);
        else
            check(f, nc_put_att_double(f->nc, NC_GLOBAL, key, NC_DOUBLE, 1, &l->number));
        xfree(key);
    }
    check(f, nc_enddef(f->nc));
    double *const times = xalloc(f->n_time, sizeof *times);
    check(f, nc_get_var_double(f->nc, f->var_time, times));
    xdmf_write(s, times, f->n_time);
    xfree(times);
    close_file(f);
    write_summary(s);
}

void output_crash(struct sim *s, const char *message)
{
    struct file crash;
    open_file(&crash, s, "crash.nc");
    put_text(&crash, NC_GLOBAL, "message", message);
    finish_definitions(&crash, s);
    write_fields(&crash, s);
    close_file(&crash);
    fprintf(stderr, "silt: the state at hand is in %s/crash.nc\n", s->run.directory);
}
