/* verify/test_volume_parts.c - the volume of a shaped body on the grid by parts of it.
 *
 * A ball in parts against its exact shares, and blocky bodies against ten times finer parts, in
 * cells of a quarter of the diameter and smaller and larger ones: the largest error of a cell over
 * the body's volume. Volume, centre and inertia of the parts. Between walls, wrapped, in a box one
 * cell thick: shares sum to 1 and name interior cells. */
#include <gsl/gsl_rng.h>
#include <stdlib.h>
#include <string.h>
#include "../solver/base.h"
#include "../solver/shares.h"
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

static double depth(const void *body, vec3 x)
{
    return -superquadric_inside(body, x);
}

/* A body of the volume of the unit ball. */
static struct superquadric body(double blockiness)
{
    struct superquadric s;
    double axes[3] = {1, 1, 1};
    if (blockiness > 2) {
        axes[1] = 1.3;
        axes[2] = 0.8;
    }
    superquadric_set(&s, axes, blockiness, blockiness);
    const double f = cbrt(4.0 / 3.0 * PI / superquadric_volume(&s));
    for (int k = 0; k < 3; k++)
        axes[k] *= f;
    superquadric_set(&s, axes, blockiness, blockiness);
    return s;
}

static struct parts cut(const struct superquadric *s, double spacing)
{
    const vec3 hi = v3(s->a[0], s->a[1], s->a[2]), centre = v3(0, 0, 0);
    return volume_parts(depth, s, v3_scale(-1.0, hi), hi, spacing, &centre);
}

static void test_moments(double blockiness)
{
    const struct superquadric s = body(blockiness);
    struct parts p = cut(&s, 2.0 / 12);
    double sum = 0, inertia[3], zz = 0;
    vec3 centre = v3(0, 0, 0);
    superquadric_inertia(&s, inertia);
    for (int k = 0; k < p.n; k++) {
        const double own = 2.0 / 3.0 * p.half[k] * p.half[k];
        sum += p.weight[k];
        centre = v3_axpy(centre, p.weight[k], p.at[k]);
        zz += p.weight[k] * (p.at[k].x * p.at[k].x + p.at[k].y * p.at[k].y + own);
    }
    check_abs(sum, 1, 1e-13, "weights of parts");
    check_abs(v3_norm(centre), 0, 1e-14, "their centre");
    check_rel(zz, inertia[2] / superquadric_volume(&s), 3e-3, "their inertia about z");
    parts_free(&p);
}

static double error_of(const struct grid *g, const struct share *a, int n,
                       const struct share *b, int m, double *field)
{
    double most = 0;
    for (int k = 0; k < n; k++)
        field[a[k].cell] += a[k].weight;
    for (int k = 0; k < m; k++)
        field[b[k].cell] -= b[k].weight;
    for (size_t c = 0; c < g->total; c++) {
        most = fmax(most, fabs(field[c]));
        field[c] = 0;
    }
    return most;
}

/* Largest error of a cell of h diameters, by parts of the diameter over `across`. */
static double grid_error(const struct superquadric *s, double h, double across)
{
    struct domain d = {.size = {2.4, 2.4, 2.4}, .periodic = {true, true, true}};
    const int n = (int)(2.4 / h + 0.5);
    struct grid g = {.n = {n, n, n},
                     .h = {h, h, h},
                     .volume = h * h * h,
                     .sj = n + 2,
                     .sk = (n + 2) * (n + 2),
                     .total = (size_t)((n + 2) * (n + 2) * (n + 2))};
    struct parts p = cut(s, 2.0 / across);
    struct parts fine = {0};
    if (!s->ellipsoid)
        fine = cut(s, 2.0 / 50);
    double *const field = xalloc(g.total, sizeof *field), worst = 0;
    const int room = shares_ball_most(&g, 1.0);
    struct share *const a = xalloc((size_t)room, sizeof *a), *const b = xalloc((size_t)room,
                                                                               sizeof *b);
    for (int k = 0; k < 8; k++) {
        const vec3 x = v3(uniform(0, 2.4), uniform(0, 2.4), uniform(0, 2.4));
        const struct mat3 m = turn();
        const int na = shares_parts(&g, &d, &p, x, &m, 0.5, a);
        const int nb = s->ellipsoid ? shares_ball(&g, &d, x, 0.5, b)
                                    : shares_parts(&g, &d, &fine, x, &m, 0.5, b);
        worst = fmax(worst, error_of(&g, a, na, b, nb, field));
    }
    xfree(a);
    xfree(b);
    xfree(field);
    parts_free(&p);
    parts_free(&fine);
    return worst;
}

static void test_error(double blockiness)
{
    const struct superquadric s = body(blockiness);
    double last = 1;
    for (double across = 6; across <= 24; across *= 2) {
        const double e = grid_error(&s, 0.25, across);
        check(e < (across < 12 ? 5e-3 : 1e-3) && e < last,
              "blockiness %g, cells of a quarter, %2g parts across: a cell is wrong by %.1e of "
              "the "
              "body at most",
              blockiness, across, e);
        last = e;
    }
    const double wide = grid_error(&s, 1.2, 12), small = grid_error(&s, 0.1, 12);
    check(wide < 2e-3 && small < 1e-3,
          "cells of 1.2 and of 0.1 diameters, 12 parts: %.1e, %.1e", wide, small);
}

/* Shares in boxes with walls and one cell thick. */
static void test_sides(void)
{
    const struct superquadric s = body(6);
    struct parts p = cut(&s, 2.0 / 8);
    bool good = true;
    double off = 0;
    for (int k = 0; k < 60; k++) {
        struct domain d = {.size = {1, 1, 1}};
        struct grid g = {.n = {1 + k % 7, 4, 5}};
        for (int a = 0; a < 3; a++) {
            d.periodic[a] = k >> a & 1;
            g.h[a] = 1.0 / g.n[a];
        }
        g.sj = g.n[0] + 2;
        g.sk = g.sj * (g.n[1] + 2);
        g.total = (size_t)(g.sk * (g.n[2] + 2));
        const double size = uniform(0.05, 0.45);
        const int room = shares_parts_most(&g, size * p.reach);
        struct share *const out = xalloc((size_t)room, sizeof *out);
        const struct mat3 m = turn();
        const int n = shares_parts(&g, &d, &p, v3(uniform(0, 1), uniform(0, 1), uniform(0, 1)),
                                   &m, size, out);
        double sum = 0;
        for (int c = 0; c < n; c++) {
            const int at = out[c].cell, z = at / g.sk, y = at % g.sk / g.sj, x = at % g.sj;
            good = good && x >= 1 && x <= g.n[0] && y >= 1 && y <= g.n[1] && z >= 1 &&
                   z <= g.n[2] && out[c].weight >= 0;
            sum += out[c].weight;
        }
        good = good && n <= room;
        off = fmax(off, fabs(sum - 1));
        xfree(out);
    }
    check(good && off < 1e-14,
          "beside walls, wrapped, one cell thick: interior cells, sum 1 to %.1e", off);
    parts_free(&p);
}

int main(void)
{
    rng = gsl_rng_alloc(gsl_rng_mt19937);
    test_moments(2);
    test_moments(8);
    test_error(2);
    test_error(8);
    test_sides();
    gsl_rng_free(rng);
    return check_end();
}
