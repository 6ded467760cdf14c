/* trade_plan.c - which variants are run.
 *
 * grid   all of them
 * one    the first value on every axis, and from there each axis alone (at each value of a condition)
 * front  a part of the grid, chosen so that the Pareto front is found with few runs: first those of
 *        `one`; then log(error) and log(cost) are taken as sums of one effect per value and axis,
 *        fitted by least squares (by the pseudo-inverse [GolubReinsch70] where they do not
 *        determine it), and what has not run and would lie on the front by that sum is run next,
 *        until what would lie there has run. The further a front is bent by effects that depend on
 *        each other, the more of the grid this takes; it never takes more than all of it. */
#include <gsl/gsl_multifit.h>
#include <string.h>
#include "trade.h"

#define LEAST_ERROR 1e-15 /* what is exact counts as this on a logarithmic scale */

enum { MOST_BATCH = 8 };

/* Next choice of the grid; false after the last. */
static bool next_choice(const struct study *s, int *choice)
{
    for (int a = s->n_axes - 1; a >= 0; a--) {
        if (++choice[a] < s->axis[a].n)
            return true;
        choice[a] = 0;
    }
    return false;
}

/* A named axis that does not apply is told once and ends the study: the user asked for it. */
static struct variant *wanted(struct trade *t, const int *choice)
{
    char *why;
    struct variant *const v = study_variant(&t->study, choice, &why);
    if (!v)
        die(EXIT_SCENE, "%s", why);
    return v;
}

/* With all its repetitions. */
static void wanted_all(struct trade *t, const int *choice)
{
    int each[MOST_AXES];
    memcpy(each, choice, sizeof each);
    for (int k = 0; k < (t->mean < 0 ? 1 : t->study.axis[t->mean].n); k++) {
        if (t->mean >= 0)
            each[t->mean] = k;
        wanted(t, each);
    }
}

static void make_one(struct trade *t)
{
    for (int group = 0; group < trade_groups(t); group++) {
        int choice[MOST_AXES] = {0};
        if (t->per >= 0)
            choice[t->per] = group;
        wanted_all(t, choice);
        for (int a = 0; a < t->study.n_axes; a++) {
            for (int i = 1; a != t->per && a != t->mean && i < t->study.axis[a].n; i++) {
                choice[a] = i;
                wanted_all(t, choice);
            }
            choice[a] = a == t->per ? group : 0;
        }
    }
}

/* The finest variants, which the others are compared with. */
static void make_finest(struct trade *t)
{
    const struct study *const s = &t->study;
    for (int group = 0; group < trade_groups(t); group++) {
        int choice[MOST_AXES], along = -1;
        for (int a = 0; a < s->n_axes; a++) {
            choice[a] = a == t->per ? group : s->axis[a].n - 1;
            if (along < 0 && a != t->per && a != t->mean && !s->axis[a].words &&
                s->axis[a].n >= 3 && s->axis[a].kind != AXIS_THREADS)
                along = a;
        }
        wanted_all(t, choice);
        for (int k = 2; along >= 0 && k <= 3; k++) {
            choice[along] = s->axis[along].n - k;
            wanted_all(t, choice);
        }
    }
}

static void make_grid(struct trade *t)
{
    int choice[MOST_AXES] = {0};
    do
        wanted(t, choice);
    while (next_choice(&t->study, choice));
}

static int columns_of(const struct study *s)
{
    int n = 1;
    for (int a = 0; a < s->n_axes; a++)
        n += s->axis[a].n;
    return n;
}

/* A row of the design: 1, and 1 for each value chosen. */
static void fill_row(const struct study *s, const int *choice, gsl_vector *row)
{
    size_t c = 1;
    gsl_vector_set_zero(row);
    gsl_vector_set(row, 0, 1.0);
    for (int a = 0; a < s->n_axes; a++) {
        gsl_vector_set(row, c + (size_t)choice[a], 1.0);
        c += (size_t)s->axis[a].n;
    }
}

