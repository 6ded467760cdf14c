/* shapes/geometry/dilated_surface.c - the surface of dilated polyhedra in triangles: for pictures,
 * its area, and the shadow that it casts.
 *
 * Faces are moved out by r, edges are strips of a cylinder, vertices patches of a sphere. Of several
 * parts that overlap the area counts where no other part covers it. The shadow of one part is exact
 * (area of the core's, its perimeter times r, pi r^2); that of several is counted on a raster for a
 * table of directions over half a cube, and taken from there by bilinear interpolation. */
#include "dilated.h"

#define PI 3.14159265358979323846

enum { NODES = 9, RASTER = 128, STRIPS = 4, DEPTH = 2 };

static void triangle(struct shape_canvas *c, vec3 a, vec3 b, vec3 p)
{
    c->triangle(c, a, b, p);
}

static void faces(const struct polyhedron *p, double r, struct shape_canvas *c)
{
    for (int f = 0; f < p->n_faces; f++) {
        const int *const loop = &p->loop[p->loop_begin[f]];
        const int n = p->loop_begin[f + 1] - p->loop_begin[f];
        const vec3 up = v3_scale(r, polyhedron_normal(p, f));
        for (int k = 1; k < n - 1; k++)
            triangle(c, v3_add(polyhedron_vertex(p, loop[0]), up),
                     v3_add(polyhedron_vertex(p, loop[k]), up),
                     v3_add(polyhedron_vertex(p, loop[k + 1]), up));
    }
}

/* The unit vector a part t of the way from a to b. */
static vec3 on_arc(vec3 a, vec3 b, double t)
{
    const double whole = acos(fmin(fmax(v3_dot(a, b), -1.0), 1.0)), s = sin(whole);
    if (!(s > 1e-9))
        return a;
    return v3_axpy(v3_scale(sin((1.0 - t) * whole) / s, a), sin(t * whole) / s, b);
}

static void edges(const struct polyhedron *p, double r, struct shape_canvas *c)
{
    for (int e = 0; e < p->n_edges; e++) {
        const vec3 a = polyhedron_vertex(p, p->edge[e][0]),
                   b = polyhedron_vertex(p, p->edge[e][1]);
        const vec3 left = polyhedron_normal(p, p->edge_face[e][0]),
                   right = polyhedron_normal(p, p->edge_face[e][1]);
        for (int k = 0; k < STRIPS; k++) {
            const vec3 n = on_arc(right, left, (double)k / STRIPS),
                       m = on_arc(right, left, (k + 1.0) / STRIPS);
            triangle(c, v3_axpy(a, r, n), v3_axpy(b, r, n), v3_axpy(b, r, m));
            triangle(c, v3_axpy(a, r, n), v3_axpy(b, r, m), v3_axpy(a, r, m));
        }
    }
}

static void patch(vec3 at, double r, vec3 a, vec3 b, vec3 d, int depth, struct shape_canvas *c)
{
    if (depth == 0) {
        triangle(c, v3_axpy(at, r, a), v3_axpy(at, r, b), v3_axpy(at, r, d));
        return;
    }
    const vec3 ab = on_arc(a, b, 0.5), bd = on_arc(b, d, 0.5), da = on_arc(d, a, 0.5);
    patch(at, r, a, ab, da, depth - 1, c);
    patch(at, r, ab, b, bd, depth - 1, c);
    patch(at, r, da, bd, d, depth - 1, c);
    patch(at, r, ab, bd, da, depth - 1, c);
}

static void vertices(const struct polyhedron *p, double r, struct shape_canvas *c)
{
    for (int v = 0; v < p->n_vertices; v++) {
        const int *const fan = &p->fan[p->fan_begin[v]];
        const int n = p->fan_begin[v + 1] - p->fan_begin[v];
        for (int k = 1; k < n - 1; k++)
            patch(polyhedron_vertex(p, v), r, polyhedron_normal(p, fan[0]),
                  polyhedron_normal(p, fan[k]), polyhedron_normal(p, fan[k + 1]), DEPTH, c);
    }
}

