/* bench/fluid.c - a Navier-Stokes step, whole and verb by verb, in ns per cell, beside the
 * memory's triad of the same minute. OMP_NUM_THREADS threads; arguments: cells per direction
 * (128), rounds (9), any word to leave out the boxes without grains. Times are medians over the rounds: of the processor on one thread (what
 * else runs on the machine counts less), of the clock on more. Bytes per cell are those that
 * the run has taken from memory. */
/* slots: solver/fluid/navier_stokes drag/ergun porosity/divided */
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include "../solver/fluid_state.h"
#include "../solver/pressure.h"
#include "../solver/projection.h"
#include "../verify/harness.h"

enum { MOST = 99 };

static int n = 128, rounds = 9;
static double bandwidth; /* GB/s, of the triad */

static double now(void)
{
    struct timespec t;
    if (omp_get_max_threads() > 1)
        return wall_clock();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

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
        const double start = now();
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < m; i++)
            a[i] = b[i] + 3.0 * c[i];
        time[r] = now() - start;
    }
    xfree(a);
    xfree(b);
    xfree(c);
    return 24.0 * (double)m / median(time) * 1e-9;
}

/* Bytes in memory: what malloc gives out is up to 2 MB more an array, for huge pages, never touched. */
static double resident(void)
{
    long pages[2] = {0, 0};
    FILE *const file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%ld %ld", &pages[0], &pages[1]) != 2)
        pages[1] = 0;
    if (file)
        fclose(file);
    return (double)pages[1] * (double)sysconf(_SC_PAGESIZE);
}

static void vortex(const struct sim *s)
{
    const struct grid *const g = &s->grid;
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const double x = 6.283 * (i - 1) / n, y = 6.283 * (j - 0.5) / n;
                s->fluid.u[0][cell(g, i, j, k)] = sin(x) * cos(y);
                s->fluid.u[1][cell(g, i, j, k)] = -cos(x + 3.1415 / n) * sin(y - 3.1415 / n);
            }
}

static struct sim *box(int nz, const char *sides, const char *keys, const char *grains,
                       double *bytes)
{
    const double before = resident();
    char *const text =
        xprintf("[domain]\nsize = 1 1 %g m\ncells = %d %d %d\n%s"
                "[fluid]\ndensity = 1 kg/m3\nviscosity = 1e-4 Pa s\ndt = %g s\n%s"
                "[run]\nend = 1e9 s\nforce = on\n%s",
                (double)nz / n, n, n, nz, sides, 0.1 / n, keys, grains);
    struct sim *const s = sim_from(text);
    *bytes = before;
    xfree(text);
    return s;
}

static void report(const char *name, double *time, double cells, double bytes)
{
    printf("  %-48s %7.1f ns/cell", name, 1e9 * median(time) / cells);
    if (bytes > 0.0)
        printf(" %6.0f B/cell", bytes);
    printf("\n");
}

/* A verb that reads and writes so many numbers a cell: its time over that of the triad for as many. */
static void report_verb(const char *name, double *time, int numbers)
{
    const double ns = 1e9 * median(time) / ((double)n * n * n);
    printf("  %-48s %7.1f ns/cell", name, ns);
    if (numbers > 0)
        printf(", %2d numbers: %4.1f x memory", numbers, ns * bandwidth / (8.0 * numbers));
    printf("\n");
}

/* Whole steps of a box without grains. */
static void plain(const char *name, int nz, const char *sides, const char *keys)
{
    double bytes, time[MOST];
    struct sim *const s = box(nz, sides, keys, "", &bytes);
    vortex(s);
    step(s);
    step(s);
    bytes = (resident() - bytes) / ((double)n * n * nz); /* what the first steps ask for too */
    for (int r = 0; r < rounds; r++) {
        const double start = now();
        step(s);
        time[r] = now() - start;
    }
    report(name, time, (double)n * n * nz, bytes);
    sim_free(s);
}

