/* verify/test_poisson.c - the direct solve and the conjugate gradients: every pair of sides in
 * every direction, layered and random coefficients, one-cell directions, bits on 1 to 7
 * threads.
 */
#include <omp.h>
#include <string.h>
#include "check.h"
#include "../solver/pressure.h"

static unsigned long lcg = 12345;
static double noise(void)
{
    lcg = lcg * 6364136223846793005ul + 1442695040888963407ul;
    return (double)(lcg >> 11) / 9007199254740992.0 - 0.5;
}

static void fill_noise(const struct grid *g, double *f)
{
    double mean = 0.0;
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++)
                mean += f[cell(g, i, j, k)] = noise();
    mean /= (double)g->n[0] * g->n[1] * g->n[2];
    for (int k = 1; k <= g->n[2]; k++) /* so that closed boxes have a solution */
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++)
                f[cell(g, i, j, k)] -= mean;
}

static struct domain box(const int n[3], const enum poisson_side side[6])
{
    struct domain d = {.size = {1.3, 0.7, 2.1}};
    for (int a = 0; a < 3; a++) {
        d.cells[a] = n[a];
        d.periodic[a] = side[2 * a] == POISSON_PERIODIC;
    }
    return d;
}

/* Largest |div(c grad phi) - shift phi - rhs| over the largest |rhs|, from scratch. */
static double residual(const struct grid *g, const struct pressure *p, double *const c[3],
                       double shift, double *phi, const double *rhs)
{
    double worst = 0.0, size = 0.0;
    pressure_ghosts(p, phi);
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int m = cell(g, i, j, k);
                double sum = -shift * phi[m] - rhs[m];
                for (int a = 0; a < 3; a++) {
                    const int s = g->s[a];
                    sum += (c[a][m + s] * (phi[m + s] - phi[m]) -
                            c[a][m] * (phi[m] - phi[m - s])) /
                           (g->h[a] * g->h[a]);
                }
                worst = fmax(worst, fabs(sum));
                size = fmax(size, fabs(rhs[m]));
            }
    return worst / size;
}

/* Direct solve with c = c(z), all 5 x 5 x 5 pairs of sides. */
static void check_direct(const int n[3], double shift)
{
    static const enum poisson_side pair[5][2] = {{POISSON_PERIODIC, POISSON_PERIODIC},
                                                 {POISSON_NEUMANN, POISSON_NEUMANN},
                                                 {POISSON_DIRICHLET, POISSON_DIRICHLET},
                                                 {POISSON_NEUMANN, POISSON_DIRICHLET},
                                                 {POISSON_DIRICHLET, POISSON_NEUMANN}};
    double worst = 0.0;
    for (int q = 0; q < 125; q++) {
        const enum poisson_side *const x = pair[q % 5], *const y = pair[q / 5 % 5],
                                       *const z = pair[q / 25];
        const enum poisson_side side[6] = {x[0], x[1], y[0], y[1], z[0], z[1]};
        const struct domain d = box(n, side);
        struct grid g;
        grid_create(&g, &d);
        struct pressure *const p = pressure_create(&g, &d, side);
        struct poisson *const direct = poisson_create(&g, side);
        double *const rhs = grid_field(&g), *const phi = grid_field(&g);
        double *const c[3] = {grid_field(&g), grid_field(&g), grid_field(&g)};
        double flat[64] = {0}, up[64] = {0};
        for (int k = 1; k <= n[2] + 1; k++) {
            flat[k] = 1.0 + 0.5 * sin(0.7 * k);
            up[k] = z[0] == POISSON_PERIODIC && k == n[2] + 1 ? up[1] : 1.5 + cos(1.3 * k);
        }
        for (int k = 1; k <= n[2] + 1; k++)
            for (int m = g.sk * k; m < g.sk * (k + 1); m++) {
                c[0][m] = c[1][m] = flat[k];
                c[2][m] = up[k];
            }
        fill_noise(&g, rhs);
        poisson_solve(direct, flat, up, shift, rhs, phi);
        worst = fmax(worst, residual(&g, p, c, shift, phi, rhs));
        for (int a = 0; a < 3; a++)
            xfree(c[a]);
        xfree(rhs);
        xfree(phi);
        poisson_free(direct);
        pressure_free(p);
    }
    check(worst < 1e-10,
          "direct solve, %d x %d x %d, shift %g, 125 pairs of sides: residual %.2g", n[0], n[1],
          n[2], shift, worst);
}

