/* mesh_seams.c - where the triangles of a mesh meet: edges that two of them share. Corners are the same
 * where their numbers are.
 *
 * Triangles that join in one plane are a patch: a ball whose foot lies on one of them touches the patch
 * there and nowhere else. Seen from the hollow side of two triangles that join at less than 90 degrees out of
 * one plane, an edge is never the nearest point of both: a ball does not touch it
 * (contact_wall_crowds.c). */
#include "mesh.h"

#include <stdlib.h>

#define FLAT 1e-6 /* rad: in one plane */

/* A corner of a triangle on its way to a number. */
struct corner {
    vec3 x;
    int at; /* 3 triangle + corner */
};

/* An edge of a triangle, by the numbers of its corners. */
struct edge {
    int low, high, at; /* 3 triangle + edge */
};

static int compare(double a, double b)
{
    return a < b ? -1 : a > b;
}

static int by_place(const void *a, const void *b)
{
    const struct corner *const p = a, *const q = b;
    const int x = compare(p->x.x, q->x.x), y = compare(p->x.y, q->x.y);
    const int z = compare(p->x.z, q->x.z);
    return x ? x : y ? y : z ? z : p->at - q->at;
}

static int by_corners(const void *a, const void *b)
{
    const struct edge *const p = a, *const q = b;
    return p->low != q->low     ? (p->low < q->low ? -1 : 1)
           : p->high != q->high ? (p->high < q->high ? -1 : 1)
                                : p->at - q->at;
}

/* The corners that are the ends of an edge, and the third. */
static const int ends[3][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};

/* Numbers of the corners, equal where these are. */
static int *number_corners(const vec3 *corner, int n)
{
    struct corner *const c = xalloc((size_t)n, sizeof *c);
    int *const number = xalloc((size_t)n, sizeof *number), corners = 0;
    for (int i = 0; i < n; i++)
        c[i] = (struct corner){corner[i], i};
    qsort(c, (size_t)n, sizeof *c, by_place);
    for (int i = 0; i < n; i++) {
        const vec3 a = c[i].x, b = c[i > 0 ? i - 1 : 0].x;
        corners += i == 0 || a.x != b.x || a.y != b.y || a.z != b.z;
        number[c[i].at] = corners - 1;
    }
    xfree(c);
    return number;
}

/* Per edge of each triangle the one that shares it with this triangle alone, or -1. */
static int *find_partners(const int *number, int n)
{
    struct edge *const e = xalloc((size_t)n, sizeof *e);
    int *const partner = xalloc((size_t)n, sizeof *partner);
    for (int i = 0; i < n; i++) {
        const int a = number[i / 3 * 3 + ends[i % 3][0]],
                  b = number[i / 3 * 3 + ends[i % 3][1]];
        e[i] = (struct edge){a < b ? a : b, a < b ? b : a, i};
        partner[i] = -1;
    }
    qsort(e, (size_t)n, sizeof *e, by_corners);
    for (int i = 0, to; i < n; i = to) {
        for (to = i + 1; to < n && e[to].low == e[i].low && e[to].high == e[i].high;)
            to++;
        if (to - i == 2) {
            partner[e[i].at] = e[i + 1].at;
            partner[e[i + 1].at] = e[i].at;
        }
    }
    xfree(e);
    return partner;
}

/* How the neighbour goes on over an edge, along the outward direction in the plane of the triangle and along
 * its normal; false: it is folded over the triangle. */
static bool goes_out(const struct mesh *m, const vec3 *corner, int edge, int other, double *out,
                     double *up)
{
    const vec3 *const c = &corner[edge / 3 * 3], *const d = &corner[other / 3 * 3];
    const vec3 from = c[ends[edge % 3][0]], along = v3_sub(c[ends[edge % 3][1]], from);
    const vec3 own = v3_sub(c[ends[edge % 3][2]], from);
    const vec3 over = v3_sub(d[ends[other % 3][2]], from);
    const double square = v3_dot(along, along);
    const vec3 in = v3_axpy(own, -v3_dot(own, along) / square, along);
    const vec3 beyond = v3_axpy(over, -v3_dot(over, along) / square, along);
    *out = -v3_dot(beyond, in) / v3_norm(in);
    *up = v3_dot(beyond, m->triangle[edge / 3].normal);
    return *out >= 0.0;
}

/* In the plane of the patch's first triangle: neighbours that bend by little each do not add up. */
static bool in_plane(const struct mesh *m, int first, int i)
{
    return v3_norm(v3_cross(m->triangle[first].normal, m->triangle[i].normal)) <= FLAT;
}

/* The triangles that join `first` in its plane; `stack` has room for all. */
static void grow_patch(struct mesh *m, const vec3 *corner, const int *partner, int first,
                       int *stack)
{
    int n = 0;
    stack[n++] = first;
    m->patch[first] = first;
    while (n > 0) {
        const int i = stack[--n];
        for (int e = 3 * i; e < 3 * i + 3; e++) {
            double out, up;
            if (partner[e] < 0 || m->patch[partner[e] / 3] >= 0 ||
                !goes_out(m, corner, e, partner[e], &out, &up))
                continue;
            if (fabs(up) > FLAT * out || !in_plane(m, first, partner[e] / 3))
                continue;
            m->patch[partner[e] / 3] = first;
            stack[n++] = partner[e] / 3;
        }
    }
}

static void note_hollows(struct mesh *m, const vec3 *corner, const int *partner)
{
    for (int e = 0; e < 3 * m->n; e++) {
        double out, up;
        if (partner[e] >= 0 && m->patch[partner[e] / 3] != m->patch[e / 3] &&
            goes_out(m, corner, e, partner[e], &out, &up) && up != 0.0)
            m->triangle[e / 3].hollow += (1 << e % 3) * (up > 0.0 ? HOLLOW_FRONT : HOLLOW_BACK);
    }
}

void mesh_sew(struct mesh *m, const vec3 *corner)
{
    int *const number = number_corners(corner, 3 * m->n);
    int *const partner = find_partners(number, 3 * m->n);
    int *const stack = xalloc((size_t)m->n, sizeof *stack);
    m->patch = xalloc((size_t)m->n, sizeof *m->patch);
    for (int i = 0; i < m->n; i++)
        m->patch[i] = -1;
    for (int i = 0; i < m->n; i++)
        if (m->patch[i] < 0)
            grow_patch(m, corner, partner, i, stack);
    note_hollows(m, corner, partner);
    xfree(number);
    xfree(partner);
    xfree(stack);
}
