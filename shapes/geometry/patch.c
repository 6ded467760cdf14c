/* shapes/geometry/patch.c - the corners of the gap between two polyhedra, and their shares. */
#include "patch.h"

#include <string.h>

#define PI       3.14159265358979323846
#define UPRIGHT  1e-9 /* cosine below which a face counts as parallel to the normal */
#define INSIDE   1e-9 /* of the size: how far outside of a face a point may lie that is on it */
#define PARALLEL 1e-9 /* sine below which edges do not cross */
#define SAME     1e-6 /* of the size: corners nearer than this are one */
#define NO_SHARE 1e-12

/* Corners of the gap over the plane across the normal. */
struct corners {
    int n, id[PATCH_NEAR];
    double u[PATCH_NEAR], v[PATCH_NEAR], gap[PATCH_NEAR], share[PATCH_NEAR];
    vec3 on_b[PATCH_NEAR];
};

/* Vertices and edges of a body that come near the other one. */
struct rim {
    int n, n_edges;
    int vertex[PATCH_NEAR], edge[PATCH_NEAR];
};

static void add_corner(struct corners *c, int id, double gap, vec3 on_b)
{
    if (c->n == PATCH_NEAR)
        return;
    c->id[c->n] = id;
    c->gap[c->n] = gap;
    c->on_b[c->n++] = on_b;
}

/* Which corners of a body may be the nearest for some slope: not those that rise from the furthest
 * along `out` by more than `tilt` times how far they are aside from the nearest point `at`. Edges: by a
 * height alone. */
struct reach {
    vec3 out, at;
    double tilt, window, size;
    bool met; /* the nearest points are one line across both bodies */
};

static bool may_lead(const struct reach *w, vec3 x, double drop)
{
    const vec3 d = v3_sub(x, w->at);
    const double up = v3_dot(w->out, d), aside = v3_dot(d, d) - up * up;
    return drop <= INSIDE * w->size || drop * drop < w->tilt * w->tilt * aside;
}

static void find_rim(const struct patch_body *b, const struct reach *w, bool edges,
                     struct rim *r)
{
    const struct polyhedron *const p = b->p;
    double h[POLYHEDRON_MOST], most = -1e300;
    for (int k = 0; k < p->n_vertices; k++) {
        h[k] = v3_dot(w->out, points_at(&b->at, k));
        most = h[k] > most ? h[k] : most;
    }
    r->n = r->n_edges = 0;
    for (int k = 0; k < p->n_vertices && r->n < PATCH_NEAR; k++)
        if (h[k] >= most - w->window &&
            (!w->met || may_lead(w, points_at(&b->at, k), most - h[k])))
            r->vertex[r->n++] = k;
    const double low = most - 2.0 * w->window;
    for (int e = 0; e < p->n_edges && edges && r->n_edges < PATCH_NEAR; e++)
        if (h[p->edge[e][0]] >= low && h[p->edge[e][1]] >= low)
            r->edge[r->n_edges++] = e;
}

static vec3 to_own(const struct patch_body *b, vec3 d)
{
    return v3(v3_dot(b->axes[0], d), v3_dot(b->axes[1], d), v3_dot(b->axes[2], d));
}

/* How far x lies above the surface of b along `up`, over which it must be; in the frame of b. */
static bool height_over(const struct polyhedron *p, vec3 up, vec3 x, double *height)
{
    double most = -(double)INFINITY, out = -(double)INFINITY;
    double rise[POLYHEDRON_MOST], side[POLYHEDRON_MOST];
    for (int f = 0; f < p->face_room; f++) {
        rise[f] = p->nx[f] * up.x + p->ny[f] * up.y + p->nz[f] * up.z;
        side[f] = p->nx[f] * x.x + p->ny[f] * x.y + p->nz[f] * x.z - p->off[f];
    }
    for (int f = 0; f < p->face_room; f++) {
        const double h = rise[f] > UPRIGHT ? side[f] / rise[f] : -1e300;
        most = h > most ? h : most;
    }
    for (int f = 0; f < p->face_room; f++) {
        const double slope = rise[f] > UPRIGHT || rise[f] < 0.0 ? rise[f] : 0.0;
        const double h = side[f] - most * slope;
        out = h > out ? h : out;
    }
    *height = most;
    return out <= INSIDE * p->radius;
}

/* Vertices of `a` over faces of `b`; `up` points from b to a. */
static void add_vertices(struct corners *c, const struct patch_body *a, const struct rim *rim,
                         const struct patch_body *b, vec3 up, bool swapped)
{
    const vec3 own = to_own(b, up);
    for (int k = 0; k < rim->n; k++) {
        const vec3 x = points_at(&a->at, rim->vertex[k]);
        const vec3 inside = v3_scale(1.0 / b->scale, to_own(b, v3_sub(x, b->place)));
        double height;
        if (!height_over(b->p, own, inside, &height))
            continue;
        height *= b->scale;
        if (swapped)
            add_corner(c, b->p->n_vertices + rim->vertex[k], height, x);
        else
            add_corner(c, rim->vertex[k], height, v3_axpy(x, -height, up));
    }
}

