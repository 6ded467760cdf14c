/* shapes/geometry/distance.c - Gilbert, Johnson and Keerthi's distance [Gilbert88], with the nearest
 * point of a simplex by the regions of its corners, edges and faces [Ericson05, ch. 5.1]. */
#include "distance.h"

#include <string.h>
#include "lanes.h"

enum { ROUNDS = 64 };
#define FLAT  1e-10 /* height over length of a tetrahedron that has no inside */
#define TIGHT 1e-15 /* of the distance squared: what a further vertex must gain */

/* Corners of the set of differences, and the part of each in the nearest point. */
struct simplex {
    int n, a[4], b[4];
    vec3 w[4];
    double part[4];
};

/* A lane each looks through every eighth vertex; then the best of the lanes, by halves: each carries
 * its number in its last three bits, which decides between vertices equally high to 1e-15. */
int points_highest(const struct points *p, vec3 along, double *height)
{
    const counts number = {0, 1, 2, 3, 4, 5, 6, 7};
    counts best = number;
    lanes most =
        along.x * lanes_load(p->x) + along.y * lanes_load(p->y) + along.z * lanes_load(p->z);
    for (int k = POLYHEDRON_LANES; k < p->room; k += POLYHEDRON_LANES) {
        const lanes h = along.x * lanes_load(p->x + k) + along.y * lanes_load(p->y + k) +
                        along.z * lanes_load(p->z + k);
        const counts higher = h > most;
        most = lanes_greater(h, most);
        best = ((number + k) & higher) | (best & ~higher);
    }
    lanes a = (lanes)(((counts)most & ~7LL) | number);
    a = lanes_greater(a, __builtin_shuffle(a, (counts){4, 5, 6, 7, 0, 1, 2, 3}));
    a = lanes_greater(a, __builtin_shuffle(a, (counts){2, 3, 0, 1, 6, 7, 4, 5}));
    a = lanes_greater(a, __builtin_shuffle(a, (counts){1, 0, 3, 2, 5, 4, 7, 6}));
    int k = (int)(((counts)a)[0] & 7);
    if (p->room > POLYHEDRON_LANES) {
        long long index[POLYHEDRON_LANES];
        memcpy(index, &best, sizeof index);
        k = (int)index[k];
    }
    *height = along.x * p->x[k] + along.y * p->y[k] + along.z * p->z[k];
    return k;
}

int points_lowest(const struct points *p, vec3 along, double *height)
{
    const int k = points_highest(p, v3(-along.x, -along.y, -along.z), height);
    *height = -*height;
    return k;
}

double gap_along(const struct points *a, const struct points *b, vec3 direction)
{
    double low, high;
    points_lowest(a, direction, &low);
    points_highest(b, direction, &high);
    return low - high;
}

static void keep(struct simplex *s, const int *which, int n)
{
    for (int k = 0; k < n; k++) {
        const int from = which[k];
        s->a[k] = s->a[from];
        s->b[k] = s->b[from];
        s->w[k] = s->w[from];
        s->part[k] = s->part[from];
    }
    s->n = n;
}

static vec3 blend(const struct simplex *s)
{
    vec3 v = v3_scale(s->part[0], s->w[0]);
    for (int k = 1; k < s->n; k++)
        v = v3_axpy(v, s->part[k], s->w[k]);
    return v;
}

static vec3 nearest_of_segment(struct simplex *s)
{
    const vec3 d = v3_sub(s->w[1], s->w[0]);
    const double along = -v3_dot(s->w[0], d), square = v3_dot(d, d);
    if (along <= 0.0) {
        s->part[0] = 1.0;
        keep(s, (int[]){0}, 1);
    } else if (along >= square) {
        s->part[1] = 1.0;
        keep(s, (int[]){1}, 1);
    } else {
        s->part[1] = along / square;
        s->part[0] = 1.0 - s->part[1];
    }
    return blend(s);
}

static vec3 on_edge(struct simplex *s, int i, int j, double t)
{
    s->part[i] = 1.0 - t;
    s->part[j] = t;
    keep(s, (int[]){i, j}, 2);
    return blend(s);
}

static vec3 on_corner(struct simplex *s, int i)
{
    s->part[i] = 1.0;
    keep(s, (int[]){i}, 1);
    return s->w[0];
}

/* Of a triangle without width: the nearest of its sides. */
static vec3 nearest_of_sides(struct simplex *s)
{
    static const int side[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    struct simplex best = {0};
    vec3 v = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; k++) {
        struct simplex one = *s;
        keep(&one, side[k], 2);
        const vec3 x = nearest_of_segment(&one);
        if (best.n > 0 && v3_dot(x, x) >= v3_dot(v, v))
            continue;
        best = one;
        v = x;
    }
    *s = best;
    return v;
}

/* [Ericson05, p. 141]. In the inner region the point is the foot on the plane, by the normal: its
 * direction then has no error of the parts. Where foot and parts are further apart than the triangle
 * is wide, its corners are on a line but for round-off: parallel edges make such ones. */
