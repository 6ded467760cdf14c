/* poisson.c - the direct solve [SwarztrauberSweet73], [Costa18]: FFTW's transforms of the kinds
 * that the sides ask for diagonalise x and y; what is left is a tridiagonal system in z for
 * each mode, swept for all modes of a line at once. Periodic z: the wrap-around by Sherman and
 * Morrison.
 *
 *   sides                      forward / backward    eigenvalue of mode k       norm
 *   periodic                   R2HC / HC2R           4 sin^2(pi k/n)/h^2        n
 *   Neumann-Neumann            REDFT10 / REDFT01     4 sin^2(pi k/2n)/h^2       2n
 *   Dirichlet-Dirichlet        RODFT10 / RODFT01     with k + 1                 2n
 *   Neumann-Dirichlet          REDFT11               with k + 1/2               2n
 *   Dirichlet-Neumann          RODFT11               with k + 1/2               2n
 *
 * Plans are made without timing (FFTW_ESTIMATE) for one thread; threads take planes. So the
 * bits do not depend on the number of threads. */
#include "poisson.h"

#include <fftw3.h>
#include <string.h>

#define PI 3.14159265358979323846

struct poisson {
    const struct grid *g;
    enum poisson_side side[6];
    fftw_plan forward, backward; /* of one plane */
    double *work;                /* nz planes of ny x nx */
    double *pivot;               /* the same size: upper factors of the sweeps */
    double *wrap;                /* the same size, if z is periodic */
    double *lambda;              /* ny x nx */
    double norm;
};

static bool dirichlet(const struct poisson *p, int side)
{
    return p->side[side] == POISSON_DIRICHLET;
}

static fftw_r2r_kind kind_of(const struct poisson *p, int a, bool back)
{
    const bool lo = dirichlet(p, 2 * a), hi = dirichlet(p, 2 * a + 1);
    if (p->side[2 * a] == POISSON_PERIODIC)
        return back ? FFTW_HC2R : FFTW_R2HC;
    if (!lo && !hi)
        return back ? FFTW_REDFT01 : FFTW_REDFT10;
    if (lo && hi)
        return back ? FFTW_RODFT01 : FFTW_RODFT10;
    return lo ? FFTW_RODFT11 : FFTW_REDFT11;
}

static double eigenvalue(const struct poisson *p, int a, int k)
{
    const int n = p->g->n[a];
    const bool lo = dirichlet(p, 2 * a), hi = dirichlet(p, 2 * a + 1);
    double x = PI * k / n;
    if (p->side[2 * a] == POISSON_PERIODIC)
        x = 2.0 * PI * k / n;
    else if (lo && hi)
        x = PI * (k + 1) / n;
    else if (lo || hi)
        x = PI * (k + 0.5) / n;
    const double s = 2.0 * sin(0.5 * x) / p->g->h[a];
    return s * s;
}

struct poisson *poisson_create(const struct grid *g, const enum poisson_side side[6])
{
    struct poisson *const p = xalloc(1, sizeof *p);
    const int nx = g->n[0], ny = g->n[1], nz = g->n[2];
    const size_t plane = (size_t)nx * ny;
    p->g = g;
    memcpy(p->side, side, sizeof p->side);
    p->work = xalloc(plane * nz, sizeof(double));
    p->pivot = xalloc(plane * nz, sizeof(double));
    if (side[Z_LO] == POISSON_PERIODIC)
        p->wrap = xalloc(plane * nz, sizeof(double));
    p->lambda = xalloc(plane, sizeof(double));
    p->norm = (side[X_LO] == POISSON_PERIODIC ? nx : 2.0 * nx) *
              (side[Y_LO] == POISSON_PERIODIC ? ny : 2.0 * ny);
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++)
            p->lambda[i + (size_t)nx * j] = eigenvalue(p, 0, i) + eigenvalue(p, 1, j);
    const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
    p->forward = fftw_plan_r2r_2d(ny, nx, p->work, p->work, kind_of(p, 1, false),
                                  kind_of(p, 0, false), flags);
    p->backward = fftw_plan_r2r_2d(ny, nx, p->work, p->work, kind_of(p, 1, true),
                                   kind_of(p, 0, true), flags);
    return p;
}

