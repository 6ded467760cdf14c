/* pressure.c - conjugate gradients [HestenesStiefel52] with a direct solve as preconditioner
 * [ConcusGolub73]. For porosities from 0.35 to 1 it takes about ten iterations to 1e-6; for a
 * flat bed, whose coefficient depends on the height only, a few. */
#include "pressure.h"

#include <string.h>

enum { MOST = 2000 }; /* iterations */

struct pressure {
    const struct grid *g;
    const struct domain *d;
    enum poisson_side side[6];
    struct poisson *direct;
    double *r, *z, *s, *q; /* residual, preconditioned, direction, A direction */
    double *flat, *up;     /* layer means */
    double *part;          /* sums of the rows, for dot products */
};

struct pressure *pressure_create(const struct grid *g, const struct domain *d,
                                 const enum poisson_side side[6])
{
    struct pressure *const p = xalloc(1, sizeof *p);
    p->g = g;
    p->d = d;
    memcpy(p->side, side, sizeof p->side);
    p->direct = poisson_create(g, side);
    double **const fields[] = {&p->r, &p->z, &p->s, &p->q};
    for (size_t i = 0; i < 4; i++)
        *fields[i] = grid_field(g);
    p->flat = xalloc((size_t)g->n[2] + 2, sizeof(double));
    p->up = xalloc((size_t)g->n[2] + 2, sizeof(double));
    p->part = xalloc((size_t)g->n[2] + 2, sizeof(double));
    return p;
}

void pressure_free(struct pressure *p)
{
    if (!p)
        return;
    poisson_free(p->direct);
    void *const all[] = {p->r, p->z, p->s, p->q, p->flat, p->up, p->part, p};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

/* Sum of x y over the interior: by layers, each by one thread, added in order. */
static double dot(const struct pressure *p, const double *x, const double *y)
{
    const struct grid *const g = p->g;
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++) {
        double sum = 0.0;
        for (int j = 1; j <= g->n[1]; j++) {
            double row = 0.0;
            for (int c = cell(g, 1, j, k); c <= cell(g, g->n[0], j, k); c++)
                row += x[c] * y[c];
            sum += row;
        }
        p->part[k] = sum;
    }
    double sum = 0.0;
    for (int k = 1; k <= g->n[2]; k++)
        sum += p->part[k];
    return sum;
}

void pressure_ghosts(const struct pressure *p, double *phi)
{
    const struct grid *const g = p->g;
    grid_ghosts(g, p->d, phi);
    for (int side = 0; side < 6; side++) {
        if (p->side[side] != POISSON_DIRICHLET)
            continue;
        const int a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3;
        const int ghost = (side % 2 ? g->n[a] + 1 : 0) * g->s[a];
        const int inside = (side % 2 ? g->n[a] : 1) * g->s[a];
        for (int k = 1; k <= g->n[c]; k++)
            for (int j = 1; j <= g->n[b]; j++) {
                const int at = j * g->s[b] + k * g->s[c];
                phi[at + ghost] = -phi[at + inside];
            }
    }
}

/* out = div(c grad phi) - shift phi; Neumann faces pass nothing since their ghost equals the
 * cell */
static void apply(const struct pressure *p, double *const c[3], double shift, double *phi,
                  double *out)
{
    const struct grid *const g = p->g;
    const double sx = 1.0 / (g->h[0] * g->h[0]), sy = 1.0 / (g->h[1] * g->h[1]);
    const double sz = 1.0 / (g->h[2] * g->h[2]);
    const int sj = g->sj, sk = g->sk;
    const double *const restrict cx = c[0], *const restrict cy = c[1],
                                 *const restrict cz = c[2];
    pressure_ghosts(p, phi);
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int m = cell(g, 1, j, k); m <= cell(g, g->n[0], j, k); m++) {
                const double f = phi[m];
                out[m] = sx * (cx[m + 1] * (phi[m + 1] - f) - cx[m] * (f - phi[m - 1])) +
                         sy * (cy[m + sj] * (phi[m + sj] - f) - cy[m] * (f - phi[m - sj])) +
                         sz * (cz[m + sk] * (phi[m + sk] - f) - cz[m] * (f - phi[m - sk])) -
                         shift * f;
            }
}

/* Means over layers: flat of the x and y faces of a layer, up of the z faces below it. */
static void layer_means(struct pressure *p, double *const c[3])
{
    const struct grid *const g = p->g;
    const double count = (double)g->n[0] * g->n[1];
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2] + 1; k++) {
        double flat = 0.0, up = 0.0;
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++) {
                const int m = cell(g, i, j, k);
                up += c[2][m];
                if (k <= g->n[2])
                    flat += 0.25 * (c[0][m] + c[0][m + 1] + c[1][m] + c[1][m + g->sj]);
            }
        p->up[k] = up / count;
        if (k <= g->n[2])
            p->flat[k] = flat / count;
    }
}

double pressure_imbalance(const struct pressure *p, double shift, const double *rhs)
{
    const struct grid *const g = p->g;
    if (!poisson_singular(p->direct, shift))
        return 0.0;
    double sum = 0.0, size = 0.0;
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int c = cell(g, 1, j, k); c <= cell(g, g->n[0], j, k); c++) {
                sum += rhs[c];
                size += fabs(rhs[c]);
            }
    return size > 0.0 ? fabs(sum) / size : 0.0;
}

/* x += a y over the whole field */
static void axpy(const struct grid *g, double a, const double *y, double *x)
{
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < g->total; c++)
        x[c] += a * y[c];
}

struct solve pressure_solve(struct pressure *p, double *const c[3], double shift,
                            const double *rhs, double *phi, double tolerance, double floor)
{
    const struct grid *const g = p->g;
    struct solve result = {.iterations = 0};
    layer_means(p, c);
    const bool singular = poisson_singular(p->direct, shift);
    double mean = 0.0; /* of a singular rhs: not to be balanced */
    apply(p, c, shift, phi, p->r);
    for (int k = 1; k <= g->n[2] && singular; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int m = cell(g, 1, j, k); m <= cell(g, g->n[0], j, k); m++)
                mean += rhs[m] / ((double)g->n[0] * g->n[1] * g->n[2]);
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int m = cell(g, 1, j, k); m <= cell(g, g->n[0], j, k); m++)
                p->r[m] = rhs[m] - mean - p->r[m];
    const double size = sqrt(dot(p, rhs, rhs));
    const double target = fmax(tolerance * size, floor);
    result.start = result.end = sqrt(dot(p, p->r, p->r));
    double rz = 0.0;
    while (result.end > target && result.iterations < MOST) {
        poisson_solve(p->direct, p->flat, p->up, shift, p->r, p->z);
        const double rz_new = dot(p, p->r, p->z);
        const double beta = result.iterations > 0 ? rz_new / rz : 0.0;
        rz = rz_new;
#pragma omp parallel for schedule(static)
        for (size_t m = 0; m < g->total; m++)
            p->s[m] = p->z[m] + beta * p->s[m];
        apply(p, c, shift, p->s, p->q);
        const double sq = dot(p, p->s, p->q);
        if (sq == 0.0)
            break;
        axpy(g, rz / sq, p->s, phi);
        axpy(g, -rz / sq, p->q, p->r);
        result.end = sqrt(dot(p, p->r, p->r));
        result.iterations++;
    }
    result.converged = result.end <= target;
    pressure_ghosts(p, phi);
    return result;
}
