/* distance_mesh.c - the signed distance to a closed surface of triangles, see distance_field.h.
 *
 * Within three spacings the distance to the nearest triangle is exact: every triangle visits the
 * nodes about it. Beyond, |grad d| = 1 is swept outwards by Gauss and Seidel in the eight orders of
 * the axes [Zhao05]. The sign comes from the number of crossings of a line of nodes along x with
 * the surface, the line moved aside a little so that it meets no edge. */
#include <stdlib.h>
#include "base.h"
#include "distance_make.h"

enum { BAND = 3, MARGIN = 4 };

/* Square of the distance of p from triangle a b c [Ericson05, sect. 5.1.5]. */
static double triangle_square(vec3 p, vec3 a, vec3 b, vec3 c)
{
    const vec3 ab = v3_sub(b, a), ac = v3_sub(c, a), ap = v3_sub(p, a);
    const double d1 = v3_dot(ab, ap), d2 = v3_dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0)
        return v3_dot(ap, ap);
    const vec3 bp = v3_sub(p, b);
    const double d3 = v3_dot(ab, bp), d4 = v3_dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3)
        return v3_dot(bp, bp);
    const vec3 cp = v3_sub(p, c);
    const double d5 = v3_dot(ab, cp), d6 = v3_dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6)
        return v3_dot(cp, cp);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    vec3 q;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        q = v3_axpy(a, d1 / (d1 - d3), ab);
    } else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        q = v3_axpy(a, d2 / (d2 - d6), ac);
    } else if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        q = v3_axpy(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), v3_sub(c, b));
    } else {
        const double inv = 1.0 / (va + vb + vc);
        q = v3_axpy(v3_axpy(a, vb * inv, ab), vc * inv, ac);
    }
    const vec3 pq = v3_sub(p, q);
    return v3_dot(pq, pq);
}

