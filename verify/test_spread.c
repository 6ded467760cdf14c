/* verify/test_spread.c - sums from grains to cells, and the diffusion of fields.
 *
 * Sums: against a plain loop over the grains, bit for bit, on 1 to 16 threads. Diffusion: it must do to
 * each mode of the transforms what exp(t L) does; symmetric; the sum of a field kept; positive; the
 * same bits on any number of threads; for sides of every kind, widths below a cell to wider than the
 * box. */
#include <gsl/gsl_rng.h>
#include <omp.h>
#include <string.h>
#include "../solver/diffuse.h"
#include "../solver/spread.h"
#include "check.h"

enum { N = 5000, REACH = 8 };
static const int team[] = {1, 2, 3, 7, 16};

static double uniform(gsl_rng *rng, double a, double b)
{
    return a + (b - a) * gsl_rng_uniform(rng);
}

static void test_sums(gsl_rng *rng)
{
    const struct domain d = {
        .size = {1.0, 2.0, 3.0}, .cells = {9, 23, 31}, .periodic = {true, false, true}};
    struct grid g;
    grid_create(&g, &d);
    struct share *const shares = xalloc((size_t)N * REACH, sizeof *shares);
    int *const n_shares = xalloc(N, sizeof *n_shares);
    double *const value = xalloc(N, sizeof *value);
    double *const values = xalloc((size_t)N * SPREAD_STRIDE, sizeof *values);
    double *const factor = xalloc((size_t)N * REACH, sizeof *factor);
    double *want[6], *got[6], *one = grid_field(&g), *one_want = grid_field(&g);
    for (int c = 0; c < 6; c++) {
        want[c] = grid_field(&g);
        got[c] = grid_field(&g);
    }
    for (int i = 0; i < N; i++) {
        const vec3 x =
            v3(uniform(rng, -0.1, 1.1), uniform(rng, -0.1, 2.1), uniform(rng, -0.1, 3.1));
        n_shares[i] = shares_trilinear(&g, &d, x, &shares[(size_t)i * REACH]);
        value[i] = uniform(rng, 0.1, 1.0);
        for (int c = 0; c < 6; c++)
            values[i * SPREAD_STRIDE + c] = uniform(rng, -1.0, 1.0);
        for (int k = 0; k < n_shares[i]; k++) {
            const size_t at = (size_t)i * REACH + k;
            factor[at] = shares[at].weight * uniform(rng, 0.5, 2.0);
            one_want[shares[at].cell] += shares[at].weight * value[i];
            for (int c = 0; c < 6; c++)
                want[c][shares[at].cell] += factor[at] * values[i * SPREAD_STRIDE + c];
        }
    }
    struct spread sp;
    spread_create(&sp, &g);
    for (int t = 0; t < 5; t++) {
        bool same = true;
        omp_set_num_threads(team[t]);
        spread_prepare(&sp, N, REACH, n_shares, shares);
        spread_one(&sp, value, one);
        spread_columns(&sp, factor, values, 6, got);
        same = memcmp(one, one_want, g.total * sizeof(double)) == 0;
        for (int c = 0; c < 6; c++)
            same = same && memcmp(got[c], want[c], g.total * sizeof(double)) == 0;
        check(same, "sums of %d grains on %d threads: the bits of a plain loop", N, team[t]);
    }
    spread_free(&sp);
    void *const all[] = {shares, n_shares, value, values, factor, one, one_want};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    for (int c = 0; c < 6; c++) {
        xfree(want[c]);
        xfree(got[c]);
    }
}

static double sum_interior(const struct grid *g, const double *x, const double *y)
{
    double sum = 0.0;
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++)
                sum += x[cell(g, i, j, k)] * (y ? y[cell(g, i, j, k)] : 1.0);
    return sum;
}

/* The modes of the transforms: cosines of half-integer steps, or Fourier's along periodic lines. */
static double mode(const struct domain *d, int a, int m, int i)
{
    const double x = (i - 0.5) / d->cells[a];
    return d->periodic[a] ? cos(2.0 * PI * m * x + 0.3) : cos(PI * m * x);
}

