/* rows_body.h - the seven-point operator and sums, row by row, for krylov_body.h and
 * multigrid_body.h. A body, included once for each precision; the includer defines REAL. */
#include <math.h>
#include <string.h>

enum { LANES = 64 / sizeof(REAL) };
typedef REAL pack __attribute__((vector_size(64)));

struct stencil {
    int n[3], s[3], start;
    size_t total;
    bool periodic[3];
    REAL *c[3]; /* on low faces; of the last cell also on its high face */
    double shift;
    REAL *weight[3]; /* fine cells along each direction in a cell; NULL: 1 */
};

static inline size_t row_at(const struct stencil *t, long row)
{
    return (size_t)t->start + (size_t)(row % t->n[1]) * t->s[1] +
           (size_t)(row / t->n[1]) * t->s[2];
}

static inline long rows_of(const struct stencil *t)
{
    return (long)t->n[1] * t->n[2];
}

static inline bool worth_threads(const struct stencil *t)
{
    return t->total > POISSON_SERIAL;
}

/* out[i] = (A f)[i] of the row whose first cell is f[0] */
static inline void row_apply(const struct stencil *t, const REAL *restrict f, size_t at,
                             long row, REAL *restrict out)
{
    const int n = t->n[0], sj = t->s[1], sk = t->s[2];
    const REAL *const restrict cx = t->c[0] + at, *const restrict cy = t->c[1] + at,
                               *const restrict cz = t->c[2] + at;
    for (int i = 0; i < n; i++) {
        const REAL g = f[i];
        out[i] = (cx[i + 1] * (f[i + 1] - g) - cx[i] * (g - f[i - 1])) +
                 (cy[i + sj] * (f[i + sj] - g) - cy[i] * (g - f[i - sj])) +
                 (cz[i + sk] * (f[i + sk] - g) - cz[i] * (g - f[i - sk]));
    }
    if (t->shift == 0.0)
        return;
    REAL mass = (REAL)t->shift;
    if (t->weight[0])
        mass *= t->weight[1][row % t->n[1]] * t->weight[2][row / t->n[1]];
    for (int i = 0; i < n; i++)
        out[i] -= mass * (t->weight[0] ? t->weight[0][i] : (REAL)1) * f[i];
}

static double row_dot(const REAL *a, const REAL *b, int n)
{
    pack sum = {0};
    int i = 0;
    for (; i + LANES <= n; i += LANES) {
        pack x, y;
        memcpy(&x, a + i, sizeof x);
        memcpy(&y, b + i, sizeof y);
        sum += x * y;
    }
    double total = 0.0;
    for (int l = 0; l < LANES; l++)
        total += (double)sum[l];
    for (; i < n; i++)
        total += (double)a[i] * (double)b[i];
    return total;
}

/* Periodic images of the ends of a row. */
static inline void row_ghosts(const struct stencil *t, REAL *f)
{
    if (t->periodic[0]) {
        f[-1] = f[t->n[0] - 1];
        f[t->n[0]] = f[0];
    }
}

/* Periodic images of the first and the last row of plane k; other ghosts stay as they are. */
static inline void plane_ghosts(const struct stencil *t, REAL *f, int k)
{
    const size_t bytes = (size_t)t->s[1] * sizeof(REAL);
    REAL *const plane = f + t->start - 1 + (size_t)k * t->s[2];
    if (!t->periodic[1])
        return;
    memcpy(plane - t->s[1], plane + (size_t)(t->n[1] - 1) * t->s[1], bytes);
    memcpy(plane + (size_t)t->n[1] * t->s[1], plane, bytes);
}

/* Periodic images of the first and the last plane. Inside a team. */
static void end_ghosts(const struct stencil *t, REAL *f)
{
    const size_t bytes = (size_t)t->s[1] * sizeof(REAL);
    REAL *const first = f + t->start - 1;
    if (t->periodic[2])
#pragma omp for schedule(static)
        for (int j = 0; j < t->n[1]; j++) {
            REAL *const row = first + (size_t)j * t->s[1];
            memcpy(row - t->s[2], row + (size_t)(t->n[2] - 1) * t->s[2], bytes);
            memcpy(row + (size_t)t->n[2] * t->s[2], row, bytes);
        }
}

/* Of a whole field. Inside a team. */
static void all_ghosts(const struct stencil *t, REAL *f)
{
#pragma omp for schedule(static)
    for (int k = 0; k < t->n[2]; k++)
        plane_ghosts(t, f, k);
    end_ghosts(t, f);
}

static double sum_rows(const struct stencil *t, const double *part)
{
    double sum = 0.0;
    for (long row = 0; row < rows_of(t); row++)
        sum += part[row];
    return sum;
}
