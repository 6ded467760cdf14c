/* wall_strips.c - round surfaces that the kinds of walls are made of: strips of revolution (disc, tube,
 * frustum), tubes with caps. Nearest points in closed form. */
#include "real.h"
#include "walls/wall_tube.h"

#define PI 3.14159265358979323846

enum { SIDE_BOTH, SIDE_IN, SIDE_OUT };
enum { CAPS_NONE, CAPS_FOOT, CAPS_END, CAPS_BOTH };

static double clamped(double t)
{
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

/* In the half-plane of x the strip is a segment. */
void wall_strip_view(const struct wall_strip *s, const vec3 *x, struct wall_view *out)
{
    const vec3 rel = v3(x->x - s->foot.x, x->y - s->foot.y, x->z - s->foot.z);
    const double h = v3_dot(rel, s->axis);
    const vec3 radial = v3_axpy(rel, -h, s->axis);
    const double r = v3_norm(radial);
    const vec3 outwards = r > 0.0 ? v3_scale(1.0 / r, radial) : v3_across(s->axis);
    const double dh = s->h1 - s->h0, dr = s->r1 - s->r0;
    const double t = ((h - s->h0) * dh + (r - s->r0) * dr) / (dh * dh + dr * dr);
    const double at = clamped(t), up = h - (s->h0 + at * dh);
    const double radius = s->r0 + at * dr, beyond = r - radius;
    double curvature = 0.0;
    enum wall_part part = WALL_FACE;
    const double distance = sqrt(up * up + beyond * beyond);
    if (at != t && radius > 0.0)
        part = WALL_EDGE;
    else if (at != t && dh != 0.0)
        part = WALL_VERTEX; /* the tip of a cone; the middle of a disc is none */
    else if (radius > 0.0 && distance > 0.0)
        curvature = beyond / distance / radius;
    wall_view_put(out, v3_axpy(v3_scale(up, s->axis), beyond, outwards), curvature, part);
}

/* The same for several; `one`: they all look at strip[0], whose numbers then stay where they are. */
static inline __attribute__((always_inline)) void views(const struct wall_strip *strip,
                                                        struct wall_looks *l, bool one)
{
    const vec3 foot = strip->foot, axis = strip->axis, across = v3_across(axis);
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const struct wall_strip *const s = &strip[one ? 0 : l->element[c]];
        const double x = l->x[c] - foot.x, y = l->y[c] - foot.y, z = l->z[c] - foot.z;
        const double h = x * axis.x + y * axis.y + z * axis.z;
        const double rx = x - h * axis.x, ry = y - h * axis.y, rz = z - h * axis.z;
        const double square = rx * rx + ry * ry + rz * rz;
        const double some = inverse_root_double(square), r = square * some;
        const double inverse = square > 0.0 ? some : 0.0, none = square > 0.0 ? 0.0 : 1.0;
        const double h0 = s->h0, r0 = s->r0, dh = s->h1 - h0, dr = s->r1 - r0;
        const double per = 1.0 / (dh * dh + dr * dr);
        const double t = ((h - h0) * dh + (r - r0) * dr) * per;
        const double at = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t, up = h - (h0 + at * dh);
        const double radius = r0 + at * dr, beyond = r - radius;
        const double away = up * up + beyond * beyond;
        const bool ends = at != t, edge = ends & (radius > 0.0), tip = ends & (dh != 0.0);
        const bool curved = !ends & (radius > 0.0) & (away > 0.0);
        const double over = beyond * inverse_root_double(away) / (curved ? radius : 1.0);
        l->ax[c] = up * axis.x + beyond * (inverse * rx + none * across.x);
        l->ay[c] = up * axis.y + beyond * (inverse * ry + none * across.y);
        l->az[c] = up * axis.z + beyond * (inverse * rz + none * across.z);
        l->curvature[c] = curved ? over : 0.0;
        l->part[c] = edge ? WALL_EDGE : tip ? WALL_VERTEX : WALL_FACE;
    }
}

void wall_strip_views(const struct wall_strip *strip, int n, struct wall_looks *l)
{
    if (n == 1)
        views(strip, l, true);
    else
        views(strip, l, false);
}

bool wall_strip_flat(const struct wall_strip *s, const vec3 *x, struct wall_flat *plane,
                     double *within)
{
    if (s->h0 != s->h1)
        return false;
    const vec3 rel = v3(x->x - s->foot.x, x->y - s->foot.y, x->z - s->foot.z);
    const double r = v3_norm(v3_axpy(rel, -v3_dot(rel, s->axis), s->axis));
    const double inner = fmin(s->r0, s->r1), outer = fmax(s->r0, s->r1);
    *within = inner > 0.0 ? fmin(outer - r, r - inner) : outer - r;
    plane->point = v3_axpy(s->foot, s->h0, s->axis);
    plane->normal = s->axis;
    return true;
}

