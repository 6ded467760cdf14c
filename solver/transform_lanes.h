/* transform_lanes.h - the passes of a transform over two packs of lines at once, each SIMD lane
 * a line: a Stockham FFT [Cochran67] of radices 4, 2 and any odd prime, with the steps before
 * and after it that make of it the transform that the sides ask for (transform.h).
 *
 * A body, included once for each precision: the includer defines REAL (double or float), INDEX
 * (the integer of the same size) and table_of(). */
#include <string.h>
#include "transform.h"

enum { LANES = 64 / sizeof(REAL) }; /* of a pack */
typedef REAL pack __attribute__((vector_size(64)));
typedef INDEX pack_index __attribute__((vector_size(64)));
struct pair { /* a complex number of each lane */
    pack re, im;
};

static inline struct pair add(struct pair a, struct pair b)
{
    return (struct pair){a.re + b.re, a.im + b.im};
}

static inline struct pair sub(struct pair a, struct pair b)
{
    return (struct pair){a.re - b.re, a.im - b.im};
}

static inline struct pair turned(struct pair a, const REAL *w) /* w a */
{
    return (struct pair){a.re * w[0] - a.im * w[1], a.im * w[0] + a.re * w[1]};
}

/* A pass: y[q + s (r p + i)] = w^(p i) sum_j x[q + s (p + m j)] exp(-2 pi i ij/r) */
static void pass_2(int m, int s, const REAL *w, const struct pair *restrict x,
                   struct pair *restrict y)
{
    for (int p = 0; p < m; p++, w += 2)
        for (int q = 0; q < s; q++) {
            const struct pair a = x[q + s * p], b = x[q + s * (p + m)];
            y[q + s * 2 * p] = add(a, b);
            y[q + s * (2 * p + 1)] = p == 0 ? sub(a, b) : turned(sub(a, b), w);
        }
}

static inline void butterfly_4(int p, int m, int s, const REAL *w,
                               const struct pair *restrict x, struct pair *restrict y)
{
    const struct pair a = x[s * p], b = x[s * (p + m)], c = x[s * (p + 2 * m)],
                      d = x[s * (p + 3 * m)];
    const struct pair ac = add(a, c), bd = add(b, d), e = sub(a, c), f = sub(b, d);
    const struct pair lo = {e.re + f.im, e.im - f.re}, hi = {e.re - f.im, e.im + f.re};
    struct pair *const out = y + (size_t)s * 4 * p;
    out[0] = add(ac, bd);
    out[s] = p == 0 ? lo : turned(lo, w);
    out[2 * s] = p == 0 ? sub(ac, bd) : turned(sub(ac, bd), w + 2);
    out[3 * s] = p == 0 ? hi : turned(hi, w + 4);
}

static void pass_4(int m, int s, const REAL *w, const struct pair *restrict x,
                   struct pair *restrict y)
{
    for (int q = 0; q < s; q++)
        butterfly_4(0, m, s, w, x + q, y + q);
    for (int p = 1; p < m; p++)
        for (int q = 0; q < s; q++)
            butterfly_4(p, m, s, w + 6 * p, x + q, y + q);
}

/* Odd radices: sums and differences of the values j and r - j halve the work. */
static inline __attribute__((always_inline)) void pass_odd(const int r, int m, int s,
                                                           const REAL *w, const REAL *root,
                                                           const struct pair *restrict x,
                                                           struct pair *restrict y)
{
    struct pair sum[TRANSFORM_PRIME / 2 + 1], difference[TRANSFORM_PRIME / 2 + 1];
    const int half = r / 2;
    for (int p = 0; p < m; p++, w += 2 * (r - 1))
        for (int q = 0; q < s; q++) {
            const struct pair first = x[q + s * p];
            struct pair all = first;
            for (int j = 1; j <= half; j++) {
                const struct pair a = x[q + s * (p + m * j)], b = x[q + s * (p + m * (r - j))];
                sum[j] = add(a, b);
                difference[j] = sub(a, b);
                all = add(all, sum[j]);
            }
            struct pair *const out = y + q + (size_t)s * r * p;
            out[0] = all;
            for (int i = 1; i <= half; i++) {
                struct pair c = first, d = {0};
                for (int j = 1, ij = i; j <= half; j++) {
                    const REAL cosine = root[2 * ij], sine = root[2 * ij + 1];
                    c.re += cosine * sum[j].re;
                    c.im += cosine * sum[j].im;
                    d.re += sine * difference[j].re;
                    d.im += sine * difference[j].im;
                    ij += i;
                    ij -= ij >= r ? r : 0;
                }
                const struct pair lo = {c.re + d.im, c.im - d.re},
                                  hi = {c.re - d.im, c.im + d.re};
                out[s * i] = turned(lo, w + 2 * (i - 1));
                out[s * (r - i)] = turned(hi, w + 2 * (r - i - 1));
            }
        }
}

