/* disc_union.c - integrals over the union of discs, by Green's theorem along the arcs that bound it,
 *   area = 1/2 cycle (x dy - y dx),  int x^2 = 1/3 cycle x^3 dy,  int x y = 1/2 cycle x^2 y dy, ...
 * each arc by Gauss' rule (its integrands are trigonometric polynomials); and over the union of
 * balls, by slices: between heights where the picture changes (a ball begins or ends, two or three
 * meet) the slices' integrals are smooth but for roots at the ends, which z = a + (b - a)(1 - cos
 * t)/2 takes away. The area of the surface is that of the arcs: a slice of a ball's surface of
 * thickness dz has R dz for each radian, as Archimedes knew. */
#include "disc_union.h"

#include <gsl/gsl_integration.h>
#include <stdbool.h>
#include <stdlib.h>
#include "base.h"

#define PI 3.14159265358979323846

enum { ARC_POINTS = 10, SLICE_POINTS = 48, TRIPLES_MOST = 40 };

struct span {
    double from, to; /* rad */
};

static int by_start(const void *a, const void *b)
{
    const struct span *const x = a, *const y = b;
    return x->from < y->from ? -1 : x->from > y->from;
}

/* The part of disc i's rim inside disc j: 0 none, 1 the span, 2 all. Of two that are one, the first
 * has the rim. */
static int covered(const struct disc *i, const struct disc *j, bool first, struct span *s)
{
    const double dx = j->x - i->x, dy = j->y - i->y, d2 = dx * dx + dy * dy, d = sqrt(d2);
    if (d >= i->r + j->r || d + j->r < i->r)
        return 0;
    if (d + i->r < j->r || (d == 0.0 && i->r == j->r))
        return d == 0.0 && i->r == j->r ? (first ? 0 : 2) : 2;
    if (d == 0.0)
        return 0;
    const double cosine = (d2 + i->r * i->r - j->r * j->r) / (2.0 * d * i->r);
    const double half = acos(fmin(fmax(cosine, -1.0), 1.0)), middle = atan2(dy, dx);
    *s = (struct span){middle - half, middle + half};
    return 1;
}

/* Adds the integrals along the arc from a to b of a disc. */
static void add_arc(struct disc_union *u, const struct disc *d, double a, double b,
                    const gsl_integration_glfixed_table *gauss)
{
    const int parts = 1 + (int)((b - a) / (0.5 * PI));
    for (int p = 0; p < parts; p++) {
        const double lo = a + (b - a) * p / parts, hi = a + (b - a) * (p + 1) / parts;
        for (size_t k = 0; k < ARC_POINTS; k++) {
            double t, w;
            gsl_integration_glfixed_point(lo, hi, k, &t, &w, gauss);
            const double c = cos(t), s = sin(t), x = d->x + d->r * c, y = d->y + d->r * s;
            const double dx = -d->r * s * w, dy = d->r * c * w;
            u->area += 0.5 * (x * dy - y * dx);
            u->x += 0.5 * x * x * dy;
            u->y -= 0.5 * y * y * dx;
            u->xx += x * x * x * dy / 3.0;
            u->yy -= y * y * y * dx / 3.0;
            u->xy += 0.5 * x * x * y * dy;
        }
    }
}

/* The spans of a rim that others cover, cut to [-pi, pi], in order; returns how many, or -1: all. */
static int spans_of(const struct disc *d, int n, int i, struct span *span)
{
    int count = 0;
    for (int j = 0; j < n; j++) {
        struct span s;
        const int how = j == i ? 0 : covered(&d[i], &d[j], i < j, &s);
        if (how == 2)
            return -1;
        if (how == 0)
            continue;
        if (s.from < -PI) {
            span[count++] = (struct span){s.from + 2.0 * PI, PI};
            s.from = -PI;
        }
        if (s.to > PI) {
            span[count++] = (struct span){-PI, s.to - 2.0 * PI};
            s.to = PI;
        }
        span[count++] = s;
    }
    qsort(span, (size_t)count, sizeof *span, by_start);
    return count;
}

static struct disc_union unite(const struct disc *d, int n, double *arc, struct span *span,
                               const gsl_integration_glfixed_table *gauss)
{
    struct disc_union u = {0};
    for (int i = 0; i < n; i++) {
        double at = -PI, open = 0.0;
        const int count = d[i].r > 0.0 ? spans_of(d, n, i, span) : -1;
        for (int k = 0; k <= count; k++) {
            const double next = k < count ? span[k].from : PI;
            if (next > at) {
                add_arc(&u, &d[i], at, next, gauss);
                open += next - at;
            }
            if (k < count)
                at = fmax(at, span[k].to);
        }
        if (arc)
            arc[i] = open;
    }
    return u;
}

struct disc_union disc_union(const struct disc *d, int n, double *arc)
{
    gsl_integration_glfixed_table *const gauss =
        gsl_integration_glfixed_table_alloc(ARC_POINTS);
    struct span *const span = xalloc(3 * (size_t)n + 1, sizeof *span);
    const struct disc_union u = unite(d, n, arc, span, gauss);
    xfree(span);
    gsl_integration_glfixed_table_free(gauss);
    return u;
}

/* Heights at which the picture of the slices changes. */
struct heights {
    int n, room;
    double *z;
};

static void add_height(struct heights *h, double z)
{
    if (h->n == h->room) {
        const int more = 2 * h->room + 64;
        h->z = xrealloc(h->z, (size_t)h->room, (size_t)more, sizeof *h->z);
        h->room = more;
    }
    h->z[h->n++] = z;
}

