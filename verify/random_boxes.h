/* random_boxes.h - boxes at random places with random turns that do not overlap: where grains of any shape
 * can fall from, each in the box about it.
 *
 * Random sequential addition; two boxes by their separating axes [GottschalkLinManocha96]. Lengths
 * in any one unit. */
#ifndef RANDOM_BOXES_H
#define RANDOM_BOXES_H

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <stdbool.h>
#include <stdio.h>
#include "../solver/base.h"
#include "../solver/rotation.h"

enum { BOX_NEAR = 27, BOX_TRIES = 100000 };

/* What a box is like, and where it may be: from the origin up. */
struct box_kind {
    double half[3];
    vec3 offset; /* of its middle from the grain's centre, in the grain's frame */
    double base, height;
};

struct box {
    vec3 x, middle; /* x: the grain's centre */
    struct quat q;
    vec3 axis[3];
};

static inline double box_spread(const struct box_kind *k, const struct box *b, vec3 n)
{
    double s = 0.0;
    for (int a = 0; a < 3; a++)
        s += k->half[a] * fabs(v3_dot(b->axis[a], n));
    return s;
}

static inline bool box_parts(const struct box_kind *k, const struct box *a, const struct box *b,
                             vec3 n)
{
    return fabs(v3_dot(v3_sub(a->middle, b->middle), n)) >
           box_spread(k, a, n) + box_spread(k, b, n);
}

static inline bool boxes_overlap(const struct box_kind *k, const struct box *a,
                                 const struct box *b)
{
    for (int m = 0; m < 3; m++)
        if (box_parts(k, a, b, a->axis[m]) || box_parts(k, a, b, b->axis[m]))
            return false;
    for (int m = 0; m < 9; m++) {
        const vec3 n = v3_cross(a->axis[m / 3], b->axis[m % 3]);
        if (v3_dot(n, n) > 1e-12 && box_parts(k, a, b, n))
            return false;
    }
    return true;
}

/* Cells as wide as a box is long, each with a list of boxes. */
struct box_cells {
    int n[3], *first, *next;
    double edge;
};

static inline int box_cell(const struct box_cells *c, vec3 x, int dx, int dy, int dz)
{
    const int i = (int)(x.x / c->edge) + dx, j = (int)(x.y / c->edge) + dy,
              k = (int)(x.z / c->edge) + dz;
    return i < 0 || j < 0 || k < 0 || i >= c->n[0] || j >= c->n[1] || k >= c->n[2]
               ? -1
               : (k * c->n[1] + j) * c->n[0] + i;
}

static inline bool box_has_room(const struct box_kind *kind, const struct box_cells *c,
                                const struct box *all, const struct box *b)
{
    for (int k = 0; k < BOX_NEAR; k++) {
        const int cell = box_cell(c, b->middle, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        for (int m = cell < 0 ? -1 : c->first[cell]; m >= 0; m = c->next[m])
            if (boxes_overlap(kind, b, &all[m]))
                return false;
    }
    return true;
}

static inline struct box box_draw(gsl_rng *rng, const struct box_kind *k)
{
    double q[4];
    gsl_ran_dir_nd(rng, 4, q);
    struct box b = {.q = {q[0], q[1], q[2], q[3]}};
    const struct mat3 turn = quat_matrix(b.q);
    for (int a = 0; a < 3; a++)
        b.axis[a] = mat3_turn(&turn, v3(a == 0, a == 1, a == 2));
    const double wx = box_spread(k, &b, v3(1, 0, 0)), wy = box_spread(k, &b, v3(0, 1, 0)),
                 wz = box_spread(k, &b, v3(0, 0, 1));
    b.middle = v3(gsl_ran_flat(rng, wx, k->base - wx), gsl_ran_flat(rng, wy, k->base - wy),
                  gsl_ran_flat(rng, wz, k->height - wz));
    b.x = v3_sub(b.middle, mat3_turn(&turn, k->offset));
    return b;
}

/* Lines for fill = file: places moved by `origin`, times `unit` (m), the diameter (m), the turn. False: not
 * all have found room. */
static inline bool boxes_place(const struct box_kind *k, int count, unsigned long seed,
                               vec3 origin, double unit, double diameter, FILE *f)
{
    const double *const half = k->half;
    struct box_cells c = {
        .edge = 2.0 * sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2])};
    struct box *const all = xalloc((size_t)count + 1, sizeof *all);
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    int n = 0;
    gsl_rng_set(rng, seed);
    c.n[0] = c.n[1] = (int)(k->base / c.edge) + 1;
    c.n[2] = (int)(k->height / c.edge) + 1;
    const int n_cells = c.n[0] * c.n[1] * c.n[2];
    c.first = xalloc((size_t)n_cells, sizeof *c.first);
    c.next = xalloc((size_t)count + 1, sizeof *c.next);
    for (int m = 0; m < n_cells; m++)
        c.first[m] = -1;
    for (int tries = 0; n < count && tries < BOX_TRIES; tries++) {
        const struct box b = all[n] = box_draw(rng, k);
        if (!box_has_room(k, &c, all, &b))
            continue;
        const int cell = box_cell(&c, b.middle, 0, 0, 0);
        const vec3 x = v3_scale(unit, v3_add(b.x, origin));
        fprintf(f, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", x.x, x.y, x.z, diameter, b.q.w,
                b.q.x, b.q.y, b.q.z);
        c.next[n] = c.first[cell];
        c.first[cell] = n++;
        tries = 0;
    }
    gsl_rng_free(rng);
    xfree(c.first);
    xfree(c.next);
    xfree(all);
    return n == count;
}

#endif