static void add_crossings(struct corners *c, const struct patch_body *a, const struct rim *ra,
                          const struct patch_body *b, const struct rim *rb, vec3 up)
{
    const int first = a->p->n_vertices + b->p->n_vertices;
    for (int i = 0; i < ra->n_edges; i++) {
        const int *const e = a->p->edge[ra->edge[i]];
        const vec3 p = points_at(&a->at, e[0]), d = v3_sub(points_at(&a->at, e[1]), p);
        const vec3 wall = v3_cross(up, d); /* normal of the plane through the edge along up */
        for (int j = 0; j < rb->n_edges; j++) {
            const int *const f = b->p->edge[rb->edge[j]];
            const vec3 q = points_at(&b->at, f[0]), g = v3_sub(points_at(&b->at, f[1]), q);
            const vec3 apart = v3_sub(q, p);
            const double det = v3_dot(wall, g);
            if (det * det <= PARALLEL * PARALLEL * v3_dot(d, d) * v3_dot(g, g))
                continue;
            const double t = -v3_dot(wall, apart) / det;
            const double s = -v3_dot(v3_cross(up, g), apart) / det;
            if (t < 0.0 || t > 1.0 || s < 0.0 || s > 1.0)
                continue;
            const vec3 on_b = v3_axpy(q, t, g);
            const double gap = v3_dot(up, v3_sub(v3_axpy(p, s, d), on_b));
            add_corner(c, first + ra->edge[i] * b->p->n_edges + rb->edge[j], gap, on_b);
        }
    }
}

/* One of corners that coincide is enough: the first. */
static void merge(struct corners *c, double size)
{
    int n = 0;
    for (int k = 0; k < c->n; k++) {
        bool new = true;
        for (int m = 0; m < n && new; m++) {
            const double du = c->u[k] - c->u[m], dv = c->v[k] - c->v[m];
            new = du *du + dv *dv > SAME *SAME *size *size;
        }
        if (!new)
            continue;
        c->id[n] = c->id[k];
        c->gap[n] = c->gap[k];
        c->on_b[n] = c->on_b[k];
        c->u[n] = c->u[k];
        c->v[n++] = c->v[k];
    }
    c->n = n;
}

/* Corners whose discs lie in that of the nearest one have no share. Distances over it are w. */
static void prune(struct corners *c, double *w)
{
    int n = 0, first = 0;
    for (int k = 1; k < c->n; k++)
        first = w[k] < w[first] ? k : first;
    const double u = c->u[first], v = c->v[first], lowest = w[first];
    for (int k = 0; k < c->n; k++) {
        const double du = c->u[k] - u, dv = c->v[k] - v, dw = w[k] - lowest;
        if (k != first && dw * dw >= du * du + dv * dv)
            continue;
        c->id[n] = c->id[k];
        c->gap[n] = c->gap[k];
        c->on_b[n] = c->on_b[k];
        c->u[n] = c->u[k];
        c->v[n] = c->v[k];
        w[n++] = w[k];
    }
    c->n = n;
}

/* Where disc j comes to lead over disc i, as the direction turns counter-clockwise: as an angle
 * from (ux, uy), on a scale from 0 to 4 that ascends with it; 5: never. */
static inline double lead(const struct corners *c, const double *w, int i, int j, double ux,
                          double uy)
{
    const double du = c->u[j] - c->u[i], dv = c->v[j] - c->v[i];
    const double square = du * du + dv * dv, inverse = 1.0 / sqrt(square + 1e-300);
    const double k = (w[j] - w[i]) * inverse;
    const double across = sqrt(fmax(1.0 - k * k, 0.0));
    const double ex = du * inverse, ey = dv * inverse;
    const double x = k * ex + across * ey, y = k * ey - across * ex;
    const double cosine = ux * x + uy * y, sine = ux * y - uy * x;
    const double key = sine >= 0.0 ? 1.0 - cosine : 3.0 + cosine;
    const bool just_now = key > 4.0 - 1e-13;
    return i == j || fabs(k) >= 1.0 - 1e-12 ? 5.0 : just_now ? 0.0 : key;
}