static void draw_part(const struct polyhedron *p, double r, struct shape_canvas *c)
{
    if (p->radius > 0.0) {
        faces(p, r, c);
        edges(p, r, c);
        vertices(p, r, c);
        return;
    }
    const vec3 e[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int k = 0; k < 8; k++) {
        const vec3 a = v3_scale(k & 1 ? -1.0 : 1.0, e[0]),
                   b = v3_scale(k & 2 ? -1.0 : 1.0, e[1]),
                   d = v3_scale(k & 4 ? -1.0 : 1.0, e[2]);
        const bool even = ((k & 1) + (k >> 1 & 1) + (k >> 2 & 1)) % 2 == 0;
        patch(v3(0.0, 0.0, 0.0), r, a, even ? b : d, even ? d : b, DEPTH + 1, c);
    }
}

void dilated_surface(const struct dilated *d, struct shape_canvas *c)
{
    for (int k = 0; k < d->n_parts; k++)
        draw_part(d->part[k].core, d->r, c);
}

/* Adds up what no other part covers. */
struct area_canvas {
    struct shape_canvas canvas;
    const struct dilated *d;
    int part;
    double area;
};

/* Of a face that two parts have in common, the first part's counts. */
static bool covered(const struct dilated *d, int part, vec3 x, vec3 normal)
{
    for (int k = 0; k < d->n_parts; k++) {
        const double shift = k < part ? -1e-6 : 1e-6;
        if (k != part && dilated_part_holds(d, k, v3_axpy(x, shift, normal)))
            return true;
    }
    return false;
}

static void add_area(struct area_canvas *c, vec3 a, vec3 b, vec3 p)
{
    const vec3 ab = v3_sub(b, a), ap = v3_sub(p, a), bp = v3_sub(p, b);
    const double wide = fmax(v3_norm(ab), fmax(v3_norm(ap), v3_norm(bp)));
    if (wide > 0.08 && c->d->n_parts > 1) {
        const vec3 m = v3_scale(0.5, v3_add(a, b)), n = v3_scale(0.5, v3_add(b, p)),
                   o = v3_scale(0.5, v3_add(p, a));
        add_area(c, a, m, o);
        add_area(c, m, b, n);
        add_area(c, o, n, p);
        add_area(c, m, n, o);
        return;
    }
    const vec3 middle = v3_scale(1.0 / 3.0, v3_add(a, v3_add(b, p)));
    const vec3 twice = v3_cross(ab, ap);
    const double area = 0.5 * v3_norm(twice);
    if (area > 0.0 &&
        (c->d->n_parts == 1 || !covered(c->d, c->part, middle, v3_scale(0.5 / area, twice))))
        c->area += area;
}

static void area_triangle(struct shape_canvas *canvas, vec3 a, vec3 b, vec3 p)
{
    add_area((struct area_canvas *)canvas, a, b, p);
}

static double area_of(const struct dilated *d)
{
    struct area_canvas c = {{area_triangle}, d, 0, 0.0};
    if (d->n_parts == 1 && d->part[0].core->radius > 0.0)
        return polyhedron_surface(d->part[0].core, d->r);
    if (d->n_parts == 1)
        return 4.0 * PI * d->r * d->r;
    for (; c.part < d->n_parts; c.part++)
        draw_part(d->part[c.part].core, d->r, &c.canvas);
    return c.area;
}

/* A raster on which triangles are dropped along a direction. */
struct shadow_canvas {
    struct shape_canvas canvas;
    vec3 e1, e2;
    double step, edge;
    unsigned char dark[RASTER][RASTER];
};

static double side(double ax, double ay, double bx, double by, double x, double y)
{
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
}

static int pixel(const struct shadow_canvas *s, double x)
{
    const int k = (int)floor((x + s->edge) / s->step);
    return k < 0 ? 0 : k < RASTER ? k : RASTER - 1;
}

static void shadow_triangle(struct shape_canvas *canvas, vec3 a, vec3 b, vec3 p)
{
    struct shadow_canvas *const s = (struct shadow_canvas *)canvas;
    const double ax = v3_dot(a, s->e1), ay = v3_dot(a, s->e2), bx = v3_dot(b, s->e1),
                 by = v3_dot(b, s->e2), px = v3_dot(p, s->e1), py = v3_dot(p, s->e2);
    const double turn = side(ax, ay, bx, by, px, py) < 0.0 ? -1.0 : 1.0;
    for (int j = pixel(s, fmin(ay, fmin(by, py))); j <= pixel(s, fmax(ay, fmax(by, py))); j++)
        for (int i = pixel(s, fmin(ax, fmin(bx, px))); i <= pixel(s, fmax(ax, fmax(bx, px)));
             i++) {
            const double x = (i + 0.5) * s->step - s->edge, y = (j + 0.5) * s->step - s->edge;
            s->dark[j][i] |= turn * side(ax, ay, bx, by, x, y) >= 0.0 &&
                             turn * side(bx, by, px, py, x, y) >= 0.0 &&
                             turn * side(px, py, ax, ay, x, y) >= 0.0;
        }
}