void poisson_free(struct poisson *p)
{
    if (!p)
        return;
    fftw_destroy_plan(p->forward);
    fftw_destroy_plan(p->backward);
    xfree(p->work);
    xfree(p->pivot);
    xfree(p->wrap);
    xfree(p->lambda);
    xfree(p);
}

bool poisson_singular(const struct poisson *p, double shift)
{
    for (int side = 0; side < 6; side++)
        if (dirichlet(p, side))
            return false;
    return shift == 0.0;
}

/* Sweeps of the modes [lo, hi): d[k] x[k] + c[k] x[k-1] + c[k+1] x[k+1] = r[k] with
 * c[k] = up[k]/h^2 and d[k] = -c[k] - c[k+1] - flat[k] lambda - shift, sides as they are. A
 * mode without any of these terms (singular) has its last value set to zero. */
struct sweep {
    double c[2]; /* below and above the layer */
    double side; /* what the side of the box adds to the diagonal */
};

static struct sweep layer(const struct poisson *p, const double *up, int k)
{
    const double scale = 1.0 / (p->g->h[2] * p->g->h[2]);
    const int n = p->g->n[2];
    struct sweep s = {.c = {up[k] * scale, up[k + 1] * scale}};
    if (k == 1 && p->side[Z_LO] != POISSON_PERIODIC) {
        s.side += dirichlet(p, Z_LO) ? 2.0 * s.c[0] : 0.0;
        s.c[0] = 0.0;
    }
    if (k == n && p->side[Z_HI] != POISSON_PERIODIC) {
        s.side += dirichlet(p, Z_HI) ? 2.0 * s.c[1] : 0.0;
        s.c[1] = 0.0;
    }
    return s;
}

/* Thomas, in place on r, for layers first..last (the rows outside are zero). `corner` is added
 * to the diagonals of layers 1 and n (for Sherman and Morrison). */
static void thomas(const struct poisson *p, const double *flat, const double *up, double shift,
                   int first, int last, const double *corner, double *r, size_t lo, size_t hi)
{
    const size_t plane = (size_t)p->g->n[0] * p->g->n[1];
    const int n = p->g->n[2];
    for (int k = first; k <= last; k++) {
        const struct sweep s = layer(p, up, k);
        const double below = k > first ? s.c[0] : 0.0, above = k < last ? s.c[1] : 0.0;
        double diagonal = s.c[0] + s.c[1] + s.side + shift;
        if (corner)
            diagonal += (k == 1 ? corner[0] : 0.0) + (k == n ? corner[1] : 0.0);
        double *const restrict x = r + (size_t)(k - 1) * plane;
        double *const restrict g = p->pivot + (size_t)(k - 1) * plane;
        const double *const restrict x_below = k > first ? x - plane : x;
        const double *const restrict g_below = k > first ? g - plane : g;
        for (size_t m = lo; m < hi; m++) {
            const double d = -diagonal - flat[k] * p->lambda[m];
            const double carry = k > first ? below : 0.0;
            const double inverse = 1.0 / (carry != 0.0 ? d - carry * g_below[m] : d);
            const double before = carry != 0.0 ? carry * x_below[m] : 0.0;
            g[m] = above * inverse;
            x[m] = (x[m] - before) * inverse;
        }
    }
    for (int k = last - 1; k >= first; k--) {
        double *const restrict x = r + (size_t)(k - 1) * plane;
        const double *const restrict g = p->pivot + (size_t)(k - 1) * plane;
        for (size_t m = lo; m < hi; m++)
            x[m] -= g[m] * x[m + plane];
    }
}

