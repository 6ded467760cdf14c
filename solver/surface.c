/* surface.c - points of a free surface, and the line through them. */
#include "surface.h"

#include <gsl/gsl_fit.h>
#include "sim.h"

enum { MOST_COLUMNS = 4000 }; /* along a direction */

/* Grains that touch something. */
static unsigned char *resting(const struct sim *s, const struct contact_view *v,
                              const struct surface *f)
{
    unsigned char *const rests = xalloc((size_t)s->grains.n + 1, 1);
    for (int i = 0; f->flying && i < s->grains.n; i++)
        rests[i] = 1;
    for (size_t k = 0; !f->flying && k < v->n; k++) {
        rests[v->seen[k].i] = 1;
        if (v->seen[k].j >= 0)
            rests[v->seen[k].j] = 1;
    }
    return rests;
}

static bool inside(const struct surface *f, vec3 x)
{
    return x.x >= f->from.x && x.x <= f->to.x && x.y >= f->from.y && x.y <= f->to.y &&
           x.z >= f->from.z && x.z <= f->to.z;
}

/* Tops of the columns, x y h. */
static double *find_points(const struct sim *s, const struct contact_view *v,
                           const struct surface *f, int *n)
{
    const double *const size = s->domain.size;
    int columns[2];
    for (int a = 0; a < 2; a++)
        columns[a] = (int)fmin(fmax(1.0, floor(size[a] / f->cell)), MOST_COLUMNS);
    const size_t all = (size_t)columns[0] * (size_t)columns[1];
    int *const highest = xalloc(all, sizeof *highest); /* grain + 1 */
    unsigned char *const rests = resting(s, v, f);
    const struct grains *const g = &s->grains;
    for (int i = 0; i < g->n; i++) {
        const vec3 x = domain_wrap(&s->domain, g->pos[i]);
        const int a = (int)floor(x.x / size[0] * columns[0]);
        const int b = (int)floor(x.y / size[1] * columns[1]);
        if (!rests[i] || !inside(f, x) || g->inv_mass[i] == 0.0 || a < 0 || b < 0 ||
            a >= columns[0] || b >= columns[1])
            continue;
        int *const top = &highest[(size_t)b * (size_t)columns[0] + (size_t)a];
        const double z = g->pos[i].z + g->radius[i];
        if (*top == 0 || z > g->pos[*top - 1].z + g->radius[*top - 1])
            *top = i + 1;
    }
    double *const point = xalloc(3 * all + 1, sizeof *point);
    *n = 0;
    for (size_t k = 0; k < all; k++) {
        if (highest[k] == 0)
            continue;
        const int i = highest[k] - 1;
        const vec3 x = domain_wrap(&s->domain, g->pos[i]);
        double *const p = &point[3 * (*n)++];
        p[0] = x.x; /* the grain's own place: no bias from the width of a column */
        p[1] = x.y;
        p[2] = x.z + g->radius[i];
    }
    xfree(highest);
    xfree(rests);
    return point;
}

static double place_of(const struct surface *f, const double *p)
{
    const double x = p[0] - f->centre[0], y = p[1] - f->centre[1];
    if (f->kind == SURFACE_HEAP)
        return sqrt(x * x + y * y);
    const double a = f->axis == 0 ? x : y;
    return f->kind == SURFACE_RIDGE ? fabs(a) : a;
}

/* Where the mean height over distance falls below `high` and below `low` of its highest. The
 * selection is by distance, not by height of a point, which would flatten the line. */
static void range_of_heap(const struct surface *f, const double *r, const double *h, int n,
                          double range[2])
{
    double most = 0.0;
    for (int k = 0; k < n; k++)
        most = fmax(most, r[k]);
    const int bins = (int)(most / f->cell) + 1;
    double *const sum = xalloc(2 * (size_t)bins, sizeof *sum), *const count = sum + bins;
    for (int k = 0; k < n; k++) {
        const int b = (int)(r[k] / f->cell);
        sum[b] += h[k] - f->base;
        count[b] += 1.0;
    }
    double highest = 0.0;
    for (int b = 0; b < bins; b++)
        if (count[b] > 0.0)
            highest = fmax(highest, sum[b] / count[b]);
    int first = -1, last = bins;
    for (int b = 1; b < bins; b++) {
        if (count[b] == 0.0)
            continue;
        const double mean = sum[b] / count[b];
        if (first < 0 && mean < f->high * highest)
            first = b;
        if (first >= 0 && last == bins && mean < f->low * highest)
            last = b;
    }
    range[0] = first < 0 ? (double)INFINITY : first * f->cell;
    range[1] = last * f->cell;
    xfree(sum);
}

static void range_of_slope(const struct surface *f, const double *r, int n, double range[2])
{
    double lo = (double)INFINITY, hi = -(double)INFINITY;
    for (int k = 0; k < n; k++) {
        lo = fmin(lo, r[k]);
        hi = fmax(hi, r[k]);
    }
    const double half = 0.5 * f->middle * (hi - lo), mid = 0.5 * (lo + hi);
    range[0] = mid - half;
    range[1] = mid + half;
}

static void fit(struct surface *f, const double *r, const double *h, int n,
                const double range[2])
{
    double *const x = xalloc(2 * (size_t)n + 1, sizeof *x), *const y = x + n;
    int m = 0;
    f->angle = f->scatter = (double)NAN;
    f->width = range[1] - range[0];
    for (int k = 0; k < n; k++)
        if (r[k] >= range[0] && r[k] < range[1]) {
            x[m] = r[k];
            y[m++] = h[k];
        }
    f->points = m;
    if (m >= 4) {
        double c0, c1, c00, c01, c11, rest;
        gsl_fit_linear(x, 1, y, 1, (size_t)m, &c0, &c1, &c00, &c01, &c11, &rest);
        const double degrees = atan(c1) * 180.0 / 3.14159265358979323846;
        f->angle = f->kind == SURFACE_SLOPE ? degrees : -degrees;
        f->scatter = sqrt(rest / m);
    }
    xfree(x);
}

double *surface_measure(const struct sim *s, const struct contact_view *v, struct surface *f,
                        int *n)
{
    double *const point = find_points(s, v, f, n);
    double *const r = xalloc(2 * (size_t)*n + 1, sizeof *r), *const h = r + *n;
    double range[2] = {0.0, 0.0};
    f->height = 0.0;
    for (int k = 0; k < *n; k++) {
        r[k] = place_of(f, &point[3 * k]);
        h[k] = point[3 * k + 2];
        f->height = fmax(f->height, h[k] - f->base);
    }
    if (f->kind == SURFACE_SLOPE)
        range_of_slope(f, r, *n, range);
    else
        range_of_heap(f, r, h, *n, range);
    fit(f, r, h, *n, range);
    xfree(r);
    return point;
}