enum { AROUND = 96 };

static vec3 ring(const struct wall_strip *s, double h, double r, int k)
{
    const vec3 e = v3_across(s->axis), f = v3_cross(s->axis, e);
    const double angle = 2.0 * PI * (k % AROUND) / AROUND;
    const vec3 centre = v3_axpy(s->foot, h, s->axis);
    return v3_axpy(v3_axpy(centre, r * cos(angle), e), r * sin(angle), f);
}

void wall_strip_draw(const struct wall_strip *s, struct wall_canvas *c)
{
    for (int k = 0; k < AROUND; k++) {
        const vec3 a = ring(s, s->h0, s->r0, k), b = ring(s, s->h0, s->r0, k + 1);
        const vec3 p = ring(s, s->h1, s->r1, k), q = ring(s, s->h1, s->r1, k + 1);
        if (s->r0 > 0.0)
            c->triangle(c, a, b, q);
        if (s->r1 > 0.0)
            c->triangle(c, a, q, p);
    }
}

void wall_strip_bounds(const struct wall_strip *s, vec3 *low, vec3 *high)
{
    const double foot[3] = {s->foot.x, s->foot.y, s->foot.z};
    const double axis[3] = {s->axis.x, s->axis.y, s->axis.z};
    double lo[3], hi[3];
    for (int a = 0; a < 3; a++) {
        const double wide = sqrt(fmax(0.0, 1.0 - axis[a] * axis[a]));
        const double c0 = foot[a] + (axis[a] != 0.0 ? s->h0 * axis[a] : 0.0);
        const double c1 = foot[a] + (axis[a] != 0.0 ? s->h1 * axis[a] : 0.0);
        lo[a] = fmin(c0 - s->r0 * wide, c1 - s->r1 * wide);
        hi[a] = fmax(c0 + s->r0 * wide, c1 + s->r1 * wide);
    }
    *low = v3(lo[0], lo[1], lo[2]);
    *high = v3(hi[0], hi[1], hi[2]);
}

double wall_strip_sweep(const struct wall_strip *s, vec3 point, vec3 axis)
{
    const double length = fmax(s->r0, s->r1);
    const vec3 off = v3_cross(v3_sub(s->foot, point), axis);
    if (v3_norm(v3_cross(axis, s->axis)) < 1e-9 && v3_norm(off) < 1e-9 * length)
        return 0.0;
    return (double)INFINITY; /* no better than the bounds */
}

/* Element 0 is the tube, the others are its caps. */
struct tube {
    struct wall_strip strip[3];
    int n, side;
    bool endless;
};

/* An endless tube along a periodic direction must fit it, or leave it alone. */
static void check_periods(struct scene *scene, const char *name, const struct domain *d,
                          vec3 axis)
{
    const double along[3] = {axis.x, axis.y, axis.z};
    for (int a = 0; a < 3; a++)
        if (d->periodic[a] && along[a] != 0.0 && fabs(along[a]) < 1.0)
            scene_error(scene, "wall", name, "axis", "an endless cylinder askew in periodic %c",
                        'x' + a);
}

void *wall_tube_read(struct scene *scene, const char *name, const struct domain *d, double foot,
                     double end, bool endless)
{
    struct tube *const t = xalloc(1, sizeof *t);
    struct wall_strip *const s = &t->strip[0];
    s->foot = scene_vector(scene, "wall", name, "point");
    s->axis = wall_unit_vector(scene, name, "axis");
    s->r0 = foot;
    s->r1 = end;
    s->h1 = endless ? (double)INFINITY : scene_real(scene, "wall", name, "length");
    s->h0 = endless ? -(double)INFINITY : 0.0;
    t->n = 1;
    t->endless = endless;
    t->side = scene_choice(scene, "wall", name, "side");
    const int caps = scene_choice(scene, "wall", name, "caps");
    if (endless && caps != CAPS_NONE)
        scene_error(scene, "wall", name, "caps",
                    "an endless cylinder has none: give its length");
    if (endless)
        check_periods(scene, name, d, s->axis);
    else if (!(s->h1 > 0.0))
        s->h1 = 1.0; /* an error is on the list */
    for (int k = CAPS_FOOT; k <= CAPS_END; k++)
        if ((caps == k || caps == CAPS_BOTH) && (k == CAPS_FOOT ? foot : end) > 0.0)
            t->strip[t->n++] = (struct wall_strip){.foot = s->foot,
                                                   .axis = s->axis,
                                                   .h0 = k == CAPS_FOOT ? 0.0 : s->h1,
                                                   .h1 = k == CAPS_FOOT ? 0.0 : s->h1,
                                                   .r1 = k == CAPS_FOOT ? foot : end};
    return t;
}