/* Effects on log(y) of all that has run; false where too little has. */
static bool fit(const struct trade *t, const double *y, gsl_vector *effect)
{
    const struct study *const s = &t->study;
    const size_t columns = effect->size;
    size_t rows = 0;
    for (int i = 0; i < s->n; i++)
        rows += isfinite(y[i]);
    if (rows < 2)
        return false;
    /* zero rows make it as tall as GSL asks for */
    const size_t tall = rows > columns ? rows : columns;
    gsl_matrix *const design = gsl_matrix_calloc(tall, columns);
    gsl_matrix *const covariance = gsl_matrix_alloc(columns, columns);
    gsl_vector *const right = gsl_vector_calloc(tall);
    gsl_multifit_linear_workspace *const work = gsl_multifit_linear_alloc(tall, columns);
    size_t r = 0, rank;
    double rest;
    for (int i = 0; i < s->n; i++) {
        if (!isfinite(y[i]))
            continue;
        gsl_vector_view row = gsl_matrix_row(design, r);
        fill_row(s, s->variant[i]->choice, &row.vector);
        gsl_vector_set(right, r++, log(fmax(y[i], LEAST_ERROR)));
    }
    gsl_multifit_linear_tsvd(design, right, 1e-9, effect, covariance, &rest, &rank, work);
    gsl_matrix_free(design);
    gsl_matrix_free(covariance);
    gsl_vector_free(right);
    gsl_multifit_linear_free(work);
    return true;
}

static bool exists(const struct study *s, const int *choice)
{
    for (int i = 0; i < s->n; i++)
        if (memcmp(s->variant[i]->choice, choice, (size_t)s->n_axes * sizeof *choice) == 0)
            return true;
    return false;
}

/* Adds what the sums put on the front and has not run; returns how many. */
static int add_promising(struct trade *t)
{
    struct study *const s = &t->study;
    gsl_vector *const effect[2] = {gsl_vector_alloc((size_t)columns_of(s)),
                                   gsl_vector_alloc((size_t)columns_of(s))};
    gsl_vector *const row = gsl_vector_alloc((size_t)columns_of(s));
    int added = 0, total = 1, choice[MOST_AXES] = {0};
    for (int a = 0; a < s->n_axes; a++)
        total *= s->axis[a].n;
    if (fit(t, t->cost, effect[0]) && fit(t, t->error, effect[1])) {
        double *const guess[2] = {xalloc((size_t)total, sizeof(double)),
                                  xalloc((size_t)total, sizeof(double))};
        bool *const front = xalloc((size_t)total, sizeof *front);
        int *const group = xalloc((size_t)total, sizeof *group);
        int k = 0;
        do {
            group[k] = trade_group(t, choice);
            fill_row(s, choice, row);
            for (int e = 0; e < 2; e++) {
                guess[e][k] = 0.0;
                for (size_t c = 0; c < row->size; c++)
                    guess[e][k] += gsl_vector_get(row, c) * gsl_vector_get(effect[e], c);
            }
            k++;
        } while (next_choice(s, choice));
        pareto_front(total, group, guess[0], guess[1], front);
        memset(choice, 0, sizeof choice);
        k = 0;
        do {
            if (front[k++] && !exists(s, choice) && added < MOST_BATCH) {
                wanted_all(t, choice);
                added++;
            }
        } while (next_choice(s, choice));
        xfree(guess[0]);
        xfree(guess[1]);
        xfree(front);
        xfree(group);
    }
    gsl_vector_free(effect[0]);
    gsl_vector_free(effect[1]);
    gsl_vector_free(row);
    return added;
}

/* Once each: what the front is sought with. */
static void run_once(struct trade *t)
{
    for (int i = 0; i < t->study.n; i++)
        if (t->study.variant[i]->n_runs == 0)
            study_run(&t->study, t->study.variant[i]);
    trade_costs(t);
    trade_errors(t);
}

void trade_run_plan(struct trade *t)
{
    if (t->plan == PLAN_GRID) {
        make_grid(t);
    } else {
        make_one(t);
        if (t->against == AGAINST_FINEST)
            make_finest(t);
        if (t->plan == PLAN_FRONT) {
            run_once(t);
            while (add_promising(t) > 0)
                run_once(t);
        }
    }
    study_rounds(&t->study, t->study.variant, t->study.n);
}
