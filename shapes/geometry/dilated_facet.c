/* shapes/geometry/dilated_facet.c - where a part of a body of dilated polyhedra lies nearest to a
 * flat piece of a wall.
 *
 * The gap is the greatest over all normals m of -s(-m) - max_b (m b), s the support function of the
 * crowned core (crown.h), b the corners of the piece: on its face m is that of the face, on an edge
 * it is sought across the edge, at a corner all round. That the other corners lie behind it and the
 * point abreast of the edge tells which (Karush, Kuhn and Tucker's conditions [Boyd04, section
 * 5.5.3]). So a face of a grain on a wall is as stiff as a vertex, and one contact goes from face to
 * edge to corner without a jump. */
#include "dilated.h"

#define LEVEL 1e-9 /* of the size */

struct piece {
    int n;
    vec3 corner[4], normal; /* in the body's frame, sizes */
};

static vec3 next_of(const struct piece *f, int k)
{
    return f->corner[(k + 1) % f->n];
}

/* How far x lies outside of edge k, in the plane of the piece. */
static double outside(const struct piece *f, int k, vec3 x)
{
    const vec3 d = v3_sub(next_of(f, k), f->corner[k]);
    const vec3 way = v3_cross(d, f->normal);
    const double side = v3_dot(way, v3_sub(f->corner[(k + 2) % f->n], f->corner[k]));
    return (side > 0.0 ? -1.0 : 1.0) * v3_dot(way, v3_sub(x, f->corner[k])) / v3_norm(way);
}

static bool behind_all(const struct piece *f, vec3 m, vec3 b)
{
    for (int k = 0; k < f->n; k++)
        if (v3_dot(m, v3_sub(f->corner[k], b)) > LEVEL)
            return false;
    return true;
}

/* From an edge (line) or corner. False: it is not the nearest, or out of reach. */
static bool try_point(const struct crown *a, const struct piece *f, int k, bool edge,
                      vec3 towards, double reach, struct crown_gap *g)
{
    static const double none[POLYHEDRON_LANES] = {0.0,        CROWN_NONE, CROWN_NONE,
                                                  CROWN_NONE, CROWN_NONE, CROWN_NONE,
                                                  CROWN_NONE, CROWN_NONE};
    double x[POLYHEDRON_LANES], y[POLYHEDRON_LANES], z[POLYHEDRON_LANES];
    const vec3 b = f->corner[k], along = v3_sub(next_of(f, k), b);
    const double length = v3_norm(along);
    const vec3 line = edge ? v3_scale(1.0 / length, along) : v3(0.0, 0.0, 0.0);
    vec3 start = v3_sub(towards, b);
    for (int c = 0; c < POLYHEDRON_LANES; c++) {
        x[c] = b.x;
        y[c] = b.y;
        z[c] = b.z;
    }
    const struct crown point = {{POLYHEDRON_LANES, x, y, z}, none, a->sharp};
    start = v3_axpy(start, -v3_dot(start, line), line);
    const double size = v3_norm(start);
    start = size > LEVEL ? v3_scale(1.0 / size, start) : f->normal;
    if (!crown_find_gap(a, &point, line, reach, start, g))
        return false;
    const double at = v3_dot(v3_sub(g->on_a, b), line);
    return (!edge || (at >= -LEVEL && at <= length + LEVEL)) && behind_all(f, g->normal, b);
}

/* The face itself. */
static bool try_face(const struct crown *a, const struct piece *f, struct crown_gap *g)
{
    struct crown_top top;
    crown_find_top(a, v3_scale(-1.0, f->normal), &top);
    g->normal = f->normal;
    g->on_a = top.at;
    g->gap = -top.height - v3_dot(f->normal, f->corner[0]);
    crown_set_flat(&top, g);
    for (int k = 0; k < f->n; k++)
        if (outside(f, k, top.at) > 0.0)
            return false;
    return true;
}

/* `beyond`: the plane itself is out of reach. */
static bool find(const struct crown *a, const struct piece *f, double reach, bool *face,
                 bool *beyond, struct crown_gap *g)
{
    *face = try_face(a, f, g);
    *beyond = g->gap >= reach;
    if (*face || *beyond) /* further than the plane is the piece */
        return !*beyond;
    const vec3 lowest = g->on_a;
    for (int k = 0; k < f->n; k++)
        if (outside(f, k, lowest) > 0.0 && try_point(a, f, k, true, lowest, reach, g))
            return true;
    for (int k = 0; k < f->n; k++)
        if (try_point(a, f, k, false, lowest, reach, g))
            return true;
    return false;
}

