/* bench/kernels.c - the memory's triad and the direct pressure solve, on OMP_NUM_THREADS threads. */
#include <omp.h>
#include <stdio.h>
#include "../solver/poisson.h"

enum { ROUNDS = 9 };

static double median(double *x)
{
    for (int i = 0; i < ROUNDS; i++)
        for (int j = i; j > 0 && x[j] < x[j - 1]; j--) {
            const double t = x[j];
            x[j] = x[j - 1];
            x[j - 1] = t;
        }
    return x[ROUNDS / 2];
}

/* GB/s as the program counts them: two read, one written. */
static double triad(void)
{
    const size_t n = (size_t)1 << 24;
    double *const a = xalloc(n, sizeof *a), *const b = xalloc(n, sizeof *b);
    double *const c = xalloc(n, sizeof *c), time[ROUNDS];
    for (int r = 0; r < ROUNDS; r++) {
        const double start = wall_clock();
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n; i++)
            a[i] = b[i] + 3.0 * c[i];
        time[r] = wall_clock() - start;
    }
    xfree(a);
    xfree(b);
    xfree(c);
    return 24.0 * (double)n / median(time) * 1e-9;
}

/* ns per cell of one solve on n^3 cells. */
static double solve(int n, bool periodic)
{
    struct domain d = {.size = {1.0, 1.0, 1.0}, .cells = {n, n, n}};
    enum poisson_side side[6];
    double time[ROUNDS];
    struct grid g;
    for (int i = 0; i < 6; i++)
        side[i] = periodic && i < 4 ? POISSON_PERIODIC : POISSON_NEUMANN;
    d.periodic[0] = d.periodic[1] = periodic;
    grid_create(&g, &d);
    struct poisson *const p = poisson_create(&g, side);
    double *const f = grid_field(&g), *const c = xalloc((size_t)n + 2, sizeof *c);
    for (int k = 0; k < n + 2; k++)
        c[k] = 1.0;
    for (size_t i = 0; i < g.total; i++)
        f[i] = (double)(i % 17) - 8.0;
    for (int r = 0; r < ROUNDS; r++) {
        const double start = wall_clock();
        poisson_solve(p, c, c, 0.0, f, f);
        time[r] = wall_clock() - start;
    }
    xfree(f);
    xfree(c);
    poisson_free(p);
    return 1e9 * median(time) / ((double)n * n * n);
}

int main(void)
{
    printf("threads %d: triad %.1f GB/s; pressure solve, ns per cell: 64^3 walls %.1f, "
           "periodic %.1f; "
           "128^3 walls %.1f, periodic %.1f\n",
           omp_get_max_threads(), triad(), solve(64, false), solve(64, true), solve(128, false),
           solve(128, true));
    return 0;
}
