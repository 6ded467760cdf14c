/* trade_error.c - the error of each variant, and its cost.
 *
 * The error is that against the scene's reference, or the largest relative difference of the
 * quantities from a value, from a table, or from the finest variant: that with the last value on
 * every axis. Where the first axis with numbers has three values or more, Richardson's estimate
 * from its last three takes the place of the finest variant itself. */
#include <stdlib.h>
#include <string.h>
#include "trade.h"

void trade_costs(struct trade *t)
{
    const int n = t->study.n;
    double **const list[] = {&t->error,  &t->cost, &t->wall, &t->core,
                             &t->memory, &t->low,  &t->high};
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++) {
        xfree(*list[i]);
        *list[i] = xalloc((size_t)n + 1, sizeof(double));
    }
    xfree(t->front);
    t->front = xalloc((size_t)n + 1, sizeof *t->front);
    for (int i = 0; i < n; i++) {
        const struct variant *const v = t->study.variant[i];
        double x[MOST_REPEATS], core[MOST_REPEATS], wall[MOST_REPEATS], memory = 0.0;
        t->error[i] = t->cost[i] = t->wall[i] = t->core[i] = t->memory[i] = t->low[i] =
            t->high[i] = (double)NAN;
        if (v->ending != RUN_GOOD || v->n_runs == 0)
            continue;
        t->low[i] = HUGE_VAL;
        t->high[i] = 0.0;
        for (int k = 0; k < v->n_runs; k++) {
            const struct cost *const c = &v->run[k];
            wall[k] = c->wall;
            core[k] = c->core / v->simulated;
            memory = fmax(memory, c->memory);
            x[k] = t->by == BY_MEMORY ? c->memory / 1048576.0
                   : t->by == BY_CORE ? core[k]
                                      : c->wall / v->simulated;
            t->low[i] = fmin(t->low[i], x[k]);
            t->high[i] = fmax(t->high[i], x[k]);
        }
        t->cost[i] = median(x, v->n_runs);
        t->wall[i] = median(wall, v->n_runs);
        t->core[i] = median(core, v->n_runs);
        t->memory[i] = memory;
    }
}

/* The step that a value of an axis stands for: small is fine. Of cells the inverse. */
static double step_of(const struct axis *a, int i)
{
    return strcmp(a->key, "domain.cells") == 0 ? 1.0 / a->number[i] : a->number[i];
}

static const struct variant *with_choice(const struct study *s, int axis, int value)
{
    for (int i = 0; i < s->n; i++) {
        bool same = true;
        for (int a = 0; a < s->n_axes; a++)
            same = same && s->variant[i]->choice[a] == (a == axis ? value : s->axis[a].n - 1);
        if (same && s->variant[i]->ending == RUN_GOOD)
            return s->variant[i];
    }
    return NULL;
}

static void find_finest(struct trade *t, int q)
{
    const struct study *const s = &t->study;
    const struct variant *const finest = with_choice(s, -1, 0);
    const char *const key = t->quantity[q];
    if (!finest)
        die(EXIT_SCENE,
            "the finest variant (the last value on every axis) has not run to its end");
    t->truth[q] = result_number(&finest->result, key);
    t->doubt[q] = t->order[q] = (double)NAN;
    for (int a = 0; a < s->n_axes; a++) {
        const struct axis *const x = &s->axis[a];
        const struct variant *v[3] = {NULL, NULL, NULL};
        if (x->words || x->n < 3 || x->kind == AXIS_THREADS)
            continue;
        double h[3], f[3];
        bool all = true;
        for (int k = 0; k < 3; k++) {
            v[k] = with_choice(s, a, x->n - 3 + k);
            h[k] = step_of(x, x->n - 3 + k);
            f[k] = v[k] ? result_number(&v[k]->result, key) : (double)NAN;
            all = all && isfinite(f[k]);
        }
        /* a stiffness that grows, say: what counts is its inverse */
        for (int k = 0; k < 3 && h[2] > h[0]; k++)
            h[k] = 1.0 / h[k];
        if (all && h[0] > h[1] && h[1] > h[2])
            t->truth[q] = richardson(h, f, &t->order[q], &t->doubt[q]);
        return;
    }
}

/* One line of a CSV file into fields, in place; returns how many. */
static int split(char *line, char **field, int most)
{
    int n = 0;
    while (n < most) {
        while (*line == ' ' || *line == '"')
            line++;
        field[n++] = line;
        char *const comma = strchr(line, ',');
        char *end = comma ? comma : line + strlen(line);
        while (end > line && (end[-1] == ' ' || end[-1] == '"' || end[-1] == '\r'))
            *--end = '\0';
        if (!comma)
            break;
        *comma = '\0';
        line = comma + 1;
    }
    return n;
}