static double eigenvalue(const struct grid *g, const struct domain *d, int a, int m)
{
    const double x = (d->periodic[a] ? 2.0 : 1.0) * PI * m / g->n[a];
    const double s = 2.0 * sin(0.5 * x) / g->h[a];
    return s * s;
}

static void test_diffusion(gsl_rng *rng, const struct domain *d, double width)
{
    struct grid g;
    grid_create(&g, d);
    struct diffuse *const f = diffuse_create(&g, d, width);
    double *const x = grid_field(&g), *const y = grid_field(&g), *const z = grid_field(&g);
    double worst = 0.0, asymmetry = 0.0, least = 1.0;
    for (int trial = 0; trial < 6; trial++) {
        int m[3];
        double rate = 0.0;
        for (int a = 0; a < 3; a++) {
            m[a] =
                (int)gsl_rng_uniform_int(rng, (unsigned long)(1 + d->cells[a] / (1 + trial)));
            rate += eigenvalue(&g, d, a, m[a]);
        }
        const double factor = exp(-0.5 * width * width * rate);
        for (int k = 1; k <= g.n[2]; k++)
            for (int j = 1; j <= g.n[1]; j++)
                for (int i = 1; i <= g.n[0]; i++)
                    x[cell(&g, i, j, k)] = y[cell(&g, i, j, k)] =
                        mode(d, 0, m[0], i) * mode(d, 1, m[1], j) * mode(d, 2, m[2], k);
        diffuse_apply(f, x);
        for (int k = 1; k <= g.n[2]; k++)
            for (int j = 1; j <= g.n[1]; j++)
                for (int i = 1; i <= g.n[0]; i++)
                    worst =
                        fmax(worst, fabs(x[cell(&g, i, j, k)] - factor * y[cell(&g, i, j, k)]));
    }
    check(worst < 2e-12, "%dx%dx%d, width %g cells: modes decay as exp(t L), error %.1e",
          g.n[0], g.n[1], g.n[2], width / g.h[0], worst);
    for (size_t c = 0; c < g.total; c++) {
        x[c] = uniform(rng, 0.0, 1.0);
        y[c] = gsl_rng_uniform(rng) < 0.02 ? 1.0 : 0.0;
    }
    memcpy(z, x, g.total * sizeof *z);
    const double mass = sum_interior(&g, x, NULL);
    diffuse_apply(f, x);
    asymmetry = sum_interior(&g, x, y);
    check_rel(sum_interior(&g, x, NULL), mass, 1e-13, "  the sum of a field is kept");
    diffuse_apply(f, y);
    check_rel(sum_interior(&g, z, y), asymmetry, 1e-13, "  symmetric");
    for (int k = 1; k <= g.n[2]; k++)
        for (int j = 1; j <= g.n[1]; j++)
            for (int i = 1; i <= g.n[0]; i++)
                least = fmin(least, y[cell(&g, i, j, k)]);
    check(least >= -1e-15, "  positive stays positive to round-off: %.1e", least);
    for (int t = 0; t < 5; t++) {
        omp_set_num_threads(team[t]);
        memcpy(y, z, g.total * sizeof *y);
        diffuse_apply(f, y);
        if (t > 0)
            check(sum_interior(&g, y, y) == sum_interior(&g, x, x) &&
                      sum_interior(&g, y, x) == sum_interior(&g, x, x),
                  "  the same bits on %d threads", team[t]);
        else
            memcpy(x, y, g.total * sizeof *x);
    }
    xfree(x);
    xfree(y);
    xfree(z);
    diffuse_free(f);
}

int main(void)
{
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    static const struct domain boxes[] = {
        {.size = {1.3, 1.7, 3.1}, .cells = {11, 37, 21}},
        {.size = {1.3, 1.7, 3.1}, .cells = {37, 11, 21}, .periodic = {true, true, true}},
        {.size = {1.3, 1.7, 3.1}, .cells = {12, 1, 40}, .periodic = {false, true, true}},
        {.size = {1.3, 1.7, 3.1}, .cells = {70, 3, 5}, .periodic = {true, false, false}},
    };
    test_sums(rng);
    for (int b = 0; b < 4; b++)
        for (int w = 0; w < 3; w++)
            test_diffusion(rng, &boxes[b], (double[]){0.03, 0.2, 1.9}[w]);
    gsl_rng_free(rng);
    return check_end();
}
