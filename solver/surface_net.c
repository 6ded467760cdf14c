/* surface_net.c - the zero of a distance field as a net of triangles, see distance_field.h.
 *
 * Surface nets [Gibson98]: the field is looked at on a lattice; every cube of it whose corners
 * differ in sign has one corner of the net, the mean of the points where its edges are cut, moved on
 * to the surface along the gradient; every edge that is cut has a quadrilateral of the four cubes
 * about it, two triangles. Closed wherever the lattice covers the body. */
#include <string.h>
#include "base.h"
#include "distance_field.h"

struct lattice {
    int n[3]; /* cubes */
    double h;
    vec3 origin;
    double *d;   /* at the corners of the cubes */
    int *corner; /* of the net, per cube; -1: none */
};

static size_t knot(const struct lattice *l, int i, int j, int k)
{
    return (size_t)i + (size_t)(l->n[0] + 1) * ((size_t)j + (size_t)(l->n[1] + 1) * (size_t)k);
}

static size_t cube(const struct lattice *l, int i, int j, int k)
{
    return (size_t)i + (size_t)l->n[0] * ((size_t)j + (size_t)l->n[1] * (size_t)k);
}

static vec3 knot_place(const struct lattice *l, int i, int j, int k)
{
    return v3_axpy(l->origin, l->h, v3(i, j, k));
}

/* Mean of the cuts of the edges of a cube; false: none is cut. */
static bool cuts_mean(const struct lattice *l, int i, int j, int k, vec3 *mean)
{
    int n = 0;
    vec3 sum = v3(0.0, 0.0, 0.0);
    for (int a = 0; a < 3; a++)
        for (int e = 0; e < 4; e++) {
            int lo[3] = {i, j, k}, hi[3];
            lo[(a + 1) % 3] += e & 1;
            lo[(a + 2) % 3] += e >> 1;
            memcpy(hi, lo, sizeof hi);
            hi[a]++;
            const double from = l->d[knot(l, lo[0], lo[1], lo[2])];
            const double to = l->d[knot(l, hi[0], hi[1], hi[2])];
            if ((from < 0.0) == (to < 0.0))
                continue;
            const vec3 x = knot_place(l, lo[0], lo[1], lo[2]),
                       y = knot_place(l, hi[0], hi[1], hi[2]);
            sum = v3_add(sum, v3_axpy(x, from / (from - to), v3_sub(y, x)));
            n++;
        }
    *mean = v3_scale(n ? 1.0 / n : 0.0, sum);
    return n > 0;
}

/* On to the surface, no farther than half a cube. */
static vec3 onto(const struct distance_field *f, vec3 x, double most)
{
    const vec3 start = x;
    for (int k = 0; k < 8; k++) {
        vec3 g;
        const double d = distance_slope(f, x, &g), square = v3_dot(g, g);
        if (square < 0.01)
            break;
        const vec3 to = v3_axpy(x, -d / square, g);
        if (v3_norm(v3_sub(to, start)) > most)
            break;
        x = to;
    }
    return x;
}

static void corners(const struct distance_field *f, struct lattice *l, struct surface_net *s)
{
    for (int pass = 0; pass < 2; pass++) {
        s->n = 0;
        for (int k = 0; k < l->n[2]; k++)
            for (int j = 0; j < l->n[1]; j++)
                for (int i = 0; i < l->n[0]; i++) {
                    vec3 mean;
                    if (!cuts_mean(l, i, j, k, &mean))
                        continue;
                    if (pass == 1)
                        s->at[s->n] = onto(f, mean, 0.5 * l->h);
                    l->corner[cube(l, i, j, k)] = s->n++;
                }
        if (pass == 0)
            s->at = xalloc((size_t)s->n + 1, sizeof *s->at);
    }
}

static void add_triangle(struct surface_net *s, int *room, int a, int b, int c)
{
    if (s->n_triangles == *room) {
        const int more = 2 * *room + 64;
        s->triangle = xrealloc(s->triangle, (size_t)*room, (size_t)more, sizeof *s->triangle);
        *room = more;
    }
    int *const t = s->triangle[s->n_triangles++];
    t[0] = a;
    t[1] = b;
    t[2] = c;
}

