/* extremes_picture.c - extremes.png: a coloured cell for each point asked for. Two axes: a map, with
 * the line on which a limit of `check` is reached. Otherwise a strip for each axis. Cells are as far
 * apart as their order; between them a limit is placed by the logarithm of its ratio. */
#include <string.h>
#include "../../solver/picture.h"
#include "extremes.h"

static const char *const colour[VERDICTS] = {"#f4f4f4", "#79b473", "#e8b04b", "#8fb8de",
                                             "#5b7db1", "#bdbdbd", "#c0392b"};

enum { LEGEND_ROW = 26 }; /* pixels */

/* The grid of the picture: a row is a value of the second axis, or an axis. */
struct rows {
    const struct extremes *x;
    int n;
};

static int columns_of(const struct rows *r, int row)
{
    return r->x->shown[r->x->grid ? 0 : row];
}

static const struct point *at(const struct rows *r, int row, int column)
{
    const struct extremes *const x = r->x;
    int choice[MOST_AXES];
    for (int a = 0; a < MOST_AXES; a++)
        choice[a] = a < x->study.n_axes ? -1 : 0;
    if (x->grid) {
        choice[0] = column;
        choice[1] = row;
    } else {
        choice[row] = column;
    }
    return extremes_find(x, choice);
}

static void send_cell(FILE *to, const struct rows *r, int row, int column)
{
    const struct extremes *const x = r->x;
    const struct point *const p = at(r, row, column);
    const enum verdict verdict = p ? p->verdict : POINT_NONE;
    fprintf(
        to,
        "set object rectangle from %g,%g to %g,%g fc rgb '%s' fs solid 1 border lc '#ffffff' "
        "lw 2 behind\n",
        column - 0.5, row - (x->grid ? 0.5 : 0.3), column + 0.5, row + (x->grid ? 0.5 : 0.3),
        colour[verdict]);
    char *error = p && isfinite(p->error) ? xprintf("%.2g", p->error) : xstrdup("");
    char *const place = xprintf("at %d,%g center font ',8' tc '#333333' noenhanced", column,
                                row + (x->grid ? 0.0 : 0.12));
    if (x->grid ? x->shown[0] <= 16 : columns_of(r, row) <= 16)
        picture_text(to, "label", error, place);
    xfree(error);
    xfree(place);
    if (x->grid)
        return;
    char *const value =
        xprintf("at %d,%g center font ',9' tc '#000000' noenhanced", column, row - 0.12);
    picture_text(to, "label", x->study.axis[row].value[column], value);
    xfree(value);
}

/* Part of the way from a ratio to the next at which 1 is passed; NaN if it is not. */
static double crossing(double a, double b)
{
    if (!(a > 0.0) || !(b > 0.0) || !isfinite(a) || !isfinite(b) || (a > 1.0) == (b > 1.0))
        return (double)NAN;
    return log(a) / (log(a) - log(b));
}

static double ratio(const struct rows *r, int row, int column, int limit)
{
    const struct point *const p = at(r, row, column);
    return p ? p->ratio[limit] : (double)NAN;
}

/* The line ratio = 1 through the square right and above of a cell, if it goes through two of its
 * sides (marching squares; a saddle is left out). */
static void send_square(FILE *to, const struct rows *r, int row, int column, int limit)
{
    double x[4], y[4];
    int n = 0;
    for (int side = 0; side < 4; side++) {
        const bool along = side % 2 == 0; /* along a row */
        const int r0 = row + (side == 2), c0 = column + (side == 1);
        const double part =
            along ? crossing(ratio(r, r0, column, limit), ratio(r, r0, column + 1, limit))
                  : crossing(ratio(r, row, c0, limit), ratio(r, row + 1, c0, limit));
        if (isnan(part))
            continue;
        x[n] = along ? column + part : c0;
        y[n++] = along ? r0 : row + part;
    }
    if (n == 2 && to)
        fprintf(to, "%g %g\n%g %g\n\n", x[0], y[0], x[1], y[1]);
}

/* Returns whether there is anything of it to draw; to: NULL to ask only. */
static bool send_limit(FILE *to, const struct rows *r, int limit)
{
    bool any = false;
    for (int row = 0; row < r->n; row++)
        for (int c = 0; c + 1 < columns_of(r, row); c++) {
            const double part = crossing(ratio(r, row, c, limit), ratio(r, row, c + 1, limit));
            any = any || isfinite(part);
            if (!r->x->grid && isfinite(part) && to)
                fprintf(to, "%g %g\n%g %g\n\n", c + part, row - 0.4, c + part, row + 0.4);
            if (r->x->grid && row + 1 < r->n)
                send_square(to, r, row, c, limit);
        }
    for (int c = 0; r->x->grid && c < columns_of(r, 0); c++)
        for (int row = 0; row + 1 < r->n; row++)
            any =
                any || isfinite(crossing(ratio(r, row, c, limit), ratio(r, row + 1, c, limit)));
    return any;
}

