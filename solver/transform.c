/* transform.c - plans of the transforms of transform.h: layouts, radices, tables. Nothing is
 * timed (FFTW_ESTIMATE), so that a run gives the same bits every time. */
#include "transform.h"

#include <fftw3.h>
#include "base.h"

#define PI 3.14159265358979323846

static bool mixed(enum poisson_side lo, enum poisson_side hi)
{
    return lo != hi;
}

int transform_largest_prime(int n)
{
    int largest = 1;
    for (int p = 2; p * p <= n; p++)
        for (; n % p == 0; n /= p)
            largest = p;
    return n > 1 ? n : largest;
}

static enum method method_of(int n, enum poisson_side lo, enum poisson_side hi)
{
    if (transform_largest_prime(n) > TRANSFORM_PRIME)
        return METHOD_LIBRARY;
    if (lo == POISSON_PERIODIC)
        return METHOD_FOURIER;
    return mixed(lo, hi) && n % 2 == 0 ? METHOD_QUARTER : METHOD_COSINE;
}

int transform_good_size(int n)
{
    while (transform_largest_prime(n) > 13)
        n++;
    return n;
}

/* v 's inverse modulo n */
static int inverse_modulo(int v, int n)
{
    int x = 1;
    while (n > 1 && (int)((long)v * x % n) != 1)
        x++;
    return x;
}

/* The one of +-u, +-u + 4n, modulo 8n, that is 1 modulo 8; whether its cosines change sign. */
static int representative(int u, int n, bool *negative)
{
    const int all = 8 * n, choice[4] = {u, all - u, u + 4 * n, 4 * n - u};
    int i = 0;
    while ((choice[i] % all + all) % 8 != 1)
        i++;
    *negative = i > 1;
    return (choice[i] + all) % all;
}

/* Where mode k of a DCT-IV of odd n lies: -m = b v modulo n. */
static int odd_mode(int k, int n)
{
    bool negative;
    const int v = representative(2 * k + 1, n, &negative);
    return (n - (int)((long)inverse_modulo(8 % n, n) * v % n)) % n;
}

static void set_radices(struct transform *t)
{
    int left = t->length;
    while (left % 4 == 0) {
        t->radix[t->passes++] = 4;
        left /= 4;
    }
    for (int p = 2; left > 1; p++)
        for (; left % p == 0; left /= p)
            t->radix[t->passes++] = p;
}

/* Pass of radix r on what is left of the length, n: factors w^(p i), p < n/r, 0 < i < r. */
static int fill_tables(struct transform *t, double *table)
{
    int at = 0, left = t->length;
    for (int q = 0; q < t->passes; q++) {
        const int r = t->radix[q];
        t->at_pass[q] = at;
        for (int p = 0; p < left / r; p++)
            for (int i = 1; i < r; i++, at += 2) {
                const double angle = -2.0 * PI * ((double)p * i) / left;
                if (table) {
                    table[at] = cos(angle);
                    table[at + 1] = sin(angle);
                }
            }
        t->at_root[q] = at;
        for (int i = 0; i < r; i++, at += 2)
            if (table) {
                table[at] = cos(2.0 * PI * i / r);
                table[at + 1] = sin(2.0 * PI * i / r);
            }
        left /= r;
    }
    t->at_turn = at;
    const int n = t->n;
    const double a = n % 2 ? 0.25 * PI * inverse_modulo(n % 8, 8) : 0.0; /* of a DCT-IV */
    if (t->method == METHOD_COSINE) /* half of exp(-i pi k/2n); whole in the middle */
        for (int k = 0; k <= n / 2; k++, at += 2)
            if (table) {
                const double size = 2 * k == n ? 1.0 : 0.5;
                table[at] = size * (t->mixed ? cos(a) : cos(PI * k / (2.0 * n)));
                table[at + 1] = size * (t->mixed ? sin(a) : -sin(PI * k / (2.0 * n)));
            }
    if (t->method == METHOD_QUARTER)
        for (int k = 0; k < n / 2; k++, at += 4)
            if (table) {
                table[at] = cos(PI * (4 * k + 1) / (4.0 * n));
                table[at + 1] = -sin(PI * (4 * k + 1) / (4.0 * n));
                table[at + 2] = cos(PI * k / n);
                table[at + 3] = -sin(PI * k / n);
            }
    return at;
}

