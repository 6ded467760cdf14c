/* mesh_split.c - triangles that are long beside a period are cut, so that the image of a triangle that is
 * nearest to a grain is the one that its middle tells. An edge is halved where it is too long, in
 * both of its triangles alike, so that no gaps open. */
#include "mesh.h"

enum { PARTS_MOST = 4000000 };

static bool is_long(vec3 p, vec3 q, const double most[3])
{
    return fabs(p.x - q.x) > most[0] || fabs(p.y - q.y) > most[1] || fabs(p.z - q.z) > most[2];
}

static vec3 half_way(vec3 p, vec3 q)
{
    return v3_scale(0.5, v3_add(p, q));
}

static int put(vec3 *out, vec3 a, vec3 b, vec3 c)
{
    if (out) {
        out[0] = a;
        out[1] = b;
        out[2] = c;
    }
    return 1;
}

/* The parts of a triangle, up to four, to `out` unless it is NULL; how many. */
static int cut(const vec3 *t, const double most[3], vec3 *out)
{
    int marked = 0, first = 0;
    bool long_edge[3];
    for (int e = 0; e < 3; e++) {
        long_edge[e] = is_long(t[e], t[(e + 1) % 3], most);
        marked += long_edge[e];
    }
    if (marked == 0)
        return put(out, t[0], t[1], t[2]);
    for (int e = 0; e < 3; e++) /* one: edge a b; two: not c a */
        if (marked == 1 ? long_edge[e] : !long_edge[e])
            first = marked == 1 ? e : (e + 1) % 3;
    const vec3 a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    const vec3 ab = half_way(a, b), bc = half_way(b, c), ca = half_way(c, a);
    int n = 0;
    if (marked == 1) {
        n += put(out, a, ab, c);
        return n + put(out ? out + 3 : NULL, ab, b, c);
    }
    n += put(out, ab, b, bc);
    if (marked == 2) {
        n += put(out ? out + 3 : NULL, a, ab, bc);
        return n + put(out ? out + 6 : NULL, a, bc, c);
    }
    n += put(out ? out + 3 : NULL, a, ab, ca);
    n += put(out ? out + 6 : NULL, ca, bc, c);
    return n + put(out ? out + 9 : NULL, ab, bc, ca);
}

vec3 *mesh_split(vec3 *corner, int *n, const double most[3])
{
    for (;;) {
        long parts = 0;
        for (int i = 0; i < *n; i++)
            parts += cut(&corner[3 * i], most, NULL);
        if (parts == *n || parts > PARTS_MOST)
            return corner;
        vec3 *const out = xalloc(3 * (size_t)parts, sizeof *out);
        size_t at = 0;
        for (int i = 0; i < *n; i++)
            at += 3 * (size_t)cut(&corner[3 * i], most, &out[at]);
        xfree(corner);
        corner = out;
        *n = (int)parts;
    }
}