static double at(vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static size_t node(const struct distance_field *f, int i, int j, int k)
{
    return (size_t)i + (size_t)f->n[0] * ((size_t)j + (size_t)f->n[1] * (size_t)k);
}

/* The nodes within `band` of the box of a triangle. */
static void nodes_about(const struct distance_field *f, const vec3 *t, double band, int lo[3],
                        int hi[3])
{
    for (int a = 0; a < 3; a++) {
        const double x[3] = {at(t[0], a), at(t[1], a), at(t[2], a)}, o = at(f->origin, a);
        const double low = fmin(x[0], fmin(x[1], x[2])), high = fmax(x[0], fmax(x[1], x[2]));
        lo[a] = (int)fmax(0.0, floor((low - band - o) * f->inv_spacing));
        hi[a] = (int)fmin(f->n[a] - 1.0, ceil((high + band - o) * f->inv_spacing));
    }
}

static void band(struct distance_field *f, const vec3 *corner, int n, double *square)
{
    for (int t = 0; t < n; t++) {
        const vec3 *const c = corner + 3 * t;
        int lo[3], hi[3];
        nodes_about(f, c, BAND * f->spacing, lo, hi);
        for (int k = lo[2]; k <= hi[2]; k++)
            for (int j = lo[1]; j <= hi[1]; j++)
                for (int i = lo[0]; i <= hi[0]; i++) {
                    const vec3 p = v3_axpy(f->origin, f->spacing, v3(i, j, k));
                    const double d = triangle_square(p, c[0], c[1], c[2]);
                    const size_t m = node(f, i, j, k);
                    square[m] = fmin(square[m], d);
                }
    }
}

/* The smallest d with sum over axes of max(0, d - a_k)^2 = h^2, a sorted. */
static double eikonal(double a, double b, double c, double h)
{
    const double low = fmin(a, fmin(b, c)), high = fmax(a, fmax(b, c));
    const double mid = fmax(fmin(a, b), fmin(fmax(a, b), c));
    double d = low + h;
    if (d > mid) {
        d = 0.5 * (low + mid + sqrt(fmax(0.0, 2.0 * h * h - (low - mid) * (low - mid))));
        if (d > high) {
            const double s = low + mid + high;
            const double q = low * low + mid * mid + high * high - h * h;
            d = (s + sqrt(fmax(0.0, s * s - 3.0 * q))) / 3.0;
        }
    }
    return d;
}

static void sweep(const struct distance_field *f, double *d, const unsigned char *exact,
                  int order)
{
    const int nx = f->n[0], ny = f->n[1], nz = f->n[2];
    for (int kk = 0; kk < nz; kk++)
        for (int jj = 0; jj < ny; jj++)
            for (int ii = 0; ii < nx; ii++) {
                const int i = order & 1 ? nx - 1 - ii : ii, j = order & 2 ? ny - 1 - jj : jj;
                const int k = order & 4 ? nz - 1 - kk : kk;
                const size_t m = node(f, i, j, k), sj = (size_t)nx, sk = sj * (size_t)ny;
                if (exact[m])
                    continue;
                const double x = fmin(i > 0 ? d[m - 1] : 1e30, i < nx - 1 ? d[m + 1] : 1e30);
                const double y = fmin(j > 0 ? d[m - sj] : 1e30, j < ny - 1 ? d[m + sj] : 1e30);
                const double z = fmin(k > 0 ? d[m - sk] : 1e30, k < nz - 1 ? d[m + sk] : 1e30);
                d[m] = fmin(d[m], eikonal(x, y, z, f->spacing));
            }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Crossings of lines along x with the surface: a list per line. */
struct crossings {
    int n, room;
    double *x;
};

static void cross_line(struct crossings *c, double x)
{
    if (c->n == c->room) {
        const int more = 2 * c->room + 8;
        c->x = xrealloc(c->x, (size_t)c->room, (size_t)more, sizeof *c->x);
        c->room = more;
    }
    c->x[c->n++] = x;
}

/* Where the line (y, z) meets the triangle. */
static bool meets(const vec3 *t, double y, double z, double *x)
{
    double w[3];
    for (int e = 0; e < 3; e++) {
        const vec3 a = t[(e + 1) % 3], b = t[(e + 2) % 3];
        w[e] = (a.y - y) * (b.z - z) - (a.z - z) * (b.y - y);
    }
    if (!((w[0] > 0.0 && w[1] > 0.0 && w[2] > 0.0) || (w[0] < 0.0 && w[1] < 0.0 && w[2] < 0.0)))
        return false;
    *x = (w[0] * t[0].x + w[1] * t[1].x + w[2] * t[2].x) / (w[0] + w[1] + w[2]);
    return true;
}

/* Signs of the nodes; false: some line ends inside. */
static bool signs(struct distance_field *f, const vec3 *corner, int n)
{
    const int nx = f->n[0], ny = f->n[1], nz = f->n[2];
    const double aside_y = 3.1415926e-6 * f->spacing, aside_z = 2.7182818e-6 * f->spacing;
    struct crossings *const line = xalloc((size_t)ny * (size_t)nz, sizeof *line);
    bool closed = true;
    for (int t = 0; t < n; t++) {
        int lo[3], hi[3];
        nodes_about(f, corner + 3 * t, f->spacing, lo, hi);
        for (int k = lo[2]; k <= hi[2]; k++)
            for (int j = lo[1]; j <= hi[1]; j++) {
                double x;
                if (meets(corner + 3 * t, f->origin.y + j * f->spacing + aside_y,
                          f->origin.z + k * f->spacing + aside_z, &x))
                    cross_line(&line[j + ny * k], x);
            }
    }
    for (int k = 0; k < nz; k++)
        for (int j = 0; j < ny; j++) {
            struct crossings *const c = &line[j + ny * k];
            if (c->n > 0)
                qsort(c->x, (size_t)c->n, sizeof *c->x, by_value);
            closed = closed && c->n % 2 == 0;
            for (int i = 0, m = 0; i < nx; i++) {
                while (m < c->n && c->x[m] < f->origin.x + i * f->spacing)
                    m++;
                if (m % 2 == 1)
                    f->value[node(f, i, j, k)] *= -1.0f;
            }
            xfree(c->x);
        }
    xfree(line);
    return closed;
}

struct distance_field *distance_of_triangles(const vec3 *corner, int n, int across, char **why)
{
    vec3 lo = corner[0], hi = corner[0];
    for (int k = 1; k < 3 * n; k++) {
        lo = v3(fmin(lo.x, corner[k].x), fmin(lo.y, corner[k].y), fmin(lo.z, corner[k].z));
        hi = v3(fmax(hi.x, corner[k].x), fmax(hi.y, corner[k].y), fmax(hi.z, corner[k].z));
    }
    const vec3 size = v3_sub(hi, lo);
    const double h = fmax(size.x, fmax(size.y, size.z)) / (across - 1);
    int nodes[3];
    for (int a = 0; a < 3; a++)
        nodes[a] = (int)ceil(at(size, a) / h) + 1 + 2 * MARGIN;
    struct distance_field *const f =
        distance_new(nodes, h, v3_axpy(lo, -MARGIN * h, v3(1.0, 1.0, 1.0)));
    const size_t total = (size_t)nodes[0] * (size_t)nodes[1] * (size_t)nodes[2];
    double *const d = xalloc(total, sizeof *d);
    unsigned char *const exact = xalloc(total, 1);
    for (size_t m = 0; m < total; m++)
        d[m] = 1e30;
    band(f, corner, n, d);
    for (size_t m = 0; m < total; m++) {
        exact[m] = d[m] < BAND * BAND * h * h;
        d[m] = exact[m] ? sqrt(d[m]) : 1e30;
    }
    for (int pass = 0; pass < 16; pass++)
        sweep(f, d, exact, pass % 8);
    for (size_t m = 0; m < total; m++)
        f->value[m] = (float)d[m];
    xfree(d);
    xfree(exact);
    if (signs(f, corner, n)) {
        distance_make_spline(f);
        return f;
    }
    *why = xprintf("the surface is not closed");
    distance_free(f);
    return NULL;
}
