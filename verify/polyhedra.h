/* verify/polyhedra.h - polyhedra at random places for tests, and a distance by brute force. */
#ifndef POLYHEDRA_H
#define POLYHEDRA_H

#include <gsl/gsl_rng.h>
#include <string.h>
#include "../shapes/geometry/distance.h"
#include "check.h"

static inline struct polyhedron *hull_of(const vec3 *point, int n)
{
    char *why = NULL;
    struct polyhedron *const p = polyhedron_hull(point, n, &why);
    if (!p)
        check(false, "no hull: %s", why);
    return p;
}

static inline struct polyhedron *box_of(vec3 sides, vec3 middle)
{
    vec3 point[8];
    for (int k = 0; k < 8; k++)
        point[k] =
            v3_add(middle, v3((k & 1 ? 0.5 : -0.5) * sides.x, (k & 2 ? 0.5 : -0.5) * sides.y,
                              (k & 4 ? 0.5 : -0.5) * sides.z));
    return hull_of(point, 8);
}

static inline double between(gsl_rng *r, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(r);
}

static inline vec3 any_direction(gsl_rng *r)
{
    for (;;) {
        const vec3 x = {between(r, -1.0, 1.0), between(r, -1.0, 1.0), between(r, -1.0, 1.0)};
        const double s = v3_norm(x);
        if (s < 1.0 && s > 0.1)
            return v3_scale(1.0 / s, x);
    }
}

static inline struct polyhedron *cloud_of(gsl_rng *r, int n, vec3 sides)
{
    vec3 *const point = xalloc((size_t)n, sizeof *point);
    for (int k = 0; k < n; k++)
        point[k] = v3(between(r, -0.5, 0.5) * sides.x, between(r, -0.5, 0.5) * sides.y,
                      between(r, -0.5, 0.5) * sides.z);
    struct polyhedron *const p = hull_of(point, n);
    xfree(point);
    return p;
}

/* Columns of a rotation by any angle about any axis, as the axes of the body in the frame. */
static inline void turn_about(vec3 u, double angle, vec3 axes[3])
{
    const vec3 e[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int k = 0; k < 3; k++)
        axes[k] = v3_add(v3_axpy(v3_scale(cos(angle), e[k]), sin(angle), v3_cross(u, e[k])),
                         v3_scale((1.0 - cos(angle)) * v3_dot(u, e[k]), u));
}

/* The body somewhere else: place and axes; its points in a frame of its own memory. */
struct placed {
    vec3 at, axes[3];
    double x[POLYHEDRON_MOST], y[POLYHEDRON_MOST], z[POLYHEDRON_MOST];
    struct points points;
};

static inline vec3 turned_by(const vec3 axes[3], vec3 x)
{
    return v3_add(v3_scale(x.x, axes[0]), v3_axpy(v3_scale(x.y, axes[1]), x.z, axes[2]));
}

static inline void place(struct placed *b, const struct polyhedron *p)
{
    for (int k = 0; k < p->vertex_room; k++) {
        const vec3 x = v3_add(b->at, turned_by(b->axes, v3(p->x[k], p->y[k], p->z[k])));
        b->x[k] = x.x;
        b->y[k] = x.y;
        b->z[k] = x.z;
    }
    b->points = (struct points){p->vertex_room, b->x, b->y, b->z};
}

static inline double segments_apart(vec3 p, vec3 d, vec3 q, vec3 e)
{
    /* by the least of a convex function of two parts of [0, 1], at corners, sides and inside */
    const vec3 w = v3_sub(p, q);
    const double a = v3_dot(d, d), b = v3_dot(d, e), c = v3_dot(e, e), f = v3_dot(d, w),
                 g = v3_dot(e, w), det = a * c - b * b;
    double least = (double)INFINITY;
    double s[5], t[5];
    int n = 0;
    for (int k = 0; k < 2; k++) {
        s[n] = k;
        t[n++] = fmin(fmax((g + b * k) / c, 0.0), 1.0);
        t[n] = k;
        s[n++] = fmin(fmax((b * k - f) / a, 0.0), 1.0);
    }
    if (det > 1e-14 * a * c) {
        s[n] = (b * g - c * f) / det;
        t[n] = (a * g - b * f) / det;
        n += s[n] >= 0.0 && s[n] <= 1.0 && t[n] >= 0.0 && t[n] <= 1.0;
    }
    for (int k = 0; k < n; k++)
        least = fmin(least, v3_norm(v3_axpy(v3_axpy(w, s[k], d), -t[k], e)));
    return least;
}

