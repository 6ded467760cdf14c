/* spread.h - sums from grains to cells: out_c = sum over grains p of f_pc v_p.
 *
 * Every cell adds its grains in their order in memory, whatever the number of threads: the field is
 * cut into strips of consecutive entries, each with the list of the grains that have shares in it
 * (grains are sorted in space, so a strip's grains lie together), and a strip is one thread's. The
 * lists are made in two passes over fixed blocks of grains. */
#ifndef SPREAD_H
#define SPREAD_H

#include "shares.h"

struct spread_run; /* consecutive shares of one grain in one strip */

struct spread {
    int shift;          /* a strip is 2^shift entries of a field */
    int strips, blocks; /* at most */
    size_t total;       /* entries of a field */
    int reach;
    const struct share *shares; /* n x reach, the caller's */
    int *counts;                /* blocks x strips */
    int *begin;                 /* strips + 1 */
    struct spread_run *runs;
    size_t capacity;
};

void spread_create(struct spread *sp, const struct grid *g);
void spread_free(struct spread *sp);

/* Lists the shares (n x reach, of which n_shares[i] are used), which must outlive the sums. */
void spread_prepare(struct spread *sp, int n, int reach, const int *n_shares,
                    const struct share *shares);

enum {
    SPREAD_STRIDE = 8
}; /* doubles from grain to grain in `values` of a sum of several columns */

/* out = sum of weight times the grain's value, over a whole field (ghosts 0). */
void spread_one(const struct spread *sp, const double *value, double *out);

/* out[c] = sum of factor times column c of the grain's values, c < columns (at most 8). Factors are
 * n x reach; NULL: the weights of the shares. */
void spread_columns(const struct spread *sp, const double *factor, const double *values,
                    int columns, double *const *out);

#endif
