/* spread.c - sums from grains to cells, see spread.h. */
#include "spread.h"

#include <string.h>

enum { STRIPS_MOST = 1024, BLOCKS_MOST = 64, BLOCK_LEAST = 128, STRIP_LEAST = 5 /* 2^5 */ };

struct spread_run {
    int grain, n;
    size_t first; /* share */
};

void spread_create(struct spread *sp, const struct grid *g)
{
    *sp = (struct spread){.shift = STRIP_LEAST, .total = g->total};
    while (g->total >> sp->shift >= STRIPS_MOST)
        sp->shift++;
    sp->strips = (int)(g->total >> sp->shift) + 1;
    sp->counts = xalloc((size_t)BLOCKS_MOST * sp->strips, sizeof *sp->counts);
    sp->begin = xalloc((size_t)sp->strips + 1, sizeof *sp->begin);
}

void spread_free(struct spread *sp)
{
    xfree(sp->counts);
    xfree(sp->begin);
    xfree(sp->runs);
}

/* The runs of grains first..last-1: counted per strip, or written from next[strip] on. */
static void walk(struct spread *sp, int first, int last, const int *n_shares, int *next,
                 bool write)
{
    for (int i = first; i < last; i++) {
        const size_t base = (size_t)i * sp->reach;
        for (int k = 0; k < n_shares[i];) {
            const int strip = sp->shares[base + k].cell >> sp->shift, start = k;
            while (k < n_shares[i] && sp->shares[base + k].cell >> sp->shift == strip)
                k++;
            if (write)
                sp->runs[next[strip]] =
                    (struct spread_run){.grain = i, .n = k - start, .first = base + start};
            next[strip]++;
        }
    }
}

/* Counts per block and strip become the places where each block writes. */
static void place_runs(struct spread *sp)
{
    int sum = 0;
    for (int t = 0; t < sp->strips; t++) {
        sp->begin[t] = sum;
        for (int b = 0; b < sp->blocks; b++) {
            int *const count = &sp->counts[(size_t)b * sp->strips + t];
            const int here = *count;
            *count = sum;
            sum += here;
        }
    }
    sp->begin[sp->strips] = sum;
    if ((size_t)sum > sp->capacity) {
        xfree(sp->runs);
        sp->capacity = (size_t)sum + (size_t)sum / 4;
        sp->runs = xalloc(sp->capacity, sizeof *sp->runs);
    }
}

void spread_prepare(struct spread *sp, int n, int reach, const int *n_shares,
                    const struct share *shares)
{
    const int wish = n / BLOCK_LEAST + 1;
    sp->reach = reach;
    sp->shares = shares;
    sp->blocks = wish < BLOCKS_MOST ? wish : BLOCKS_MOST;
    memset(sp->counts, 0, (size_t)sp->blocks * sp->strips * sizeof *sp->counts);
    for (int pass = 0; pass < 2; pass++) {
#pragma omp parallel for schedule(static)
        for (int b = 0; b < sp->blocks; b++)
            walk(sp, (int)((long)n * b / sp->blocks), (int)((long)n * (b + 1) / sp->blocks),
                 n_shares, &sp->counts[(size_t)b * sp->strips], pass == 1);
        if (pass == 0)
            place_runs(sp);
    }
}

void spread_one(const struct spread *sp, const double *value, double *out)
{
#pragma omp parallel for schedule(dynamic, 4)
    for (int t = 0; t < sp->strips; t++) {
        const size_t lo = (size_t)t << sp->shift, end = (size_t)(t + 1) << sp->shift;
        const size_t hi = end < sp->total ? end : sp->total;
        if (hi > lo)
            memset(out + lo, 0, (hi - lo) * sizeof *out);
        for (int r = sp->begin[t]; r < sp->begin[t + 1]; r++) {
            const struct spread_run run = sp->runs[r];
            const double v = value[run.grain];
            for (int k = 0; k < run.n; k++)
                out[sp->shares[run.first + k].cell] += sp->shares[run.first + k].weight * v;
        }
    }
}

/* The sums of one strip, columns side by side. */
static void sum_strip(const struct spread *sp, int t, const double *factor,
                      const double *values, double (*restrict sum)[SPREAD_STRIDE])
{
    const int lo = t << sp->shift;
    for (int r = sp->begin[t]; r < sp->begin[t + 1]; r++) {
        const struct spread_run run = sp->runs[r];
        const double *const v = values + (size_t)run.grain * SPREAD_STRIDE;
        for (int k = 0; k < run.n; k++) {
            const struct share *const w = &sp->shares[run.first + k];
            const double f = factor ? factor[run.first + k] : w->weight;
            double *const to = sum[w->cell - lo];
#pragma omp simd
            for (int c = 0; c < SPREAD_STRIDE; c++)
                to[c] += f * v[c];
        }
    }
}

void spread_columns(const struct spread *sp, const double *factor, const double *values,
                    int columns, double *const *out)
{
    const size_t size = (size_t)1 << sp->shift;
#pragma omp parallel
    {
        double(*const sum)[SPREAD_STRIDE] = xalloc(size, sizeof *sum);
#pragma omp for schedule(dynamic, 4)
        for (int t = 0; t < sp->strips; t++) {
            const size_t lo = (size_t)t << sp->shift;
            const size_t here = lo + size < sp->total ? size : sp->total - lo;
            const bool any = sp->begin[t + 1] > sp->begin[t];
            if (any)
                sum_strip(sp, t, factor, values, sum);
            for (int c = 0; c < columns; c++)
                for (size_t k = 0; k < here; k++)
                    out[c][lo + k] = any ? sum[k][c] : 0.0;
            if (any)
                memset(sum, 0, size * sizeof *sum);
        }
        xfree(sum);
    }
}