static double raster_shadow(const struct dilated *d, vec3 along)
{
    struct shadow_canvas *const s = xalloc(1, sizeof *s);
    long dark = 0;
    s->canvas.triangle = shadow_triangle;
    s->edge = d->radius;
    s->step = 2.0 * d->radius / RASTER;
    s->e1 = v3_across(along);
    s->e2 = v3_cross(along, s->e1);
    dilated_surface(d, &s->canvas);
    for (int j = 0; j < RASTER; j++)
        for (int i = 0; i < RASTER; i++)
            dark += s->dark[j][i];
    const double area = (double)dark * s->step * s->step;
    xfree(s);
    return area;
}

/* Node i, j of the face of a cube across the axis. */
static vec3 node_direction(int axis, int i, int j)
{
    const double a = 2.0 * i / (NODES - 1) - 1.0, b = 2.0 * j / (NODES - 1) - 1.0;
    const vec3 x = axis == 0 ? v3(1.0, a, b) : axis == 1 ? v3(b, 1.0, a) : v3(a, b, 1.0);
    return v3_scale(1.0 / v3_norm(x), x);
}

void dilated_make_shadows(struct dilated *d)
{
    d->surface = area_of(d);
    if (d->n_parts == 1)
        return;
    d->shadow = xalloc(3 * NODES * NODES, sizeof *d->shadow);
    for (int axis = 0; axis < 3; axis++)
        for (int j = 0; j < NODES; j++)
            for (int i = 0; i < NODES; i++)
                d->shadow[d->n_shadows++] = raster_shadow(d, node_direction(axis, i, j));
}

static double shadow_of_one(const struct dilated *d, vec3 u)
{
    const struct polyhedron *const p = d->part[0].core;
    double area = 0.0, round = 0.0;
    if (!(p->radius > 0.0))
        return PI * d->r * d->r;
    for (int e = 0; e < p->n_edges; e++) {
        const bool one = v3_dot(polyhedron_normal(p, p->edge_face[e][0]), u) > 0.0;
        const bool two = v3_dot(polyhedron_normal(p, p->edge_face[e][1]), u) > 0.0;
        if (one == two)
            continue;
        const vec3 a = polyhedron_vertex(p, p->edge[e][0]),
                   b = polyhedron_vertex(p, p->edge[e][1]);
        const vec3 flat = v3_sub(v3_sub(b, a), v3_scale(v3_dot(v3_sub(b, a), u), u));
        round += v3_norm(flat);
        /* the outline runs along the edge of the face that is lit */
        area += (one ? 0.5 : -0.5) * v3_dot(u, v3_cross(a, b));
    }
    return area + round * d->r + PI * d->r * d->r;
}

double dilated_shadow(const struct dilated *d, vec3 u)
{
    if (d->n_parts == 1)
        return shadow_of_one(d, u);
    const double ax = fabs(u.x), ay = fabs(u.y), az = fabs(u.z);
    const int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    const double main = axis == 0 ? u.x : axis == 1 ? u.y : u.z;
    const double a = (axis == 0   ? u.y
                      : axis == 1 ? u.z
                                  : u.x) /
                     main,
                 b = (axis == 0   ? u.z
                      : axis == 1 ? u.x
                                  : u.y) /
                     main;
    const double s = 0.5 * (a + 1.0) * (NODES - 1), t = 0.5 * (b + 1.0) * (NODES - 1);
    const int i = s < NODES - 2 ? (int)s : NODES - 2, j = t < NODES - 2 ? (int)t : NODES - 2;
    const double p = s - i, q = t - j;
    const double *const at = &d->shadow[axis * NODES * NODES + j * NODES + i];
    return (1.0 - q) * ((1.0 - p) * at[0] + p * at[1]) +
           q * ((1.0 - p) * at[NODES] + p * at[NODES + 1]);
}