/* The value of a quantity in the first row whose columns that are named as axes agree with the
 * variant; NaN if there is none. */
static double in_table(const struct trade *t, const struct variant *v, const char *key)
{
    enum { COLUMNS = 64 };
    char *const text = file_text(t->against_text), *rest = NULL, *head[COLUMNS],
                *field[COLUMNS];
    int columns = 0, wanted = -1;
    double found = (double)NAN;
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        if (*line == '#')
            continue;
        if (columns == 0) {
            columns = split(line, head, COLUMNS);
            for (int c = 0; c < columns; c++)
                wanted = strcmp(head[c], key) == 0 ? c : wanted;
            if (wanted < 0)
                die(EXIT_SCENE, "%s: there is no column %s", t->against_text, key);
            continue;
        }
        const int n = split(line, field, COLUMNS);
        bool same = n == columns;
        for (int c = 0; c < n && same; c++)
            for (int a = 0; a < t->study.n_axes; a++) {
                const struct axis *const x = &t->study.axis[a];
                if (strcmp(head[c], x->name) == 0 && v->choice[a] >= 0)
                    same = same && (strcmp(field[c], x->value[v->choice[a]]) == 0 ||
                                    strtod(field[c], NULL) == x->number[v->choice[a]]);
            }
        if (same) {
            found = strtod(field[wanted], NULL);
            break;
        }
    }
    if (columns == 0)
        die(EXIT_SCENE, "%s: no such table, or an empty one", t->against_text);
    xfree(text);
    return found;
}

/* The number of that line; NaN, and a reason for the table, where the summary has none. */
static double number_of(struct variant *v, const char *key)
{
    const struct summary_entry *const e = result_find(&v->result, key);
    if (e && e->is_number)
        return e->number;
    xfree(v->reason);
    v->reason = xprintf("its summary has no number %s", key);
    return (double)NAN;
}

/* Ends the program if no variant that has run has such a line. */
static void need_line(const struct trade *t, const char *key)
{
    int good = 0;
    for (int i = 0; i < t->study.n; i++) {
        const struct variant *const v = t->study.variant[i];
        const struct summary_entry *const e = result_find(&v->result, key);
        good += v->ending == RUN_GOOD;
        if (e && e->is_number)
            return;
    }
    if (good > 0)
        die(EXIT_SCENE, "%s has no number %s in its summary%s", t->study.scene, key,
            strcmp(key, "reference_error") == 0
                ? ": name a reference in the scene, or ask for --quantity KEY --against finest"
                : "");
}

void trade_errors(struct trade *t)
{
    const int n = t->study.n, nq = t->n_quantities;
    xfree(t->value);
    t->value = xalloc((size_t)n * (size_t)nq + 1, sizeof *t->value);
    if (t->against == AGAINST_FINEST)
        for (int q = 0; q < nq; q++)
            find_finest(t, q);
    if (nq == 0)
        need_line(t, t->error_key ? t->error_key : "reference_error");
    for (int q = 0; q < nq; q++)
        need_line(t, t->quantity[q]);
    for (int i = 0; i < n; i++) {
        struct variant *const v = t->study.variant[i];
        if (v->ending != RUN_GOOD)
            continue;
        if (nq == 0) {
            t->error[i] = fabs(number_of(v, t->error_key ? t->error_key : "reference_error"));
            continue;
        }
        t->error[i] = 0.0;
        for (int q = 0; q < nq; q++) {
            const double got = number_of(v, t->quantity[q]);
            const double want = t->against == AGAINST_FILE    ? in_table(t, v, t->quantity[q])
                                : t->against == AGAINST_VALUE ? strtod(t->against_text, NULL)
                                                              : t->truth[q];
            const double off = fabs(got - want) / fabs(want);
            t->value[i * nq + q] = got;
            t->error[i] = off > t->error[i] || isnan(off) ? off : t->error[i];
        }
    }
    pareto_front(n, t->cost, t->error, t->front);
}

void trade_free(struct trade *t)
{
    void *const all[] = {t->error, t->cost, t->wall,  t->core, t->memory,
                         t->low,   t->high, t->front, t->value};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    for (int q = 0; q < t->n_quantities; q++)
        xfree(t->quantity[q]);
    study_close(&t->study);
}
