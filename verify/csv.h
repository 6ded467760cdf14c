/* verify/csv.h - the tables of verify/reference: rows of cells under names, comments behind #. */
#ifndef CSV_H
#define CSV_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "check.h"

enum { CSV_COLUMNS = 24, CSV_ROWS = 512, CSV_TEXT = 24 };

struct csv {
    int n, columns;
    char name[CSV_COLUMNS][CSV_TEXT];
    char cell[CSV_ROWS][CSV_COLUMNS][CSV_TEXT];
};

/* Cells of a line; how many. */
static inline int csv_split(const char *line, char (*out)[CSV_TEXT])
{
    int n = 0;
    while (n < CSV_COLUMNS) {
        const size_t length = strcspn(line, ",\r\n");
        snprintf(out[n++], CSV_TEXT, "%.*s", (int)length, line);
        line += length;
        if (*line++ != ',')
            break;
    }
    return n;
}

/* One of verify/reference, at most CSV_ROWS of it; a missing one is a failed check. It is kept until the
 * next is read. */
static inline const struct csv *csv_read(const char *file)
{
    static struct csv t;
    char path[256], line[2048];
    snprintf(path, sizeof path, "verify/reference/%s", file);
    FILE *const f = fopen(path, "r");
    t.n = t.columns = 0;
    while (f && t.n < CSV_ROWS && fgets(line, sizeof line, f)) {
        if (line[0] == '#' || line[0] == '\n')
            continue;
        if (t.columns == 0)
            t.columns = csv_split(line, t.name);
        else
            csv_split(line, t.cell[t.n++]);
    }
    if (f)
        fclose(f);
    check(t.n > 0, "%s: %d rows", path, t.n);
    return &t;
}

static inline const char *csv_text(const struct csv *t, int row, const char *name)
{
    for (int c = 0; c < t->columns; c++)
        if (strcmp(t->name[c], name) == 0)
            return t->cell[row][c];
    check(false, "no column %s", name);
    return "";
}

/* NaN where the cell is blank. */
static inline double csv_value(const struct csv *t, int row, const char *name)
{
    const char *const text = csv_text(t, row, name);
    return text[0] ? strtod(text, NULL) : (double)NAN;
}

#endif