static inline double to_face(const struct polyhedron *p, int f, const struct points *x, vec3 v)
{
    const int *const loop = &p->loop[p->loop_begin[f]];
    const int n = p->loop_begin[f + 1] - p->loop_begin[f];
    const vec3 a = points_at(x, loop[0]);
    vec3 normal = v3_cross(v3_sub(points_at(x, loop[1]), a), v3_sub(points_at(x, loop[2]), a));
    normal = v3_scale(1.0 / v3_norm(normal), normal);
    for (int k = 0; k < n; k++) {
        const vec3 b = points_at(x, loop[k]), c = points_at(x, loop[(k + 1) % n]);
        if (v3_dot(v3_cross(normal, v3_sub(c, b)), v3_sub(v, b)) < 0.0)
            return (double)INFINITY;
    }
    return fabs(v3_dot(normal, v3_sub(v, a)));
}

/* Of polyhedra that are apart: the least over all pairs of vertex and face, edge and edge. */
static inline double brute_distance(const struct polyhedron *pa, const struct points *a,
                                    const struct polyhedron *pb, const struct points *b)
{
    double least = (double)INFINITY;
    for (int f = 0; f < pb->n_faces; f++)
        for (int v = 0; v < pa->n_vertices; v++)
            least = fmin(least, to_face(pb, f, b, points_at(a, v)));
    for (int f = 0; f < pa->n_faces; f++)
        for (int v = 0; v < pb->n_vertices; v++)
            least = fmin(least, to_face(pa, f, a, points_at(b, v)));
    for (int i = 0; i < pa->n_edges; i++)
        for (int j = 0; j < pb->n_edges; j++) {
            const vec3 p = points_at(a, pa->edge[i][0]), q = points_at(b, pb->edge[j][0]);
            least = fmin(least, segments_apart(p, v3_sub(points_at(a, pa->edge[i][1]), p), q,
                                               v3_sub(points_at(b, pb->edge[j][1]), q)));
        }
    return least;
}

/* What of one cube touches what of the other. */
enum cubes_meet { FACES, EDGES, CORNER, ANYWHERE, PARALLEL_EDGES, ROD };

static const char *const cubes_meet_name[] = {"face to face",      "edge to edge",
                                              "vertex to face",    "anywhere",
                                              "edges in parallel", "long rod and plate"};

/* Turns cube a so that its face, edge or vertex looks along -z; then the whole pair is turned. */
static inline void set_pair(gsl_rng *r, enum cubes_meet how, double gap, double spread,
                            struct placed *a, struct placed *b)
{
    vec3 first[3], second[3], whole[3], spin[3];
    const double c = 1.0 / sqrt(2.0), h = 0.5;
    double up = h + h;
    turn_about(v3(0.0, 0.0, 1.0), between(r, 0.0, 6.0), spin);
    turn_about(v3(0.0, 0.0, 1.0), 0.0, first);
    turn_about(v3(0.0, 0.0, 1.0), 0.0, second);
    vec3 aside = {between(r, -0.7, 0.7), between(r, -0.7, 0.7), 0.0};
    if (how == EDGES || how == PARALLEL_EDGES) {
        turn_about(v3(1.0, 0.0, 0.0), 0.25 * PI, first);
        turn_about(v3(1.0, 0.0, 0.0), 0.25 * PI, second);
        up = c + c;
        aside = how == EDGES ? v3(between(r, -0.3, 0.3), between(r, -0.3, 0.3), 0.0)
                             : v3(between(r, -0.9, 0.9), 0.0, 0.0);
        if (how == PARALLEL_EDGES)
            turn_about(v3(0.0, 0.0, 1.0), 0.0, spin);
    } else if (how == CORNER) {
        const vec3 diagonal = v3_scale(1.0 / sqrt(3.0), v3(1.0, 1.0, 1.0));
        const vec3 axis = v3_cross(diagonal, v3(0.0, 0.0, -1.0));
        turn_about(v3_scale(1.0 / v3_norm(axis), axis), acos(-diagonal.z), first);
        up = h + 0.5 * sqrt(3.0);
        aside = v3_scale(0.6, aside);
    }
    turn_about(any_direction(r), between(r, 0.0, 3.0), whole);
    for (int k = 0; k < 3; k++) {
        a->axes[k] = turned_by(whole, turned_by(spin, first[k]));
        b->axes[k] = turned_by(whole, second[k]);
    }
    b->at = v3_scale(3.0, any_direction(r));
    a->at = v3_add(b->at,
                   turned_by(whole, v3_add(v3_scale(spread, aside), v3(0.0, 0.0, up + gap))));
}

#endif
