/* shapes/geometry/crown.c - see crown.h. */
#include "crown.h"

#include <string.h>
#include "lanes.h"

enum { ROUNDS = 100, LANES = POLYHEDRON_LANES };
#define STEP  0.5   /* the normal turns by no more at once */
#define FLAT  1e-13 /* of the size: a gain in height that round-off hides */
#define TIGHT 1e-10 /* of the size: feet on one line; the gap is of second order in that */
#define LAST  3e-9 /* after a turn by less, what the slopes promise is so to 1e-13 of the size */

/* exp(x) for x <= 0 to 1e-15: x = k log 2 + f, with log 2 in two parts [CodyWaite80], Taylor's
 * series of f, in the order of Estrin, for short chains. Ours, as libm's works one number at a time,
 * and the bits of its vectors change with the machine. */
static inline lanes exponential(lanes x)
{
    const lanes low = {-700, -700, -700, -700, -700, -700, -700, -700};
    const lanes y = lanes_greater(low, x);
    const double whole = 6755399441055744.0; /* 1.5 2^52: the sum's last bits are the integer */
    const lanes sum = y * 1.4426950408889634 + whole, k = sum - whole;
    const lanes f = y - k * 0.693147180369123816490 - k * 1.90821492927058770002e-10;
    const lanes f2 = f * f, f4 = f2 * f2;
    const lanes p0 = (f + 1.0) + f2 * (f * (1.0 / 6.0) + 0.5);
    const lanes p4 = (f * (1.0 / 120.0) + 1.0 / 24.0) + f2 * (f * (1.0 / 5040.0) + 1.0 / 720.0);
    const lanes p8 = (f * (1.0 / 362880.0) + 1.0 / 40320.0) +
                     f2 * (f * (1.0 / 39916800.0) + 1.0 / 3628800.0);
    const lanes p = p0 + f4 * (p4 + f4 * (p8 + f4 * (1.0 / 479001600.0)));
    const counts power = (((counts)sum - 0x4338000000000000LL) + 1023) << 52;
    return p * (lanes)power;
}

static inline double total(lanes x)
{
    const lanes a = x + __builtin_shuffle(x, (counts){4, 5, 6, 7, 0, 1, 2, 3});
    const lanes b = a + __builtin_shuffle(a, (counts){2, 3, 0, 1, 6, 7, 4, 5});
    return b[0] + b[1];
}

static inline double greatest(lanes x)
{
    const lanes a = lanes_greater(x, __builtin_shuffle(x, (counts){4, 5, 6, 7, 0, 1, 2, 3}));
    const lanes b = lanes_greater(a, __builtin_shuffle(a, (counts){2, 3, 0, 1, 6, 7, 4, 5}));
    return b[0] > b[1] ? b[0] : b[1];
}

/* The totals of eight, added in the order of `total`. */
static inline lanes totals(const lanes x[8])
{
    const counts low4 = {0, 1, 2, 3, 8, 9, 10, 11}, high4 = {4, 5, 6, 7, 12, 13, 14, 15},
                 low2 = {0, 1, 4, 5, 8, 9, 12, 13}, high2 = {2, 3, 6, 7, 10, 11, 14, 15},
                 even = {0, 2, 4, 6, 8, 10, 12, 14}, odd = {1, 3, 5, 7, 9, 11, 13, 15};
    lanes a[4], b[2];
    for (int k = 0; k < 4; k++)
        a[k] = __builtin_shuffle(x[2 * k], x[2 * k + 1], low4) +
               __builtin_shuffle(x[2 * k], x[2 * k + 1], high4);
    for (int k = 0; k < 2; k++)
        b[k] = __builtin_shuffle(a[2 * k], a[2 * k + 1], low2) +
               __builtin_shuffle(a[2 * k], a[2 * k + 1], high2);
    return __builtin_shuffle(b[0], b[1], even) + __builtin_shuffle(b[0], b[1], odd);
}

/* The parts of the vertices, not yet over their sum. */
struct parts {
    double sum;
    _Alignas(64) double of[POLYHEDRON_MOST];
};

/* The height of the top, and the parts there. */
static inline double find_height(const struct crown *c, vec3 along, struct parts *part)
{
    const struct points *const p = &c->at;
    const vec3 b = v3_scale(c->sharp, along);
    lanes most = lanes_load(c->log_weight) + b.x * lanes_load(p->x) + b.y * lanes_load(p->y) +
                 b.z * lanes_load(p->z);
    for (int k = LANES; k < p->room; k += LANES) {
        const lanes h = lanes_load(c->log_weight + k) + b.x * lanes_load(p->x + k) +
                        b.y * lanes_load(p->y + k) + b.z * lanes_load(p->z + k);
        most = lanes_greater(h, most);
    }
    const double high = greatest(most);
    lanes s = {0.0};
    for (int k = 0; k < p->room; k += LANES) {
        const lanes x = lanes_load(p->x + k), y = lanes_load(p->y + k),
                    z = lanes_load(p->z + k);
        const lanes e =
            exponential(lanes_load(c->log_weight + k) + b.x * x + b.y * y + b.z * z - high);
        memcpy(part->of + k, &e, sizeof e);
        s += e;
    }
    part->sum = total(s);
    return (high + log(part->sum)) / c->sharp;
}

