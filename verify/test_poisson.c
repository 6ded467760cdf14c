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

int main(void)
{
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