/* A periodic column: the matrix is a tridiagonal one plus a rank-one part at the corners. */
static void cyclic(struct poisson *p, const double *flat, const double *up, double shift,
                   double *r, size_t lo, size_t hi)
{
    const size_t plane = (size_t)p->g->n[0] * p->g->n[1];
    const int n = p->g->n[2];
    const double c = up[1] / (p->g->h[2] * p->g->h[2]); /* couples layer n to layer 1 */
    if (n == 1) { /* both neighbours of the layer are itself */
        for (size_t m = lo; m < hi; m++)
            r[m] /= -(flat[1] * p->lambda[m] + shift);
        return;
    }
    /* A = T + u v^T, u = (c, 0, ..., 0, c), v = (1, 0, ..., 0, 1): T's corners lose c */
    const double corner[2] = {c, c};
    double *const w = p->wrap;
    for (int k = 1; k <= n; k++)
        for (size_t m = lo; m < hi; m++)
            w[(size_t)(k - 1) * plane + m] = (k == 1) + (k == n) ? c : 0.0;
    thomas(p, flat, up, shift, 1, n, corner, r, lo, hi);
    thomas(p, flat, up, shift, 1, n, corner, w, lo, hi);
    const size_t end = (size_t)(n - 1) * plane;
    for (size_t m = lo; m < hi; m++) {
        const double factor = (r[m] + r[end + m]) / (1.0 + w[m] + w[end + m]);
        for (int k = 0; k < n; k++)
            r[(size_t)k * plane + m] -= factor * w[(size_t)k * plane + m];
    }
}

/* The mode that is constant in x and y, where a constant solves the equation: the first value
 * is set to zero in place of the first equation. */
static void singular_mode(struct poisson *p, const double *flat, const double *up, double *r)
{
    const int n = p->g->n[2];
    double *const x = r; /* mode 0 of each plane */
    const size_t plane = (size_t)p->g->n[0] * p->g->n[1];
    double mean = 0.0;
    for (int k = 0; k < n; k++)
        mean += x[(size_t)k * plane] / n;
    for (int k = 0; k < n; k++)
        x[(size_t)k * plane] -= mean;
    x[0] = 0.0;
    if (n > 1)
        thomas(p, flat, up, 0.0, 2, n, NULL, r, 0, 1);
}

static void gather_planes(const struct poisson *p, const double *rhs)
{
    const struct grid *const g = p->g;
    const int nx = g->n[0], ny = g->n[1];
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++) {
        double *const plane = p->work + (size_t)(k - 1) * nx * ny;
        for (int j = 1; j <= ny; j++)
            memcpy(plane + (size_t)(j - 1) * nx, rhs + cell(g, 1, j, k),
                   (size_t)nx * sizeof(double));
        fftw_execute_r2r(p->forward, plane, plane);
    }
}

static void scatter_planes(const struct poisson *p, double mean, double *out)
{
    const struct grid *const g = p->g;
    const int nx = g->n[0], ny = g->n[1];
    const double scale = 1.0 / p->norm;
#pragma omp parallel for schedule(static)
    for (int k = 1; k <= g->n[2]; k++) {
        double *const plane = p->work + (size_t)(k - 1) * nx * ny;
        fftw_execute_r2r(p->backward, plane, plane);
        for (int j = 1; j <= ny; j++)
            for (int i = 1; i <= nx; i++)
                out[cell(g, i, j, k)] = scale * plane[(i - 1) + (size_t)(j - 1) * nx] - mean;
    }
}

void poisson_solve(struct poisson *p, const double *flat, const double *up, double shift,
                   const double *rhs, double *out)
{
    enum { MODES = 256 }; /* swept at a time */
    const size_t plane = (size_t)p->g->n[0] * p->g->n[1];
    const bool singular = poisson_singular(p, shift);
    const bool periodic = p->side[Z_LO] == POISSON_PERIODIC;
    gather_planes(p, rhs);
    const long runs = (long)((plane + MODES - 1) / MODES);
#pragma omp parallel for schedule(static)
    for (long run = 0; run < runs; run++) {
        const size_t first = (size_t)run * MODES;
        const size_t lo = singular && run == 0 ? 1 : first;
        const size_t hi = first + MODES < plane ? first + MODES : plane;
        if (singular && run == 0)
            singular_mode(p, flat, up, p->work);
        if (periodic)
            cyclic(p, flat, up, shift, p->work, lo, hi);
        else
            thomas(p, flat, up, shift, 1, p->g->n[2], NULL, p->work, lo, hi);
    }
    double mean = 0.0;
    if (singular) {
        for (int k = 0; k < p->g->n[2]; k++)
            mean += p->work[(size_t)k * plane] / p->g->n[2];
        /* mode 0 is the sum over the plane, times 2 for each Neumann direction */
        mean /= p->norm;
    }
    scatter_planes(p, mean, out);
}
