/* turn.h - rows to columns: eight structures of eight numbers to eight arrays of eight and back,
 * in registers. Written in GCC's vectors, since the compiler turns strided loops into many more
 * shuffles than these three rounds. */
#ifndef TURN_H
#define TURN_H

#include "body.h"
#if defined __AVX__
#include <immintrin.h>
#endif

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

/* Halves of rows k and k + 4 side by side: these come together where they are read, and part where they are
 * written, at no shuffle's price, which gcc 12 does not see by itself. */
static inline __attribute__((always_inline)) real8 turn_join(real4 row, real4 fourth_next)
{
#if defined SILT_FLOAT && defined __AVX__
    return (real8)_mm256_insertf128_ps(_mm256_castps128_ps256((__m128)row), (__m128)fourth_next,
                                       1);
#elif defined __AVX512F__
    return (real8)_mm512_insertf64x4(_mm512_castpd256_pd512((__m256d)row), (__m256d)fourth_next,
                                     1);
#else
    return __builtin_shufflevector(row, fourth_next, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

static inline __attribute__((always_inline)) real4 turn_second(real8 a)
{
#if defined SILT_FLOAT && defined __AVX__
    return (real4)_mm256_extractf128_ps((__m256)a, 1);
#elif defined __AVX512F__
    return (real4)_mm512_extractf64x4_pd((__m512d)a, 1);
#else
    return __builtin_shufflevector(a, a, 4, 5, 6, 7);
#endif
}

typedef coordinate coordinate8 __attribute__((vector_size(8 * sizeof(coordinate))));

static inline __attribute__((always_inline)) coordinate8
turn_join_places(coordinate4 row, coordinate4 fourth_next)
{
    return (coordinate8)turn_join((real4)row, (real4)fourth_next);
}

/* Four such halves to columns: column m of eight rows in out[m]; the two other rounds of turn8. */
static inline __attribute__((always_inline)) void turn_half(const real8 in[4], real8 out[4])
{
    real8 b[4];
#ifdef SILT_FLOAT /* within quarters of a register, each in one cycle */
    for (int k = 0; k < 4; k += 2) {
        b[k] = __builtin_shuffle(in[k], in[k + 1], (lane8){0, 8, 1, 9, 4, 12, 5, 13});
        b[k + 1] = __builtin_shuffle(in[k], in[k + 1], (lane8){2, 10, 3, 11, 6, 14, 7, 15});
    }
    for (int m = 0; m < 2; m++) {
        out[2 * m] = __builtin_shuffle(b[m], b[m + 2], (lane8){0, 1, 8, 9, 4, 5, 12, 13});
        out[2 * m + 1] = __builtin_shuffle(b[m], b[m + 2], (lane8){2, 3, 10, 11, 6, 7, 14, 15});
    }
#else
    for (int k = 0; k < 4; k += 2) {
        b[k] = __builtin_shuffle(in[k], in[k + 1], (lane8){0, 8, 2, 10, 4, 12, 6, 14});
        b[k + 1] = __builtin_shuffle(in[k], in[k + 1], (lane8){1, 9, 3, 11, 5, 13, 7, 15});
    }
    for (int m = 0; m < 2; m++) {
        out[m] = __builtin_shuffle(b[m], b[m + 2], (lane8){0, 1, 8, 9, 4, 5, 12, 13});
        out[m + 2] = __builtin_shuffle(b[m], b[m + 2], (lane8){2, 3, 10, 11, 6, 7, 14, 15});
    }
#endif
}

/* Eight rows of eight numbers to columns. */
static inline __attribute__((always_inline)) void turn_rows(const real4 *const row[8],
                                                            real8 out[8])
{
    for (int half = 0; half < 2; half++) {
        real8 in[4];
        for (int k = 0; k < 4; k++)
            in[k] = turn_join(row[k][half], row[k + 4][half]);
        turn_half(in, out + 4 * half);
    }
}

/* Eight columns to rows of eight numbers. */
static inline __attribute__((always_inline)) void turn_columns(const real8 in[8],
                                                               real (*row)[8])
{
    for (int half = 0; half < 2; half++) {
        real8 out[4];
        turn_half(in + 4 * half, out);
        for (int k = 0; k < 4; k++) {
            const real4 first = __builtin_shufflevector(out[k], out[k], 0, 1, 2, 3);
            const real4 second = turn_second(out[k]);
            __builtin_memcpy(&row[k][4 * half], &first, sizeof first);
            __builtin_memcpy(&row[k + 4][4 * half], &second, sizeof second);
        }
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
