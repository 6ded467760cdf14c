/* shapes/geometry/dilated_facet.c - where a body of dilated polyhedra touches a flat piece of a wall
 * elsewhere than with its vertices: a corner of the piece on a face, an edge of it across an edge
 * or a face. (Vertices on the piece are balls, which walls of all kinds meet.) */
#include "dilated.h"

#define LEVEL 1e-6 /* slope of an edge that counts as along a face */

/* Points of two segments that come nearest; false: on an end of the first. */
static bool cross(vec3 p, vec3 d, vec3 q, vec3 e, vec3 *on_p, vec3 *on_q)
{
    const vec3 w = v3_sub(p, q);
    const double a = v3_dot(d, d), b = v3_dot(d, e), c = v3_dot(e, e), f = v3_dot(d, w),
                 g = v3_dot(e, w), det = a * c - b * b;
    if (det <= 1e-12 * a * c)
        return false;
    const double s = (b * g - c * f) / det, t = (a * g - b * f) / det;
    if (s <= 0.0 || s >= 1.0 || t <= 0.0 || t >= 1.0)
        return false;
    *on_p = v3_axpy(p, s, d);
    *on_q = v3_axpy(q, t, e);
    return true;
}

struct facet_search {
    const struct shape_pose *pose;
    const struct shape_facet *f;
    vec3 corner[4]; /* in the body's frame, sizes */
    double reach;
    int most, n, id;
    double r;
    struct shape_point *out;
};

/* Is a point of the wall in the core, if it is behind a face or edge of it? */
static bool behind_all(const struct polyhedron *p, vec3 x)
{
    for (int f = 0; f < p->n_faces; f++)
        if (v3_dot(polyhedron_normal(p, f), x) > p->off[f])
            return false;
    return true;
}

/* A point of the body at distance along n from one of the wall; `inside`: the wall's point is in the
 * core, and distance negative. */
static void put(struct facet_search *s, int id, vec3 on_body, double distance, vec3 n)
{
    const double size = s->pose->size;
    if (distance - s->r >= s->reach)
        return;
    const vec3 normal = mat3_turn(&s->pose->turn, n);
    const vec3 at = v3_scale(size, mat3_turn(&s->pose->turn, on_body));
    const double depth = size * (s->r - distance);
    if (s->n < s->most)
        s->out[s->n] =
            (struct shape_point){.id = s->id + id,
                                 .depth = depth,
                                 .normal = normal,
                                 .at_i = v3_axpy(at, 0.5 * depth - size * s->r, normal),
                                 .from_i = at,
                                 .r_i = size,
                                 .scale = size};
    s->n++;
}

/* A corner of the piece over a face of the core. */
static void corner_on_face(struct facet_search *s, const struct polyhedron *p, int corner,
                           int id)
{
    const vec3 x = s->corner[corner];
    double most = -(double)INFINITY;
    int face = 0;
    for (int f = 0; f < p->n_faces; f++) {
        const double h = v3_dot(polyhedron_normal(p, f), x) - p->off[f];
        if (h > most) {
            most = h;
            face = f;
        }
    }
    const vec3 n = polyhedron_normal(p, face), foot = v3_axpy(x, -most, n);
    const int corners = s->f->n;
    const vec3 next = v3_sub(s->corner[(corner + 1) % corners], x),
               last = v3_sub(s->corner[(corner + corners - 1) % corners], x);
    if (v3_dot(n, next) < -LEVEL * v3_norm(next) || v3_dot(n, last) < -LEVEL * v3_norm(last))
        return; /* the piece comes nearer elsewhere */
    for (int f = 0; f < p->n_faces; f++)
        if (f != face && v3_dot(polyhedron_normal(p, f), foot) - p->off[f] > 0.0)
            return; /* beside the face */
    put(s, id, foot, most, v3_scale(-1.0, n));
}

/* An edge of the piece across an edge of the core, outside of it or a little inside. */
static void edge_on_edge(struct facet_search *s, const struct polyhedron *p, int e, vec3 q,
                         vec3 d, vec3 inward, int id)
{
    const vec3 a = polyhedron_vertex(p, p->edge[e][0]), b = polyhedron_vertex(p, p->edge[e][1]);
    const vec3 n1 = polyhedron_normal(p, p->edge_face[e][0]),
               n2 = polyhedron_normal(p, p->edge_face[e][1]);
    vec3 on_body, on_wall;
    if (!cross(a, v3_sub(b, a), q, d, &on_body, &on_wall))
        return;
    vec3 n = v3_cross(v3_sub(b, a), d); /* outward: between the normals of the faces */
    n = v3_scale(1.0 / v3_norm(n), n);
    const vec3 out = v3_add(n1, n2);
    if (v3_dot(n, out) < 0.0)
        n = v3_scale(-1.0, n);
    const double c = v3_dot(n1, n2), h1 = v3_dot(n, n1), h2 = v3_dot(n, n2);
    if (h1 < c * h2 || h2 < c * h1)
        return; /* not between the faces: the nearest is a face, not this edge */
    const double distance = v3_dot(n, v3_sub(on_wall, on_body));
    if (v3_dot(n, inward) < -LEVEL || distance < -s->r ||
        (distance < 0.0 && !behind_all(p, on_wall)))
        return; /* the inside of the piece comes nearer; or it passes behind the body */
    put(s, id, on_body, distance, v3_scale(-1.0, n));
}

static void of_part(struct facet_search *s, const struct dilated_part *part)
{
    const struct polyhedron *const p = part->core;
    const int corners = s->f->n;
    for (int k = 0; k < corners; k++) {
        corner_on_face(s, p, k, k);
        const vec3 q = s->corner[k], d = v3_sub(s->corner[(k + 1) % corners], q);
        const vec3 other = v3_sub(s->corner[(k + 2) % corners], q);
        const vec3 inward = v3_axpy(other, -v3_dot(other, d) / v3_dot(d, d), d);
        for (int e = 0; e < p->n_edges; e++)
            edge_on_edge(s, p, e, q, d, v3_scale(1.0 / v3_norm(inward), inward), 4 + 4 * e + k);
    }
    s->id += 4 + 4 * p->n_edges;
}

int dilated_facet(const struct dilated *d, const struct shape_pose *i,
                  const struct shape_facet *f, double reach, int most, struct shape_point *out)
{
    struct facet_search s = {.pose = i,
                             .f = f,
                             .reach = reach / i->size,
                             .most = most,
                             .id = d->n_balls,
                             .r = d->r,
                             .out = out};
    for (int k = 0; k < f->n; k++)
        s.corner[k] = v3_scale(1.0 / i->size, mat3_back(&i->turn, f->corner[k]));
    for (int k = 0; k < d->n_parts && f->n > 0; k++)
        of_part(&s, &d->part[k]);
    return s.n;
}
