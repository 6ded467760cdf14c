/* table.h - what there is to write and to restart: fields, time series, tables, summary lines.
 *
 * Modules register what they own; output, restart, sorting and summary walk these lists and
 * know no physics. Names are CF-like, units as udunits2 reads them. */
#ifndef TABLE_H
#define TABLE_H

#include <stdbool.h>
#include <stdio.h>
#include "base.h"

enum place {
    PLACE_GRAIN,  /* one entry per grain, in memory order (permuted when grains are sorted) */
    PLACE_CELL,   /* a grid field at cell centres */
    PLACE_FACE_X, /* grid fields at the low faces of cells, see grid.h */
    PLACE_FACE_Y,
    PLACE_FACE_Z
};

enum kind {
    KIND_REAL,
    KIND_INT,
    KIND_VEC3,
    KIND_QUAT,
    KIND_BYTE
}; /* bytes: state only, not output */

enum { FIELD_OUTPUT = 1, FIELD_STATE = 2 }; /* written at output times; needed by a restart */

struct field {
    const char *name, *unit, *long_name;
    enum place place;
    enum kind kind;
    void **data; /* address of the owner's pointer, which may move */
    int flags;
};

struct fields {
    int n, capacity;
    struct field *field;
};

void fields_add(struct fields *f, struct field field);
size_t kind_size(enum kind kind); /* bytes */

/* A number recorded at every output time. */
struct series_entry {
    const char *name, *unit, *long_name;
    const double *value;
};

struct series {
    int n, capacity;
    struct series_entry *entry;
};

void series_add(struct series *s, const char *name, const char *unit, const char *long_name,
                const double *value);

/* A table of results with the figure that shows it. */
enum { TABLE_COLUMNS = 20, FIGURE_CURVES = 8 };

struct column {
    const char *name, *unit, *long_name;
    bool quiet; /* written to the files but not printed */
};

struct curve {
    const char *column; /* of the table, for y; NaN entries are skipped */
    const char *style;  /* "points" or "line" */
    const char *title;
};

struct figure {
    const char *file; /* "pressure_drop.png"; NULL: no figure */
    const char *title;
    const char *x; /* column */
    const char *x_label, *y_label;
    bool log_x, log_y;
    int n_curves;
    struct curve curve[FIGURE_CURVES];
};

struct table {
    const char *name, *title;
    int n_columns;
    struct column column[TABLE_COLUMNS];
    bool bulky; /* rows go to run.nc only, neither to the terminal nor to the summary */
    int n_rows, capacity;
    double *row; /* n_rows x n_columns; freed by tables_free */
    struct figure figure;
};

struct tables {
    int n, capacity;
    struct table **table;
};

struct table *tables_add(struct tables *t,
                         const struct table *pattern); /* copies; no rows yet */
void table_row(struct table *t, const double *values); /* n_columns values */
void table_print(FILE *out, const struct table *t);    /* aligned, with units */

/* summary.txt: "key = value unit", one a line, in the order added. */
struct summary_line {
    char key[64], value[128], unit[24];
    double number; /* NaN for text */
};

struct summary {
    int n, capacity;
    struct summary_line *line;
};

void summary_number(struct summary *s, const char *key, double value, const char *unit);
void summary_text(struct summary *s, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* What a study and the report compare: as lines reference_quantity, reference_source,
 * reference_value, reference_expected, reference_error, reference_tolerance. */
struct comparison {
    const char *quantity, *source, *unit; /* source: keys in NOTATION.md */
    double got, want;                     /* NaN: the comparison is of a whole curve */
    double error, tolerance;              /* relative */
};
void summary_reference(struct summary *s, struct comparison c);
const struct summary_line *summary_find(const struct summary *s, const char *key); /* or NULL */

void tables_free(struct tables *t);
void fields_free(struct fields *f);
void series_free(struct series *s);
void summary_free(struct summary *s);

#endif