int wall_tube_elements(const void *shape)
{
    return ((const struct tube *)shape)->n;
}

void wall_tube_view(const void *shape, int element, const vec3 *x, struct wall_view *out)
{
    const struct tube *const t = shape;
    const struct wall_strip *const s = &t->strip[element];
    if (!t->endless) {
        wall_strip_view(s, x, out);
        return;
    }
    const vec3 rel = v3(x->x - s->foot.x, x->y - s->foot.y, x->z - s->foot.z);
    const vec3 radial = v3_axpy(rel, -v3_dot(rel, s->axis), s->axis);
    const double r = v3_norm(radial), beyond = r - s->r0;
    const vec3 outwards = r > 0.0 ? v3_scale(1.0 / r, radial) : v3_across(s->axis);
    wall_view_put(out, v3_scale(beyond, outwards), (beyond > 0.0 ? 1.0 : -1.0) / s->r0,
                  WALL_FACE);
}

void wall_tube_views(const void *shape, struct wall_looks *l)
{
    const struct tube *const t = shape;
    const struct wall_strip *const s = &t->strip[0];
    const vec3 foot = s->foot, axis = s->axis, across = v3_across(axis);
    const double radius = s->r0, curvature = 1.0 / radius;
    if (!t->endless) {
        wall_strip_views(s, t->n, l);
        return;
    }
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const double x = l->x[c] - foot.x, y = l->y[c] - foot.y, z = l->z[c] - foot.z;
        const double h = x * axis.x + y * axis.y + z * axis.z;
        const double rx = x - h * axis.x, ry = y - h * axis.y, rz = z - h * axis.z;
        const double square = rx * rx + ry * ry + rz * rz;
        const double some = inverse_root_double(square), beyond = square * some - radius;
        const double inverse = square > 0.0 ? some : 0.0, none = square > 0.0 ? 0.0 : 1.0;
        l->ax[c] = beyond * (inverse * rx + none * across.x);
        l->ay[c] = beyond * (inverse * ry + none * across.y);
        l->az[c] = beyond * (inverse * rz + none * across.z);
        l->curvature[c] = beyond > 0.0 ? curvature : -curvature;
        l->part[c] = WALL_FACE;
    }
}

bool wall_tube_flat(const void *shape, int element, const vec3 *x, struct wall_flat *plane,
                    double *within)
{
    const struct tube *const t = shape;
    return element > 0 && wall_strip_flat(&t->strip[element], x, plane, within);
}

bool wall_tube_behind(const void *shape, vec3 x)
{
    const struct tube *const t = shape;
    const struct wall_strip *const s = &t->strip[0];
    const vec3 rel = v3_sub(x, s->foot);
    const double h = v3_dot(rel, s->axis), r = v3_norm(v3_axpy(rel, -h, s->axis));
    const double part = t->endless ? 0.0 : (h - s->h0) / (s->h1 - s->h0);
    const bool along = part >= 0.0 && part <= 1.0;
    const bool inside = along && r < s->r0 + part * (s->r1 - s->r0);
    return t->side == SIDE_IN ? along && !inside : t->side == SIDE_OUT && inside;
}

void wall_tube_bounds(const void *shape, vec3 *low, vec3 *high)
{
    wall_strip_bounds(shape, low, high);
}

double wall_tube_sweep(const void *shape, vec3 point, vec3 axis)
{
    return wall_strip_sweep(shape, point, axis);
}

void wall_tube_draw(const void *shape, struct wall_canvas *c)
{
    const struct tube *const t = shape;
    if (t->endless) { /* as far as the box of the picture goes along the axis */
        struct wall_strip s = t->strip[0];
        s.h0 = (double)INFINITY;
        s.h1 = -(double)INFINITY;
        for (int corner = 0; corner < 8; corner++) {
            const vec3 x =
                v3(corner & 1 ? c->high.x : c->low.x, corner & 2 ? c->high.y : c->low.y,
                   corner & 4 ? c->high.z : c->low.z);
            const double h = v3_dot(v3_sub(x, s.foot), s.axis);
            s.h0 = fmin(s.h0, h);
            s.h1 = fmax(s.h1, h);
        }
        wall_strip_draw(&s, c);
    }
    for (int k = 0; k < t->n && !t->endless; k++)
        wall_strip_draw(&t->strip[k], c);
}