/* The quadrilaterals about cut edges along axis a, by their shorter diagonal. */
static void quads(const struct lattice *l, int a, struct surface_net *s, int *room)
{
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    int p[3];
    for (p[2] = 0; p[2] <= l->n[2] - (a == 2); p[2]++)
        for (p[1] = 0; p[1] <= l->n[1] - (a == 1); p[1]++)
            for (p[0] = 0; p[0] <= l->n[0] - (a == 0); p[0]++) {
                int to[3] = {p[0], p[1], p[2]}, v[4];
                to[a]++;
                const bool in = l->d[knot(l, p[0], p[1], p[2])] < 0.0;
                if (in == (l->d[knot(l, to[0], to[1], to[2])] < 0.0))
                    continue;
                for (int e = 0; e < 4; e++) { /* the cubes about the edge, in turn */
                    int q[3] = {p[0], p[1], p[2]};
                    q[b] -= e == 1 || e == 2 ? 0 : 1;
                    q[c] -= e >= 2 ? 0 : 1;
                    v[e] = l->corner[cube(l, q[0], q[1], q[2])];
                }
                if (!in) {
                    const int swap = v[1];
                    v[1] = v[3];
                    v[3] = swap;
                }
                const vec3 one = v3_sub(s->at[v[0]], s->at[v[2]]);
                const vec3 two = v3_sub(s->at[v[1]], s->at[v[3]]);
                const int from = v3_dot(one, one) <= v3_dot(two, two) ? 0 : 1;
                add_triangle(s, room, v[from], v[from + 1], v[from + 2]);
                add_triangle(s, room, v[from], v[from + 2], v[(from + 3) % 4]);
            }
}

static void normals(const struct distance_field *f, struct surface_net *s)
{
    s->normal = xalloc((size_t)s->n + 1, sizeof *s->normal);
    s->area = xalloc((size_t)s->n + 1, sizeof *s->area);
    for (int t = 0; t < s->n_triangles; t++) {
        const int *const v = s->triangle[t];
        const vec3 cross =
            v3_cross(v3_sub(s->at[v[1]], s->at[v[0]]), v3_sub(s->at[v[2]], s->at[v[0]]));
        for (int k = 0; k < 3; k++)
            s->area[v[k]] += v3_norm(cross) / 6.0;
    }
    for (int k = 0; k < s->n; k++) {
        distance_slope(f, s->at[k], &s->normal[k]);
        const double length = v3_norm(s->normal[k]);
        s->normal[k] = length > 0.0 ? v3_scale(1.0 / length, s->normal[k]) : v3(0.0, 0.0, 1.0);
    }
}

struct surface_net *surface_net(const struct distance_field *f, double spacing)
{
    struct surface_net *const s = xalloc(1, sizeof *s);
    struct lattice l = {.h = spacing};
    size_t knots = 1, cubes = 1;
    double low[3];
    int room = 0;
    for (int a = 0; a < 3;
         a++) { /* over the grid and a cube more on either side, about its middle */
        const double length = (f->n[a] - 1) * f->spacing;
        l.n[a] = (int)ceil(length / spacing) + 2;
        low[a] = 0.5 * (length - l.n[a] * spacing);
        knots *= (size_t)l.n[a] + 1;
        cubes *= (size_t)l.n[a];
    }
    l.origin = v3_add(f->origin, v3(low[0], low[1], low[2]));
    l.d = xalloc(knots, sizeof *l.d);
    l.corner = xalloc(cubes, sizeof *l.corner);
    for (int k = 0; k <= l.n[2]; k++)
        for (int j = 0; j <= l.n[1]; j++)
            for (int i = 0; i <= l.n[0]; i++)
                l.d[knot(&l, i, j, k)] = distance_at(f, knot_place(&l, i, j, k));
    corners(f, &l, s);
    for (int a = 0; a < 3; a++)
        quads(&l, a, s, &room);
    normals(f, s);
    xfree(l.d);
    xfree(l.corner);
    return s;
}

void surface_net_free(struct surface_net *s)
{
    if (!s)
        return;
    xfree(s->at);
    xfree(s->normal);
    xfree(s->area);
    xfree(s->triangle);
    xfree(s);
}
