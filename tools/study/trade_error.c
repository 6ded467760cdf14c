/* trade_error.c - the error of each variant, and its cost.
 *
 * The error is that against the scene's reference, or the largest relative difference of the
 * quantities from a value, from a table, or from the finest variant: that with the last value on
 * every axis (of a condition, --per, the same value). Where the first axis with numbers has three
 * values or more, Richardson's estimate from its last three takes the place of the finest variant
 * itself. Over an axis of repetitions (--mean) quantities and costs are means. */
#include <stdlib.h>
#include <string.h>
#include "trade.h"

/* True if two variants are of one set-up: they differ at most along the axis of repetitions. */
static bool alike(const struct trade *t, const int *a, const int *b)
{
    for (int k = 0; k < t->study.n_axes; k++)
        if (k != t->mean && a[k] != b[k])
            return false;
    return true;
}

/* The mean of a line of the summary over the repetitions of a set-up that have run (NaN of none);
 * *standard_error of it: 0 of one. */
static double mean_of(const struct trade *t, const int *choice, const char *key,
                      double *standard_error)
{
    double sum = 0.0, squares = 0.0;
    int n = 0;
    for (int i = 0; i < t->study.n; i++) {
        const struct variant *const v = t->study.variant[i];
        const double x = result_number(&v->result, key);
        if (v->ending != RUN_GOOD || !alike(t, v->choice, choice) || !isfinite(x))
            continue;
        const double off = x - sum / fmax(n, 1.0); /* Welford */
        sum += x;
        n++;
        squares += n > 1 ? off * (x - sum / n) : 0.0;
    }
    *standard_error = n > 1 ? sqrt(squares / (n - 1.0) / n) : 0.0;
    return n > 0 ? sum / n : (double)NAN;
}

/* Each repetition counts with the mean cost of its set-up. */
static void mean_costs(struct trade *t)
{
    const int n = t->study.n;
    if (t->mean < 0)
        return;
    double *const cost = xalloc((size_t)n + 1, sizeof *cost);
    for (int i = 0; i < n; i++) {
        double sum = 0.0;
        int found = 0;
        for (int k = 0; k < n; k++)
            if (isfinite(t->cost[k]) &&
                alike(t, t->study.variant[i]->choice, t->study.variant[k]->choice)) {
                sum += t->cost[k];
                found++;
            }
        cost[i] = isfinite(t->cost[i]) ? sum / found : (double)NAN;
    }
    for (int i = 0; i < n; i++)
        t->cost[i] = cost[i];
    xfree(cost);
}

void trade_costs(struct trade *t)
{
    const int n = t->study.n;
    double **const list[] = {&t->error,  &t->cost, &t->wall, &t->core,
                             &t->memory, &t->low,  &t->high, &t->scatter};
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
            t->high[i] = t->scatter[i] = (double)NAN;
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
    mean_costs(t);
}

/* The step that a value of an axis stands for: small is fine. Of cells the inverse. */
static double step_of(const struct axis *a, int i)
{
    return strcmp(a->key, "domain.cells") == 0 ? 1.0 / a->number[i] : a->number[i];
}

int trade_groups(const struct trade *t)
{
    return t->per < 0 ? 1 : t->study.axis[t->per].n;
}

int trade_group(const struct trade *t, const int *choice)
{
    return t->per < 0 ? 0 : choice[t->per];
}

/* The variant of the group with the last value on every other axis, but this one on `axis`; the first
 * of its repetitions. */
static const struct variant *with_choice(const struct trade *t, int group, int axis, int value)
{
    const struct study *const s = &t->study;
    for (int i = 0; i < s->n; i++) {
        const int *const choice = s->variant[i]->choice;
        bool same = true;
        for (int a = 0; a < s->n_axes; a++)
            same = same && choice[a] == (a == t->mean  ? 0
                                         : a == t->per ? group
                                         : a == axis   ? value
                                                       : s->axis[a].n - 1);
        if (same && s->variant[i]->ending == RUN_GOOD)
            return s->variant[i];
    }
    return NULL;
}

