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
#include "ball_mesh.h"
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
    vec3 *const c = ball_mesh(N, n);
    for (int k = 0; k < 3 * *n; k++)
        c[k] = v3_add(v3(3, 2, 1), mat3_turn(&m, v3(c[k].x, 0.8 * c[k].y, 0.6 * c[k].z)));
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

/* What a pair's points add up to for a law F(depth) = depth^1.5: over that of the depth 1. */
struct felt {
    int n;
    double depth, share;
    vec3 force, torque; /* about x_i */
};

static struct felt feel(const struct field_placed *i, const struct field_placed *j, vec3 apart,
                        double reach)
{
    enum { MOST = 32 };
    struct field_touch f[MOST];
    double clear;
    struct felt all = {.n = field_meet(i, j, apart, reach, MOST, f, &clear)};
    for (int k = 0; k < all.n; k++) {
        const double part = f[k].share * f[k].slope * pow(fabs(f[k].depth), 1.5);
        all.depth = f[k].depth;
        all.share += f[k].share;
        all.force = v3_axpy(all.force, part, f[k].normal);
        all.torque = v3_axpy(all.torque, part, v3_cross(f[k].at, f[k].normal));
    }
    return all;
}

/* Forces at overlaps of 2 % of the size against Hertz' with the radii of curvature that there are: mean
 * of the relative error. */
static double pair_error(const struct field_body *b, double *normal, double *place)
{
    const struct superquadric s = exact(b);
    double sum = 0;
    enum { PAIRS = 30 };
    *normal = *place = 0;
    for (int k = 0; k < PAIRS; k++) {
        const struct field_placed i = {.body = b, .size = 1, .turn = turn()};
        const struct field_placed j = {.body = b, .size = 0.7, .turn = turn()};
        const struct superquadric_placed si = {.shape = &s, .size = 1, .turn = i.turn};
        const struct superquadric_placed sj = {.shape = &s, .size = 0.7, .turn = j.turn};
        struct superquadric_touch t = {.normal = {0, 0, 0}};
        const struct mat3 m = turn();
        vec3 apart = v3_scale(3, m.row[0]);
        for (int step = 0; step < 30; step++) {
            superquadric_meet(&si, &sj, apart, 10, &t);
            apart = v3_axpy(apart, -(t.gap + 0.02), t.normal);
        }
        superquadric_meet(&si, &sj, apart, 10, &t);
        const struct felt f = feel(&i, &j, apart, 0);
        const double force = v3_norm(f.force), of_depth = sqrt(0.7 / 1.7);
        const vec3 way = v3_scale(1 / force, f.force);
        const vec3 arm = v3_axpy(t.at_i, -0.5 * t.gap, t.normal);
        sum += fabs(of_depth * force / (sqrt(t.r_eff) * pow(-t.gap, 1.5)) - 1) / PAIRS;
        *normal += v3_norm(v3_sub(way, t.normal)) / PAIRS;
        *place += v3_norm(v3_sub(v3_scale(1 / force, f.torque), v3_cross(arm, way))) / PAIRS;
    }
    return sum;
}

static void test_pairs(void)
{
    double last = 1;
    for (int fine = 0; fine < 2; fine++) {
        struct field_body *const b = body(32 << fine, 0.08 / (1 << fine));
        double normal, place;
        const double e = pair_error(b, &normal, &place);
        check(e < last && e < (fine == 0   ? 0.6
                               : fine == 1 ? 0.2
                                           : 0.05),
              "overlaps of 0.02 sizes, %d nodes: force to %.1e of Hertz', normal %.1e, place "
              "%.1e",
              b->n, e, normal, place);
        check(normal < 0.05 && place < 0.05, "normals and places");
        last = e;
        field_body_free(b);
    }
}

/* The force of any law is the gradient of its energy: of depth^2.5 by differences, as the bodies move and
 * turn. */
