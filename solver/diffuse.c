/* diffuse.c - Gaussian diffusion of a field of cells, see diffuse.h.
 *
 * The transforms of the pressure solve (cosines between walls, Fourier modes along periodic
 * directions; table in poisson.c) diagonalise L, and so exp(t L), t = w^2/2, multiplies the mode of
 * eigenvalue -lambda by exp(-t lambda): diffusion in the transform's own basis. In space that is a
 * product of one convolution per direction, whose weights on an endless line of cells are known,
 *   k_n = exp(-2 s) I_n(2 s),  s = t/h^2,   I_n modified Bessel functions  [AbramowitzStegun64, 9.6.34]
 * and whose ends are images: mirrored at a wall, wrapped along a periodic direction. Below about ten
 * cells of width the convolutions cost less than two transforms; and they are positive, which a
 * transform is only to round-off. Weights below 1e-13 of the sum are left out, and the sum of the
 * others is made 1. */
#include "diffuse.h"

#include <gsl/gsl_sf_bessel.h>
#include <string.h>

enum { LANES = 32 }; /* columns convolved at a time: four vectors of eight */

struct diffuse {
    const struct grid *g;
    bool periodic[3];
    int band[3];       /* weights on each side */
    double *weight[3]; /* band + 1 */
    int *image[3];     /* n + 2 band: interior index of each entry of a padded line */
};

/* The weights of one direction; returns the band. */
static int weights(double s, int n, double **out)
{
    const int most = (int)ceil(8.0 * sqrt(2.0 * s)) + 20;
    double *const k = xalloc((size_t)most + 1, sizeof *k);
    double sum = 0.0;
    int band = 0;
    if (n > 1 && gsl_sf_bessel_In_scaled_array(0, most, 2.0 * s, k) != 0)
        die(EXIT_SCENE, "the Gaussian of the porosity is too wide: %g cells", sqrt(2.0 * s));
    if (n == 1)
        k[0] = 1.0;
    while (band < most && k[band + 1] > 1e-13)
        band++;
    for (int m = band; m > 0; m--)
        sum += 2.0 * k[m];
    sum += k[0];
    for (int m = 0; m <= band; m++)
        k[m] /= sum;
    *out = k;
    return band;
}

struct diffuse *diffuse_create(const struct grid *g, const struct domain *d, double width)
{
    struct diffuse *const f = xalloc(1, sizeof *f);
    f->g = g;
    for (int a = 0; a < 3; a++) {
        const int n = g->n[a], period = d->periodic[a] ? n : 2 * n;
        const double s = 0.5 * width * width / (g->h[a] * g->h[a]);
        f->band[a] = weights(s, n, &f->weight[a]);
        f->image[a] = xalloc((size_t)n + 2 * (size_t)f->band[a], sizeof(int));
        for (int i = 0; i < n + 2 * f->band[a]; i++) {
            const int rest = (i - f->band[a]) % period, m = rest < 0 ? rest + period : rest;
            f->image[a][i] = 1 + (m < n ? m : period - 1 - m);
        }
    }
    return f;
}

void diffuse_free(struct diffuse *f)
{
    if (!f)
        return;
    for (int a = 0; a < 3; a++) {
        xfree(f->weight[a]);
        xfree(f->image[a]);
    }
    xfree(f);
}

/* A line along x that starts at cell `c` of i = 0. */
static void line_x(const struct diffuse *f, double *row, double *pad)
{
    const int n = f->g->n[0], band = f->band[0];
    const double *const w = f->weight[0];
    for (int i = 0; i < n + 2 * band; i++)
        pad[i] = row[f->image[0][i]];
    const double *const p = pad + band;
    for (int i = 0; i < n; i++)
        row[1 + i] = w[0] * p[i];
    for (int m = 1; m <= band; m++)
#pragma omp simd
        for (int i = 0; i < n; i++)
            row[1 + i] += w[m] * (p[i - m] + p[i + m]);
}

/* `lanes` lines side by side along direction a, the first from cell `c` of layer 0. */
static void lines(const struct diffuse *f, int a, double *at, int lanes, double (*pad)[LANES])
{
    const int n = f->g->n[a], band = f->band[a], step = f->g->s[a];
    const double *const w = f->weight[a];
    for (int i = 0; i < n + 2 * band; i++)
        memcpy(pad[i], at + f->image[a][i] * step, (size_t)lanes * sizeof(double));
    for (int i = 0; i < n; i++) {
        double sum[LANES];
        const double(*const p)[LANES] = (const double(*)[LANES])pad + band + i;
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] = w[0] * p[0][l];
        for (int m = 1; m <= band; m++)
#pragma omp simd
            for (int l = 0; l < LANES; l++)
                sum[l] += w[m] * (p[-m][l] + p[m][l]);
        memcpy(at + (i + 1) * step, sum, (size_t)lanes * sizeof(double));
    }
}

void diffuse_apply(struct diffuse *f, double *field)
{
    const struct grid *const g = f->g;
    int longest = 0;
    for (int a = 0; a < 3; a++)
        longest = g->n[a] + 2 * f->band[a] > longest ? g->n[a] + 2 * f->band[a] : longest;
    const int blocks = (g->n[0] + LANES - 1) / LANES;
#pragma omp parallel
    {
        double(*const pad)[LANES] = xalloc((size_t)longest, sizeof *pad);
#pragma omp for schedule(static)
        for (int k = 1; k <= g->n[2]; k++) {
            for (int j = 1; j <= g->n[1] && g->n[0] > 1; j++)
                line_x(f, field + cell(g, 0, j, k), (double *)pad);
            for (int b = 0; b < blocks && g->n[1] > 1; b++) {
                const int left = g->n[0] - b * LANES;
                lines(f, 1, field + cell(g, 1 + b * LANES, 0, k), left < LANES ? left : LANES,
                      pad);
            }
        }
        if (g->n[2] > 1) {
#pragma omp for collapse(2) schedule(static)
            for (int j = 1; j <= g->n[1]; j++)
                for (int b = 0; b < blocks; b++) {
                    const int left = g->n[0] - b * LANES;
                    lines(f, 2, field + cell(g, 1 + b * LANES, j, 0),
                          left < LANES ? left : LANES, pad);
                }
        }
        xfree(pad);
    }
}
