/* output_table.c - results in run.nc: each table as variables <table>_<column> on the dimension
 * <table>_row, its figure as the attributes of a scalar variable figure_<table> (so that the
 * plot tool needs to know no table), the summary as global attributes. */
#include "output_file.h"

#include <netcdf.h>

static void define_figure(const struct output_file *f, const struct table *t)
{
    const struct figure *const g = &t->figure;
    const struct {
        const char *key, *text;
    } list[] = {{"file", g->file},
                {"title", g->title},
                {"x", g->x},
                {"x_label", g->x_label},
                {"y_label", g->y_label}};
    const int log[2] = {g->log_x, g->log_y};
    char *const name = xprintf("figure_%s", t->name);
    int var;
    output_check(f, nc_def_var(f->nc, name, NC_INT, 0, NULL, &var));
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        output_text(f, var, list[i].key, list[i].text ? list[i].text : "");
    output_check(f, nc_put_att_int(f->nc, var, "log", NC_INT, 2, log));
    for (int i = 0; i < g->n_curves; i++) {
        const struct curve *const c = &g->curve[i];
        char *const text = xprintf("%s|%s|%s", c->column, c->style, c->title);
        char *const key = xprintf("curve_%d", i);
        output_text(f, var, key, text);
        xfree(text);
        xfree(key);
    }
    xfree(name);
}

static void write_table(const struct output_file *f, const struct table *t)
{
    int dim, var[TABLE_COLUMNS];
    char *name = xprintf("%s_row", t->name);
    output_check(f, nc_redef(f->nc));
    output_check(f, nc_def_dim(f->nc, name, (size_t)t->n_rows, &dim));
    xfree(name);
    for (int c = 0; c < t->n_columns; c++) {
        name = xprintf("%s_%s", t->name, t->column[c].name);
        var[c] = output_define(f, name, NC_DOUBLE, 1, &dim, t->column[c].unit,
                               t->column[c].long_name);
        xfree(name);
    }
    if (t->figure.file)
        define_figure(f, t);
    output_check(f, nc_enddef(f->nc));
    double *const x = xalloc((size_t)t->n_rows, sizeof *x);
    for (int c = 0; c < t->n_columns; c++) {
        for (int r = 0; r < t->n_rows; r++)
            x[r] = t->row[(size_t)r * t->n_columns + c];
        output_check(f, nc_put_var_double(f->nc, var[c], x));
    }
    xfree(x);
}

void output_tables(const struct output_file *f, const struct sim *s)
{
    for (int i = 0; i < s->tables.n; i++)
        if (s->tables.table[i]->n_rows > 0)
            write_table(f, s->tables.table[i]);
}

void output_summary(const struct output_file *f, const struct sim *s)
{
    output_check(f, nc_redef(f->nc));
    for (int i = 0; i < s->summary.n; i++) {
        const struct summary_line *const l = &s->summary.line[i];
        char *const key = xprintf("summary_%s", l->key);
        if (isnan(l->number))
            output_text(f, NC_GLOBAL, key, l->value);
        else
            output_check(f, nc_put_att_double(f->nc, NC_GLOBAL, key, NC_DOUBLE, 1, &l->number));
        xfree(key);
    }
    output_check(f, nc_enddef(f->nc));
}