static void send_tics(FILE *to, const char *which, const struct axis *a, int n)
{
    fprintf(to, "set %s (", which);
    for (int i = 0; i < n; i++) {
        char *const q = picture_quoted(a->value[i]);
        fprintf(to, "%s%s %d", i ? ", " : "", q, i);
        xfree(q);
    }
    fprintf(to, ")\n");
}

/* `legend` of `height`: what the legend takes below the axes, pixels. */
static void send_frame(FILE *to, const struct rows *r, int most, int legend, int height)
{
    const struct study *const s = &r->x->study;
    const double bottom = (legend + (r->x->grid ? 110.0 : 20.0)) / height;
    fprintf(
        to,
        "unset grid\nset xrange [-0.6:%g]\nset yrange [-0.6:%g]\nset lmargin at screen 0.14\n"
        "set bmargin at screen %g\nset key at screen 0.53,%g center top horizontal "
        "maxcols 2\n",
        most - 0.4, r->n - 0.4, bottom, (legend + 5.0) / height);
    if (r->x->grid) {
        send_tics(to, "xtics rotate by -30", &s->axis[0], r->x->shown[0]);
        send_tics(to, "ytics", &s->axis[1], r->x->shown[1]);
        picture_text(to, "xlabel", s->axis[0].name, "noenhanced");
        picture_text(to, "ylabel", s->axis[1].name, "noenhanced");
        return;
    }
    fprintf(to, "unset xtics\nset border 0\nset ytics (");
    for (int a = 0; a < r->n; a++) {
        char *const q = picture_quoted(s->axis[a].name);
        fprintf(to, "%s%s %d", a ? ", " : "", q, a);
        xfree(q);
    }
    fprintf(to, ") noenhanced\n");
}

void extremes_draw(const struct extremes *x)
{
    const struct rows r = {x, x->grid ? x->shown[1] : x->study.n_axes};
    int most = 1, lines = 0;
    bool drawn[MOST_NAMES] = {false};
    for (int row = 0; row < r.n; row++)
        most = columns_of(&r, row) > most ? columns_of(&r, row) : most;
    for (int k = 0; k < x->n_names; k++) {
        drawn[k] = send_limit(NULL, &r, k);
        lines += drawn[k];
    }
    const int legend = LEGEND_ROW * (VERDICTS - POINT_RIGHT + lines + 1) / 2 + 15;
    const int height = x->grid ? 780 + legend : 90 + 75 * r.n + legend;
    struct picture p = picture_open_in(x->study.directory, "extremes.png", 1200, height);
    FILE *const to = p.gnuplot;
    char *const title =
        xprintf("%s: where it breaks (numbers in cells: error)", x->study.scene);
    picture_text(to, "title", title, "font ',15' noenhanced");
    send_frame(to, &r, most, legend, height);
    for (int row = 0; row < r.n; row++)
        for (int c = 0; c < columns_of(&r, row); c++)
            send_cell(to, &r, row, c);
    for (int k = 0; k < x->n_names; k++) {
        fprintf(to, "$l%d << END\n", k);
        send_limit(to, &r, k);
        fprintf(to, "NaN NaN\nEND\n");
    }
    fprintf(to, "plot NaN with boxes fs solid fc '%s' title 'right'", colour[POINT_RIGHT]);
    for (int v = POINT_WRONG; v < VERDICTS; v++)
        fprintf(to, ", NaN with boxes fs solid fc '%s' title '%s'", colour[v], verdict_name[v]);
    for (int k = 0, line = 0; k < x->n_names; k++) {
        if (!drawn[k])
            continue;
        char *const name = xprintf("limit: %s%s", x->name[k], x->binds[k] ? "" : " (accuracy)");
        char *const q = picture_quoted(name);
        fprintf(to, ", $l%d with lines lw 3 dt %d lc '#111111' title %s", k, 1 + line++ % 5, q);
        xfree(name);
        xfree(q);
    }
    fprintf(to, "\n");
    picture_close(&p);
    xfree(title);
}