static void pass_prime(int r, int m, int s, const REAL *w, const REAL *root,
                       const struct pair *restrict x, struct pair *restrict y)
{
    if (r == 3)
        pass_odd(3, m, s, w, root, x, y);
    else if (r == 5)
        pass_odd(5, m, s, w, root, x, y);
    else
        pass_odd(r, m, s, w, root, x, y);
}

/* Forward FFT of each copy; the result is in x or in y, which is returned. */
static struct pair *fft(const struct transform *t, struct pair *x, struct pair *y)
{
    const REAL *const table = table_of(t);
    for (int q = 0, left = t->length, s = 1; q < t->passes; q++) {
        const int r = t->radix[q], m = left / r;
        const REAL *const w = table + t->at_pass[q], *const root = table + t->at_root[q];
        for (int copy = 0; copy < t->copies; copy++) {
            const struct pair *const from = x + (size_t)copy * t->length;
            struct pair *const to = y + (size_t)copy * t->length;
            if (r == 4)
                pass_4(m, s, w, from, to);
            else if (r == 2)
                pass_2(m, s, w, from, to);
            else
                pass_prime(r, m, s, w, root, from, to);
        }
        struct pair *const other = x;
        x = y;
        y = other;
        left = m;
        s *= r;
    }
    return x;
}

/* The transform Z = A + i B of two real lines holds both: 2 A[k] = Z[k] + conj Z[n-k],
 * 2 B[k] = -i (Z[k] - conj Z[n-k]). Modes k and n - k are the real and imaginary parts of A
 * and B, first turned by w if there is one. */
static inline void separate(const struct pair *z, const struct pair *zn, const REAL *w,
                            struct pair *out, struct pair *out_n)
{
    const struct pair a = {z->re + zn->re, z->im - zn->im},
                      b = {z->im + zn->im, zn->re - z->re};
    if (w) {
        const struct pair wa = turned(a, w), wb = turned(b, w);
        *out = (struct pair){wa.re, wb.re};
        *out_n = (struct pair){-wa.im, -wb.im};
    } else {
        *out = (struct pair){a.re, b.re};
        *out_n = (struct pair){a.im, b.im};
    }
}

/* The inverse of it, with the real and imaginary parts exchanged: the forward FFT of that is
 * the inverse FFT, exchanged. */
static inline void join(const struct pair *x, const struct pair *xn, const REAL *w,
                        struct pair *z, struct pair *zn)
{
    struct pair a = {x->re, xn->re}, b = {x->im, xn->im};
    if (w) { /* conj(w) (X[k] - i X[n-k]) */
        a = (struct pair){w[0] * x->re - w[1] * xn->re, -w[1] * x->re - w[0] * xn->re};
        b = (struct pair){w[0] * x->im - w[1] * xn->im, -w[1] * x->im - w[0] * xn->im};
    }
    *z = (struct pair){a.re + b.im, b.re - a.im};
    *zn = (struct pair){a.re - b.im, b.re + a.im};
}

static inline void scale(struct pair *x, REAL factor)
{
    x->re *= factor;
    x->im *= factor;
}