/* The exact distance of core and piece; 0: the piece cuts the core. */
static struct gap exact_gap(const struct polyhedron *core, const struct piece *f, double reach)
{
    const struct points a = {core->vertex_room, core->x, core->y, core->z};
    double x[POLYHEDRON_LANES], y[POLYHEDRON_LANES], z[POLYHEDRON_LANES];
    const struct points b = {POLYHEDRON_LANES, x, y, z};
    struct gap_memory memory = {0};
    struct gap gap;
    for (int c = 0; c < POLYHEDRON_LANES; c++) {
        x[c] = f->corner[c % f->n].x;
        y[c] = f->corner[c % f->n].y;
        z[c] = f->corner[c % f->n].z;
    }
    gap_find(&a, NULL, &b, NULL, NULL, reach, &memory, &gap);
    return gap;
}

/* From the nearest points: across an edge or a corner of the piece, or as they are. */
static void find_beside(const struct crown *a, const struct piece *f, const struct gap *exact,
                        double reach, struct crown_gap *g)
{
    for (int edge = 1; edge >= 0; edge--)
        for (int k = 0; k < f->n; k++)
            if (try_point(a, f, k, edge, exact->on_a, reach, g) && g->gap > 0.0)
                return;
    g->gap = exact->distance;
    g->normal = exact->normal;
    g->on_a = exact->on_a;
}

/* What find() gives counts as long as the plane lies outside of the core. A body that hangs past an
 * edge, its centre beyond the plane, may have its farthest point abreast of the piece, which it
 * does not reach all the same: then the nearest points tell. Or it has a part that rests on the
 * piece from the other side: what that side gives counts. Where the piece cuts the core each of its
 * sides has a gap of its own, and the greater counts. */
static bool find_side(const struct crown *a, const struct polyhedron *core,
                      const struct piece *f, double reach, bool *face, struct crown_gap *g)
{
    bool beyond, other_face;
    const bool own = find(a, f, reach, face, &beyond, g);
    if ((own && g->gap >= 0.0) || beyond || f->n == 0)
        return own;
    const struct gap exact = exact_gap(core, f, reach);
    if (exact.distance >= reach)
        return false;
    struct piece back = *f;
    struct crown_gap other;
    bool found = own;
    back.normal = v3_scale(-1.0, f->normal);
    if (find(a, &back, reach, &other_face, &beyond, &other) &&
        other.gap > (own ? g->gap : 0.0)) {
        *g = other;
        *face = other_face;
        found = true;
    }
    if (exact.distance > 0.0 && found && g->gap < 0.0) {
        *face = false;
        find_beside(a, f, &exact, reach, g);
    }
    return found;
}

/* As in dilated_pair.c. */
static int put(const struct dilated *d, const struct shape_pose *i, const struct crown_gap *g,
               bool face, int first, struct shape_point *out)
{
    const double size = i->size, depth = size * (d->r - g->gap), wide = sqrt(2.0);
    const vec3 normal = mat3_turn(&i->turn, g->normal),
               at = v3_scale(size, mat3_turn(&i->turn, g->on_a));
    const bool point = !face || g->r11 + g->r22 < CROWN_NARROW;
    const vec3 side[2] = {v3_add(v3_scale(g->r11, g->e1), v3_scale(g->r12, g->e2)),
                          v3_add(v3_scale(g->r12, g->e1), v3_scale(g->r22, g->e2))};
    const int n = point ? 1 : 4;
    for (int k = 0; k < n; k++) {
        const double far = point ? 0.0 : k % 2 ? -wide * size : wide * size;
        const vec3 lever = v3_scale(far, mat3_turn(&i->turn, side[k / 2]));
        const vec3 from = v3_add(at, lever);
        out[k] = (struct shape_point){.id = first + (point ? 0 : 1 + k),
                                      .depth = depth,
                                      .normal = normal,
                                      .at_i = v3_axpy(from, 0.5 * depth - size * d->r, normal),
                                      .from_i = from,
                                      .r_i = size,
                                      .lever = lever,
                                      .scale = size,
                                      .share = 1.0 / n};
    }
    return n;
}

int dilated_flat(const struct dilated *d, const struct shape_pose *i, int part,
                 const struct shape_facet *f, double reach, vec3 *core,
                 struct shape_point out[4])
{
    const struct dilated_part *const p = &d->part[part];
    const struct polyhedron *const c = p->core;
    const struct crown a = {{c->vertex_room, c->x, c->y, c->z}, p->log_weight, CROWN_SHARP};
    const double most = reach / i->size + d->r;
    struct piece own = {.n = f->n, .normal = mat3_back(&i->turn, f->normal)};
    struct crown_gap g;
    bool face;
    for (int k = 0; k < (f->n > 0 ? f->n : 1); k++)
        own.corner[k] = v3_scale(1.0 / i->size, mat3_back(&i->turn, f->corner[k]));
    /* the plane is out of reach of the ball about the part */
    if (v3_dot(own.normal, v3_sub(p->middle, own.corner[0])) > p->radius + reach / i->size)
        return 0;
    if (!find_side(&a, c, &own, most, &face, &g))
        return 0;
    *core = v3_scale(i->size, mat3_turn(&i->turn, g.on_a));
    return put(d, i, &g, face, d->n_balls + 5 * part, out);
}
