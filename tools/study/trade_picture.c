/* trade_picture.c - trade.png: error against cost, both logarithmic, the front as a line. Points of
 * the front are labelled by their axes, the others by their number in trade.csv. */
#include <string.h>
#include "../../solver/picture.h"
#include "labels.h"
#include "trade.h"

#define ROUND_OFF 1e-15 /* smaller errors count as none */

enum {
    MOST_LEGEND = 8,
    LEGEND_COLUMNS = 4,
    LEGEND_LETTER = 10,
    LEGEND_SAMPLE = 80
}; /* pixels */

/* "ergun, 2": the values alone, of axes that vary. */
static char *short_label(const struct study *s, const struct variant *v)
{
    char *text = xstrdup("");
    for (int a = 0; a < s->n_axes; a++) {
        if (v->choice[a] < 0)
            continue;
        char *const longer =
            xprintf("%s%s%s", text, text[0] ? ", " : "", s->axis[a].value[v->choice[a]]);
        xfree(text);
        text = longer;
    }
    return text;
}

static bool shown(const struct trade *t, int i)
{
    return isfinite(t->cost[i]) && isfinite(t->error[i]) && t->cost[i] > 0.0;
}

/* Where a point is drawn: one without error at a third of the least error of the others, so that
 * it does not stretch the picture. */
static double error_shown(const struct trade *t, int i)
{
    double least = HUGE_VAL;
    if (t->error[i] > ROUND_OFF)
        return t->error[i];
    for (int k = 0; k < t->study.n; k++)
        if (shown(t, k) && t->error[k] > ROUND_OFF)
            least = fmin(least, t->error[k]);
    return isfinite(least) ? least / 3.0 : ROUND_OFF;
}

/* The axis of words (or else the first) colours the points. */
static int colour_axis(const struct study *s)
{
    for (int a = 0; a < s->n_axes; a++)
        if (s->axis[a].words && s->axis[a].n <= MOST_LEGEND)
            return a;
    for (int a = 0; a < s->n_axes; a++)
        if (s->axis[a].n <= MOST_LEGEND)
            return a;
    return -1;
}

static void send_points(FILE *to, const struct trade *t, int axis)
{
    const struct study *const s = &t->study;
    const int groups = axis < 0 ? 1 : s->axis[axis].n;
    for (int g = 0; g < groups; g++) {
        fprintf(to, "$p%d << END\n", g);
        for (int i = 0; i < s->n; i++)
            if (shown(t, i) && (axis < 0 || s->variant[i]->choice[axis] == g))
                fprintf(to, "%.10g %.10g %.10g %.10g\n", t->cost[i], error_shown(t, i),
                        t->low[i], t->high[i]);
        fprintf(to, "NaN NaN NaN NaN\nEND\n");
    }
}

static int group_of(const struct trade *t, int i)
{
    return trade_group(t, t->study.variant[i]->choice);
}

/* By group, then in order of cost. */
static int front_order(const struct trade *t, int *order)
{
    int n = 0;
    for (int i = 0; i < t->study.n; i++) {
        if (!t->front[i] || !shown(t, i))
            continue;
        int k = n++;
        for (; k > 0 && (group_of(t, order[k - 1]) > group_of(t, i) ||
                         (group_of(t, order[k - 1]) == group_of(t, i) &&
                          t->cost[order[k - 1]] > t->cost[i]));
             k--)
            order[k] = order[k - 1];
        order[k] = i;
    }
    return n;
}

static void send_front(FILE *to, const struct trade *t, const int *order, int n)
{
    fprintf(to, "$front << END\n");
    for (int k = 0; k < n; k++)
        fprintf(to, "%s%.10g %.10g\n",
                k > 0 && group_of(t, order[k]) != group_of(t, order[k - 1]) ? "\n" : "",
                t->cost[order[k]], error_shown(t, order[k]));
    fprintf(to, "NaN NaN\nEND\n");
}

static void send_label(FILE *to, struct labels *l, const struct trade *t, int i,
                       const char *text, int font, const char *colour)
{
    const double x = t->cost[i], y = error_shown(t, i);
    double offset[2];
    labels_place(l, x, y, 0.72 * font * (double)strlen(text), 1.5 * font, offset);
    char *const options =
        xprintf("at %.10g,%.10g left offset screen %.5f,%.5f font ',%d' tc '%s' noenhanced "
                "front",
                x, y, offset[0], offset[1], font, colour);
    picture_text(to, "label", text, options);
    xfree(options);
}

static void send_labels(FILE *to, const struct trade *t, const int *order, int n, int axis,
                        struct labels *l)
{
    for (int i = 0; i < t->study.n; i++)
        if (shown(t, i)) {
            labels_point(l, t->cost[i], error_shown(t, i), 5.0);
            labels_bar(l, t->low[i], t->high[i], error_shown(t, i));
        }
    if (t->within > l->low[1] && t->within < l->high[1])
        labels_bar(l, l->low[0], l->high[0], t->within);
    for (int k = 0; k < n; k++) {
        const int i = order[k];
        char *const label = short_label(&t->study, t->study.variant[i]);
        char *const text = xprintf("%d: %s%s", t->study.variant[i]->number, label,
                                   t->error[i] > ROUND_OFF ? "" : " (no error)");
        send_label(to, l, t, i, text, 10, "#222222");
        xfree(label);
        xfree(text);
    }
    for (int i = 0; i < t->study.n; i++) {
        if (!shown(t, i) || t->front[i])
            continue;
        const int group = axis < 0 ? 0 : t->study.variant[i]->choice[axis];
        char *const text = xprintf("%d", t->study.variant[i]->number);
        send_label(to, l, t, i, text, 8, picture_colour[group % PICTURE_COLOURS]);
        xfree(text);
    }
}