static void set_layout(struct transform *t, bool sine)
{
    const int n = t->n;
    t->step = t->method == METHOD_QUARTER ? 1 : 2;
    t->group = t->method == METHOD_QUARTER ? n : 1;
    for (int j = 0; j < n; j++) {
        const int even = j % 2 == 0;
        switch (t->method) {
        case METHOD_COSINE:
            if (t->mixed) {
                const int u = 2 * (sine ? n - 1 - j : j) + 1;
                t->slot[j] = 2 * (representative(u, n, &t->negative[j]) % n);
            } else {
                t->slot[j] = 2 * (even ? j / 2 : n - 1 - j / 2);
                t->negative[j] = sine && !even;
            }
            break;
        case METHOD_QUARTER: {
            const int x = sine ? n - 1 - j : j;
            t->slot[j] = x % 2 == 0 ? x : n - x; /* x = n - 1 - 2i: imaginary part of i */
            break;
        }
        default:
            t->slot[j] = 2 * j;
        }
    }
    for (int j = 0; j < n; j++)
        t->signs = t->signs || t->negative[j];
}

static void set_eigenvalues(struct transform *t, enum poisson_side lo)
{
    const int n = t->n;
    for (int m = 0; m < n; m++) {
        int at = m; /* mode m of the table of transform.h */
        double x = PI * m / n;
        if (lo == POISSON_PERIODIC)
            x = 2.0 * PI * m / n;
        else if (t->mixed)
            x = PI * (m + 0.5) / n;
        else if (lo == POISSON_DIRICHLET)
            x = PI * (t->method == METHOD_LIBRARY ? m + 1 : n - m) / n;
        if (t->method == METHOD_QUARTER) /* 0, n - 1, 2, n - 3, ... */
            at = m % 2 == 0 ? m : n - m;
        else if (t->mixed && t->method == METHOD_COSINE)
            at = odd_mode(m, n);
        const double s = 2.0 * sin(0.5 * x);
        t->eigenvalue[at] = s * s;
    }
}

static fftw_r2r_kind kind_of(enum poisson_side lo, enum poisson_side hi, bool back)
{
    if (lo == POISSON_PERIODIC)
        return back ? FFTW_HC2R : FFTW_R2HC;
    if (mixed(lo, hi))
        return lo == POISSON_DIRICHLET ? FFTW_RODFT11 : FFTW_REDFT11;
    if (lo == POISSON_DIRICHLET)
        return back ? FFTW_RODFT01 : FFTW_RODFT10;
    return back ? FFTW_REDFT01 : FFTW_REDFT10;
}

static void set_library(struct transform *t, enum poisson_side lo, enum poisson_side hi)
{
    double *const lines = xalloc((size_t)t->n * TRANSFORM_LINES, sizeof *lines);
    for (int back = 0; back < 2; back++) {
        const fftw_r2r_kind kind = kind_of(lo, hi, back);
        t->plan[back] =
            fftw_plan_many_r2r(1, &t->n, TRANSFORM_LINES, lines, NULL, TRANSFORM_LINES, 1,
                               lines, NULL, TRANSFORM_LINES, 1, &kind, FFTW_ESTIMATE);
    }
    xfree(lines);
}

struct transform *transform_create(int n, enum poisson_side lo, enum poisson_side hi)
{
    struct transform *const t = xalloc(1, sizeof *t);
    t->n = n;
    t->method = method_of(n, lo, hi);
    t->mixed = mixed(lo, hi);
    t->slot = xalloc((size_t)n, sizeof *t->slot);
    t->negative = xalloc((size_t)n, sizeof *t->negative);
    t->eigenvalue = xalloc((size_t)n, sizeof *t->eigenvalue);
    t->length = t->method == METHOD_QUARTER ? n / 2 : n;
    t->copies = t->method == METHOD_QUARTER ? 2 : 1;
    set_layout(t, lo == POISSON_DIRICHLET);
    set_eigenvalues(t, lo);
    if (t->method == METHOD_LIBRARY) {
        t->norm = lo == POISSON_PERIODIC ? n : 2.0 * n;
        set_library(t, lo, hi);
        return t;
    }
    t->norm = t->method == METHOD_FOURIER ? 2.0 * n : 0.5 * n;
    set_radices(t);
    t->table_size = fill_tables(t, NULL);
    t->table = xalloc((size_t)t->table_size, sizeof *t->table);
    t->table_single = xalloc((size_t)t->table_size, sizeof *t->table_single);
    fill_tables(t, t->table);
    for (int i = 0; i < t->table_size; i++)
        t->table_single[i] = (float)t->table[i];
    return t;
}

void transform_free(struct transform *t)
{
    if (!t)
        return;
    for (int back = 0; back < 2; back++)
        if (t->plan[back])
            fftw_destroy_plan(t->plan[back]);
    void *const all[] = {t->slot, t->negative, t->eigenvalue, t->table, t->table_single, t};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

void transform_library(const struct transform *t, bool back, double *lines)
{
    fftw_execute_r2r(t->plan[back], lines, lines);
}