/* Walks round the hull of the discs about the corners, of radius -w. */
static void walk(struct corners *c, const double *w)
{
    double ux = 1.0, uy = 0.0, gone = 0.0, best = -(double)INFINITY;
    int i = 0;
    for (int k = 0; k < c->n; k++) {
        c->share[k] = 0.0;
        if (c->u[k] - w[k] > best) {
            best = c->u[k] - w[k];
            i = k;
        }
    }
    for (int turn = 0; turn < 4 * c->n && gone < 1.0; turn++) {
        double key[PATCH_NEAR], least = 4.5;
        int next = -1;
        for (int j = 0; j < c->n; j++)
            key[j] = lead(c, w, i, j, ux, uy);
        for (int j = 0; j < c->n; j++)
            if (key[j] < least) {
                least = key[j];
                next = j;
            }
        if (next < 0)
            break; /* one disc holds all others */
        const double du = c->u[next] - c->u[i], dv = c->v[next] - c->v[i];
        const double inverse = 1.0 / sqrt(du * du + dv * dv), k = (w[next] - w[i]) * inverse;
        const double across = sqrt(fmax(1.0 - k * k, 0.0));
        const double x = (k * du + across * dv) * inverse, y = (k * dv - across * du) * inverse;
        double angle = atan2(ux * y - uy * x, ux * x + uy * y);
        if (angle < 0.0)
            angle = least == 0.0 ? 0.0 : angle + 2.0 * PI;
        const double part = fmin(angle / (2.0 * PI), 1.0 - gone);
        c->share[i] += part;
        gone += part;
        ux = x;
        uy = y;
        i = next;
    }
    c->share[i] += 1.0 - gone;
}

static void share_out(struct corners *c, vec3 n, double tilt, double size)
{
    double w[PATCH_NEAR], least = (double)INFINITY;
    const vec3 e1 = v3_across(n), e2 = v3_cross(n, e1);
    for (int k = 0; k < c->n; k++) {
        c->u[k] = v3_dot(e1, c->on_b[k]);
        c->v[k] = v3_dot(e2, c->on_b[k]);
    }
    merge(c, size);
    for (int k = 0; k < c->n; k++)
        least = fmin(least, c->gap[k]);
    for (int k = 0; k < c->n; k++)
        w[k] = (c->gap[k] - least) / tilt;
    prune(c, w);
    if (c->n == 1)
        c->share[0] = 1.0;
    else
        walk(c, w);
}

static int hand_out(const struct corners *c, int most, struct patch_point *out)
{
    int n = 0;
    double sum = 0.0;
    for (int k = 0; k < c->n; k++) {
        if (c->share[k] <= NO_SHARE)
            continue;
        int at = n < most ? n++ : -1;
        for (int m = 0; at < 0 && m < n; m++)
            if (out[m].share < c->share[k] && (at < 0 || out[m].share < out[at].share))
                at = m;
        if (at >= 0)
            out[at] = (struct patch_point){
                .id = c->id[k], .share = c->share[k], .gap = c->gap[k], .on_b = c->on_b[k]};
    }
    for (int k = 0; k < n; k++)
        sum += out[k].share;
    for (int k = 0; k < n; k++)
        out[k].share /= sum;
    return n;
}

int patch_ids(const struct polyhedron *a, const struct polyhedron *b)
{
    return a->n_vertices + b->n_vertices + a->n_edges * b->n_edges + 1;
}

/* The nearest points alone. */
static int one_point(int id, const struct gap *gap, vec3 on_b, struct patch_point *out)
{
    out[0] = (struct patch_point){.id = id, .share = 1.0, .gap = gap->distance, .on_b = on_b};
    return 1;
}

int patch_find(const struct patch_body *a, const struct patch_body *b, const struct gap *gap,
               double tilt, int most, struct patch_point *out)
{
    const double size = fmin(a->scale * a->p->radius, b->scale * b->p->radius);
    const vec3 n = gap->normal;
    const struct reach below = {v3_scale(-1.0, n), gap->on_b, tilt,
                                2.0 * tilt * size, size,      gap->distance > 0.0},
                       above = {n,    gap->on_b,          tilt, 2.0 * tilt * size,
                                size, gap->distance > 0.0};
    struct rim ra, rb;
    struct corners c;
    if (!(size > 0.0)) /* one of them is a ball */
        return one_point(patch_ids(a->p, b->p) - 1, gap, gap->on_b, out);
    find_rim(a, &below, false, &ra);
    if (ra.n == 1)
        return one_point(ra.vertex[0], gap,
                         v3_axpy(points_at(&a->at, ra.vertex[0]), -gap->distance, n), out);
    find_rim(b, &above, true, &rb);
    if (rb.n == 1)
        return one_point(a->p->n_vertices + rb.vertex[0], gap, points_at(&b->at, rb.vertex[0]),
                         out);
    find_rim(a, &below, true, &ra);
    c.n = 0;
    add_vertices(&c, a, &ra, b, n, false);
    add_vertices(&c, b, &rb, a, v3_scale(-1.0, n), true);
    add_crossings(&c, a, &ra, b, &rb, n);
    if (c.n == 0)
        return one_point(patch_ids(a->p, b->p) - 1, gap, gap->on_b, out);
    share_out(&c, n, tilt, size);
    return hand_out(&c, most, out);
}
