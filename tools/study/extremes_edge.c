/* extremes_edge.c - where along an axis the verdict changes, by halving, and where a limit that
 * `check` names is passed. */
#include <stdlib.h>
#include <string.h>
#include "extremes.h"

#define NEAR 1.05 /* ratio of the values on both sides of an edge */

enum { MOST_HALVINGS = 12 };

struct station {
    double number;
    int choice;
};

static int by_number(const void *a, const void *b)
{
    const double x = ((const struct station *)a)->number,
                 y = ((const struct station *)b)->number;
    return (x > y) - (x < y);
}

/* " mm" of "3 mm" */
static const char *unit_of(const char *value)
{
    char *end;
    strtod(value, &end);
    return end;
}

static double middle(const struct axis *a, double low, double high)
{
    return a->log && low > 0.0 ? sqrt(low * high) : 0.5 * (low + high);
}

static bool near(const struct axis *a, double low, double high)
{
    if (a->log && low > 0.0)
        return high / low <= NEAR;
    return high - low <= (NEAR - 1.0) * fabs(high);
}

/* The values of the axis that have been run on this line, in order; xfree. */
static struct station *stations(struct extremes *x, int axis, int *choice, int *n)
{
    const struct axis *const a = &x->study.axis[axis];
    struct station *const list = xalloc((size_t)a->n + 1, sizeof *list);
    *n = 0;
    for (int i = 0; i < a->n; i++) {
        choice[axis] = i;
        if (extremes_find(x, choice))
            list[(*n)++] = (struct station){a->number[i], i};
    }
    qsort(list, (size_t)*n, sizeof *list, by_number);
    return list;
}

/* Where the highest binding ratio passes 1 between neighbours, nearest to the edge in question. */
static void predict_edge(struct extremes *x, int axis, int *choice, struct edge *e)
{
    const struct axis *const a = &x->study.axis[axis];
    int n;
    struct station *const s = stations(x, axis, choice, &n);
    double nearest = HUGE_VAL;
    e->predicted = (double)NAN;
    e->limit = "";
    for (int i = 1; i < n; i++) {
        int which[2];
        double r[2];
        for (int k = 0; k < 2; k++) {
            choice[axis] = s[i - 1 + k].choice;
            r[k] = extremes_ratio(x, extremes_find(x, choice), &which[k]);
        }
        if (!(isfinite(r[0]) && isfinite(r[1])) || (r[0] > 1.0) == (r[1] > 1.0))
            continue;
        const double part = log(r[0]) / (log(r[0]) - log(r[1]));
        const double low = s[i - 1].number, high = s[i].number;
        const double at =
            a->log && low > 0.0 ? low * pow(high / low, part) : low + part * (high - low);
        const double far = a->log && at > 0.0 ? fabs(log(at / e->found)) : fabs(at - e->found);
        if (far < nearest) {
            nearest = far;
            e->predicted = at;
            e->limit = x->name[r[1] > 1.0 ? which[1] : which[0]];
        }
    }
    xfree(s);
}

static void halve(struct extremes *x, int axis, int *choice, struct station low,
                  struct station high)
{
    struct axis *const a = &x->study.axis[axis];
    char *why;
    choice[axis] = low.choice;
    const enum verdict before = extremes_find(x, choice)->verdict;
    choice[axis] = high.choice;
    const enum verdict end = extremes_find(x, choice)->verdict;
    enum verdict after = end;
    for (int i = 0; i < MOST_HALVINGS && !near(a, low.number, high.number); i++) {
        char *const number = number_text(middle(a, low.number, high.number));
        char *const value = xprintf("%s%s", number, unit_of(a->value[high.choice]));
        const struct station mid = {strtod(number, NULL),
                                    axis_add(a, value, strtod(number, NULL))};
        xfree(number);
        xfree(value);
        choice[axis] = mid.choice;
        const struct point *const p = extremes_point(x, choice, &why);
        if (!p) {
            xfree(why);
            break;
        }
        if (p->verdict == before) {
            low = mid;
        } else {
            high = mid;
            after = p->verdict;
        }
    }
    if (x->n_edges == MOST_EDGES)
        return;
    struct edge *const e = &x->edge[x->n_edges++];
    *e = (struct edge){.axis = axis, .before = before, .after = after};
    choice[axis] = low.choice;
    e->left = extremes_find(x, choice)->v;
    choice[axis] = high.choice;
    e->right = extremes_find(x, choice)->v;
    e->found = middle(a, low.number, high.number);
    predict_edge(x, axis, choice, e);
}

void extremes_edges(struct extremes *x, int axis, const int *fixed)
{
    int choice[MOST_AXES], n;
    memcpy(choice, fixed, sizeof choice);
    if (x->study.axis[axis].words)
        return;
    struct station *const s = stations(x, axis, choice, &n);
    for (int i = 1; i < n; i++) {
        choice[axis] = s[i - 1].choice;
        const enum verdict before = extremes_find(x, choice)->verdict;
        choice[axis] = s[i].choice;
        const enum verdict after = extremes_find(x, choice)->verdict;
        /* between what is slow and what is not lies the patience of the study, no limit */
        if (before != after && before != POINT_SLOW && after != POINT_SLOW)
            halve(x, axis, choice, s[i - 1], s[i]);
    }
    xfree(s);
}
