/* verify/test_polyhedron.c - hulls, exact moments of cores and of dilated polyhedra: boxes and
 * tetrahedra, Steiner's formula, a body cut in two, sums over random points. */
#include <stdlib.h>
#include "../shapes/geometry/distance.h"
#include "polyhedra.h"

static void check_box(void)
{
    const vec3 a = {1.31, 0.57, 2.23}, at = {0.3, -0.2, 5.1};
    struct polyhedron *const p = box_of(a, at);
    struct moments m = {0.0};
    double inertia[3];
    vec3 centre, axes[3];
    check(p->n_vertices == 8 && p->n_faces == 6 && p->n_edges == 12,
          "a box has 8 vertices, 6 faces, 12 edges: %d %d %d", p->n_vertices, p->n_faces,
          p->n_edges);
    moments_of_core(&m, p);
    moments_principal(&m, &centre, inertia, axes);
    const double v = a.x * a.y * a.z;
    check_rel(m.volume, v, 1e-14, "volume of a box");
    check_rel(v3_norm(v3_sub(centre, at)) + 1.0, 1.0, 1e-14, "centre of a box");
    check_rel(inertia[0], v * (a.x * a.x + a.y * a.y) / 12.0, 1e-12, "inertia of a box, least");
    check_rel(inertia[1], v * (a.y * a.y + a.z * a.z) / 12.0, 1e-12,
              "inertia of a box, middle");
    check_rel(inertia[2], v * (a.x * a.x + a.z * a.z) / 12.0, 1e-12, "inertia of a box, most");
    const double r = 0.173, s = 2.0 * (a.x * a.y + a.y * a.z + a.x * a.z);
    const double want = v + s * r + PI * r * r * (a.x + a.y + a.z) + 4.0 / 3.0 * PI * r * r * r;
    check_rel(polyhedron_steiner(p, r), want, 1e-14, "Steiner's formula for a box");
    check_rel(polyhedron_surface(p, r), s + 2.0 * PI * r * (a.x + a.y + a.z) + 4.0 * PI * r * r,
              1e-14, "surface of a dilated box");
    polyhedron_free(p);
}

/* [Tonon04]: a tetrahedron at any place, I_xx = V/10 (sum over i <= j of y_i y_j + z_i z_j). */
static void check_tetrahedron(void)
{
    const vec3 c[4] = {{8.33220, -11.86875, 0.93355},
                       {0.75523, 5.0, 16.37072},
                       {52.61236, 5.0, -5.38580},
                       {2.0, 5.0, 3.0}};
    struct polyhedron *const p = hull_of(c, 4);
    struct moments m = {0.0};
    double inertia[3];
    vec3 centre, axes[3], want = {0.0, 0.0, 0.0};
    moments_of_core(&m, p);
    moments_principal(&m, &centre, inertia, axes);
    for (int k = 0; k < 4; k++)
        want = v3_axpy(want, 0.25, c[k]);
    check_rel(v3_norm(v3_sub(centre, want)) + 1.0, 1.0, 1e-13, "centre of a tetrahedron");
    double xx = 0.0, yy = 0.0, zz = 0.0;
    for (int i = 0; i < 4; i++)
        for (int j = i; j < 4; j++) {
            const vec3 a = v3_sub(c[i], want), b = v3_sub(c[j], want);
            xx += a.x * b.x;
            yy += a.y * b.y;
            zz += a.z * b.z;
        }
    /* the trace is free of the axes */
    check_rel(inertia[0] + inertia[1] + inertia[2], m.volume / 10.0 * 2.0 * (xx + yy + zz),
              1e-12, "trace of a tetrahedron's inertia");
    const vec3 e1 = axes[0];
    check_rel(v3_norm(v3_cross(axes[0], axes[1])), 1.0, 1e-12,
              "principal axes are at right angles");
    check_rel(v3_dot(v3_cross(axes[0], axes[1]), axes[2]), 1.0, 1e-12, "and right-handed");
    check(v3_norm(e1) > 0.0 && inertia[0] <= inertia[1] && inertia[1] <= inertia[2],
          "moments ascend");
    polyhedron_free(p);
}

