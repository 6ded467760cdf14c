/* turn.h - rows to columns: eight structures of eight numbers to eight arrays of eight and back,
 * in registers. Written in GCC's vectors, since the compiler turns strided loops into many more
 * shuffles than these three rounds. */
#ifndef TURN_H
#define TURN_H

#include "body.h"

#ifdef SILT_FLOAT
typedef int32_t lane8 __attribute__((vector_size(32)));
#else
typedef int64_t lane8 __attribute__((vector_size(64)));
#endif

/* a[k][m] <-> a[m][k] */
#define TURN_EIGHT(name, eight, lanes)                                                         \
    static inline __attribute__((always_inline)) void name(eight a[8])                         \
    {                                                                                          \
        eight b[8];                                                                            \
        for (int k = 0; k < 8; k += 2) { /* pairs of neighbours */                             \
            b[k] = __builtin_shuffle(a[k], a[k + 1], (lanes){0, 8, 2, 10, 4, 12, 6, 14});      \
            b[k + 1] = __builtin_shuffle(a[k], a[k + 1], (lanes){1, 9, 3, 11, 5, 13, 7, 15});  \
        }                                                                                      \
        for (int k = 0; k < 8; k += 4) /* twos of twos */                                      \
            for (int m = k; m < k + 2; m++) {                                                  \
                a[m] = __builtin_shuffle(b[m], b[m + 2], (lanes){0, 1, 8, 9, 4, 5, 12, 13});   \
                a[m + 2] =                                                                     \
                    __builtin_shuffle(b[m], b[m + 2], (lanes){2, 3, 10, 11, 6, 7, 14, 15});    \
            }                                                                                  \
        for (int m = 0; m < 4; m++) { /* halves */                                             \
            b[m] = __builtin_shuffle(a[m], a[m + 4], (lanes){0, 1, 2, 3, 8, 9, 10, 11});       \
            b[m + 4] = __builtin_shuffle(a[m], a[m + 4], (lanes){4, 5, 6, 7, 12, 13, 14, 15}); \
        }                                                                                      \
        for (int m = 0; m < 8; m++)                                                            \
            a[m] = b[m];                                                                       \
    }
typedef int64_t long8 __attribute__((vector_size(64)));
TURN_EIGHT(turn8, real8, lane8)
TURN_EIGHT(turn8_double, double8, long8) /* whatever the precision of the build */
#undef TURN_EIGHT

/* Four arrays of eight to rows of four: row m in the lower half of out[m], row m + 4 in the upper. */
static inline __attribute__((always_inline)) void turn4(const real8 in[4], real8 out[4])
{
    real8 b[4];
    for (int k = 0; k < 4; k += 2) {
        b[k] = __builtin_shuffle(in[k], in[k + 1], (lane8){0, 8, 2, 10, 4, 12, 6, 14});
        b[k + 1] = __builtin_shuffle(in[k], in[k + 1], (lane8){1, 9, 3, 11, 5, 13, 7, 15});
    }
    for (int m = 0; m < 2; m++) {
        out[m] = __builtin_shuffle(b[m], b[m + 2], (lane8){0, 1, 8, 9, 4, 5, 12, 13});
        out[m + 2] = __builtin_shuffle(b[m], b[m + 2], (lane8){2, 3, 10, 11, 6, 7, 14, 15});
    }
}

static inline real8 take8(const real *x)
{
    real8 a;
    __builtin_memcpy(&a, x, sizeof a);
    return a;
}

static inline void put8(real *x, real8 a)
{
    __builtin_memcpy(x, &a, sizeof a);
}

#endif
