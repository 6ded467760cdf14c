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
    bool confirm;
    enum cost_by by; /* what `cost`, `low` and `high` are */
    double within;   /* NaN: not asked for */
    /* what came out, by variant */
    double *error, *cost, *wall, *core, *memory, *low, *high; /* s per simulated
                                           s, or MiB; wall: s of a run */
    double *value;                                            /* n x n_quantities */
    bool *front;
    double truth[MOST_QUANTITIES], doubt[MOST_QUANTITIES], order[MOST_QUANTITIES]; /* finest */
    int best; /* index of the recommended variant, or -1 */
};

void trade_costs(struct trade *t);  /* medians and spreads of all variants */
void trade_errors(struct trade *t); /* after trade_costs; ends the program (2) where what is
                                       compared is not there */
/* Runs what the plan asks for. */
void trade_run_plan(struct trade *t);
void trade_write(const struct trade *t); /* trade.csv, trade.nc */
void trade_draw(const struct trade *t);  /* trade.png */
void trade_free(struct trade *t);

#endif