/* Conjugate gradients on one case; the solution's bits. */
static unsigned long conjugate(double contrast, bool layered, double *worst, int *iterations)
{
    const int n[3] = {17, 12, 20};
    const enum poisson_side side[6] = {POISSON_PERIODIC, POISSON_PERIODIC,  POISSON_NEUMANN,
                                       POISSON_NEUMANN,  POISSON_DIRICHLET, POISSON_NEUMANN};
    const struct domain d = box(n, side);
    struct grid g;
    grid_create(&g, &d);
    struct pressure *const p = pressure_create(&g, &d, side);
    double *const rhs = grid_field(&g), *const phi = grid_field(&g);
    double *const c[3] = {grid_field(&g), grid_field(&g), grid_field(&g)};
    lcg = 777;
    for (int a = 0; a < 3; a++)
        for (size_t m = 0; m < g.total; m++) {
            const double t = layered ? (m / (size_t)g.sk < 9 ? 0.0 : 1.0) : noise() + 0.5;
            c[a][m] = pow(contrast, t);
        }
    for (int k = 1; k <= n[2]; k++) /* the periodic faces are one */
        for (int j = 1; j <= n[1]; j++)
            c[0][cell(&g, n[0] + 1, j, k)] = c[0][cell(&g, 1, j, k)];
    fill_noise(&g, rhs);
    const struct solve r = pressure_solve(p, c, 0.0, rhs, phi, 1e-11, 0.0);
    *worst = residual(&g, p, c, 0.0, phi, rhs);
    *iterations = r.converged ? r.iterations : -1;
    unsigned long h = 14695981039346656037ul;
    for (size_t b = 0; b < g.total * sizeof(double); b++)
        h = (h ^ ((const unsigned char *)phi)[b]) * 1099511628211ul;
    for (int a = 0; a < 3; a++)
        xfree(c[a]);
    xfree(rhs);
    xfree(phi);
    pressure_free(p);
    return h;
}

static const enum poisson_side of_sides[5][2] = {{POISSON_PERIODIC, POISSON_PERIODIC},
                                                 {POISSON_NEUMANN, POISSON_NEUMANN},
                                                 {POISSON_DIRICHLET, POISSON_DIRICHLET},
                                                 {POISSON_NEUMANN, POISSON_DIRICHLET},
                                                 {POISSON_DIRICHLET, POISSON_NEUMANN}};

/* A field of a kind and a contrast on a grid, solved by a method. */
struct problem {
    struct domain d;
    struct grid g;
    enum poisson_side side[6];
    double *rhs, *phi, *c[3];
};

enum kind { NOISE, SPHERES, BED, BUBBLING, SMOOTH };

/* 0..1 */
static double level(enum kind kind, const double x[3], double sphere[][3])
{
    bool inside = false;
    for (int s = 0; s < 30; s++) {
        double distance = 0.0;
        for (int a = 0; a < 3; a++)
            distance += (x[a] - sphere[s][a]) * (x[a] - sphere[s][a]);
        inside = inside || distance < 0.15 * 0.15;
    }
    switch (kind) {
    case NOISE:
        return noise() + 0.5;
    case SPHERES:
        return inside ? 0.0 : 1.0;
    case BED:
        return x[2] < 0.47 ? 0.0 : 1.0;
    case BUBBLING:
        return inside || x[2] > 0.61 ? 1.0 : 0.0;
    default:
        return 0.5 + 0.25 * sin(5.1 * x[0] + 1.0) * cos(7.3 * x[1]) + 0.25 * sin(6.2 * x[2]);
    }
}

