/* superquadric_pair.c - the common normal of two superquadrics, see superquadric.h.
 *
 * On the unit sphere the gap g(n) = n . apart - h_i(n) - h_j(n) (both bodies have h(-n) = h(n))
 * has the gradient T' (apart - p_i - p_j) and the Hessian -(T' (H_i + H_j) T + g), with p the
 * points and H the Hessians of the support functions, T a basis across n. Newton's step solves a
 * 2 x 2 system; quadratic convergence from the last step's normal takes two evaluations. Where a
 * step overshoots - faces of blocky bodies have infinite radii of curvature, p changes there as a
 * root of n - the point of the blockier body is moved instead and its normal taken, in which
 * the equations are smooth; and if that fails the step is cut by the secant of the slopes. The
 * depth so found is minus the largest gap, a potential: -d(depth)/dx_i is the normal, so elastic
 * contacts whose force depends on the depth alone conserve energy, which those of midway points
 * [Podlozhnyuk17, eq. 13] need not. Nearest points by common normals: [Wellmann08]. */
#include "superquadric.h"

enum { LATE = 8, TRIES = 40 };

static const double turned = 1e-15; /* rad, of no account */
static const double aligned =
    1e-6; /* sizes: the linear step from there is good to 1e-12 or so */
/* sizes, of the gap: what is left to gain when the normal's round-off, times the radius of a face's
 * curvature, moves the points more than a step does */
static const double noise = 1e-13;
static const double blocky =
    2.0; /* sizes: radii of curvature from which on the point is moved first */
static const double largest_step = 0.7; /* rad */

static inline vec3 times(const struct symmetric *m, vec3 v)
{
    return v3(m->xx * v.x + m->xy * v.y + m->xz * v.z, m->xy * v.x + m->yy * v.y + m->yz * v.z,
              m->xz * v.x + m->yz * v.y + m->zz * v.z);
}

struct tensor2 {
    double uu, uv, vv;
};

static inline double det2(struct tensor2 m)
{
    return m.uu * m.vv - m.uv * m.uv;
}

/* One body seen along the normal. */
struct side {
    vec3 p;           /* of its surface, from the centre, laboratory */
    struct tensor2 H; /* on the basis across the normal */
};

/* All that is known at a normal. */
struct view {
    vec3 n, u, v; /* normal and basis across it */
    struct side i, j;
    vec3 g; /* between the two points */
    double gap, gu, gv;
};

/* Two unit vectors across n [Duff17]. */
static inline void basis_across(vec3 n, vec3 *u, vec3 *v)
{
    const double sign = copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    *u = v3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    *v = v3(b, sign + n.y * n.y * a, -n.y);
}

static inline void side_see(struct side *s, const struct superquadric_placed *b,
                            const struct view *w)
{
    struct symmetric m;
    const vec3 u = mat3_back(&b->turn, w->u), v = mat3_back(&b->turn, w->v);
    const vec3 p = superquadric_support_curved(b->shape, mat3_back(&b->turn, w->n), &m);
    s->p = v3_scale(b->size, mat3_turn(&b->turn, p));
    const vec3 mu = times(&m, u), mv = times(&m, v);
    s->H = (struct tensor2){b->size * v3_dot(u, mu), b->size * v3_dot(u, mv),
                            b->size * v3_dot(v, mv)};
}

static inline void view_set(struct view *w, const struct superquadric_placed *i,
                            const struct superquadric_placed *j, vec3 apart, vec3 n)
{
    w->n = n;
    basis_across(n, &w->u, &w->v);
    side_see(&w->i, i, w);
    side_see(&w->j, j, w);
    w->g = v3_sub(v3_sub(apart, w->i.p), w->j.p);
    w->gap = v3_dot(w->g, n);
    w->gu = v3_dot(w->g, w->u);
    w->gv = v3_dot(w->g, w->v);
}

/* Newton's step across the normal, in the basis. */
static inline void newton(const struct view *w, double *du, double *dv)
{
    struct tensor2 m = {w->i.H.uu + w->j.H.uu, w->i.H.uv + w->j.H.uv, w->i.H.vv + w->j.H.vv};
    const double trace = m.uu + m.vv;
    /* Deep overlaps of small radii: the local maximum is elsewhere; uphill is the way. */
    const bool convex =
        (m.uu + w->gap) * (m.vv + w->gap) - m.uv * m.uv > 1e-12 * trace * trace &&
        trace + 2.0 * w->gap > 0.0;
    const double shift = convex ? w->gap : fabs(w->gap);
    m.uu += shift;
    m.vv += shift;
    const double inv = 1.0 / det2(m);
    *du = (m.vv * w->gu - m.uv * w->gv) * inv;
    *dv = (m.uu * w->gv - m.uv * w->gu) * inv;
}

static inline vec3 across(const struct view *w, double du, double dv)
{
    return v3_axpy(v3_scale(du, w->u), dv, w->v);
}

static inline vec3 shift_of(const struct view *w, const struct tensor2 *m, double du, double dv)
{
    return across(w, m->uu * du + m->uv * dv, m->uv * du + m->vv * dv);
}

static inline vec3 unit(vec3 a)
{
    return v3_scale(1.0 / v3_norm(a), a);
}

