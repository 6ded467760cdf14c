/* pressure_field.c - right-hand side, residual and solution of the variable-coefficient solve, row by row in
 * double precision, see pressure_parts.h. */
#include "pressure_parts.h"

#include <float.h>

/* Ghosts of one side: the image, the cell inside, or its negative. */
static void side_ghosts(const struct pressure *p, int side, double *phi)
{
    const struct grid *const g = p->g;
    const int a = side / 2, b = a == 0 ? 1 : 0, c = a == 2 ? 1 : 2, n = g->n[a];
    const bool periodic = p->side[side] == POISSON_PERIODIC;
    const int inside = (side % 2 == (periodic ? 0 : 1) ? n : 1) * g->s[a];
    const int ghost = (side % 2 ? n + 1 : 0) * g->s[a];
    const double sign = p->side[side] == POISSON_DIRICHLET ? -1.0 : 1.0;
    const int from_image = periodic && side % 2 ? g->s[a] : inside;
#pragma omp for schedule(static)
    for (int k = 0; k <= g->n[c] + 1; k++)
        for (int j = 0; j <= g->n[b] + 1; j++) {
            const int at = j * g->s[b] + k * g->s[c];
            phi[at + ghost] = sign * phi[at + from_image];
        }
}

void pressure_ghosts(const struct pressure *p, double *phi)
{
#pragma omp parallel if (worth_threads(p))
    for (int side = 0; side < 6; side++) /* later directions fill edges and corners */
        side_ghosts(p, side, phi);
}

/* Sum of x over a row of a field of the grid, and of its squares; eight sums side by side. */
double pressure_row_sum(const double *x, int stride, int n, bool squares)
{
    enum { SIDE = 8 };
    double sum[SIDE] = {0.0}, total = 0.0;
    int i = 0;
    for (; i + SIDE <= n; i += SIDE)
        for (int l = 0; l < SIDE; l++) {
            const double v = x[(size_t)(i + l) * stride];
            sum[l] += squares ? v * v : v;
        }
    for (; i < n; i++) {
        const double v = x[(size_t)i * stride];
        total += squares ? v * v : v;
    }
    for (int l = 0; l < SIDE; l++)
        total += sum[l];
    return total;
}

/* Norm of rhs; *mean: its mean. */
double pressure_rhs_norm(const struct pressure *p, const double *rhs, double *mean)
{
    const struct box *const b = &p->box;
    const long rows = rows_of(b);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        p->part[row] = pressure_row_sum(rhs + in_grid(b, row), b->grid_s[0], b->n[0], true);
        p->part[rows + row] =
            pressure_row_sum(rhs + in_grid(b, row), b->grid_s[0], b->n[0], false);
    }
    *mean = sum_of(p->part + rows, rows) / ((double)b->n[0] * (double)rows);
    return sqrt(sum_of(p->part, rows));
}

double pressure_imbalance(const struct pressure *p, double shift, const double *rhs)
{
    const struct box *const b = &p->box;
    const long rows = rows_of(b);
    if (!poisson_singular(p->direct, shift))
        return 0.0;
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        const double *const x = rhs + in_grid(b, row);
        double sum = 0.0, size = 0.0;
        for (int i = 0; i < b->n[0]; i++) {
            sum += x[(size_t)i * b->grid_s[0]];
            size += fabs(x[(size_t)i * b->grid_s[0]]);
        }
        p->part[row] = sum;
        p->part[rows + row] = size;
    }
    const double sum = sum_of(p->part, rows), size = sum_of(p->part + rows, rows);
    return size > 0.0 ? fabs(sum) / size : 0.0;
}

/* The true residual rhs - mean - A phi: its 2-norm; times `scale` into w->r if there is a w. */
double pressure_residual(const struct pressure *p, double *const c[3], double shift,
                         const double *rhs, double mean, double *phi, double scale,
                         struct krylov *w)
{
    const struct grid *const g = p->g;
    const struct box *const b = &p->box;
    const double sx = 1.0 / (g->h[0] * g->h[0]), sy = 1.0 / (g->h[1] * g->h[1]);
    const double sz = 1.0 / (g->h[2] * g->h[2]);
    const int sj = g->sj, sk = g->sk, step = b->grid_s[0];
    const double *const cx = c[0], *const cy = c[1], *const cz = c[2];
    const long rows = rows_of(b);
    pressure_ghosts(p, phi);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        double r[SEGMENT], sum = 0.0;
        for (int i0 = 0; i0 < b->n[0]; i0 += SEGMENT) {
            const int n = b->n[0] - i0 < SEGMENT ? b->n[0] - i0 : SEGMENT;
            const int first = in_grid(b, row) + i0 * step;
            for (int i = 0; i < n; i++) {
                const int m = first + i * step;
                const double f = phi[m];
                r[i] = rhs[m] - mean + shift * f -
                       (sx * (cx[m + 1] * (phi[m + 1] - f) - cx[m] * (f - phi[m - 1])) +
                        sy * (cy[m + sj] * (phi[m + sj] - f) - cy[m] * (f - phi[m - sj])) +
                        sz * (cz[m + sk] * (phi[m + sk] - f) - cz[m] * (f - phi[m - sk])));
            }
            sum += pressure_row_sum(r, 1, n, true);
            for (int i = 0; i < n && w; i++)
                r[i] *= scale;
            if (w)
                put(w, w->r, in_box(b, row) + i0, r, n);
        }
        p->part[row] = sum;
    }
    return sqrt(sum_of(p->part, rows));
}

/* What round-off of phi alone leaves of the residual: 2-norm of the sum over faces of c |phi|. */
double pressure_round_off(const struct pressure *p, double *const c[3], const double *phi)
{
    const struct grid *const g = p->g;
    const struct box *const b = &p->box;
    const long rows = rows_of(b);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        p->part[row] = 0.0;
        for (int i = 0; i < b->n[0]; i++) {
            const int m = in_grid(b, row) + i * b->grid_s[0];
            double sum = 0.0;
            for (int a = 0; a < 3; a++)
                sum += (c[a][m] * (fabs(phi[m]) + fabs(phi[m - g->s[a]])) +
                        c[a][m + g->s[a]] * (fabs(phi[m]) + fabs(phi[m + g->s[a]]))) /
                       (g->h[a] * g->h[a]);
            p->part[row] += sum * sum;
        }
    }
    return DBL_EPSILON * sqrt(sum_of(p->part, rows));
}

/* phi += factor x, x = 0 */
void pressure_take(const struct pressure *p, struct krylov *w, double factor, double *phi)
{
    const struct box *const b = &p->box;
    const long rows = rows_of(b);
#pragma omp parallel for schedule(static) if (worth_threads(p))
    for (long row = 0; row < rows; row++) {
        double *const to = phi + in_grid(b, row);
        const size_t at = in_box(b, row);
        if (w->real == sizeof(float)) {
            float *const x = (float *)w->x + at;
            for (int i = 0; i < b->n[0]; i++) {
                to[(size_t)i * b->grid_s[0]] += factor * (double)x[i];
                x[i] = 0.0F;
            }
        } else {
            double *const x = (double *)w->x + at;
            for (int i = 0; i < b->n[0]; i++) {
                to[(size_t)i * b->grid_s[0]] += factor * x[i];
                x[i] = 0.0;
            }
        }
    }
}
