/* mesh_views.c - nearest points of triangles: of one, and of several side by side. */
#include "mesh.h"

#include <string.h>
#include "turn.h"

/* Nearest point of the segment from + t along, 0 <= t <= 1, to x; squares of distances. */
static double segment(vec3 from, vec3 along, vec3 x, vec3 *away, enum wall_part *part)
{
    const vec3 rel = v3_sub(x, from);
    const double t = v3_dot(rel, along) / v3_dot(along, along);
    *part = t <= 0.0 || t >= 1.0 ? WALL_VERTEX : WALL_EDGE;
    *away = v3_axpy(rel, -fmin(fmax(t, 0.0), 1.0), along);
    if (t >= 1.0)
        *away = v3_sub(x, v3_add(from, along));
    return v3_dot(*away, *away);
}

/* The nearest of its edges and corners. */
static void view_rim(const struct triangle *t, vec3 x, struct wall_view *out)
{
    const vec3 from[3] = {t->a, t->a, v3_add(t->a, t->e1)};
    const vec3 along[3] = {t->e1, t->e2, v3_sub(t->e2, t->e1)};
    double least = (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        struct wall_view view = {.part = WALL_EDGE};
        const double square = segment(from[k], along[k], x, &view.away, &view.part);
        if (square < least) {
            least = square;
            *out = view;
        }
    }
}

void triangle_view(const struct triangle *t, const vec3 *x, struct wall_view *out)
{
    const vec3 at = v3(x->x, x->y, x->z), rel = v3_sub(at, t->a);
    const double p = v3_dot(rel, t->e1), q = v3_dot(rel, t->e2);
    const double u = t->g11 * p + t->g12 * q, v = t->g12 * p + t->g22 * q;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0)
        wall_view_put(out, v3_scale(v3_dot(rel, t->normal), t->normal), 0.0, WALL_FACE);
    else
        view_rim(t, at, out);
}

/* u, v and 1 - u - v times the heights over the edges; |g| of a height h is 1/h. */
bool triangle_flat(const struct triangle *t, const vec3 *x, struct wall_flat *plane,
                   double *within)
{
    const vec3 rel = v3_sub(v3(x->x, x->y, x->z), t->a);
    const double p = v3_dot(rel, t->e1), q = v3_dot(rel, t->e2);
    const double u = t->g11 * p + t->g12 * q, v = t->g12 * p + t->g22 * q;
    const double third = (1.0 - u - v) / sqrt(t->g11 + 2.0 * t->g12 + t->g22);
    *within = fmin(third, fmin(u / sqrt(t->g11), v / sqrt(t->g22)));
    plane->point = v3_axpy(t->a, 1.0 / 3.0, v3_add(t->e1, t->e2));
    plane->normal = t->normal;
    return true;
}

enum { EIGHT = 8 };

/* Rows of struct triangle. */
enum {
    A = 0,
    E1 = 3,
    E2 = 6,
    NORMAL = 9,
    G11 = 12,
    G12,
    G22,
    HOLLOW,
    ROWS = 16,
};
_Static_assert(sizeof(struct triangle) == ROWS * sizeof(double), "sixteen numbers");

/* Eight triangles, number by number. */
struct eight {
    double8 row[ROWS];
};

typedef int int8 __attribute__((vector_size(32)));

static inline double8 take(const double *x)
{
    double8 a;
    memcpy(&a, x, sizeof a);
    return a;
}

static inline void put(double *x, double8 a)
{
    memcpy(x, &a, sizeof a);
}

static void gather(const struct triangle *triangle, const int *element, struct eight *e)
{
    for (int half = 0; half < ROWS; half += EIGHT) {
        double8 a[EIGHT];
        for (int k = 0; k < EIGHT; k++)
            a[k] = take((const double *)&triangle[element[k]] + half);
        turn8_double(a);
        for (int k = 0; k < EIGHT; k++)
            e->row[half + k] = a[k];
    }
}