static struct problem problem(const int n[3], int sides, enum kind kind, double contrast)
{
    struct problem q;
    double sphere[30][3];
    lcg = 4711;
    for (int s = 0; s < 30; s++)
        for (int a = 0; a < 3; a++)
            sphere[s][a] = noise() + 0.5;
    for (int a = 0, s = sides; a < 3; a++, s /= 5) {
        q.side[2 * a] = of_sides[s % 5][0];
        q.side[2 * a + 1] = of_sides[s % 5][1];
    }
    q.d = box(n, q.side);
    grid_create(&q.g, &q.d);
    double *const e = grid_field(&q.g);
    q.rhs = grid_field(&q.g);
    q.phi = grid_field(&q.g);
    for (int k = 1; k <= n[2]; k++)
        for (int j = 1; j <= n[1]; j++)
            for (int i = 1; i <= n[0]; i++) {
                const double x[3] = {(i - 0.5) / n[0], (j - 0.5) / n[1], (k - 0.5) / n[2]};
                e[cell(&q.g, i, j, k)] = pow(contrast, level(kind, x, sphere));
            }
    grid_ghosts(&q.g, &q.d, e);
    for (int a = 0; a < 3; a++) {
        q.c[a] = grid_field(&q.g);
        for (size_t m = (size_t)q.g.s[a]; m < q.g.total; m++) {
            const double lo = e[m - (size_t)q.g.s[a]], hi = e[m];
            q.c[a][m] = lo > 0.0 && hi > 0.0 ? 2.0 * lo * hi / (lo + hi) : 0.0;
        }
    }
    fill_noise(&q.g, q.rhs);
    xfree(e);
    return q;
}

static void problem_free(struct problem *q)
{
    for (int a = 0; a < 3; a++)
        xfree(q->c[a]);
    xfree(q->rhs);
    xfree(q->phi);
}

/* Converges within `most` iterations, and the residual is what it says, from scratch. */
static void check_field(const int n[3], int sides, enum kind kind, double contrast,
                        enum pressure_method method, double tolerance, int most)
{
    static const char *const kinds[] = {"noise", "spheres", "flat bed", "bubbling bed",
                                        "smooth"};
    static const char *const methods[] = {"auto", "box", "layers", "multigrid"};
    struct problem q = problem(n, sides, kind, contrast);
    struct pressure *const p = pressure_create(&q.g, &q.d, q.side);
    pressure_method(p, method);
    const struct solve r = pressure_solve(p, q.c, 0.0, q.rhs, q.phi, tolerance, 0.0);
    const double left = residual(&q.g, p, q.c, 0.0, q.phi, q.rhs);
    check(r.converged && r.iterations <= most && left < 30.0 * tolerance,
          "%s, contrast %g, %d x %d x %d: %s in %d iterations (%s), residual %.2g", kinds[kind],
          contrast, n[0], n[1], n[2], r.converged ? "solved" : "NOT solved", r.iterations,
          methods[r.method], left);
    pressure_free(p);
    problem_free(&q);
}

/* Every pair of sides, with coefficients that vary: what a projection leaves, against 1e-10. */
static void check_every_side(enum pressure_method method, const char *name)
{
    const int n[3] = {6, 5, 7};
    double worst = 0.0;
    int most = 0;
    bool all = true;
    for (int sides = 0; sides < 125; sides++) {
        struct problem q = problem(n, sides, NOISE, 3.0);
        struct pressure *const p = pressure_create(&q.g, &q.d, q.side);
        pressure_method(p, method);
        const struct solve r = pressure_solve(p, q.c, 0.0, q.rhs, q.phi, 1e-12, 0.0);
        all = all && r.converged;
        most = r.iterations > most ? r.iterations : most;
        worst = fmax(worst, residual(&q.g, p, q.c, 0.0, q.phi, q.rhs));
        pressure_free(p);
        problem_free(&q);
    }
    check(all && worst < 1e-10,
          "contrast 3, 125 pairs of sides, %s: residual %.2g, at most %d "
          "iterations",
          name, worst, most);
}

static unsigned long bits_of(int threads, enum pressure_method method, double contrast)
{
    const int n[3] = {31, 22, 27};
    omp_set_num_threads(threads);
    struct problem q = problem(n, 3 * 25 + 5, BUBBLING, contrast);
    struct pressure *const p = pressure_create(&q.g, &q.d, q.side);
    pressure_method(p, method);
    pressure_solve(p, q.c, 0.0, q.rhs, q.phi, 1e-9, 0.0);
    unsigned long h = 14695981039346656037ul;
    for (size_t b = 0; b < q.g.total * sizeof(double); b++)
        h = (h ^ ((const unsigned char *)q.phi)[b]) * 1099511628211ul;
    pressure_free(p);
    problem_free(&q);
    return h;
}

static void check_threads(void)
{
    static const char *const names[] = {"", "box", "layers", "multigrid"};
    for (int method = PRESSURE_BOX; method <= PRESSURE_MULTIGRID; method++)
        for (int fine = 0; fine < 2; fine++) { /* single, then double precision inside */
            const double contrast = fine ? 2e3 : 20.0;
            const unsigned long one = bits_of(1, (enum pressure_method)method, contrast);
            bool same = true;
            for (int threads = 2; threads <= 7; threads = threads == 3 ? 7 : threads + 1)
                same = same && bits_of(threads, (enum pressure_method)method, contrast) == one;
            check(same, "%s, contrast %g: the same bits on 1, 2, 3, 7 threads", names[method],
                  contrast);
        }
}