/* The verbs of such a step, one after the other. */
static void verbs(const char *convection, enum convection scheme)
{
    double bytes, time[7][MOST];
    char *const keys = xprintf("convection = %s\n", convection);
    struct sim *const s = box(n, "", keys, "", &bytes);
    struct momentum m = {0};
    enum poisson_side side[6];
    double *old[3], *out[3], *const one = xalloc((size_t)n + 2, sizeof *one);
    double *const dp = grid_field(&s->grid);
    vortex(s);
    for (int a = 0; a < 3; a++) {
        old[a] = grid_field(&s->grid);
        out[a] = grid_field(&s->grid);
    }
    for (int k = 0; k < n + 2; k++)
        one[k] = 1.0;
    fluid_pressure_sides(&s->domain, side);
    struct poisson *const p = poisson_create(&s->grid, side);
    momentum_create(&m, s, scheme, FORM_A, false);
    for (int r = 0; r < rounds; r++) {
        double at[8];
        at[0] = now();
        fluid_velocity_sides(s, 0.0);
        at[1] = now();
        momentum_plain(s, &m, 1.5, -0.5, old, out);
        at[2] = now();
        fluid_divergences(s, 1.0, dp);
        at[3] = now();
        poisson_solve(p, one, one, 0.0, dp, dp);
        at[4] = now();
        grid_ghosts(&s->grid, &s->domain, dp);
        at[5] = now();
        projection_correct(s, NULL, dp);
        at[6] = now();
        fluid_guard(s, false);
        at[7] = now();
        for (int v = 0; v < 7; v++)
            time[v][r] = at[v + 1] - at[v];
    }
    static const char *const name[7] = {"sides and ghosts (three times a step)",
                                        "explicit terms and prediction",
                                        "divergence",
                                        "pressure, direct",
                                        "ghosts of the pressure",
                                        "correction",
                                        "guards: continuity, Courant number"};
    static const int numbers[7] = {0, 13, 4, 6, 0, 9, 3};
    for (int v = 0; v < 7; v++)
        report_verb(name[v], time[v], numbers[v]);
    momentum_free(&m);
    poisson_free(p);
    for (int a = 0; a < 3; a++) {
        xfree(old[a]);
        xfree(out[a]);
    }
    void *const all[] = {one, dp, keys};
    for (size_t i = 0; i < 3; i++)
        xfree(all[i]);
    sim_free(s);
}

/* A box with porosity from 0.35 to 1 and a drag that goes with it, in place of what grains would give. */
static struct sim *porous_box(const char *keys, double *bytes)
{
    struct sim *const s =
        box(n, "x = periodic\ny = periodic\nz+ = outflow\n", keys,
            "[grains g]\ndiameter = 0.001 m\ndensity = 2 kg/m3\nfill = point\n"
            "position = 0.5 0.5 0.5 m\nfrozen = yes\n",
            bytes);
    const struct grid *const g = &s->grid;
    struct fluid *const f = &s->fluid;
    for (int k = 0; k <= n + 1; k++)
        for (int j = 0; j <= n + 1; j++)
            for (int i = 0; i <= n + 1; i++) {
                const double x = 25.13 * (i - 0.5) / n, y = 12.57 * (j - 0.5) / n;
                f->eps[cell(g, i, j, k)] = 0.675 + 0.325 * sin(x) * sin(y) * cos(0.05 * k);
            }
    grid_ghosts(g, &s->domain, f->eps);
    for (size_t c = 0; c < g->total; c++)
        f->eps_old[c] = f->eps[c];
    for (int a = 0; a < 3; a++) {
        for (int c = g->s[a]; c < (int)g->total; c++)
            f->drag[a][c] = 20.0 * (1.0 - grid_face(f->eps, c, g->s[a]));
    }
    vortex(s);
    fluid_step(s);
    fluid_step(s);
    *bytes = (resident() - *bytes) / ((double)n * n * n);
    return s;
}

static void porous(const char *name, const char *keys)
{
    double bytes, time[MOST], iterations = 0.0;
    struct sim *const s = porous_box(keys, &bytes);
    for (int r = 0; r < rounds; r++) {
        const double start = now();
        fluid_step(s);
        time[r] = now() - start;
        iterations += (double)s->fluid.iterations / rounds;
    }
    char *const what = xprintf("%s (%.1f iterations)", name, iterations);
    report(what, time, (double)n * n * n, bytes);
    xfree(what);
    sim_free(s);
}