static vec3 nearest_of_triangle(struct simplex *s)
{
    const vec3 a = s->w[0], b = s->w[1], c = s->w[2], ab = v3_sub(b, a), ac = v3_sub(c, a);
    const double d1 = -v3_dot(ab, a), d2 = -v3_dot(ac, a), d3 = -v3_dot(ab, b),
                 d4 = -v3_dot(ac, b), d5 = -v3_dot(ab, c), d6 = -v3_dot(ac, c);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (d1 <= 0.0 && d2 <= 0.0)
        return on_corner(s, 0);
    if (d3 >= 0.0 && d4 <= d3)
        return on_corner(s, 1);
    if (d6 >= 0.0 && d5 <= d6)
        return on_corner(s, 2);
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
        return on_edge(s, 0, 1, d1 / (d1 - d3));
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
        return on_edge(s, 0, 2, d2 / (d2 - d6));
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
        return on_edge(s, 1, 2, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    const vec3 n = v3_cross(ab, ac);
    if (!(sum > 0.0) || !(v3_dot(n, n) > 0.0))
        return nearest_of_sides(s);
    s->part[1] = vb / sum;
    s->part[2] = vc / sum;
    s->part[0] = 1.0 - s->part[1] - s->part[2];
    const vec3 foot = v3_scale(v3_dot(n, a) / v3_dot(n, n), n), off = v3_sub(foot, blend(s));
    const double longest = fmax(v3_dot(ab, ab), v3_dot(ac, ac));
    return v3_dot(off, off) * longest <= v3_dot(n, n) ? foot : nearest_of_sides(s);
}

static void pick(const struct simplex *s, const int *corner, struct simplex *out)
{
    out->n = 3;
    for (int k = 0; k < 3; k++) {
        out->a[k] = s->a[corner[k]];
        out->b[k] = s->b[corner[k]];
        out->w[k] = s->w[corner[k]];
    }
}

/* The nearest over the faces that the origin is outside of; false: it is inside of all. */
static bool nearest_of_tetrahedron(struct simplex *s, vec3 *v)
{
    static const int face[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};
    struct simplex best = {0}, flat = {0};
    double least = (double)INFINITY;
    for (int f = 0; f < 4; f++) {
        const vec3 a = s->w[face[f][0]];
        const vec3 n = v3_cross(v3_sub(s->w[face[f][1]], a), v3_sub(s->w[face[f][2]], a));
        const vec3 fourth = v3_sub(s->w[face[f][3]], a);
        const double inner = v3_dot(n, fourth), side = -v3_dot(n, a);
        const bool flat_one = fabs(inner) <= FLAT * v3_norm(n) * v3_norm(fourth);
        if (!flat_one && side * inner > 0.0)
            continue; /* the origin is on the side of the fourth corner */
        pick(s, face[f], &flat);
        const vec3 x = nearest_of_triangle(&flat);
        if (v3_dot(x, x) < least) {
            least = v3_dot(x, x);
            best = flat;
            *v = x;
        }
    }
    if (best.n == 0)
        return false;
    *s = best;
    return true;
}

static bool nearest(struct simplex *s, vec3 *v)
{
    if (s->n == 4)
        return nearest_of_tetrahedron(s, v);
    if (s->n == 3)
        *v = nearest_of_triangle(s);
    else if (s->n == 2)
        *v = nearest_of_segment(s);
    else
        *v = on_corner(s, 0);
    return true;
}

static bool holds(const struct simplex *s, int a, int b)
{
    for (int k = 0; k < s->n; k++)
        if (s->a[k] == a && s->b[k] == b)
            return true;
    return false;
}

static void add(struct simplex *s, const struct points *a, const struct points *b, int ka,
                int kb)
{
    s->a[s->n] = ka;
    s->b[s->n] = kb;
    s->w[s->n++] = v3_sub(points_at(a, ka), points_at(b, kb));
}

static void recall(struct simplex *s, const struct points *a, const struct points *b,
                   const struct gap_memory *m)
{
    s->n = 0;
    for (int k = 0; k < m->n; k++)
        add(s, a, b, m->a[k], m->b[k]);
    if (m->n == 0)
        add(s, a, b, 0, 0);
}

static void remember(const struct simplex *s, struct gap_memory *m)
{
    m->n = s->n < 3 ? s->n : 3;
    memcpy(m->a, s->a, sizeof m->a);
    memcpy(m->b, s->b, sizeof m->b);
}

static void points_of(const struct simplex *s, const struct points *a, const struct points *b,
                      struct gap *out)
{
    out->on_a = out->on_b = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < s->n; k++) {
        out->on_a = v3_axpy(out->on_a, s->part[k], points_at(a, s->a[k]));
        out->on_b = v3_axpy(out->on_b, s->part[k], points_at(b, s->b[k]));
    }
}

static double size_of(const struct points *p)
{
    double most = 0.0;
    for (int k = 0; k < p->room; k++)
        most = fmax(most, fabs(p->x[k]) + fabs(p->y[k]) + fabs(p->z[k]));
    return most;
}