static double worst(const struct moments *a, const struct moments *b)
{
    const double scale = a->xx + a->yy + a->zz;
    double w = fabs(a->volume - b->volume) / a->volume;
    w = fmax(w, v3_norm(v3_sub(a->first, b->first)) / (1e-300 + sqrt(a->volume * scale)));
    w = fmax(w,
             fmax(fabs(a->xx - b->xx), fmax(fabs(a->yy - b->yy), fabs(a->zz - b->zz))) / scale);
    return fmax(w, fmax(fabs(a->xy - b->xy), fmax(fabs(a->xz - b->xz), fabs(a->yz - b->yz))) /
                       scale);
}

/* A hull cut by a plane: the moments of the halves add up. Dilated, Steiner's volume comes out as
 * the sum of slabs, sectors and cones; a point-like core gives a ball. */
static void check_clouds(void)
{
    gsl_rng *const r = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(r, 20261125);
    double steiner = 0.0, euler = 0.0;
    for (int trial = 0; trial < 200; trial++) {
        struct polyhedron *const p = cloud_of(r, 5 + trial % 40, v3(1.0, 0.7, 1.3));
        const double d = between(r, 0.0, 0.4);
        struct moments m = {0.0};
        moments_of_dilated(&m, p, d);
        steiner = fmax(steiner, fabs(m.volume / polyhedron_steiner(p, d) - 1.0));
        euler += abs(p->n_vertices - p->n_edges + p->n_faces - 2);
        for (int e = 0; e < p->n_edges; e++)
            euler += p->edge_face[e][0] == p->edge_face[e][1];
        polyhedron_free(p);
    }
    check(steiner < 1e-12,
          "slabs, sectors and cones add up to Steiner's volume, 200 hulls: %.2g", steiner);
    check(euler == 0.0, "V - E + F = 2 and two faces at an edge, 200 hulls");
    struct polyhedron *const tiny = box_of(v3(1e-7, 1e-7, 1e-7), v3(0.4, -0.3, 0.2));
    struct moments a = {0.0}, b = {0.0};
    moments_of_dilated(&a, tiny, 0.5);
    moments_add_ball(&b, v3(0.4, -0.3, 0.2), 0.5);
    check(worst(&b, &a) < 1e-6, "a core of nothing is a ball: %.2g", worst(&b, &a));
    polyhedron_free(tiny);
}

/* The dilated box as bricks: Gauss-Legendre would do; here the exact parts of a box. */
static void check_dilated_inertia(void)
{
    gsl_rng *const r = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(r, 5);
    struct polyhedron *const p = cloud_of(r, 9, v3(1.0, 0.7, 1.3));
    const double d = 0.21;
    struct moments m = {0.0}, g = {0.0};
    const int n = 140;
    const vec3 low = {-0.5 - d, -0.35 - d, -0.65 - d}, high = {0.5 + d, 0.35 + d, 0.65 + d};
    const vec3 h = {(high.x - low.x) / n, (high.y - low.y) / n, (high.z - low.z) / n};
    moments_of_dilated(&m, p, d);
    for (int k = 0; k < n; k++)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                const vec3 x = {low.x + (i + 0.5) * h.x, low.y + (j + 0.5) * h.y,
                                low.z + (k + 0.5) * h.z};
                if (polyhedron_distance(p, x) < d)
                    moments_add_brick(&g, 1.0, x, h);
            }
    check(worst(&m, &g) < 3e-4, "all moments against a grid of %d^3 cells: %.2g", n,
          worst(&m, &g));
    polyhedron_free(p);
}

static void check_refused(void)
{
    char *why = NULL;
    vec3 point[6] = {{0.0}};
    for (int k = 0; k < 6; k++)
        point[k] = v3(cos(k), sin(k), 0.0);
    bool none = polyhedron_hull(point, 6, &why) == NULL;
    check(none && strstr(why, "plane"), "points of a plane are refused: %s", why);
    xfree(why);
    point[2].z = (double)NAN;
    none = polyhedron_hull(point, 6, &why) == NULL;
    check(none && strstr(why, "finite"), "a point that is not finite is refused: %s", why);
    xfree(why);
    point[2].z = 0.0;
    none = polyhedron_hull(point, 3, &why) == NULL;
    check(none && strstr(why, "4"), "three points: %s", why);
    xfree(why);
}

int main(void)
{
    check_box();
    check_tetrahedron();
    check_clouds();
    check_dilated_inertia();
    check_refused();
    return check_end();
}