/* The circle in which two balls meet: centre, unit normal, radius; false: they do not. */
static bool circle_of(const struct ball *a, const struct ball *b, vec3 *centre, vec3 *normal,
                      double *radius)
{
    const vec3 d = v3_sub(b->centre, a->centre);
    const double l = v3_norm(d);
    if (l >= a->r + b->r || l <= fabs(a->r - b->r))
        return false;
    const double h = 0.5 * (l * l + a->r * a->r - b->r * b->r) / l;
    *normal = v3_scale(1.0 / l, d);
    *centre = v3_axpy(a->centre, h, *normal);
    *radius = sqrt(fmax(0.0, a->r * a->r - h * h));
    return true;
}

/* Where the circle goes through the surface of a third ball. */
static void add_triple(struct heights *h, vec3 m, vec3 n, double r, const struct ball *b)
{
    const vec3 d = v3_sub(b->centre, m), flat = v3_axpy(d, -v3_dot(d, n), n);
    const double f = v3_norm(flat);
    if (!(f > 0.0))
        return;
    /* |m + r e - c|^2 = R^2 with e . flat/f = cosine */
    const double cosine = (v3_dot(d, d) + r * r - b->r * b->r) / (2.0 * r * f);
    if (fabs(cosine) > 1.0)
        return;
    const vec3 e = v3_scale(1.0 / f, flat), g = v3_cross(n, e);
    const double sine = sqrt(1.0 - cosine * cosine);
    add_height(h, m.z + r * (cosine * e.z + sine * g.z));
    add_height(h, m.z + r * (cosine * e.z - sine * g.z));
}

static struct heights heights_of(const struct ball *b, int n)
{
    struct heights h = {0};
    for (int i = 0; i < n; i++) {
        add_height(&h, b[i].centre.z - b[i].r);
        add_height(&h, b[i].centre.z + b[i].r);
        for (int j = i + 1; j < n; j++) {
            vec3 m, normal;
            double r;
            if (!circle_of(&b[i], &b[j], &m, &normal, &r))
                continue;
            const double rise = r * sqrt(fmax(0.0, 1.0 - normal.z * normal.z));
            add_height(&h, m.z - rise);
            add_height(&h, m.z + rise);
            for (int k = j + 1; k < n && n <= TRIPLES_MOST; k++)
                add_triple(&h, m, normal, r, &b[k]);
        }
    }
    return h;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Integrals of 1, x, y, z, xx, yy, zz, xy, yz, zx; and the area of the surface. */
enum { ONE, X, Y, Z, XX, YY, ZZ, XY, YZ, ZX, SURFACE, INTEGRALS };

static void add_slice(const struct ball *b, int n, double z, double w, struct disc *d,
                      double *arc, struct span *span,
                      const gsl_integration_glfixed_table *gauss, double sum[INTEGRALS])
{
    for (int i = 0; i < n; i++) {
        const double h = z - b[i].centre.z, square = b[i].r * b[i].r - h * h;
        d[i] = (struct disc){b[i].centre.x, b[i].centre.y, square > 0.0 ? sqrt(square) : 0.0};
    }
    const struct disc_union u = unite(d, n, arc, span, gauss);
    const double part[INTEGRALS] = {u.area,         u.x,  u.y,     z * u.area, u.xx, u.yy,
                                    z * z * u.area, u.xy, z * u.y, z * u.x,    0.0};
    for (int k = 0; k < SURFACE; k++)
        sum[k] += w * part[k];
    for (int i = 0; i < n; i++)
        sum[SURFACE] += w * b[i].r * arc[i];
}

struct ball_union ball_union(const struct ball *b, int n)
{
    gsl_integration_glfixed_table *const arcs = gsl_integration_glfixed_table_alloc(ARC_POINTS);
    gsl_integration_glfixed_table *const slices =
        gsl_integration_glfixed_table_alloc(SLICE_POINTS);
    struct heights h = heights_of(b, n);
    struct span *const span = xalloc(3 * (size_t)n + 1, sizeof *span);
    struct disc *const d = xalloc((size_t)n + 1, sizeof *d);
    double *const arc = xalloc((size_t)n + 1, sizeof *arc);
    double s[INTEGRALS] = {0.0};
    qsort(h.z, (size_t)h.n, sizeof *h.z, ascending);
    for (int p = 0; p + 1 < h.n; p++) {
        const double a = h.z[p], width = h.z[p + 1] - a;
        if (!(width > 1e-14 * (h.z[h.n - 1] - h.z[0])))
            continue;
        for (size_t k = 0; k < SLICE_POINTS; k++) {
            double t, w;
            gsl_integration_glfixed_point(0.0, PI, k, &t, &w, slices);
            add_slice(b, n, a + 0.5 * width * (1.0 - cos(t)), 0.5 * width * sin(t) * w, d, arc,
                      span, arcs, s);
        }
    }
    xfree(h.z);
    xfree(span);
    xfree(d);
    xfree(arc);
    gsl_integration_glfixed_table_free(arcs);
    gsl_integration_glfixed_table_free(slices);
    const double v = s[ONE];
    const vec3 c = v3(s[X] / v, s[Y] / v, s[Z] / v);
    const double xx = s[XX] - v * c.x * c.x, yy = s[YY] - v * c.y * c.y,
                 zz = s[ZZ] - v * c.z * c.z;
    return (struct ball_union){.volume = v,
                               .area = s[SURFACE],
                               .centre = c,
                               .inertia = {yy + zz, zz + xx, xx + yy, v * c.x * c.y - s[XY],
                                           v * c.y * c.z - s[YZ], v * c.z * c.x - s[ZX]}};
}
