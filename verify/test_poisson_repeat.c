/* verify/test_poisson_repeat.c - a direct solve owes nothing to the solves before it: of nothing it makes
 * nothing, exactly, after many solves of something, for rows that do not fill the lanes. */
#include <gsl/gsl_rng.h>
#include "../solver/poisson.h"
#include "check.h"

static void test_size(const int cells[3], bool periodic)
{
    struct domain d = {.size = {0.015, 0.15, 0.45}};
    enum poisson_side side[6];
    struct grid g;
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int a = 0; a < 3; a++)
        d.cells[a] = cells[a];
    for (int i = 0; i < 6; i++)
        side[i] = periodic && i < 4 ? POISSON_PERIODIC : POISSON_NEUMANN;
    side[5] = POISSON_DIRICHLET;
    grid_create(&g, &d);
    struct poisson *const p = poisson_create(&g, side);
    double *const x = grid_field(&g), *const c = xalloc((size_t)cells[2] + 2, sizeof *c);
    for (int k = 0; k < cells[2] + 2; k++)
        c[k] = 5e-5 * (1.0 + gsl_rng_uniform(rng));
    for (int t = 0; t < 8; t++) {
        for (size_t i = 0; i < g.total; i++)
            x[i] = t < 4 ? gsl_rng_uniform(rng) - 0.5 : 0.0;
        poisson_solve(p, c, c, 0.0, x, x);
    }
    check(max_abs(x, g.total) == 0.0, "%d x %d x %d: nothing of nothing, %.1e", cells[0],
          cells[1], cells[2], max_abs(x, g.total));
    poisson_free(p);
    xfree(x);
    xfree(c);
    gsl_rng_free(rng);
}

int main(void)
{
    static const int sizes[][3] = {{2, 30, 90}, {3, 30, 20}, {8, 16, 20}, {17, 30, 20},
                                   {30, 2, 20}, {1, 30, 20}, {6, 6, 30}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int periodic = 0; periodic < 2; periodic++)
            test_size(sizes[i], periodic);
    return check_end();
}
