/* bench/kernels.c - the pressure solves at 128^3, on one thread and on all, each beside the memory's
 * triad in the same minute: the direct one for every pair of sides, conjugate gradients and
 * multigrid on fields of several kinds. ns per cell, medians; x triad: over the time that the triad
 * takes to move 24 bytes a cell. `kernels sides`: the direct solve alone. */
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "../solver/pressure.h"

enum { ROUNDS = 7, N = 128 };

/* Of the processor on one thread (what else runs counts less), of the clock on more. */
static double clock_of(void)
{
    struct timespec t;
    if (omp_get_max_threads() > 1)
        return wall_clock();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *x, int n)
{
    qsort(x, (size_t)n, sizeof *x, by_size);
    return x[n / 2];
}

/* ns per 24 bytes as the program counts them: two numbers read, one written. */
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
    return 1e9 * median(time, ROUNDS) / (double)n;
}

static const enum poisson_side pair[5][2] = {{POISSON_PERIODIC, POISSON_PERIODIC},
                                             {POISSON_NEUMANN, POISSON_NEUMANN},
                                             {POISSON_DIRICHLET, POISSON_DIRICHLET},
                                             {POISSON_NEUMANN, POISSON_DIRICHLET},
                                             {POISSON_DIRICHLET, POISSON_NEUMANN}};
static const char *const pair_name[5] = {"periodic", "NN", "DD", "ND", "DN"};

static struct grid box(const int n[3], const enum poisson_side side[6], struct domain *d)
{
    struct grid g;
    *d = (struct domain){.size = {1.0, 1.0, 1.0}};
    for (int a = 0; a < 3; a++) {
        d->cells[a] = n[a];
        d->periodic[a] = side[2 * a] == POISSON_PERIODIC;
    }
    grid_create(&g, d);
    return g;
}

/* ns per cell of one direct solve with pair q % 5 in x, q / 5 % 5 in y, q / 25 in z. */
static double direct(const int n[3], int q, bool single, int rounds)
{
    const enum poisson_side *const x = pair[q % 5], *const y = pair[q / 5 % 5],
                                   *const z = pair[q / 25];
    const enum poisson_side side[6] = {x[0], x[1], y[0], y[1], z[0], z[1]};
    struct domain d;
    const struct grid g = box(n, side, &d);
    struct poisson *const p = poisson_create(&g, side);
    double *const f = grid_field(&g), *const c = xalloc((size_t)n[2] + 2, sizeof *c);
    float *const s = xalloc(g.total, sizeof *s), *const to = xalloc(g.total, sizeof *to);
    double time[ROUNDS];
    for (int k = 0; k < n[2] + 2; k++)
        c[k] = 1.0;
    for (size_t i = 0; i < g.total; i++)
        s[i] = (float)(f[i] = (double)(i % 17) - 8.0);
    for (int r = 0; r < rounds; r++) {
        const double start = clock_of();
        if (single)
            poisson_solve_single(p, c, c, 0.0, s, to, NULL);
        else
            poisson_solve(p, c, c, 0.0, f, f);
        time[r] = clock_of() - start;
    }
    xfree(f);
    xfree(s);
    xfree(to);
    xfree(c);
    poisson_free(p);
    return 1e9 * median(time, rounds) / ((double)n[0] * n[1] * n[2]);
}

static unsigned long seed = 777;

