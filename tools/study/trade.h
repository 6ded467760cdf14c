/* trade.h - error against cost: the parts of tools/trade.c. */
#ifndef TRADE_H
#define TRADE_H

#include "study.h"

enum { MOST_QUANTITIES = 8 };

enum against { AGAINST_REFERENCE, AGAINST_VALUE, AGAINST_FILE, AGAINST_FINEST };
enum plan { PLAN_GRID, PLAN_ONE, PLAN_FRONT };

enum cost_by { BY_WALL, BY_CORE, BY_MEMORY };

struct trade {
    struct study study;
    const char *error_key; /* line of the summary that is an error; NULL: reference_error */
    int n_quantities;      /* or lines that are compared */
    char *quantity[MOST_QUANTITIES];
    enum against against;
    const char *against_text;
    enum plan plan;
    int per; /* axis of a condition: each of its values has its own finest variant, front and
                recommended set-up; -1: none */
    int mean; /* axis of repetitions (a seed): what is compared is the mean over it, and so is the cost;
                 -1: none */
    bool confirm;
    enum cost_by by; /* what `cost`, `low` and `high` are */
    double within;   /* NaN: not asked for */
    /* what came out, by variant */
    double *error, *cost, *wall, *core, *memory, *low, *high; /* s per simulated
                                           s, or MiB; wall: s of a run */
    double *value;                                            /* n x n_quantities */
    double *scatter; /* standard error of a mean over the
                                           quantity itself, the largest */
    bool *front;
    struct truth *truth; /* of AGAINST_FINEST: trade_groups x n_quantities */
    int *best;           /* of each group: index of the recommended variant, or -1 */
};

/* What the finest variant gives. */
struct truth {
    double value, scatter; /* scatter: standard error of a mean */
    double doubt, order;   /* of Richardson's estimate, or NaN */
};

int trade_groups(const struct trade *t);                   /* values of the condition, or 1 */
int trade_group(const struct trade *t, const int *choice); /* which of them */

void trade_costs(struct trade *t);  /* medians and spreads of all variants */
void trade_errors(struct trade *t); /* after trade_costs; ends the program (2) where what is
                                       compared is not there */
/* Runs what the plan asks for. */
void trade_run_plan(struct trade *t);
const char *trade_cost_unit(const struct trade *t);
void trade_write(const struct trade *t); /* trade.csv, trade.nc */
void trade_draw(const struct trade *t);  /* trade.png */
void trade_free(struct trade *t);

#endif
