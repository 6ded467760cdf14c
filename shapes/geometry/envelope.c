/* shapes/geometry/envelope.c - contact of smoothed envelopes by optimisation [LiLiuJi23, eqs 12-13].
 *
 * On f_a = f_b the least of f_a + f_b is the least of the larger of the two; there
 * m grad f_a + (1 - m) grad f_b = 0 for some m of (0, 1). For a given m the sum m f_a + (1 - m) f_b is
 * convex and piecewise quadratic: Newton with halved steps finds its least point x(m) in a few rounds;
 * f_a - f_b at x(m) falls with m, and its root is bracketed by (0, 1) [Dekker's way: secants, halved
 * where they do not help]. */
#include "envelope.h"

enum { ROUNDS = 60, HALVINGS = 30 };

struct envelope {
    const struct patch_body *body;
    double r, k, inv_round; /* 1/R^2; lengths in the frame of the pair */
    vec3 middle;            /* of its ball, in the frame of the pair */
};

/* Value, gradient and the six of the second derivative: xx yy zz xy xz yz. */
struct value {
    double f;
    vec3 grad;
    double h[6];
};

static void add_outer(double h[6], double w, vec3 a)
{
    h[0] += w * a.x * a.x;
    h[1] += w * a.y * a.y;
    h[2] += w * a.z * a.z;
    h[3] += w * a.x * a.y;
    h[4] += w * a.x * a.z;
    h[5] += w * a.y * a.z;
}

static vec3 turned(const vec3 axes[3], vec3 x)
{
    return v3_add(v3_scale(x.x, axes[0]), v3_axpy(v3_scale(x.y, axes[1]), x.z, axes[2]));
}

static void add_value(const struct envelope *e, double weight, vec3 x, struct value *out)
{
    const struct patch_body *const b = e->body;
    const struct polyhedron *const p = b->p;
    const vec3 d = v3_sub(x, b->place), away = v3_sub(x, e->middle);
    const vec3 own = {v3_dot(b->axes[0], d), v3_dot(b->axes[1], d), v3_dot(b->axes[2], d)};
    const double flat = weight * (1.0 - e->k) / (e->r * e->r),
                 round = weight * e->k * e->inv_round;
    out->f += round * v3_dot(away, away) - weight;
    out->grad = v3_axpy(out->grad, 2.0 * round, away);
    for (int c = 0; c < 3; c++)
        out->h[c] += 2.0 * round;
    for (int f = 0; f < p->n_faces; f++) {
        const double s = v3_dot(polyhedron_normal(p, f), own) - b->scale * p->off[f];
        if (s <= 0.0)
            continue;
        const vec3 n = turned(b->axes, polyhedron_normal(p, f));
        out->f += flat * s * s;
        out->grad = v3_axpy(out->grad, 2.0 * flat * s, n);
        add_outer(out->h, 2.0 * flat, n);
    }
}

static struct value mixed(const struct envelope *a, const struct envelope *b, double m, vec3 x)
{
    struct value out = {.f = 0.0};
    add_value(a, m, x, &out);
    add_value(b, 1.0 - m, x, &out);
    return out;
}

/* -h^-1 g of a symmetric positive definite matrix. */
static vec3 newton_step(const double h[6], vec3 g)
{
    const double a = h[0], b = h[3], c = h[4], d = h[1], e = h[5], f = h[2];
    const double A = d * f - e * e, B = c * e - b * f, C = b * e - c * d;
    const double det = a * A + b * B + c * C;
    const double D = a * f - c * c, E = b * c - a * e, F = a * d - b * b;
    return v3_scale(-1.0 / det, v3(A * g.x + B * g.y + C * g.z, B * g.x + D * g.y + E * g.z,
                                   C * g.x + E * g.y + F * g.z));
}

static vec3 least_point(const struct envelope *a, const struct envelope *b, double m, vec3 x)
{
    struct value v = mixed(a, b, m, x);
    for (int round = 0; round < ROUNDS; round++) {
        const vec3 step = newton_step(v.h, v.grad);
        const double slope = v3_dot(step, v.grad);
        double t = 1.0;
        struct value next = v;
        if (!(slope < -1e-28 * (1.0 + fabs(v.f))))
            return x;
        for (int k = 0; k < HALVINGS; k++, t *= 0.5) {
            next = mixed(a, b, m, v3_axpy(x, t, step));
            if (next.f <= v.f + 1e-4 * t * slope)
                break;
        }
        if (next.f >= v.f)
            return x;
        x = v3_axpy(x, t, step);
        v = next;
    }
    return x;
}

