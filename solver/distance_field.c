/* distance_field.c - signed distances between the nodes of a grid, and from voxels; see
 * distance_field.h. */
#include "distance_field.h"

#include <string.h>
#include "base.h"
#include "distance_make.h"

struct distance_field *distance_new(const int n[3], double spacing, vec3 origin)
{
    struct distance_field *const f = xalloc(1, sizeof *f);
    *f = (struct distance_field){.n = {n[0], n[1], n[2]},
                                 .spacing = spacing,
                                 .inv_spacing = 1.0 / spacing,
                                 .origin = origin};
    f->value = xalloc((size_t)n[0] * (size_t)n[1] * (size_t)n[2] + 1, sizeof *f->value);
    return f;
}

void distance_free(struct distance_field *f)
{
    if (f)
        xfree(f->value);
    xfree(f);
}

/* Control values c of the quadratic B-spline from those v at the nodes: at a node the spline is (I + sum
 * delta_a^2/8 + ...) c, so c = v - sum delta_a^2 v/8 but for fourth differences. Nodes at the edge keep
 * theirs. */
void distance_make_spline(struct distance_field *f)
{
    const int *const n = f->n;
    const size_t sj = (size_t)n[0], sk = sj * (size_t)n[1], total = sk * (size_t)n[2];
    float *const v = xalloc(total + 1, sizeof *v);
    memcpy(v, f->value, total * sizeof *v);
    for (int k = 1; k < n[2] - 1; k++)
        for (int j = 1; j < n[1] - 1; j++)
            for (int i = 1; i < n[0] - 1; i++) {
                const float *const at = v + (size_t)i + sj * (size_t)j + sk * (size_t)k;
                const double middle = (double)*at;
                const double sum = (double)at[1] + (double)at[-1] + (double)at[sj] +
                                   (double)*(at - sj) + (double)at[sk] + (double)*(at - sk);
                f->value[at - v] = (float)(middle - (sum - 6.0 * middle) / 8.0);
            }
    xfree(v);
}

/* The node next to a point, clamped to the inner ones, and where from it. */
struct spot {
    const float *at; /* the first of the 27 */
    double t[3];
    double beyond; /* distance from the grid */
};

static inline struct spot find(const struct distance_field *f, vec3 x)
{
    const double p[3] = {(x.x - f->origin.x) * f->inv_spacing,
                         (x.y - f->origin.y) * f->inv_spacing,
                         (x.z - f->origin.z) * f->inv_spacing};
    struct spot s;
    int c[3];
    double square = 0.0;
    for (int a = 0; a < 3; a++) {
        const double in = fmin(fmax(p[a], 0.0), f->n[a] - 1.0);
        c[a] = (int)(in + 0.5);
        c[a] = c[a] < 1 ? 1 : c[a] < f->n[a] - 1 ? c[a] : f->n[a] - 2;
        s.t[a] = in - c[a];
        square += (p[a] - in) * (p[a] - in);
    }
    s.at = f->value + (size_t)(c[0] - 1) +
           (size_t)f->n[0] * ((size_t)(c[1] - 1) + (size_t)f->n[1] * (size_t)(c[2] - 1));
    s.beyond = square > 0.0 ? f->spacing * sqrt(square) : 0.0;
    return s;
}

double distance_at(const struct distance_field *f, vec3 x)
{
    vec3 gradient;
    return distance_slope(f, x, &gradient);
}

/* Of one dimension: the weights and how they change. */
static inline void weights(double t, double w[3], double d[3])
{
    w[0] = 0.5 * (0.5 - t) * (0.5 - t);
    w[1] = 0.75 - t * t;
    w[2] = 0.5 * (0.5 + t) * (0.5 + t);
    d[0] = t - 0.5;
    d[1] = -2.0 * t;
    d[2] = t + 0.5;
}

double distance_slope(const struct distance_field *f, vec3 x, vec3 *gradient)
{
    const struct spot s = find(f, x);
    const size_t sj = (size_t)f->n[0], sk = sj * (size_t)f->n[1];
    double u[3], v[3], w[3], du[3], dv[3], dw[3], value = 0.0;
    vec3 g = {0.0, 0.0, 0.0};
    weights(s.t[0], u, du);
    weights(s.t[1], v, dv);
    weights(s.t[2], w, dw);
    for (int k = 0; k < 3; k++) {
        double sum = 0.0, by_x = 0.0, by_y = 0.0;
        for (int j = 0; j < 3; j++) {
            const float *const c = s.at + (size_t)j * sj + (size_t)k * sk;
            const double a = (double)c[0], b = (double)c[1], e = (double)c[2];
            const double row = u[0] * a + u[1] * b + u[2] * e;
            sum += v[j] * row;
            by_y += dv[j] * row;
            by_x += v[j] * (du[0] * a + du[1] * b + du[2] * e);
        }
        value += w[k] * sum;
        g = v3_add(g, v3(w[k] * by_x, w[k] * by_y, dw[k] * sum));
    }
    *gradient = v3_scale(f->inv_spacing, g);
    return s.beyond > 0.0 ? fmax(s.beyond, value - s.beyond) : value;
}