static struct truth find_finest(const struct trade *t, int group, const char *key)
{
    const struct study *const s = &t->study;
    const struct variant *const finest = with_choice(t, group, -1, 0);
    struct truth truth = {.doubt = (double)NAN, .order = (double)NAN};
    double unused;
    if (!finest)
        die(EXIT_SCENE,
            "the finest variant (the last value on every axis%s%s) has not run to its end",
            t->per < 0 ? "" : "; at ", t->per < 0 ? "" : s->axis[t->per].value[group]);
    truth.value = mean_of(t, finest->choice, key, &truth.scatter);
    for (int a = 0; a < s->n_axes; a++) {
        const struct axis *const x = &s->axis[a];
        if (a == t->per || a == t->mean || x->words || x->n < 3 || x->kind == AXIS_THREADS)
            continue;
        double h[3], f[3];
        bool all = true;
        for (int k = 0; k < 3; k++) {
            const struct variant *const v = with_choice(t, group, a, x->n - 3 + k);
            h[k] = step_of(x, x->n - 3 + k);
            f[k] = v ? mean_of(t, v->choice, key, &unused) : (double)NAN;
            all = all && isfinite(f[k]);
        }
        /* a stiffness that grows, say: what counts is its inverse */
        for (int k = 0; k < 3 && h[2] > h[0]; k++)
            h[k] = 1.0 / h[k];
        if (all && h[0] > h[1] && h[1] > h[2])
            truth.value = richardson(h, f, &truth.order, &truth.doubt);
        break;
    }
    return truth;
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
    xfree(t->truth);
    t->truth = xalloc((size_t)trade_groups(t) * (size_t)nq + 1, sizeof *t->truth);
    for (int k = 0; t->against == AGAINST_FINEST && k < trade_groups(t) * nq; k++)
        t->truth[k] = find_finest(t, k / nq, t->quantity[k % nq]);
    if (nq == 0)
        need_line(t, t->error_key ? t->error_key : "reference_error");
    for (int q = 0; q < nq; q++)
        need_line(t, t->quantity[q]);
    for (int i = 0; i < n; i++) {
        struct variant *const v = t->study.variant[i];
        if (v->ending != RUN_GOOD)
            continue;
        if (nq == 0) {
            const char *const key = t->error_key ? t->error_key : "reference_error";
            const double own = number_of(v, key);
            t->error[i] =
                isfinite(own) ? fabs(mean_of(t, v->choice, key, &t->scatter[i])) : own;
            continue;
        }
        const struct truth *const truth = t->truth + trade_group(t, v->choice) * nq;
        t->error[i] = 0.0;
        for (int q = 0; q < nq; q++) {
            const double own = number_of(v, t->quantity[q]);
            double scatter, got = mean_of(t, v->choice, t->quantity[q], &scatter);
            got = isfinite(own) ? got : own;
            const double want = t->against == AGAINST_FILE    ? in_table(t, v, t->quantity[q])
                                : t->against == AGAINST_VALUE ? strtod(t->against_text, NULL)
                                                              : truth[q].value;
            const double off = fabs(got - want) / fabs(want);
            t->value[i * nq + q] = own;
            t->scatter[i] = fmax(q > 0 ? t->scatter[i] : 0.0, fabs(scatter / got));
            t->error[i] = off > t->error[i] || isnan(off) ? off : t->error[i];
        }
    }
    int *const group = xalloc((size_t)n + 1, sizeof *group);
    for (int i = 0; i < n; i++)
        group[i] = trade_group(t, t->study.variant[i]->choice);
    pareto_front(n, group, t->cost, t->error, t->front);
    xfree(group);
}

void trade_free(struct trade *t)
{
    void *const all[] = {t->error, t->cost,  t->wall,  t->core,  t->memory, t->low,
                         t->high,  t->front, t->value, t->truth, t->best,   t->scatter};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    for (int q = 0; q < t->n_quantities; q++)
        xfree(t->quantity[q]);
    study_close(&t->study);
}