/* The verbs of such a step, form a, van Leer, one after the other; the solve starts at 0 each time. */
static void porous_verbs(void)
{
    enum { VERBS = 8 };
    double bytes, time[VERBS][MOST], *old[3], *w[3], iterations = 0.0;
    struct sim *const s = porous_box("", &bytes);
    struct momentum m = {0};
    enum poisson_side side[6];
    double *const dp = grid_field(&s->grid), *const rhs = grid_field(&s->grid);
    for (int a = 0; a < 3; a++) {
        old[a] = grid_field(&s->grid);
        w[a] = grid_field(&s->grid);
    }
    fluid_pressure_sides(&s->domain, side);
    struct pressure *const p = pressure_create(&s->grid, &s->domain, side);
    momentum_create(&m, s, CONVECTION_VAN_LEER, FORM_A, false);
    for (int r = 0; r < rounds; r++) {
        double at[VERBS + 1];
        memset(dp, 0, s->grid.total * sizeof *dp);
        at[0] = now();
        momentum_dilatation(s, rhs);
        momentum_porous(s, &m, rhs, w, s->fluid.stress);
        at[1] = now();
        for (int a = 0; a < 3; a++)
            projection_predict(s, a, 1.5, -0.5, w[a], old[a], s->fluid.u[a], NULL);
        at[2] = now();
        for (int a = 0; a < 3; a++)
            projection_coefficient(s, a, w[a]);
        at[3] = now();
        fluid_divergences(s, 1.0, rhs);
        at[4] = now();
        iterations += (double)pressure_solve(p, w, 0.0, rhs, dp, 1e-6, 0.0).iterations / rounds;
        at[5] = now();
        projection_correct(s, w, dp);
        at[6] = now();
        projection_stress(s, dp);
        at[7] = now();
        fluid_guard(s, false);
        at[8] = now();
        for (int v = 0; v < VERBS; v++)
            time[v][r] = at[v + 1] - at[v];
    }
    static const char *const name[VERBS] = {
        "dilatation, explicit terms",     "prediction",
        "coefficients of the pressure",   "divergence",
        "pressure to 1e-6, from 0",       "correction",
        "stress on the grains, pressure", "guards: continuity, Courant number"};
    static const int numbers[VERBS] = {18, 26, 8, 9, 0, 11, 12, 8};
    for (int v = 0; v < VERBS; v++)
        report_verb(name[v], time[v], numbers[v]);
    printf("  (%.1f iterations, %.1f ns each)\n", iterations,
           1e9 * median(time[4]) / ((double)n * n * n * iterations));
    momentum_free(&m);
    pressure_free(p);
    for (int a = 0; a < 3; a++) {
        xfree(old[a]);
        xfree(w[a]);
    }
    xfree(dp);
    xfree(rhs);
    sim_free(s);
}

static void without_grains(void)
{
    static const char *const periodic = "x = periodic\ny = periodic\nz = periodic\n";
    plain("periodic, centred", n, periodic, "convection = centred\n");
    plain("periodic, van Leer", n, periodic, "");
    plain("walls, centred", n, "", "convection = centred\n");
    plain("walls, van Leer", n, "", "");
    plain("x periodic, y walls, z open, van Leer", n, "x = periodic\nz+ = outflow\n", "");
    plain("walls, van Leer, implicit viscosity", n, "", "viscous = implicit\n");
    plain("one cell thick, walls, van Leer", 1, "z = periodic\n", "");
    printf(" verb by verb, walls, centred\n");
    verbs("centred", CONVECTION_CENTRED);
    printf(" verb by verb, walls, van Leer\n");
    verbs("van_leer", CONVECTION_VAN_LEER);
}

int main(int argc, char **argv)
{
    n = argc > 1 ? atoi(argv[1]) : n;
    rounds = argc > 2 ? atoi(argv[2]) : rounds;
    if (n < 4 || rounds < 1 || rounds > MOST)
        die(EXIT_SCENE, "usage: fluid [CELLS] [ROUNDS] [porous]");
    bandwidth = triad();
    printf("threads %d: triad %.1f GB/s; a Navier-Stokes step at %d^3, pressure included\n",
           omp_get_max_threads(), bandwidth, n);
    if (argc < 4)
        without_grains();
    printf(" porosity from 0.35 to 1, without sensing grains\n");
    porous("form a, centred, tolerance 1e-6", "convection = centred\ntolerance = 1e-6\n");
    porous("form a, centred, tolerance 0.1", "convection = centred\ntolerance = 0.1\n");
    porous("form a, van Leer, tolerance 1e-6", "tolerance = 1e-6\n");
    porous("form b, van Leer, tolerance 1e-6", "form = b\ntolerance = 1e-6\n");
    porous("form a, van Leer, implicit viscosity, 1e-6",
           "viscous = implicit\ntolerance = 1e-6\n");
    printf(" verb by verb, form a, van Leer\n");
    porous_verbs();
    return 0;
}