/* One line of the squared distance transform: lower envelope of parabolas [FelzenszwalbHuttenlocher12]. */
static void line_transform(double *f, int n, int stride, double *d, double *z, int *v)
{
    int k = 0;
    v[0] = 0;
    z[0] = -1e300;
    z[1] = 1e300;
    for (int q = 1; q < n; q++) {
        const double fq = f[(size_t)q * (size_t)stride];
        double s;
        while (
            (s = (fq + (double)q * q - f[(size_t)v[k] * (size_t)stride] - (double)v[k] * v[k]) /
                 (2.0 * (q - v[k]))) <= z[k])
            k--;
        k++;
        v[k] = q;
        z[k] = s;
        z[k + 1] = 1e300;
    }
    for (int q = 0, m = 0; q < n; q++) {
        while (z[m + 1] < q)
            m++;
        d[q] = (double)(q - v[m]) * (q - v[m]) + f[(size_t)v[m] * (size_t)stride];
    }
    for (int q = 0; q < n; q++)
        f[(size_t)q * (size_t)stride] = d[q];
}

/* Calls `line` for every line of the grid along axis a. */
static void each_line(const int n[3], int a,
                      void (*line)(double *f, int n, int stride, void *work), double *f,
                      void *work)
{
    const int stride[3] = {1, n[0], n[0] * n[1]}, b = (a + 1) % 3, c = (a + 2) % 3;
    for (int j = 0; j < n[c]; j++)
        for (int i = 0; i < n[b]; i++)
            line(f + (size_t)i * (size_t)stride[b] + (size_t)j * (size_t)stride[c], n[a],
                 stride[a], work);
}

struct line_work {
    double *d, *z;
    int *v;
    double weight[16];
    int reach;
};

static void squares(double *f, int n, int stride, void *work)
{
    const struct line_work *const w = work;
    line_transform(f, n, stride, w->d, w->z, w->v);
}

static void smooth_line(double *f, int n, int stride, void *work)
{
    const struct line_work *const w = work;
    for (int q = 0; q < n; q++) {
        w->d[q] = w->weight[0] * f[(size_t)q * (size_t)stride];
        for (int r = 1; r <= w->reach; r++) {
            const int lo = q - r > 0 ? q - r : 0, hi = q + r < n - 1 ? q + r : n - 1;
            w->d[q] += w->weight[r] *
                       (f[(size_t)lo * (size_t)stride] + f[(size_t)hi * (size_t)stride]);
        }
    }
    for (int q = 0; q < n; q++)
        f[(size_t)q * (size_t)stride] = w->d[q];
}

static void gaussian(struct line_work *w, double sigma)
{
    double sum = 0.0;
    w->reach = (int)fmin(15.0, ceil(3.0 * sigma));
    for (int r = 0; r <= w->reach; r++) {
        w->weight[r] = r == 0 ? 1.0 : exp(-0.5 * r * r / (sigma * sigma));
        sum += r == 0 ? w->weight[r] : 2.0 * w->weight[r];
    }
    for (int r = 0; r <= w->reach; r++)
        w->weight[r] /= sum;
}

struct distance_field *distance_of_voxels(const unsigned char *solid, const int n[3],
                                          double edge, double smooth)
{
    enum { MARGIN = 4 };
    const int m[3] = {n[0] + 2 * MARGIN, n[1] + 2 * MARGIN, n[2] + 2 * MARGIN};
    const size_t total = (size_t)m[0] * (size_t)m[1] * (size_t)m[2];
    const double corner = (0.5 - MARGIN) * edge;
    struct distance_field *const f = distance_new(m, edge, v3(corner, corner, corner));
    double *const to[2] = {xalloc(total, sizeof(double)), xalloc(total, sizeof(double))};
    const size_t most = (size_t)(m[0] + m[1] + m[2]) + 2;
    struct line_work w = {.d = xalloc(most, sizeof(double)),
                          .z = xalloc(most, sizeof(double)),
                          .v = xalloc(most, sizeof(int))};
    for (int k = 0; k < m[2]; k++)
        for (int j = 0; j < m[1]; j++)
            for (int i = 0; i < m[0]; i++) {
                const int x = i - MARGIN, y = j - MARGIN, z = k - MARGIN;
                const bool in =
                    x >= 0 && x < n[0] && y >= 0 && y < n[1] && z >= 0 && z < n[2] &&
                    solid[(size_t)x + (size_t)n[0] * ((size_t)y + (size_t)n[1] * (size_t)z)];
                const size_t at =
                    (size_t)i + (size_t)m[0] * ((size_t)j + (size_t)m[1] * (size_t)k);
                to[0][at] = in ? 0.0 : 1e12; /* to the solid, to the void */
                to[1][at] = in ? 1e12 : 0.0;
            }
    for (int side = 0; side < 2; side++)
        for (int a = 0; a < 3; a++)
            each_line(m, a, squares, to[side], &w);
    for (size_t c = 0; c < total; c++)
        to[0][c] = to[0][c] > 0.0 ? sqrt(to[0][c]) - 0.5 : 0.5 - sqrt(to[1][c]);
    if (smooth > 0.0) {
        gaussian(&w, smooth);
        for (int a = 0; a < 3; a++)
            each_line(m, a, smooth_line, to[0], &w);
    }
    for (size_t c = 0; c < total; c++)
        f->value[c] = (float)(edge * to[0][c]);
    distance_make_spline(f);
    xfree(to[0]);
    xfree(to[1]);
    xfree(w.d);
    xfree(w.z);
    xfree(w.v);
    return f;
}