static double uniform(void)
{
    seed = seed * 6364136223846793005ul + 1442695040888963407ul;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* From 0 (dense) to 1 (free) at a place: a flat bed with noise, a bubbling bed, spheres. */
static double field_at(int kind, const double *sphere, int spheres, const double x[3])
{
    if (kind == 0)
        return x[2] < 0.5 ? 0.1 * uniform() : 1.0;
    bool inside = false;
    for (int s = 0; s < spheres && !inside; s++) {
        double distance = 0.0;
        for (int a = 0; a < 3; a++) {
            const double e = x[a] - sphere[3 * s + a];
            distance += (e - rint(e)) * (e - rint(e));
        }
        inside = distance < 0.08 * 0.08;
    }
    return kind == 1 ? (inside || x[2] > 0.6 ? 1.0 : 0.0) : (inside ? 0.0 : 1.0);
}

/* One field of a contrast: a line of the table. */
static void variable(int kind, double contrast, const char *name, int threads, double unit)
{
    enum { SPHERES = 120 };
    static const char *const methods[] = {"", "box", "layers", "multigrid"};
    const enum poisson_side side[6] = {POISSON_PERIODIC, POISSON_PERIODIC, POISSON_PERIODIC,
                                       POISSON_PERIODIC, POISSON_NEUMANN,  POISSON_DIRICHLET};
    const int n[3] = {N, N, N};
    struct domain d;
    const struct grid g = box(n, side, &d);
    double sphere[3 * SPHERES];
    for (int i = 0; i < 3 * SPHERES; i++)
        sphere[i] = uniform();
    double *const e = grid_field(&g), *const rhs = grid_field(&g), *const phi = grid_field(&g);
    double *const c[3] = {grid_field(&g), grid_field(&g), grid_field(&g)};
    for (int k = 1; k <= N; k++)
        for (int j = 1; j <= N; j++)
            for (int i = 1; i <= N; i++) {
                const double x[3] = {(i - 0.5) / N, (j - 0.5) / N, (k - 0.5) / N};
                const int m = cell(&g, i, j, k);
                e[m] = pow(contrast, field_at(kind, sphere, SPHERES, x));
                rhs[m] = uniform() - 0.5;
            }
    grid_ghosts(&g, &d, e);
    for (int a = 0; a < 3; a++)
        for (size_t m = (size_t)g.s[a]; m < g.total; m++)
            c[a][m] = 2.0 / (1.0 / e[m] + 1.0 / e[m - (size_t)g.s[a]]);
    struct pressure *const p = pressure_create(&g, &d, side);
    struct solve cold = {0}, warm = {0};
    double time_cold = (double)INFINITY, time_warm = (double)INFINITY;
    for (int r = 0; r < 3; r++) {
        for (size_t m = 0; m < g.total; m++)
            phi[m] = 0.0;
        double start = wall_clock();
        cold = pressure_solve(p, c, 0.0, rhs, phi, 1e-6, 0.0);
        time_cold = fmin(time_cold, wall_clock() - start);
        for (size_t m = 0; m < g.total; m++)
            phi[m] *= 1.01; /* as good as an extrapolation in time */
        start = wall_clock();
        warm = pressure_solve(p, c, 0.0, rhs, phi, 1e-6, 0.0);
        time_warm = fmin(time_warm, wall_clock() - start);
    }
    const double cells = 1e-9 * N * N * N;
    printf(
        "  %d thread%s %-12s contrast %-6g %-9s cold %3d iterations %7.1f ns (x triad %5.1f), "
        "warm %3d %7.1f%s\n",
        threads, threads > 1 ? "s" : " ", name, contrast, methods[cold.method], cold.iterations,
        time_cold / cells, time_cold / cells / unit, warm.iterations, time_warm / cells,
        cold.converged && warm.converged ? "" : "  NOT CONVERGED");
    pressure_free(p);
    for (int a = 0; a < 3; a++)
        xfree(c[a]);
    xfree(e);
    xfree(rhs);
    xfree(phi);
}

static void table_of_sides(int all)
{
    const int cube[3] = {N, N, N};
    double unit[2] = {0.0, 0.0};
    printf(
        "pressure solve, %d^3, ns per cell (x triad); double, and single as preconditioner\n",
        N);
    for (int t = 0; t < 2; t++) {
        omp_set_num_threads(t ? all : 1);
        unit[t] = triad();
        printf("  %d thread%s: triad %.2f ns per 24 bytes, %.1f GB/s\n", t ? all : 1,
               t && all > 1 ? "s" : "", unit[t], 24.0 / unit[t]);
    }
    for (int q = 0; q < 5; q++) {
        double time[2][2];
        for (int t = 0; t < 2; t++) {
            omp_set_num_threads(t ? all : 1);
            for (int single = 0; single < 2; single++)
                time[t][single] = direct(cube, 31 * q, single, ROUNDS);
        }
        printf("  %-8s in x, y, z: 1 thread %5.2f (%.2f) single %5.2f; %d threads %5.2f (%.2f) "
               "single %5.2f; speed-up %.2f\n",
               pair_name[q], time[0][0], time[0][0] / unit[0], time[0][1], all, time[1][0],
               time[1][0] / unit[1], time[1][1], time[0][0] / time[1][0]);
    }
    for (int t = 0; t < 2; t++) {
        enum { PASSES = 3 };
        double time[125][PASSES], every[125], most = 0.0;
        int worst = 0;
        omp_set_num_threads(t ? all : 1);
        for (int pass = 0; pass < PASSES; pass++) /* a busy second strikes no pair alone */
            for (int q = 0; q < 125; q++)
                time[q][pass] = direct(cube, q, false, 3);
        for (int q = 0; q < 125; q++) {
            every[q] = median(time[q], PASSES);
            worst = every[q] > most ? q : worst;
            most = fmax(most, every[q]);
        }
        printf(
            "  all 125 pairs, %d thread%s, %d passes: median %.2f, slowest %.2f (%s, %s, %s)\n",
            t ? all : 1, t && all > 1 ? "s" : "", PASSES, median(every, 125), most,
            pair_name[worst % 5], pair_name[worst / 5 % 5], pair_name[worst / 25]);
    }
}

static void table_of_sizes(void)
{
    static const int sizes[][3] = {{64, 64, 64},   {100, 100, 100}, {127, 127, 64},
                                   {257, 257, 32}, {1, 512, 512},   {512, 1, 512},
                                   {512, 512, 1},  {6, 6, 1000}};
    omp_set_num_threads(1);
    printf("other sizes, walls, 1 thread:");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        printf(" %dx%dx%d %.1f%s", sizes[i][0], sizes[i][1], sizes[i][2],
               direct(sizes[i], 31, false, ROUNDS),
               i + 1 < sizeof sizes / sizeof sizes[0] ? "," : "\n");
}

int main(int argc, char **argv)
{
    const int all = omp_get_max_threads();
    table_of_sides(all);
    if (argc > 1 && strcmp(argv[1], "sides") == 0)
        return 0;
    table_of_sizes();
    printf("variable coefficients, %d^3, to 1e-6\n", N);
    for (int t = 0; t < 2; t++) {
        omp_set_num_threads(t ? all : 1);
        const double unit = triad();
        const int threads = t ? all : 1;
        variable(0, 2.9, "flat bed", threads, unit);
        variable(1, 2.9, "bubbling bed", threads, unit);
        variable(2, 2.9, "spheres", threads, unit);
        variable(2, 100.0, "spheres", threads, unit);
        variable(1, 1e4, "bubbling bed", threads, unit);
    }
    return 0;
}
