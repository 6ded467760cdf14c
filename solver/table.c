/* table.c - the lists that output, restart and sorting walk. */
#include "table.h"

#include "rotation.h"

#include <stdarg.h>
#include <string.h>

/* Room for one more entry of a growing array. */
static void *grow(void *list, int n, int *capacity, size_t size)
{
    if (n < *capacity)
        return list;
    const int more = *capacity ? 2 * *capacity : 16;
    list = xrealloc(list, (size_t)*capacity, (size_t)more, size);
    *capacity = more;
    return list;
}

void fields_add(struct fields *f, struct field field)
{
    f->field = grow(f->field, f->n, &f->capacity, sizeof *f->field);
    f->field[f->n++] = field;
}

size_t kind_size(enum kind kind)
{
    switch (kind) {
    case KIND_REAL:
        return sizeof(double);
    case KIND_INT:
        return sizeof(int);
    case KIND_BYTE:
        return 1;
    case KIND_QUAT:
        return sizeof(struct quat);
    default:
        return sizeof(vec3);
    }
}

void series_add(struct series *s, const char *name, const char *unit, const char *long_name,
                const double *value)
{
    s->entry = grow(s->entry, s->n, &s->capacity, sizeof *s->entry);
    s->entry[s->n++] = (struct series_entry){name, unit, long_name, value};
}

struct table *tables_add(struct tables *t, const struct table *pattern)
{
    struct table *const table = xalloc(1, sizeof *table);
    *table = *pattern;
    table->n_rows = table->capacity = 0;
    table->row = NULL;
    t->table = grow(t->table, t->n, &t->capacity, sizeof(struct table *));
    t->table[t->n++] = table;
    return table;
}

void table_row(struct table *t, const double *values)
{
    t->row = grow(t->row, t->n_rows, &t->capacity, (size_t)t->n_columns * sizeof *t->row);
    memcpy(&t->row[(size_t)t->n_rows * t->n_columns], values,
           (size_t)t->n_columns * sizeof *values);
    t->n_rows++;
}

static void print_cell(FILE *out, double x, int width)
{
    if (isnan(x))
        fprintf(out, " %*s", width, "-");
    else
        fprintf(out, " %*.4g", width, x);
}

void table_print(FILE *out, const struct table *t)
{
    enum { NAME, UNIT };
    if (t->bulky)
        return;
    int width[TABLE_COLUMNS];
    fprintf(out, "%s\n", t->title);
    for (int what = NAME; what <= UNIT; what++) {
        for (int c = 0; c < t->n_columns; c++) {
            const int name = (int)strlen(t->column[c].name),
                      unit = (int)strlen(t->column[c].unit);
            width[c] = name > unit ? name : unit;
            width[c] = width[c] > 9 ? width[c] : 9;
            const char *const u = strcmp(t->column[c].unit, "1") == 0 ? "" : t->column[c].unit;
            if (!t->column[c].quiet)
                fprintf(out, " %*s", width[c], what == NAME ? t->column[c].name : u);
        }
        fputc('\n', out);
    }
    for (int r = 0; r < t->n_rows; r++) {
        for (int c = 0; c < t->n_columns; c++)
            if (!t->column[c].quiet)
                print_cell(out, t->row[(size_t)r * t->n_columns + c], width[c]);
        fputc('\n', out);
    }
}

static struct summary_line *new_line(struct summary *s, const char *key)
{
    s->line = grow(s->line, s->n, &s->capacity, sizeof *s->line);
    struct summary_line *const l = &s->line[s->n++];
    snprintf(l->key, sizeof l->key, "%s", key);
    return l;
}

void summary_number(struct summary *s, const char *key, double value, const char *unit)
{
    struct summary_line *const l = new_line(s, key);
    snprintf(l->value, sizeof l->value, "%.10g", value);
    snprintf(l->unit, sizeof l->unit, "%s", strcmp(unit, "1") == 0 ? "" : unit);
    l->number = value;
}

void summary_text(struct summary *s, const char *key, const char *format, ...)
{
    struct summary_line *const l = new_line(s, key);
    va_list args;
    va_start(args, format);
    vsnprintf(l->value, sizeof l->value, format, args);
    va_end(args);
    l->unit[0] = '\0';
    l->number = (double)NAN;
}

void summary_reference(struct summary *s, struct comparison c)
{
    summary_text(s, "reference_quantity", "%s", c.quantity);
    summary_text(s, "reference_source", "%s", c.source);
    if (!isnan(c.got) && !isnan(c.want)) {
        summary_number(s, "reference_value", c.got, c.unit);
        summary_number(s, "reference_expected", c.want, c.unit);
    }
    summary_number(s, "reference_error", c.error, "1");
    summary_number(s, "reference_tolerance", c.tolerance, "1");
}

const struct summary_line *summary_find(const struct summary *s, const char *key)
{
    for (int i = 0; i < s->n; i++)
        if (strcmp(s->line[i].key, key) == 0)
            return &s->line[i];
    return NULL;
}

void tables_free(struct tables *t)
{
    for (int i = 0; i < t->n; i++) {
        xfree(t->table[i]->row);
        xfree(t->table[i]);
    }
    xfree(t->table);
}

void fields_free(struct fields *f)
{
    xfree(f->field);
}

void series_free(struct series *s)
{
    xfree(s->entry);
}

void summary_free(struct summary *s)
{
    xfree(s->line);
}