static void check_fields(void)
{
    const int n[3] = {32, 32, 32}, odd[3] = {23, 17, 29}, flat[3] = {48, 1, 37};
    const int closed = 31, open = 3 * 25; /* walls all round; periodic, open above */
    check_field(n, open, SMOOTH, 3.0, PRESSURE_AUTO, 1e-6, 11);
    check_field(n, open, SPHERES, 3.0, PRESSURE_AUTO, 1e-6, 12);
    check_field(n, open, BUBBLING, 3.0, PRESSURE_AUTO, 1e-6, 12);
    check_field(n, open, BED, 3.0, PRESSURE_LAYERS, 1e-6, 4);
    check_field(n, open, BED, 1e6, PRESSURE_LAYERS, 1e-6, 4);
    check_field(n, closed, SPHERES, 100.0, PRESSURE_AUTO, 1e-6, 25);
    check_field(n, closed, BUBBLING, 1e3, PRESSURE_AUTO, 1e-6, 80);
    check_field(n, closed, NOISE, 1e6, PRESSURE_AUTO, 1e-6, 120);
    check_field(n, closed, SPHERES, 1e6, PRESSURE_AUTO, 1e-6, 150);
    check_field(n, closed, BUBBLING, 1e6, PRESSURE_AUTO, 1e-6, 200);
    check_field(n, 0, SMOOTH, 1e6, PRESSURE_AUTO, 1e-6, 40);
    check_field(odd, closed, NOISE, 100.0, PRESSURE_MULTIGRID, 1e-11, 25);
    check_field(odd, 0, SPHERES, 100.0, PRESSURE_MULTIGRID, 1e-11, 60);
    check_field(odd, 86, NOISE, 1e6, PRESSURE_MULTIGRID, 1e-6, 120);
    check_field(flat, closed, NOISE, 1e3, PRESSURE_MULTIGRID, 1e-8, 40);
    check_field(flat, open, BUBBLING, 3.0, PRESSURE_AUTO, 1e-12, 25);
}

int main(void)
{
    omp_set_num_threads(2);
    check_direct((const int[3]){7, 6, 9}, 0.0);
    check_direct((const int[3]){8, 5, 4}, 3.7);
    check_direct((const int[3]){1, 11, 6}, 0.0);
    check_direct((const int[3]){9, 1, 2}, 0.0);
    check_direct((const int[3]){4, 6, 1}, 0.0);
    check_direct((const int[3]){1, 1, 7}, 0.0);
    check_direct((const int[3]){1, 10, 1}, 0.3);
    check_direct((const int[3]){29, 1, 5}, 0.0);
    check_direct((const int[3]){19, 15, 3}, 0.0); /* primes, odd between unlike sides */
    check_direct((const int[3]){16, 20, 4}, 0.0); /* radices 4, 2, 5 */
    check_direct((const int[3]){257, 1, 2}, 0.0); /* FFTW's */
    double worst;
    int iterations;
    const double contrasts[] = {3.0, 100.0};
    for (int i = 0; i < 2; i++) {
        conjugate(contrasts[i], false, &worst, &iterations);
        check(iterations > 0 && worst < 1e-9,
              "random c, contrast %g: residual %.2g in %d iterations", contrasts[i], worst,
              iterations);
    }
    conjugate(1e6, true, &worst, &iterations);
    check(iterations > 0 && iterations < 30 && worst < 1e-6,
          "two layers, contrast 1e6: residual %.2g in %d iterations", worst, iterations);
    check_every_side(PRESSURE_BOX, "box");
    check_every_side(PRESSURE_LAYERS, "layers");
    check_every_side(PRESSURE_MULTIGRID, "multigrid");
    check_fields();
    check_threads();
    omp_set_num_threads(1);
    const unsigned long one = conjugate(10.0, false, &worst, &iterations);
    const int threads[] = {2, 3, 7, 16};
    for (int i = 0; i < 4; i++) {
        omp_set_num_threads(threads[i]);
        check(conjugate(10.0, false, &worst, &iterations) == one,
              "the same bits on 1 and %d threads", threads[i]);
    }
    return check_end();
}