/* Eight points on the faces of their triangles; returns whether some are beside theirs. */
static bool faces(const struct eight *e, struct wall_looks *l, int c)
{
    const double8 *const r = e->row;
    const double8 x = take(&l->x[c]) - r[A], y = take(&l->y[c]) - r[A + 1];
    const double8 z = take(&l->z[c]) - r[A + 2];
    const double8 p = x * r[E1] + y * r[E1 + 1] + z * r[E1 + 2];
    const double8 q = x * r[E2] + y * r[E2 + 1] + z * r[E2 + 2];
    const double8 u = r[G11] * p + r[G12] * q, v = r[G12] * p + r[G22] * q;
    const double8 h = x * r[NORMAL] + y * r[NORMAL + 1] + z * r[NORMAL + 2], zero = {0.0};
    const long8 face = (u >= zero) & (v >= zero) & (u + v <= zero + 1.0);
    const int8 beside = ~__builtin_convertvector(face, int8);
    put(&l->ax[c], h * r[NORMAL]);
    put(&l->ay[c], h * r[NORMAL + 1]);
    put(&l->az[c], h * r[NORMAL + 2]);
    put(&l->curvature[c], zero);
    int some = 0;
    for (int k = 0; k < EIGHT; k++) {
        l->part[c + k] = -beside[k]; /* WALL_EDGE, for the time being */
        some |= beside[k];
    }
    return some != 0;
}

/* From its nearest point of a segment to a point. Its numbers are doubles too: lanes of one width. */
struct rim {
    double x, y, z, square; /* m, m2 */
    double edge, part;      /* number of the edge; enum wall_part */
};

#define RIM_INLINE static inline __attribute__((always_inline))

/* The segment along e from the origin, where it is nearer to f than what was found before. */
RIM_INLINE struct rim nearer_rim(struct rim r, double fx, double fy, double fz, double ex,
                                 double ey, double ez, double edge)
{
    const double t = (fx * ex + fy * ey + fz * ez) / (ex * ex + ey * ey + ez * ez);
    const double at = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    const double x = fx - at * ex, y = fy - at * ey, z = fz - at * ez;
    const double square = x * x + y * y + z * z;
    const double part = at == t ? (double)WALL_EDGE : (double)WALL_VERTEX;
    r.x = square < r.square ? x : r.x;
    r.y = square < r.square ? y : r.y;
    r.z = square < r.square ? z : r.z;
    r.edge = square < r.square ? edge : r.edge;
    r.part = square < r.square ? part : r.part;
    r.square = square < r.square ? square : r.square;
    return r;
}

/* Those beside their triangle: the nearest points of its rim. */
static void rims(const struct eight *e, struct wall_looks *l, int from)
{
    _Alignas(64) double r[ROWS][EIGHT], face[EIGHT], edge[EIGHT], part[EIGHT], side[EIGHT];
    memcpy(r, e->row, sizeof r);
    for (int k = 0; k < EIGHT; k++)
        face[k] = l->part[from + k] == WALL_FACE;
#pragma omp simd
    for (int k = 0; k < EIGHT; k++) {
        const int c = from + k;
        const double x = l->x[c] - r[A][k], y = l->y[c] - r[A + 1][k];
        const double z = l->z[c] - r[A + 2][k];
        const double ux = r[E1][k], uy = r[E1 + 1][k], uz = r[E1 + 2][k];
        const double vx = r[E2][k], vy = r[E2 + 1][k], vz = r[E2 + 2][k];
        struct rim n = {.square = (double)INFINITY, .part = (double)WALL_EDGE};
        n = nearer_rim(n, x, y, z, ux, uy, uz, 0.0);
        n = nearer_rim(n, x, y, z, vx, vy, vz, 1.0);
        n = nearer_rim(n, x - ux, y - uy, z - uz, vx - ux, vy - uy, vz - uz, 2.0);
        side[k] = x * r[NORMAL][k] + y * r[NORMAL + 1][k] + z * r[NORMAL + 2][k];
        edge[k] = n.edge;
        part[k] = n.part;
        l->ax[c] = face[k] > 0.0 ? l->ax[c] : n.x;
        l->ay[c] = face[k] > 0.0 ? l->ay[c] : n.y;
        l->az[c] = face[k] > 0.0 ? l->az[c] : n.z;
    }
    for (int k = 0; k < EIGHT; k++) {
        const int bits = (int)r[HOLLOW][k], of = side[k] > 0.0 ? bits : bits / HOLLOW_BACK;
        if (face[k] > 0.0)
            continue;
        l->part[from + k] = (int)part[k];
        l->hollow[from + k] = (of >> (int)edge[k]) & (l->part[from + k] == WALL_EDGE);
    }
}

void mesh_views(const struct mesh *m, struct wall_looks *l)
{
    for (int c = 0; c < l->n; c++) { /* a fine mesh is more than a core has at hand */
        const char *const t = (const char *)&m->triangle[l->element[c]];
        __builtin_prefetch(t);
        __builtin_prefetch(t + sizeof(struct triangle) / 2);
    }
    for (int c = 0; c < l->n; c += EIGHT) {
        struct eight e;
        gather(m->triangle, &l->element[c], &e);
        if (faces(&e, l, c))
            rims(&e, l, c);
    }
}
