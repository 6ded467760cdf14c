/* bench/fluid.c - a Navier-Stokes step, verb by verb, in ns per cell, beside the memory's triad
 * of the same minute. OMP_NUM_THREADS threads; arguments: cells per direction (128), rounds (9).
 * Times are medians over the rounds; bytes per cell are those of the fields that exist. */
/* slots: solver/fluid/navier_stokes drag/ergun porosity/divided */
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <malloc.h>
#include "../verify/harness.h"

enum { MOST = 99 };

static int n = 128, rounds = 9;

static double median(double *x)
{
    for (int i = 0; i < rounds; i++)
        for (int j = i; j > 0 && x[j] < x[j - 1]; j--) {
            const double t = x[j];
            x[j] = x[j - 1];
            x[j - 1] = t;
        }
    return x[rounds / 2];
}

/* GB/s as the program counts them: two read, one written. */
static double triad(void)
{
    const size_t m = (size_t)1 << 24;
    double *const a = xalloc(m, sizeof *a), *const b = xalloc(m, sizeof *b);
    double *const c = xalloc(m, sizeof *c), time[MOST];
    for (int r = 0; r < rounds; r++) {
        const double start = wall_clock();
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < m; i++)
            a[i] = b[i] + 3.0 * c[i];
        time[r] = wall_clock() - start;
    }
    xfree(a);
    xfree(b);
    xfree(c);
    return 24.0 * (double)m / median(time) * 1e-9;
}

/* Bytes that the heap has given out. */
static double heap(void)
{
    const struct mallinfo2 m = mallinfo2();
    return (double)m.uordblks + (double)m.hblkhd;
}

/* A whole step of a box without grains; the flow is a vortex, so that nothing is trivial. */
static void plain(const char *name, const char *sides, const char *keys)
{
    const double before = heap();
    char *const text =
        xprintf("[domain]\nsize = 1 1 1 m\ncells = %d %d %d\n%s"
                "[fluid]\ndensity = 1 kg/m3\nviscosity = 1e-4 Pa s\ndt = %g s\n%s"
                "[run]\nend = 1e9 s\n",
                n, n, n, sides, 0.1 / n, keys);
    struct sim *const s = sim_from(text);
    const double bytes = (heap() - before) / ((double)n * n * n);
    const struct grid *const g = &s->grid;
    for (int k = 1; k <= n; k++)
        for (int j = 1; j <= n; j++)
            for (int i = 1; i <= n; i++) {
                const double x = 6.283 * (i - 1) / n, y = 6.283 * (j - 0.5) / n;
                s->fluid.u[0][cell(g, i, j, k)] = sin(x) * cos(y);
                s->fluid.u[1][cell(g, i, j, k)] = -cos(x + 3.1415 / n) * sin(y - 3.1415 / n);
            }
    double time[MOST];
    step(s);
    step(s);
    for (int r = 0; r < rounds; r++) {
        const double start = wall_clock();
        step(s);
        time[r] = wall_clock() - start;
    }
    printf("  %-44s %7.1f ns/cell %6.0f B/cell\n", name,
           1e9 * median(time) / ((double)n * n * n), bytes);
    sim_free(s);
    xfree(text);
}

int main(int argc, char **argv)
{
    n = argc > 1 ? atoi(argv[1]) : n;
    rounds = argc > 2 ? atoi(argv[2]) : rounds;
    if (n < 4 || rounds < 1 || rounds > MOST)
        die(EXIT_SCENE, "usage: fluid [CELLS] [ROUNDS]");
    printf("threads %d: triad %.1f GB/s; a Navier-Stokes step at %d^3, pressure included\n",
           omp_get_max_threads(), triad(), n);
    static const char *const periodic = "x = periodic\ny = periodic\nz = periodic\n";
    static const char *const through = "x = periodic\nz- = wall\nz+ = outflow\n";
    plain("all periodic, centred", periodic, "convection = centred\n");
    plain("all periodic, van Leer", periodic, "convection = van_leer\n");
    plain("walls, centred", "", "convection = centred\n");
    plain("walls, van Leer", "", "convection = van_leer\n");
    plain("x periodic, y walls, z open, van Leer", through, "");
    plain("walls, van Leer, implicit viscosity", "", "viscous = implicit\n");
    return 0;
}