/* 1, 2, 5, 10, ...: decades alone would leave a short axis without a number. */
static void send_tics(FILE *to, char axis, double low, double high)
{
    static const double step[] = {1.0, 2.0, 5.0, 1.5, 3.0, 4.0, 6.0, 7.0, 8.0, 9.0};
    const int steps = high / low > 40.0 ? 3 : 10;
    const char *between = "";
    fprintf(to, "set %ctics (", axis);
    for (int decade = (int)floor(log10(low)); decade <= (int)ceil(log10(high)); decade++)
        for (int k = 0; k < steps; k++) {
            fprintf(to, "%s%.10g", between, step[k] * pow(10.0, decade));
            between = ",";
        }
    fprintf(to, ")\n");
}

/* Ranges with room for the labels; returns false where there is nothing to draw. */
static bool send_ranges(FILE *to, const struct trade *t, struct labels *l)
{
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {0.0, 0.0};
    for (int i = 0; i < t->study.n; i++)
        if (shown(t, i)) {
            const double at[2] = {t->cost[i], error_shown(t, i)};
            for (int a = 0; a < 2; a++) {
                low[a] = fmin(low[a], at[a]);
                high[a] = fmax(high[a], at[a]);
            }
            low[0] = fmin(low[0], t->low[i]);
            high[0] = fmax(high[0], t->high[i]);
        }
    if (!(high[0] > 0.0))
        return false;
    for (int a = 0; a < 2; a++) {
        const double span = fmax(high[a] / low[a], 2.0);
        l->low[a] = low[a] / pow(span, 0.06);
        l->high[a] = high[a] * pow(span, a ? 0.12 : 0.3);
        fprintf(to, "set logscale %c\nset %crange [%.6g:%.6g]\n", "xy"[a], "xy"[a], l -> low[a],
                l -> high[a]);
        if (span > 300.0)
            fprintf(to, "set format %c '10^{%%L}'\n", "xy"[a]);
        else
            send_tics(to, "xy"[a], low[a] / span, high[a] * span);
    }
    return true;
}

/* As many as the longest name leaves room for. */
static int legend_columns(const struct study *s, int axis)
{
    size_t longest = strlen("Pareto front");
    for (int g = 0; axis >= 0 && g < s->axis[axis].n; g++) {
        const size_t length = strlen(s->axis[axis].name) + 3 + strlen(s->axis[axis].value[g]);
        longest = length > longest ? length : longest;
    }
    const int columns = 1200 / (LEGEND_LETTER * (int)longest + LEGEND_SAMPLE);
    return columns < 1 ? 1 : columns > LEGEND_COLUMNS ? LEGEND_COLUMNS : columns;
}

void trade_draw(const struct trade *t)
{
    const struct study *const s = &t->study;
    const int axis = colour_axis(s);
    int *const order = xalloc((size_t)s->n + 1, sizeof *order);
    const int n = front_order(t, order), groups = axis < 0 ? 1 : s->axis[axis].n;
    const int columns = legend_columns(s, axis);
    /* a legend of so many rows below the axes */
    const int rows = (groups + 1 + (isfinite(t->within) ? 1 : 0) + columns - 1) / columns;
    const double bottom = 0.1 + 0.03 * rows;
    struct labels l = {.pixels = {1200, 900}, .frame = {0.08, 0.97, bottom, 0.93}};
    struct picture p = picture_open_in(s->directory, "trade.png", l.pixels[0], l.pixels[1]);
    FILE *const to = p.gnuplot;
    char *const title = xprintf("%s: what accuracy costs", s->scene);
    picture_text(to, "title", title, "font ',16' noenhanced");
    picture_text(to, "xlabel",
                 t->by == BY_MEMORY ? "cost: memory / MiB"
                 : t->by == BY_CORE ? "cost: core time per simulated time (bars: all repeats)"
                                    : "cost: wall time per simulated time (bars: all repeats)",
                 "");
    picture_text(to, "ylabel",
                 t->against == AGAINST_FINEST ? "error against the finest variant"
                                              : "error against the reference",
                 "");
    fprintf(to,
            "set key at screen 0.53,%g center top horizontal maxcols %d\n"
            "set lmargin at screen %g\nset rmargin at screen %g\n"
            "set bmargin at screen %g\nset tmargin at screen %g\n",
            0.01 + 0.03 * rows, columns, l.frame[0], l.frame[1], l.frame[2], l.frame[3]);
    if (send_ranges(to, t, &l)) {
        send_points(to, t, axis);
        send_front(to, t, order, n);
        send_labels(to, t, order, n, axis, &l);
        fprintf(to, "plot $front using 1:2 with lines lw 2 lc '#bbbbbb' title 'Pareto front'");
        if (isfinite(t->within))
            fprintf(to, ", %.10g with lines lw 1.2 dt 2 lc '#444444' title 'asked error'",
                    t->within);
        for (int g = 0; g < groups; g++) {
            char *const name =
                axis < 0 ? xstrdup("variants")
                         : xprintf("%s = %s", s->axis[axis].name, s->axis[axis].value[g]);
            char *const quoted = picture_quoted(name);
            fprintf(to, ", $p%d using 1:2:3:4 with xerrorbars pt 7 ps 1.3 lc '%s' title %s", g,
                    picture_colour[g % PICTURE_COLOURS], quoted);
            xfree(name);
            xfree(quoted);
        }
        fprintf(to, "\n");
    } else {
        fprintf(to,
                "set label 2 'no variant has an error and a cost' at screen 0.5,0.5 center\n"
                "plot [0:1] [0:1] NaN notitle\n");
    }
    picture_close(&p);
    labels_free(&l);
    xfree(title);
    xfree(order);
}