static struct pair *quarter(const struct transform *t, struct pair *x, struct pair *y)
{
    const REAL *const w = table_of(t) + t->at_turn;
    for (int copy = 0; copy < 2; copy++)
        for (int k = 0; k < t->length; k++)
            x[copy * t->length + k] = turned(x[copy * t->length + k], w + 4 * k);
    struct pair *const z = fft(t, x, y);
    for (int copy = 0; copy < 2; copy++)
        for (int k = 0; k < t->length; k++) {
            struct pair *const to = &z[copy * t->length + k];
            *to = turned(*to, w + 4 * k + 2);
            to->im = -to->im;
        }
    return z;
}

static struct pair *library(const struct transform *t, bool back, struct pair *x,
                            struct pair *y)
{
    enum { HALVES = 2 * LANES / TRANSFORM_LINES };
    double *const lines = (double *)y;
    for (int half = 0; half < HALVES; half++) {
        const REAL *const from = (const REAL *)x + half * TRANSFORM_LINES;
        for (int j = 0; j < t->n; j++)
            for (int l = 0; l < TRANSFORM_LINES; l++)
                lines[j * TRANSFORM_LINES + l] = from[j * 2 * LANES + l];
        transform_library(t, back, lines);
        REAL *const to = (REAL *)x + half * TRANSFORM_LINES;
        for (int j = 0; j < t->n; j++)
            for (int l = 0; l < TRANSFORM_LINES; l++)
                to[j * 2 * LANES + l] = (REAL)lines[j * TRANSFORM_LINES + l];
    }
    return x;
}

/* Input j of the lines of pack g (0 or 1) at pack slot[j] + group g of x, changed in sign where
 * `negative` says so; mode m at pack m step + group g of what is returned, x or y. */
static struct pair *forward(const struct transform *t, struct pair *x, struct pair *y)
{
    if (t->method == METHOD_LIBRARY)
        return library(t, false, x, y);
    if (t->method == METHOD_QUARTER)
        return quarter(t, x, y);
    const int n = t->n;
    const bool cosine = t->method == METHOD_COSINE;
    const REAL *const w = table_of(t) + t->at_turn;
    struct pair *const z = fft(t, x, y);
    if (!cosine)
        scale(&z[0], (REAL)2);
    if (n % 2 == 0)
        scale(&z[n / 2], cosine ? w[n] : (REAL)2);
    for (int k = 1; k < n - k; k++) {
        const struct pair a = z[k], b = z[n - k];
        separate(&a, &b, cosine ? w + 2 * k : NULL, &z[k], &z[n - k]);
    }
    return z;
}

/* Modes as forward() leaves them; lines as it takes them. */
static struct pair *backward(const struct transform *t, struct pair *x, struct pair *y)
{
    if (t->method == METHOD_LIBRARY)
        return library(t, true, x, y);
    if (t->method == METHOD_QUARTER)
        return quarter(t, x, y);
    const int n = t->n;
    const bool cosine = t->method == METHOD_COSINE;
    const REAL *const w = table_of(t) + t->at_turn;
    if (cosine)
        scale(&x[0], (REAL)0.5);
    if (n % 2 == 0 && cosine)
        scale(&x[n / 2], w[n]);
    for (int k = 1; k < n - k; k++) {
        const struct pair a = x[k], b = x[n - k];
        join(&a, &b, cosine ? w + 2 * k : NULL, &x[k], &x[n - k]);
    }
    return fft(t, x, y);
}

/* Transposes LANES packs of LANES values. */
static inline void transpose(pack *x)
{
    pack_index low, high;
    for (int i = 0; i < LANES; i++) {
        low[i] = (i % 2 ? LANES : 0) + i / 2;
        high[i] = low[i] + LANES / 2;
    }
    for (int s = 1; s < LANES; s *= 2) {
        pack y[LANES];
        for (int i = 0; i < LANES / 2; i++) {
            y[2 * i] = __builtin_shuffle(x[i], x[i + LANES / 2], low);
            y[2 * i + 1] = __builtin_shuffle(x[i], x[i + LANES / 2], high);
        }
        memcpy(x, y, sizeof y);
    }
}
