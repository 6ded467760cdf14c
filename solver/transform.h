/* transform.h - the transforms that diagonalise the second difference of n cells between two
 * sides: how a line is laid out, which passes it takes, what each mode's eigenvalue is. The
 * passes themselves are in transform_lanes.h, for many lines at once.
 *
 *   sides                  method           modes              eigenvalue times h^2
 *   periodic               FOURIER          real, imaginary    4 sin^2(pi m/n)
 *   Neumann, Neumann       COSINE           DCT-II             4 sin^2(pi m/2n)
 *   Dirichlet, Dirichlet   COSINE           DST-II             4 sin^2(pi (n - m)/2n)
 *   one of each, n even    QUARTER          DCT-IV, DST-IV     4 sin^2(pi (k + 1/2)/2n)
 *   one of each, n odd     COSINE           DCT-IV, DST-IV     the same
 *   n awkward              LIBRARY          FFTW's             the same
 *
 * FOURIER and COSINE take two lines as the real and imaginary part of one complex line of
 * length n; COSINE reorders and turns it [Makhoul80]. QUARTER takes each line as a complex one
 * of length n/2. A DST-II is a DCT-II with every other sign changed and the modes reversed, a
 * DST-IV a DCT-IV of the reversed line. For odd n a DCT-IV is a Fourier transform of the line
 * reordered [ChanHo90]: of the odd numbers u = 2j + 1 modulo 8n, the four +-u, +-u + 4n stand
 * for the same cosine but for its sign, and one of them is 1 modulo 8, so that by the Chinese
 * remainder theorem cos(2 pi u v/8n) = +-cos(2 pi (a/8 + b u v/n)), a n + 8 b = 1.
 * LIBRARY: n has a prime factor above TRANSFORM_PRIME. */
#ifndef TRANSFORM_H
#define TRANSFORM_H

#include <stdbool.h>

enum poisson_side { POISSON_PERIODIC, POISSON_NEUMANN, POISSON_DIRICHLET };

enum { TRANSFORM_PRIME = 251, TRANSFORM_PASSES = 32 };

enum method { METHOD_FOURIER, METHOD_COSINE, METHOD_QUARTER, METHOD_LIBRARY };

struct transform {
    int n;
    enum method method;
    bool mixed;         /* sides unlike */
    int length, copies; /* of the complex lines that a pair of lines makes */
    int passes, radix[TRANSFORM_PASSES];
    int *slot;       /* n: where input j goes, for the first half of the lines */
    bool signs;      /* some inputs change sign: */
    bool *negative;  /* n: this one does */
    int step, group; /* mode m of the first half lies at m step; the second half `group` on */
    double *eigenvalue; /* n, times h^2 */
    double norm;        /* backward(forward(x)) = norm x */
    double *table;      /* factors of the passes, roots of their radices, turns */
    float *table_single;
    int at_root[TRANSFORM_PASSES], at_pass[TRANSFORM_PASSES], at_turn, table_size;
    void *plan[2]; /* LIBRARY: FFTW's, forward and backward, of TRANSFORM_LINES lines */
};

enum { TRANSFORM_LINES = 16 }; /* of one library call, side by side */

struct transform *transform_create(int n, enum poisson_side lo, enum poisson_side hi);
void transform_free(struct transform *t);

/* LIBRARY: in place on n x TRANSFORM_LINES values, aligned to 64 bytes. */
void transform_library(const struct transform *t, bool back, double *lines);

/* The least size from n on whose transform is quick: no prime factor above 13; up to
 * TRANSFORM_QUICK it costs little. */
enum { TRANSFORM_QUICK = 31 };
int transform_largest_prime(int n);
int transform_good_size(int n);

#endif
