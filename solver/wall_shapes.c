/* wall_shapes.c - flat surfaces that the kinds of walls are made of: planes, sides of the box,
 * rectangles. Nearest points in closed form. (wall_strips.c: round ones.) */
#include "walls/wall_kind.h"

void found_add(struct found *f, int x)
{
    if (f->n == f->room) {
        const int more = 2 * f->room + 256;
        f->x = xrealloc(f->x, (size_t)f->room, (size_t)more, sizeof *f->x);
        f->room = more;
    }
    f->x[f->n++] = x;
}

vec3 wall_unit_vector(struct scene *scene, const char *name, const char *key)
{
    const vec3 v = scene_vector(scene, "wall", name, key);
    const double length = v3_norm(v);
    if (length > 0.0)
        return v3_scale(1.0 / length, v);
    if (scene_given(scene, "wall", name, key))
        scene_error(scene, "wall", name, key, "must not be zero");
    return v3(0.0, 0.0, 1.0);
}

int wall_single(const void *shape)
{
    (void)shape;
    return 1;
}

static double height(const struct wall_flat *p, vec3 x)
{
    return v3_dot(v3_sub(x, p->point), p->normal);
}

void wall_flat_view(const void *shape, int element, const vec3 *x, struct wall_view *out)
{
    const struct wall_flat *const p = shape;
    (void)element;
    wall_view_put(out, v3_scale(height(p, v3(x->x, x->y, x->z)), p->normal), 0.0, WALL_FACE);
}

void wall_flat_views(const void *shape, struct wall_looks *l)
{
    const struct wall_flat *const f = shape;
    const vec3 p = f->point, n = f->normal;
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const double x = l->x[c] - p.x, y = l->y[c] - p.y, z = l->z[c] - p.z;
        const double h = x * n.x + y * n.y + z * n.z;
        l->ax[c] = h * n.x;
        l->ay[c] = h * n.y;
        l->az[c] = h * n.z;
        l->curvature[c] = 0.0;
        l->part[c] = WALL_FACE;
    }
}

/* What is behind it is near too: it is to be found. */
void wall_flat_near(const void *shape, vec3 x, double reach, struct found *out)
{
    if (height(shape, x) < reach)
        found_add(out, 0);
}

bool wall_flat_behind(const void *shape, vec3 x)
{
    return height(shape, x) < 0.0;
}

void wall_flat_bounds(const void *shape, vec3 *low, vec3 *high)
{
    const struct wall_flat *const p = shape;
    const double n[3] = {p->normal.x, p->normal.y, p->normal.z};
    const double at[3] = {p->point.x, p->point.y, p->point.z};
    double lo[3], hi[3];
    for (int a = 0; a < 3; a++) {
        const bool flat = fabs(n[a]) == 1.0;
        lo[a] = flat ? at[a] : -(double)INFINITY;
        hi[a] = flat ? at[a] : (double)INFINITY;
    }
    *low = v3(lo[0], lo[1], lo[2]);
    *high = v3(hi[0], hi[1], hi[2]);
}

/* Turned about its normal it stays. */
double wall_flat_sweep(const void *shape, vec3 point, vec3 axis)
{
    const struct wall_flat *const p = shape;
    (void)point;
    return fabs(v3_dot(axis, p->normal)) > 1.0 - 1e-12 ? 0.0 : (double)INFINITY;
}

/* Cuts a polygon with the half-space where `sign` (x_a - at) >= 0; returns its corners. */
static int cut(vec3 *p, int n, int a, double at, double sign)
{
    vec3 out[12];
    int m = 0;
    for (int k = 0; k < n; k++) {
        const vec3 u = p[k], v = p[(k + 1) % n];
        const double x = sign * ((a == 0 ? u.x : a == 1 ? u.y : u.z) - at);
        const double y = sign * ((a == 0 ? v.x : a == 1 ? v.y : v.z) - at);
        if (x >= 0.0)
            out[m++] = u;
        if ((x < 0.0) != (y < 0.0))
            out[m++] = v3_axpy(u, x / (x - y), v3_sub(v, u));
    }
    for (int k = 0; k < m; k++)
        p[k] = out[k];
    return m;
}