/* Where the top is, and the variances. */
static inline void find_place(const struct crown *c, const struct parts *part,
                              struct crown_top *top)
{
    const struct points *const p = &c->at;
    lanes s[8] = {{0.0}}, yz = {0.0};
    for (int k = 0; k < p->room; k += LANES) {
        const lanes x = lanes_load(p->x + k), y = lanes_load(p->y + k),
                    z = lanes_load(p->z + k);
        const lanes e = lanes_load(part->of + k);
        const lanes ex = e * x, ey = e * y, ez = e * z;
        s[0] += ex;
        s[1] += ey;
        s[2] += ez;
        s[3] += ex * x;
        s[4] += ey * y;
        s[5] += ez * z;
        s[6] += ex * y;
        s[7] += ex * z;
        yz += ey * z;
    }
    const double per = 1.0 / part->sum;
    const lanes mean = totals(s) * per;
    const vec3 at = v3(mean[0], mean[1], mean[2]);
    top->at = at;
    top->xx = mean[3] - at.x * at.x;
    top->yy = mean[4] - at.y * at.y;
    top->zz = mean[5] - at.z * at.z;
    top->xy = mean[6] - at.x * at.y;
    top->xz = mean[7] - at.x * at.z;
    top->yz = total(yz) * per - at.y * at.z;
}

void crown_find_top(const struct crown *c, vec3 along, struct crown_top *top)
{
    struct parts part;
    top->height = find_height(c, along, &part);
    find_place(c, &part, top);
}

void crown_weights(const struct polyhedron *p, double *log_weight)
{
    for (int v = 0; v < p->vertex_room; v++) {
        int most = 1;
        for (int k = v < p->n_vertices ? p->fan_begin[v] : 0;
             v < p->n_vertices && k < p->fan_begin[v + 1]; k++) {
            const int f = p->fan[k], corners = p->loop_begin[f + 1] - p->loop_begin[f];
            most = corners > most ? corners : most;
        }
        log_weight[v] = v < p->n_vertices ? -log(most) : CROWN_NONE;
    }
    if (p->radius > 0.0)
        return;
    for (int v = 0; v < p->vertex_room; v++) /* a ball: one vertex counts */
        log_weight[v] = v == 0 ? 0.0 : CROWN_NONE;
}

/* A symmetric matrix across the normal. */
struct flat {
    double a, b, c; /* 11, 12, 22 */
};

static vec3 times(const struct crown_top *t, vec3 e)
{
    return v3(t->xx * e.x + t->xy * e.y + t->xz * e.z, t->xy * e.x + t->yy * e.y + t->yz * e.z,
              t->xz * e.x + t->yz * e.y + t->zz * e.z);
}

static struct flat across(const struct crown_top *t, vec3 e1, vec3 e2)
{
    const vec3 first = times(t, e1), second = times(t, e2);
    return (struct flat){v3_dot(e1, first), v3_dot(e1, second), v3_dot(e2, second)};
}

static void basis(vec3 n, struct crown_gap *out)
{
    out->e1 = v3_across(n);
    out->e2 = v3_cross(n, out->e1);
}

static void set_root(double p11, double p12, double p22, struct crown_gap *out)
{
    const double root = sqrt(fmax(p11 * p22 - p12 * p12, 0.0));
    const double trace = fmax(p11, 0.0) + fmax(p22, 0.0) + 2.0 * root;
    const double per = trace > 0.0 ? 1.0 / sqrt(trace) : 0.0;
    out->r11 = (fmax(p11, 0.0) + root) * per;
    out->r22 = (fmax(p22, 0.0) + root) * per;
    out->r12 = p12 * per;
}

/* The root of A (A + B)^-1 B. */
static void set_patch(const struct flat *a, const struct flat *b, double size,
                      struct crown_gap *out)
{
    const double tiny = 1e-12 * size * size;
    const struct flat s = {a->a + b->a + tiny, a->b + b->b, a->c + b->c + tiny};
    const double det = s.a * s.c - s.b * s.b;
    const struct flat inv = {s.c / det, -s.b / det, s.a / det};
    /* inv B */
    const double m11 = inv.a * b->a + inv.b * b->b, m12 = inv.a * b->b + inv.b * b->c,
                 m21 = inv.b * b->a + inv.c * b->b, m22 = inv.b * b->b + inv.c * b->c;
    set_root(a->a * m11 + a->b * m21, 0.5 * (a->a * m12 + a->b * m22 + a->b * m11 + a->c * m21),
             a->b * m12 + a->c * m22, out);
}