/* The normal where the point of the flatter body has moved by its share of the step. */
static vec3 step_on_surface(const struct superquadric_placed *i,
                            const struct superquadric_placed *j, const struct view *w,
                            double du, double dv)
{
    const vec3 at_i = shift_of(w, &w->i.H, du, dv), at_j = shift_of(w, &w->j.H, du, dv);
    const vec3 t = across(w, du, dv);
    const bool first = v3_dot(t, at_i) > v3_dot(t, at_j);
    const struct superquadric_placed *const b = first ? i : j;
    const vec3 p = first ? v3_add(w->i.p, at_i) : v3_add(w->j.p, at_j);
    return mat3_turn(&b->turn, superquadric_normal(b->shape, mat3_back(&b->turn, p)));
}

/* From a view next to the solution to the contact, by a linear step. */
static void touch_set(struct superquadric_touch *touch, const struct view *w, double du,
                      double dv)
{
    const struct tensor2 both = {w->i.H.uu + w->j.H.uu, w->i.H.uv + w->j.H.uv,
                                 w->i.H.vv + w->j.H.vv};
    const double det_i = fmax(det2(w->i.H), 0.0), det_j = fmax(det2(w->j.H), 0.0);
    const double det = fmax(det2(both), 1e-300);
    touch->normal = unit(v3_add(w->n, across(w, du, dv)));
    touch->gap = w->gap + 0.5 * (w->gu * du + w->gv * dv);
    touch->at_i = v3_scale(-1.0, v3_add(w->i.p, shift_of(w, &w->i.H, du, dv)));
    touch->at_j = v3_add(w->j.p, shift_of(w, &w->j.H, du, dv));
    touch->r_i = sqrt(det_i);
    touch->r_j = sqrt(det_j);
    touch->r_eff = touch->r_i * touch->r_j / sqrt(det);
}

/* A step from `from` that does not overshoot: the view at its end. False: farther apart than
 * `reach`, or no step is left */
static bool step_take(const struct superquadric_placed *i, const struct superquadric_placed *j,
                      vec3 apart, double reach, double size, const struct view *from, double du,
                      double dv, struct view *to, int *tries)
{
    const vec3 t = across(from, du, dv);
    const double slope = from->gu * du + from->gv * dv;
    const bool flat = from->i.H.uu + from->i.H.vv + from->j.H.uu + from->j.H.vv > blocky * size;
    double part = 1.0;
    vec3 n = flat ? step_on_surface(i, j, from, du, dv) : unit(v3_add(from->n, t));
    for (int k = 0; *tries < TRIES; k++) {
        view_set(to, i, j, apart, n);
        ++*tries;
        if (to->gap > reach)
            return false;
        const double there = v3_dot(to->g, t) - to->gap * v3_dot(to->n, t);
        if (there >= -0.9 * slope && to->gap >= from->gap - 1e-14 * v3_norm(from->i.p))
            return true;
        if (k == 0) {
            n = flat ? unit(v3_add(from->n, t)) : step_on_surface(i, j, from, du, dv);
            continue;
        }
        if (k > 1)
            part *= there < slope ? fmax(0.1, fmin(0.7, slope / (slope - there))) : 0.3;
        else
            part = 0.5;
        if (part * part * v3_dot(t, t) < turned * turned)
            return false;
        n = unit(v3_axpy(from->n, part, t));
    }
    return false;
}

bool superquadric_meet(const struct superquadric_placed *i, const struct superquadric_placed *j,
                       vec3 apart, double reach, struct superquadric_touch *touch)
{
    const double *const a = i->shape->a, *const b = j->shape->a;
    const double size = i->size * (a[0] + a[1] + a[2]) + j->size * (b[0] + b[1] + b[2]);
    const double start = v3_dot(touch->normal, touch->normal);
    struct view w, next;
    /* far pairs: the direction that parted them last still does, by a bound of the support functions */
    if (start > 0.0 && !(i->shape->ellipsoid && j->shape->ellipsoid)) {
        const double bound =
            v3_dot(apart, touch->normal) -
            i->size * superquadric_reach(i->shape, mat3_back(&i->turn, touch->normal)) -
            j->size * superquadric_reach(j->shape, mat3_back(&j->turn, touch->normal));
        if (bound > reach * sqrt(start)) {
            touch->gap = bound / sqrt(start);
            touch->tries = 0;
            return false;
        }
    }
    touch->tries = 1;
    view_set(&w, i, j, apart,
             start > 0.0 ? v3_scale(1.0 / sqrt(start), touch->normal) : unit(apart));
    while (w.gap <= reach) {
        double du, dv;
        newton(&w, &du, &dv);
        const double across2 = w.gu * w.gu + w.gv * w.gv, angle2 = du * du + dv * dv;
        const double gain = w.gu * du + w.gv * dv;
        const bool still = touch->tries > LATE ? gain < 100.0 * noise * size
                                               : touch->tries > 2 && gain < noise * size;
        if (across2 < aligned * aligned * size * size || angle2 < turned * turned || still ||
            touch->tries >= TRIES) {
            const bool near = angle2 < 1e-6;
            touch_set(touch, &w, near ? du : 0.0, near ? dv : 0.0);
            return touch->gap <= reach;
        }
        if (angle2 > largest_step * largest_step) {
            const double cut = largest_step / sqrt(angle2);
            du *= cut;
            dv *= cut;
        }
        if (!step_take(i, j, apart, reach, size, &w, du, dv, &next, &touch->tries) &&
            next.gap <= reach) {
            touch_set(touch, &w, 0.0, 0.0);
            return true;
        }
        w = next;
    }
    touch->normal = w.n;
    touch->gap = w.gap;
    return false;
}