static double value_of(const struct envelope *e, vec3 x)
{
    struct value v = {.f = 0.0};
    add_value(e, 1.0, x, &v);
    return v.f;
}

static double difference(const struct envelope *a, const struct envelope *b, double m, vec3 *x)
{
    *x = least_point(a, b, m, *x);
    return value_of(a, *x) - value_of(b, *x);
}

/* The point of eq. 13, and the m that belongs to it. */
static vec3 solve(const struct envelope *a, const struct envelope *b, vec3 x, double *m)
{
    double low = 1e-6, high = 1.0 - 1e-6, at_low = 0.0, at_high = 0.0;
    bool have_low = false, have_high = false;
    *m = 0.5;
    for (int round = 0; round < ROUNDS; round++) {
        const double d = difference(a, b, *m, &x);
        if (fabs(d) < 1e-13 || high - low < 1e-14)
            break;
        if (d > 0.0) {
            low = *m;
            at_low = have_high && have_low && round % 3 == 2 ? 0.5 * d : d;
            have_low = true;
        } else {
            high = *m;
            at_high = d;
            have_high = true;
        }
        *m = 0.5 * (low + high);
        if (have_low && have_high && round % 3 != 0) {
            const double secant = low + (high - low) * at_low / (at_low - at_high);
            if (secant > low && secant < high)
                *m = secant;
        }
    }
    return x;
}

/* How far it is from x along u to f = 0; negative: back. */
static double to_surface(const struct envelope *e, vec3 x, vec3 u)
{
    double t = 0.0;
    for (int round = 0; round < ROUNDS; round++) {
        struct value v = {.f = 0.0};
        add_value(e, 1.0, v3_axpy(x, t, u), &v);
        const double slope = v3_dot(v.grad, u);
        if (!(slope > 0.0))
            break;
        const double step = -v.f / slope;
        t += step;
        if (fabs(step) < 1e-14 * (1.0 + fabs(t)))
            break;
    }
    return t;
}

static struct envelope envelope_of(const struct patch_body *b, double r, double k)
{
    const struct polyhedron *const p = b->p;
    vec3 low = polyhedron_vertex(p, 0), high = low;
    double radius = 0.0;
    for (int v = 1; v < p->n_vertices; v++) {
        const vec3 x = polyhedron_vertex(p, v);
        low = v3(fmin(low.x, x.x), fmin(low.y, x.y), fmin(low.z, x.z));
        high = v3(fmax(high.x, x.x), fmax(high.y, x.y), fmax(high.z, x.z));
    }
    const vec3 own = v3_scale(0.5, v3_add(low, high));
    for (int v = 0; v < p->n_vertices; v++)
        radius = fmax(radius, v3_norm(v3_sub(polyhedron_vertex(p, v), own)));
    radius = b->scale * radius + r;
    return (struct envelope){b, r, k, 1.0 / (radius * radius),
                             v3_axpy(b->place, b->scale, turned(b->axes, own))};
}

void envelope_gap(const struct patch_body *a, double ra, const struct patch_body *b, double rb,
                  double k, struct gap *gap)
{
    const struct envelope ea = envelope_of(a, ra, k), eb = envelope_of(b, rb, k);
    const vec3 start = v3_axpy(gap->on_b, gap->distance * rb / (ra + rb), gap->normal);
    double m;
    const vec3 x = solve(&ea, &eb, start, &m);
    struct value vb = {.f = 0.0};
    add_value(&eb, 1.0, x, &vb);
    const double length = v3_norm(vb.grad);
    if (!(length > 0.0))
        return;
    const vec3 n = v3_scale(1.0 / length, vb.grad); /* out of b, into a */
    const double to_b = to_surface(&eb, x, n), to_a = to_surface(&ea, x, v3_scale(-1.0, n));
    gap->normal = n;
    gap->on_b = v3_axpy(x, to_b - rb, n);
    gap->on_a = v3_axpy(x, -to_a + ra, n);
    gap->distance = ra + rb - to_a - to_b;
}