/* Are they less than round-off apart? */
static bool touching(const struct points *a, const struct points *b, double distance)
{
    return distance < 1e-3 && distance < 1e-9 * (size_of(a) + size_of(b));
}

enum outcome { APART, FAR, MEET };

static enum outcome search(const struct points *a, const struct points *b, double reach,
                           struct simplex *s, vec3 *v)
{
    if (!nearest(s, v))
        return MEET;
    for (int round = 0; round < ROUNDS; round++) {
        double low, high;
        const double square = v3_dot(*v, *v);
        const int ka = points_lowest(a, *v, &low), kb = points_highest(b, *v, &high);
        const double bound = low - high; /* times |v|, of the distance */
        if (!(square > 0.0))
            return MEET;
        if (bound > 0.0 && bound * bound >= reach * reach * square)
            return FAR;
        if (square - bound <= TIGHT * square || holds(s, ka, kb))
            return APART;
        const struct simplex before = *s;
        const vec3 was = *v;
        add(s, a, b, ka, kb);
        if (!nearest(s, v))
            return MEET;
        if (v3_dot(*v, *v) >= square) { /* round-off: no nearer */
            *s = before;
            *v = was;
            return APART;
        }
    }
    return APART;
}

static void deeper(const struct points *a, const struct points *b, vec3 n, struct gap *out)
{
    const double length = v3_norm(n);
    if (!(length > 1e-9))
        return;
    for (int side = -1; side <= 1; side += 2) {
        const vec3 u = v3_scale(side / length, n);
        const double d = gap_along(a, b, u);
        if (d > out->distance) {
            out->distance = d;
            out->normal = u;
        }
    }
}

static vec3 turned(const vec3 axes[3], vec3 x)
{
    return v3_add(v3_scale(x.x, axes[0]), v3_axpy(v3_scale(x.y, axes[1]), x.z, axes[2]));
}

static vec3 edge_of(const struct points *p, const int *edge)
{
    const vec3 d = v3_sub(points_at(p, edge[1]), points_at(p, edge[0]));
    return v3_scale(1.0 / v3_norm(d), d);
}

/* The direction in which they overlap least. */
static void overlap(const struct points *a, const struct polyhedron *pa, const struct points *b,
                    const struct polyhedron *pb, const vec3 axes_b[3], struct gap *out)
{
    out->distance = -(double)INFINITY;
    for (int f = 0; f < pa->n_faces; f++)
        deeper(a, b, polyhedron_normal(pa, f), out);
    for (int f = 0; f < pb->n_faces; f++)
        deeper(a, b, turned(axes_b, polyhedron_normal(pb, f)), out);
    for (int i = 0; i < pa->n_edges; i++)
        for (int j = 0; j < pb->n_edges; j++)
            deeper(a, b, v3_cross(edge_of(a, pa->edge[i]), edge_of(b, pb->edge[j])), out);
    double height;
    out->on_a = points_at(a, points_lowest(a, out->normal, &height));
    out->on_b = points_at(b, points_highest(b, out->normal, &height));
}

void gap_find(const struct points *a, const struct polyhedron *pa, const struct points *b,
              const struct polyhedron *pb, const vec3 axes_b[3], double reach,
              struct gap_memory *memory, struct gap *out)
{
    struct simplex s;
    vec3 v = {0.0, 0.0, 0.0};
    recall(&s, a, b, memory);
    enum outcome how = search(a, b, reach, &s, &v);
    const double d = v3_norm(v);
    if (how == APART && touching(a, b, d))
        how = MEET;
    if (how == MEET) {
        memory->n = 0;
        *out = (struct gap){.distance = 0.0};
        if (pa && pb)
            overlap(a, pa, b, pb, axes_b, out);
        return;
    }
    remember(&s, memory);
    out->normal = v3_scale(1.0 / d, v);
    out->distance = how == FAR ? gap_along(a, b, out->normal) : d;
    if (how == APART)
        points_of(&s, a, b, out);
}

double polyhedron_distance(const struct polyhedron *p, vec3 x)
{
    double px[POLYHEDRON_LANES], py[POLYHEDRON_LANES], pz[POLYHEDRON_LANES];
    const struct points a = {POLYHEDRON_LANES, px, py, pz},
                        b = {p->vertex_room, p->x, p->y, p->z};
    struct gap_memory memory = {0};
    struct gap gap;
    double out = -(double)INFINITY;
    for (int f = 0; f < p->n_faces; f++)
        out = fmax(out, v3_dot(polyhedron_normal(p, f), x) - p->off[f]);
    if (out <= 0.0)
        return 0.0;
    for (int k = 0; k < POLYHEDRON_LANES; k++) {
        px[k] = x.x;
        py[k] = x.y;
        pz[k] = x.z;
    }
    gap_find(&a, NULL, &b, NULL, NULL, (double)INFINITY, &memory, &gap);
    return gap.distance;
}
