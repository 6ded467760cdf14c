/* output.c - what a run leaves: run.nc, run.xmf, summary.txt, and crash.nc where it ends badly.
 *
 * Each is written as NAME.part and takes its name when it is complete. run.nc is synced after
 * every output, so that a run that is killed leaves a readable run.nc.part with what it had. */
#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <netcdf.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include "output_file.h"
#include "surface_file.h"
#include "xdmf.h"

static struct output_file out = {.nc = -1};

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

/* Another run to the same folder would spoil the files of the first. The lock goes with the process, or with its
 * next run. */
static void lock_folder(const char *path)
{
    static int folder = -1;
    if (folder >= 0)
        close(folder);
    folder = open(path, O_RDONLY | O_DIRECTORY);
    if (folder >= 0 && flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        die(EXIT_WRITE, "%s: another run writes to this folder", path);
}

void output_create(struct sim *s, struct scene *scene)
{
    struct output_file *const f = &out;
    make_folder(s->run.directory);
    lock_folder(s->run.directory);
    errno = 0;
    output_file_open(f, s, "run.nc");
    char *const text = scene_resolved(scene);
    output_text(f, NC_GLOBAL, "scene", text);
    output_text(f, NC_GLOBAL, "scene_file", scene_path(scene));
    xfree(text);
    output_check(f, nc_def_dim(f->nc, "sample", NC_UNLIMITED, &f->dim[DIM_SAMPLE]));
    f->var_sample = output_define(f, "sample_time", NC_DOUBLE, 1, &f->dim[DIM_SAMPLE], "s",
                                  "time of the sample");
    analysis_define(s, f);
    output_file_begin(f, s);
}

void output_fields(struct sim *s)
{
    errno = 0;
    analysis_record(s, &out);
    output_file_record(&out, s);
}

/* The series are complete when the first sample is asked for. */
static void define_series(struct output_file *f, const struct sim *s)
{
    f->var_series = xalloc((size_t)s->series.n + 1, sizeof *f->var_series);
    output_check(f, nc_redef(f->nc));
    for (int i = 0; i < s->series.n; i++) {
        const struct series_entry *const e = &s->series.entry[i];
        f->var_series[i] =
            output_define(f, e->name, NC_DOUBLE, 1, &f->dim[DIM_SAMPLE], e->unit, e->long_name);
        output_text(f, f->var_series[i], "coordinates", "sample_time");
    }
    output_check(f, nc_enddef(f->nc));
}

void output_sample(struct sim *s)
{
    struct output_file *const f = &out;
    errno = 0;
    analysis_sample(s);
    if (!f->var_series)
        define_series(f, s);
    output_check(f, nc_put_var1_double(f->nc, f->var_sample, &f->n_sample, &s->t));
    for (int i = 0; i < s->series.n; i++)
        output_check(f, nc_put_var1_double(f->nc, f->var_series[i], &f->n_sample,
                                           s->series.entry[i].value));
    f->n_sample++;
    output_check(f, nc_sync(f->nc));
}

FILE *output_text_open(const char *path)
{
    char *const part = xprintf("%s.part", path);
    FILE *const file = fopen(part, "w");
    if (!file)
        die(EXIT_WRITE, "%s: cannot be written: %s", part, strerror(errno));
    xfree(part);
    return file;
}

void output_text_close(FILE *file, const char *path)
{
    char *const part = xprintf("%s.part", path);
    errno = 0;
    const bool good = ferror(file) == 0;
    if (fclose(file) != 0 || !good || rename(part, path) != 0)
        die(EXIT_WRITE, "%s: cannot be written: %s", path, strerror(errno ? errno : EIO));
    xfree(part);
}

/* A table in the summary: "table_row_column = value unit", rows counted from 1. */
static void write_rows(FILE *file, const struct table *t)
{
    enum { ROWS_MOST = 100 }; /* longer ones are in run.nc only */
    for (int r = 0; r < t->n_rows && t->n_rows <= ROWS_MOST && !t->bulky; r++)
        for (int c = 0; c < t->n_columns; c++) {
            const char *const unit = t->column[c].unit;
            const bool pure = strcmp(unit, "1") == 0;
            fprintf(file, "%s_%d_%s = %.10g%s%s\n", t->name, r + 1, t->column[c].name,
                    t->row[(size_t)r * t->n_columns + c], pure ? "" : " ", pure ? "" : unit);
        }
}

static void write_summary(const struct sim *s)
{
    char *const path = xprintf("%s/summary.txt", s->run.directory);
    FILE *const file = output_text_open(path);
    for (int i = 0; i < s->summary.n; i++) {
        const struct summary_line *const l = &s->summary.line[i];
        fprintf(file, "%s = %s%s%s\n", l->key, l->value, l->unit[0] ? " " : "", l->unit);
    }
    for (int i = 0; i < s->tables.n; i++)
        write_rows(file, s->tables.table[i]);
    output_text_close(file, path);
    xfree(path);
}

void output_close(struct sim *s)
{
    struct output_file *const f = &out;
    errno = 0;
    output_tables(f, s);
    output_summary(f, s);
    const size_t n = f->n_time;
    double *const times = xalloc(n, sizeof *times);
    if (n > 0)
        output_check(f, nc_get_var_double(f->nc, f->var_time, times));
    size_t *const count = f->count;
    f->count = NULL;
    output_file_close(f);
    xdmf_write(s, times, n, count);
    surface_file_stl(s);
    xfree(count);
    write_summary(s);
    xfree(times);
}

void output_crash(struct sim *s, const char *message)
{
    struct output_file crash;
    errno = 0;
    output_file_open(&crash, s, "crash.nc");
    output_text(&crash, NC_GLOBAL, "message", message);
    output_file_begin(&crash, s);
    output_file_record(&crash, s);
    output_file_close(&crash);
    fprintf(stderr, "silt: the state at hand is in %s/crash.nc\n", s->run.directory);
}