/* The part of the plane that lies in the box of the picture. */
void wall_flat_draw(const void *shape, struct wall_canvas *c)
{
    const struct wall_flat *const f = shape;
    const vec3 middle = v3_scale(0.5, v3_add(c->low, c->high));
    const double wide = 2.0 * v3_norm(v3_sub(c->high, c->low));
    const vec3 foot = v3_axpy(middle, -height(f, middle), f->normal);
    const vec3 e = v3_scale(wide, v3_across(f->normal)), g = v3_cross(f->normal, e);
    vec3 p[12] = {v3_add(foot, e), v3_add(foot, g), v3_sub(foot, e), v3_sub(foot, g)};
    int n = 4;
    const double low[3] = {c->low.x, c->low.y, c->low.z};
    const double high[3] = {c->high.x, c->high.y, c->high.z};
    for (int a = 0; a < 3; a++) {
        n = cut(p, n, a, low[a], 1.0);
        n = cut(p, n, a, high[a], -1.0);
    }
    for (int k = 1; k + 1 < n; k++)
        c->triangle(c, p[0], p[k], p[k + 1]);
}

const struct wall_kind wall_side = {.name = "side",
                                    .summary = "a side of the box",
                                    .free = xfree,
                                    .elements = wall_single,
                                    .view = wall_flat_view,
                                    .views = wall_flat_views,
                                    .near = wall_flat_near,
                                    .behind = wall_flat_behind,
                                    .bounds = wall_flat_bounds,
                                    .sweep = wall_flat_sweep};

static double clamped(double t)
{
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

void wall_rectangle_view(const vec3 *origin, const vec3 *edge1, const vec3 *edge2,
                         const vec3 *x, struct wall_view *out)
{
    const vec3 e1 = *edge1, e2 = *edge2;
    const vec3 rel = v3(x->x - origin->x, x->y - origin->y, x->z - origin->z);
    const double u = v3_dot(rel, e1) / v3_dot(e1, e1), v = v3_dot(rel, e2) / v3_dot(e2, e2);
    const double a = clamped(u), b = clamped(v);
    const int outside = (a != u) + (b != v);
    if (outside == 0) { /* along the normal, without the rounding of a difference of points */
        vec3 n = v3_cross(e1, e2);
        n = v3_scale(1.0 / v3_norm(n), n);
        wall_view_put(out, v3_scale(v3_dot(rel, n), n), 0.0, WALL_FACE);
    } else {
        wall_view_put(out, v3_axpy(v3_axpy(rel, -a, e1), -b, e2), 0.0,
                      outside == 1 ? WALL_EDGE : WALL_VERTEX);
    }
}

void wall_rectangle_views(const vec3 *origin, const vec3 *edge1, const vec3 *edge2,
                          struct wall_looks *l)
{
    const vec3 o = *origin, e = *edge1, f = *edge2, across = v3_cross(e, f);
    const vec3 n = v3_scale(1.0 / v3_norm(across), across);
    const double ee = v3_dot(e, e), ff = v3_dot(f, f);
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const double x = l->x[c] - o.x, y = l->y[c] - o.y, z = l->z[c] - o.z;
        const double u = (x * e.x + y * e.y + z * e.z) / ee;
        const double v = (x * f.x + y * f.y + z * f.z) / ff;
        const double a = u < 0.0 ? 0.0 : u > 1.0 ? 1.0 : u;
        const double b = v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v;
        const double h = x * n.x + y * n.y + z * n.z;
        const int outside = (a != u) + (b != v);
        l->ax[c] = outside == 0 ? h * n.x : x - a * e.x - b * f.x;
        l->ay[c] = outside == 0 ? h * n.y : y - a * e.y - b * f.y;
        l->az[c] = outside == 0 ? h * n.z : z - a * e.z - b * f.z;
        l->curvature[c] = 0.0;
        l->part[c] = outside; /* face, edge, vertex */
    }
}

bool wall_rectangle_flat(const vec3 *origin, const vec3 *edge1, const vec3 *edge2,
                         const vec3 *x, struct wall_flat *plane, double *within)
{
    const vec3 e = *edge1, f = *edge2, across = v3_cross(e, f);
    const vec3 rel = v3(x->x - origin->x, x->y - origin->y, x->z - origin->z);
    const double le = v3_norm(e), lf = v3_norm(f), u = v3_dot(rel, e) / le,
                 v = v3_dot(rel, f) / lf;
    *within = fmin(fmin(u, le - u), fmin(v, lf - v));
    plane->point = v3_axpy(*origin, 0.5, v3_add(e, f));
    plane->normal = v3_scale(1.0 / v3_norm(across), across);
    return true;
}