void crown_set_flat(const struct crown_top *top, struct crown_gap *out)
{
    basis(out->normal, out);
    const struct flat v = across(top, out->e1, out->e2);
    set_root(v.a, v.b, v.c, out);
}

/* How the normal is to turn: (B_a A + B_b B + gap)^-1 g, within the plane across `line`. */
static vec3 turn_by(const struct flat *t, double h, vec3 g, vec3 line, vec3 e1, vec3 e2)
{
    const double l1 = v3_dot(e1, line), l2 = v3_dot(e2, line), l = sqrt(l1 * l1 + l2 * l2);
    const double g1 = v3_dot(e1, g), g2 = v3_dot(e2, g), least = fmax(fabs(h), 1e-9);
    vec3 q;
    if (l > 0.5) { /* along the one direction that is left */
        const double u1 = -l2 / l, u2 = l1 / l;
        const double k = t->a * u1 * u1 + 2.0 * t->b * u1 * u2 + t->c * u2 * u2 + least;
        const double s = (g1 * u1 + g2 * u2) / k;
        q = v3_add(v3_scale(s * u1, e1), v3_scale(s * u2, e2));
    } else {
        const double a = t->a + least, c = t->c + least, det = a * c - t->b * t->b;
        q = v3_add(v3_scale((c * g1 - t->b * g2) / det, e1),
                   v3_scale((a * g2 - t->b * g1) / det, e2));
    }
    const double size = v3_norm(q);
    return size > STEP ? v3_scale(STEP / size, q) : q;
}

/* Moves the point of a top as its normal turns by q. */
static void follow(struct crown_top *t, double sharp, vec3 q)
{
    t->at = v3_axpy(t->at, sharp, times(t, q));
}

static vec3 turned(vec3 m, double part, vec3 q)
{
    const vec3 to = v3_axpy(m, part, q);
    return v3_scale(1.0 / v3_norm(to), to);
}

bool crown_find_gap(const struct crown *a, const struct crown *b, vec3 line, double reach,
                    vec3 start, struct crown_gap *out)
{
    const double ba = a->sharp, bb = b->sharp, size = CROWN_SHARP / fmax(ba, bb);
    struct crown_top ta, tb;
    struct parts pa, pb;
    struct flat va, vb;
    vec3 m = start, base = start, q = v3(0.0, 0.0, 0.0);
    double last = (double)INFINITY, part = 1.0, before = 0.0, gain = 0.0;
    for (int round = 0; round < ROUNDS; round++) {
        ta.height = find_height(a, v3_scale(-1.0, m), &pa);
        tb.height = find_height(b, m, &pb);
        out->gap = -ta.height - tb.height;
        if (out->gap >= reach) {
            out->normal = m;
            return false;
        }
        find_place(a, &pa, &ta);
        find_place(b, &pb, &tb);
        const vec3 w = v3_sub(ta.at, tb.at);
        const double h = v3_dot(w, m);
        vec3 g = v3_axpy(w, -h, m);
        g = v3_axpy(g, -v3_dot(g, line), line);
        const double error = v3_norm(g);
        if (error <= TIGHT * size)
            break;
        /* climbs, by a part of what the slope promises, as long as that is above round-off */
        if (gain > FLAT * size && out->gap < before + 0.01 * part * gain && part > 1e-6) {
            part *= 0.5;
            m = turned(base, part, q);
            continue;
        }
        if (gain <= FLAT * size && error >= last)
            break;
        basis(m, out);
        va = across(&ta, out->e1, out->e2);
        vb = across(&tb, out->e1, out->e2);
        const struct flat t = {ba * va.a + bb * vb.a, ba * va.b + bb * vb.b,
                               ba * va.c + bb * vb.c};
        base = m;
        last = error;
        before = out->gap;
        part = 1.0;
        q = turn_by(&t, h, g, line, out->e1, out->e2);
        gain = v3_dot(q, g);
        m = turned(base, 1.0, q);
        if (v3_dot(q, q) < LAST * LAST) {
            follow(&ta, ba, v3_scale(-1.0, q));
            follow(&tb, bb, q);
            out->gap += 0.5 * gain;
            break;
        }
    }
    basis(m, out);
    va = across(&ta, out->e1, out->e2);
    vb = across(&tb, out->e1, out->e2);
    set_patch(&va, &vb, size, out);
    out->normal = m;
    out->on_a = ta.at;
    out->on_b = tb.at;
    return true;
}
