/* verify/test_field_body.c - grains given by distance fields: mass, shadows, balls, and contacts
 * against those of superquadrics, exchanged and turned as a whole. */
#include <gsl/gsl_rng.h>
#include <stdlib.h>
#include <string.h>
#include "../shapes/shape.h"
#include "../solver/base.h"
#include "../solver/field_body.h"
#include "../solver/shadow.h"
#include "../solver/superquadric.h"
#include "../solver/volume_parts.h"
#include "check.h"

static gsl_rng *rng;

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * gsl_rng_uniform(rng);
}

static struct mat3 turn(void)
{
    const double u[4] = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    return quat_matrix(quat_unit((struct quat){u[0], u[1], u[2], u[3]}));
}

/* The ellipsoid x^2 + (y/0.8)^2 + (z/0.6)^2 = 1, moved and turned, as N triangles an octant side. */
static vec3 *ellipsoid(int N, int *n)
{
    const struct mat3 m = quat_matrix(quat_unit((struct quat){0.9, 0.3, -0.2, 0.4}));
    vec3 *const c = xalloc((size_t)(24 * N * N), sizeof *c);
    *n = 0;
    for (int o = 0; o < 8; o++)
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N - i; j++) {
                vec3 p[4];
                for (int k = 0; k < 4; k++) {
                    const int u = i + (k == 1 || k == 3), v = j + (k == 2 || k == 3);
                    p[k] = v3((o & 1 ? -1 : 1) * u, (o & 2 ? -1 : 1) * v,
                              (o & 4 ? -1 : 1) * (N - u - v));
                    p[k] = v3_scale(1 / v3_norm(p[k]), p[k]);
                    p[k] = v3_add(v3(3, 2, 1),
                                  mat3_turn(&m, v3(p[k].x, 0.8 * p[k].y, 0.6 * p[k].z)));
                }
                memcpy(c + 3 * (*n)++, p, 3 * sizeof *p);
                if (i + j + 2 <= N)
                    memcpy(c + 3 * (*n)++, p + 1, 3 * sizeof *p);
            }
    return c;
}

static struct field_body *body(int across, double spacing)
{
    int n;
    char *why = NULL;
    vec3 *const c = ellipsoid(32, &n);
    struct distance_field *const f = distance_of_triangles(c, n, across, &why);
    xfree(c);
    return field_body(f, spacing, &why);
}

/* The same, exactly: principal axes in the order of their moments. */
static struct superquadric exact(const struct field_body *b)
{
    struct superquadric s;
    const double size = cbrt(0.48), all[3] = {1 / size, 0.8 / size, 0.6 / size};
    double axes[3];
    const double inertia[3] = {b->inertia.x, b->inertia.y, b->inertia.z};
    for (int k = 0; k < 3; k++) { /* the longest has the least moment */
        int rank = 0;
        for (int m = 0; m < 3; m++)
            rank += inertia[m] < inertia[k];
        axes[k] = all[rank];
    }
    superquadric_set(&s, axes, 2, 2);
    return s;
}

static void test_mass(void)
{
    struct field_body *const b = body(40, 0.08);
    const struct superquadric s = exact(b);
    double inertia[3], off = 0;
    superquadric_inertia(&s, inertia);
    /* the facets lie inside by up to 1 - cos(pi/128) */
    check_rel(b->volume, 4 * PI / 3 * 0.48, 5e-3, "volume of an ellipsoid in a field");
    check_rel(b->inertia.x, inertia[0] / superquadric_volume(&s), 4e-3, "moment about x");
    check_rel(b->inertia.y, inertia[1] / superquadric_volume(&s), 4e-3, "moment about y");
    check_rel(b->inertia.z, inertia[2] / superquadric_volume(&s), 4e-3, "moment about z");
    check_rel(b->area, superquadric_area(&s), 1e-2, "surface");
    for (int k = 0; k < b->n; k++)
        off = fmax(off, fabs(superquadric_inside(&s, b->at[k])));
    check(off < 5e-3, "its %d nodes to %.1e on the surface, in the frame of its axes", b->n,
          off);
    vec3 *const corner = xalloc(3 * (size_t)b->net->n_triangles, sizeof *corner);
    for (int t = 0; t < 3 * b->net->n_triangles; t++)
        corner[t] = b->net->at[b->net->triangle[t / 3][t % 3]];
    struct shadow *const shadow = shadow_create(corner, b->net->n_triangles, b->bounding);
    off = 0;
    for (int k = 0; k < 200; k++) {
        const struct mat3 m = turn();
        off = fmax(off,
                   fabs(shadow_area(shadow, m.row[0]) / superquadric_shadow(&s, m.row[0]) - 1));
    }
    check(off < 0.03, "shadows to %.1e", off);
    int n;
    double sum = 0;
    struct shape_part *const part = field_body_parts(b, 2.0 / 12, &n);
    for (int k = 0; k < n; k++)
        sum += part[k].volume;
    check_rel(sum, 4 * PI / 3, 1e-13, "parts have the volume");
    xfree(part);
    double out = 0, in = 0;
    for (int k = 0; k < b->n; k++) {
        double best = INFINITY;
        for (int m = 0; m < b->n_balls; m++)
            best = fmin(best, v3_norm(v3_sub(b->at[k], b->ball[m].centre)) - b->ball[m].radius);
        out = fmax(out, best);
        in = fmin(in, best);
    }
    check(out < 0.0101 && in > -0.01, "%d balls cover the nodes: %.1e outside, %.1e inside",
          b->n_balls, out, -in);
    xfree(corner);
    shadow_free(shadow);
    field_body_free(b);
}