static void test_potential(void)
{
    struct field_body *const b = body(40, 0.06);
    double worst = 0, least = INFINITY;
    int met = 0;
    for (int k = 0; k < 200 && met < 60; k++) {
        const double h = 1e-6;
        const struct field_placed i = {.body = b, .size = 1, .turn = turn()},
                                  j = {.body = b, .size = 0.8, .turn = turn()};
        const struct mat3 way = turn(), other = turn();
        const vec3 apart = v3_scale(uniform(1.3, 1.75), way.row[0]), axis = other.row[1];
        const struct felt f = feel(&i, &j, apart, 0);
        if (f.n == 0 || f.depth > 0.3)
            continue;
        met++;
        least = fmin(least, f.depth);
        double energy[2], moved[2];
        for (int side = 0; side < 2; side++) {
            const double by = side ? h : -h;
            struct field_placed more = i;
            const struct mat3 small = quat_matrix(quat_unit(
                (struct quat){1, 0.5 * by * axis.x, 0.5 * by * axis.y, 0.5 * by * axis.z}));
            const struct mat3 back = mat3_transposed(&small);
            more.turn = mat3_between(&back, &i.turn);
            energy[side] = 0.4 * pow(feel(&more, &j, apart, 0).depth, 2.5);
            moved[side] = 0.4 * pow(feel(&i, &j, v3_axpy(apart, by, axis), 0).depth, 2.5);
        }
        const double unit = v3_norm(f.force);
        worst =
            fmax(worst, fabs((moved[0] - moved[1]) / (2 * h) - v3_dot(f.force, axis)) / unit);
        worst = fmax(worst,
                     fabs((energy[0] - energy[1]) / (2 * h) - v3_dot(f.torque, axis)) / unit);
    }
    check(met > 50 && worst < 1e-5,
          "%d pairs, depths from %.1e: force and torque are the gradient of the energy to %.1e",
          met, least, worst);
    field_body_free(b);
}

static void test_frames(void)
{
    struct field_body *const b = body(40, 0.06);
    double turned = 0, swapped = 0, near = 0, share = 0;
    int met = 0;
    for (int k = 0; k < 300; k++) {
        struct field_placed i = {.body = b, .size = 1, .turn = turn()}, ti = i;
        struct field_placed j = {.body = b, .size = 0.8, .turn = turn()}, tj = j;
        const struct mat3 frame = turn(), back = mat3_transposed(&frame), way = turn();
        const vec3 apart = v3_scale(uniform(1.4, 1.9), way.row[0]);
        ti.turn = mat3_between(&back, &i.turn);
        tj.turn = mat3_between(&back, &j.turn);
        const struct felt f = feel(&i, &j, apart, 0.2);
        const struct felt g = feel(&ti, &tj, mat3_turn(&frame, apart), 0.2);
        const struct felt h = feel(&j, &i, v3_scale(-1, apart), 0.2);
        if (f.n < 1)
            continue;
        const double unit = v3_norm(f.force);
        met++;
        turned += g.n != f.n;
        swapped += h.n != f.n;
        share = fmax(share, fabs(f.share - 1));
        turned =
            fmax(turned, v3_norm(v3_sub(mat3_turn(&frame, f.force), g.force)) / unit +
                             v3_norm(v3_sub(mat3_turn(&frame, f.torque), g.torque)) / unit +
                             fabs(f.depth - g.depth));
        /* torque about x_j, and the opposite force */
        const vec3 about = v3_add(f.torque, v3_cross(apart, f.force));
        swapped = fmax(swapped, v3_norm(v3_add(f.force, h.force)) / unit +
                                    v3_norm(v3_add(about, h.torque)) / unit +
                                    fabs(f.depth - h.depth));
        near += f.depth < 0;
    }
    check(met > 100 && near > 10, "%d pairs meet, %g of them with a gap", met, near);
    check(share < 1e-12, "their shares add up to 1 within %.1e", share);
    check(turned < 1e-9, "turned as a whole: the same to %.1e", turned);
    check(swapped < 1e-9, "exchanged: opposite to %.1e", swapped);
    field_body_free(b);
}

int main(void)
{
    rng = gsl_rng_alloc(gsl_rng_mt19937);
    test_mass();
    test_pairs();
    test_potential();
    test_frames();
    gsl_rng_free(rng);
    return check_end();
}
