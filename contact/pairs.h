/* contact/pairs.h - the parameters of a block's contacts, from a law's table of pairs.
 *
 * A law keeps table[pair][k], real. For a block they are spread into k[parameter][contact], which
 * the law's loop reads with its other arrays: vectorised loops have no look-up in them. Nearly
 * every block is of one pair of materials, which is looked up once. */
#ifndef PAIRS_H
#define PAIRS_H

#include "touch.h"

static __attribute__((noinline)) void pairs_spread(const struct touch *t, const real *table,
                                                   int parameters, real (*k)[TOUCH])
{
    const int first = t->pair[0];
    int unlike = 0;
#pragma omp simd reduction(| : unlike)
    for (int c = 0; c < t->n; c++)
        unlike |= t->pair[c] ^ first;
    if (unlike) {
        for (int p = 0; p < parameters; p++)
            for (int c = 0; c < t->n; c++)
                k[p][c] = table[t->pair[c] * parameters + p];
        return;
    }
    for (int p = 0; p < parameters; p++) {
        const real value = table[first * parameters + p];
#pragma omp simd
        for (int c = 0; c < t->n; c++)
            k[p][c] = value;
    }
}

#endif