/* Depths of contacts at overlaps of 2 % of the size, against the exact ones: mean of the error. */
static double pair_error(const struct field_body *b, double *normal, double *place, int *more)
{
    const struct superquadric s = exact(b);
    double sum = 0;
    enum { PAIRS = 30 };
    *normal = *place = 0;
    *more = 0;
    for (int k = 0; k < PAIRS; k++) {
        const struct field_placed i = {.body = b, .size = 1, .turn = turn()};
        const struct field_placed j = {.body = b, .size = 0.7, .turn = turn()};
        const struct superquadric_placed si = {.shape = &s, .size = 1, .turn = i.turn};
        const struct superquadric_placed sj = {.shape = &s, .size = 0.7, .turn = j.turn};
        struct superquadric_touch t = {.normal = {0, 0, 0}};
        struct field_touch f[8] = {{0}};
        const struct mat3 m = turn();
        vec3 apart = v3_scale(3, m.row[0]);
        for (int step = 0; step < 30; step++) {
            superquadric_meet(&si, &sj, apart, 10, &t);
            apart = v3_axpy(apart, -(t.gap + 0.02), t.normal);
        }
        superquadric_meet(&si, &sj, apart, 10, &t);
        const int n = field_meet(&i, &j, apart, 0, 8, f);
        *more += n != 1;
        sum += fabs(f[0].depth + t.gap) / PAIRS;
        *normal += v3_norm(v3_sub(f[0].normal, t.normal)) / PAIRS;
        *place += v3_norm(v3_sub(f[0].at, v3_axpy(t.at_i, -0.5 * t.gap, t.normal))) / PAIRS;
    }
    return sum;
}

static void test_pairs(void)
{
    double last = 1;
    for (int fine = 0; fine < 2; fine++) {
        struct field_body *const b = body(fine ? 64 : 32, fine ? 0.04 : 0.08);
        double normal, place;
        int more;
        const double e = pair_error(b, &normal, &place, &more);
        check(e < (fine ? 1e-3 : 2.5e-3) && e < last && more == 0,
              "overlaps of 0.02 sizes, %d nodes: depth to %.1e, normal %.1e, place %.1e, %d "
              "pairs not "
              "one contact",
              b->n, e, normal, place, more);
        check(normal < 0.05 && place < 0.05, "normals and places");
        last = e;
        field_body_free(b);
    }
}

static void test_frames(void)
{
    struct field_body *const b = body(40, 0.06);
    double turned = 0, swapped = 0, near = 0;
    int met = 0, several = 0;
    for (int k = 0; k < 300; k++) {
        struct field_placed i = {.body = b, .size = 1, .turn = turn()}, ti = i;
        struct field_placed j = {.body = b, .size = 0.8, .turn = turn()}, tj = j;
        const struct mat3 frame = turn(), back = mat3_transposed(&frame), way = turn();
        const vec3 apart = v3_scale(uniform(1.4, 1.9), way.row[0]);
        struct field_touch f[8], g[8], h[8];
        ti.turn = mat3_between(&back, &i.turn);
        tj.turn = mat3_between(&back, &j.turn);
        const int n = field_meet(&i, &j, apart, 0.2, 8, f);
        const int m = field_meet(&ti, &tj, mat3_turn(&frame, apart), 0.2, 8, g);
        const int o = field_meet(&j, &i, v3_scale(-1, apart), 0.2, 8, h);
        if (n < 1)
            continue;
        met++;
        turned += m != n;
        swapped += o != n;
        if (n > 1) { /* in another order */
            several++;
            continue;
        }
        turned = fmax(turned, v3_norm(v3_sub(mat3_turn(&frame, f[0].normal), g[0].normal)) +
                                  v3_norm(v3_sub(mat3_turn(&frame, f[0].at), g[0].at)) +
                                  fabs(f[0].depth - g[0].depth));
        swapped = fmax(swapped, v3_norm(v3_add(f[0].normal, h[0].normal)) +
                                    v3_norm(v3_sub(v3_add(f[0].at, apart), h[0].at)) +
                                    fabs(f[0].depth - h[0].depth));
        near += f[0].depth < 0;
    }
    check(met > 100 && near > 10 && several < met / 10,
          "%d pairs meet, %g of them with a gap, %d at more than one place", met, near,
          several);
    check(turned < 1e-11, "turned as a whole: the same to %.1e", turned);
    check(swapped < 1e-11, "exchanged: opposite to %.1e", swapped);
    field_body_free(b);
}

int main(void)
{
    rng = gsl_rng_alloc(gsl_rng_mt19937);
    test_mass();
    test_pairs();
    test_frames();
    gsl_rng_free(rng);
    return check_end();
}
