/* superquadric.c - support function, volume and inertia of a superquadric, see superquadric.h.
 *
 * Volume and inertia, with e1 = 2/n1, e2 = 2/n2, B Euler's beta function [Jaklic00, sect. 2.3]:
 *   V    = 2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2)
 *   I_xx = a b c e1 e2/2 (b^2 B(3 e2/2, e2/2) B(e1/2, 2 e1 + 1)
 *                          + 4 c^2 B(e2/2, e2/2 + 1) B(3 e1/2, e1 + 1)),   I_yy with a for b
 *   I_zz = a b c e1 e2/2 (a^2 + b^2) B(3 e2/2, e2/2) B(e1/2, 2 e1 + 1) */
#include "superquadric.h"

#include <gsl/gsl_sf_gamma.h>
#include <stddef.h>

static const double pi = 3.14159265358979323846;
/* Components of a normal count as this at least: on faces radii of curvature are infinite. */
static const double flat = 1e-100;
static const double flattest = 1e8; /* half axes: radii of curvature are cut there */

void superquadric_set(struct superquadric *s, const double half_axes[3], double n1, double n2)
{
    for (int k = 0; k < 3; k++)
        s->a[k] = half_axes[k];
    s->n1 = n1;
    s->n2 = n2;
    s->q1 = n1 / (n1 - 1.0);
    s->q2 = n2 / (n2 - 1.0);
    s->inv_q1 = 1.0 / s->q1;
    s->inv_q2 = 1.0 / s->q2;
    s->ellipsoid = n1 == 2.0 && n2 == 2.0;
    s->one = n1 == n2;
}

double superquadric_inside(const struct superquadric *s, vec3 x)
{
    const double u = fabs(x.x / s->a[0]), v = fabs(x.y / s->a[1]), w = fabs(x.z / s->a[2]);
    if (s->ellipsoid)
        return sqrt(u * u + v * v + w * w) - 1.0;
    const double flatwise = pow(pow(u, s->n2) + pow(v, s->n2), s->n1 / s->n2);
    return pow(flatwise + pow(w, s->n1), 1.0 / s->n1) - 1.0;
}

vec3 superquadric_normal(const struct superquadric *s, vec3 x)
{
    const double u = fabs(x.x / s->a[0]), v = fabs(x.y / s->a[1]), w = fabs(x.z / s->a[2]);
    const double rho = s->ellipsoid ? 1.0 : pow(pow(u, s->n2) + pow(v, s->n2), 1.0 / s->n2);
    vec3 n;
    if (s->ellipsoid) {
        n = v3(x.x / (s->a[0] * s->a[0]), x.y / (s->a[1] * s->a[1]), x.z / (s->a[2] * s->a[2]));
    } else {
        /* gradient of (rho^n1 + w^n1)/n1 */
        const double round = rho > 0.0 ? pow(rho, s->n1 - 1.0) : 0.0,
                     in = rho > 0.0 ? rho : 1.0;
        n = v3(copysign(round * pow(u / in, s->n2 - 1.0) / s->a[0], x.x),
               copysign(round * pow(v / in, s->n2 - 1.0) / s->a[1], x.y),
               copysign(pow(w, s->n1 - 1.0) / s->a[2], x.z));
    }
    return v3_scale(1.0 / v3_norm(n), n);
}

static vec3 ellipsoid_support(const struct superquadric *s, vec3 n, struct symmetric *m)
{
    const double aa = s->a[0] * s->a[0], bb = s->a[1] * s->a[1], cc = s->a[2] * s->a[2];
    const double inv = 1.0 / sqrt(aa * n.x * n.x + bb * n.y * n.y + cc * n.z * n.z);
    const vec3 p = v3(aa * n.x * inv, bb * n.y * inv, cc * n.z * inv);
    if (m)
        *m = (struct symmetric){.xx = (aa - p.x * p.x) * inv,
                                .yy = (bb - p.y * p.y) * inv,
                                .zz = (cc - p.z * p.z) * inv,
                                .xy = -p.x * p.y * inv,
                                .xz = -p.x * p.z * inv,
                                .yz = -p.y * p.z * inv};
    return p;
}

/* n1 = n2: h = |(A, B, C)|_q with A = |a nx| and so on; dh/dA = (A/h)^(q - 1), and with t = q - 1
 *   d2h/dA2 = t/h ((A/h)^(q - 2) - (dh/dA)^2),  d2h/dAdB = -t/h dh/dA dh/dB. */
static vec3 block_support(const struct superquadric *s, vec3 n, struct symmetric *m)
{
    const double a = s->a[0], b = s->a[1], c = s->a[2];
    const double size = flat * (fabs(n.x) + fabs(n.y) + fabs(n.z)) * a;
    const double A = fmax(fabs(a * n.x), size), B = fmax(fabs(b * n.y), size);
    const double C = fmax(fabs(c * n.z), size);
    const double Aq = pow(A, s->q1), Bq = pow(B, s->q1), Cq = pow(C, s->q1), U = Aq + Bq + Cq;
    const double h = pow(U, s->inv_q1), hU = h / U;
    const double iA = 1.0 / A, iB = 1.0 / B, iC = 1.0 / C;
    const double h_a = Aq * iA * hU, h_b = Bq * iB * hU, h_c = Cq * iC * hU;
    const double sx = n.x < 0.0 ? -a : a, sy = n.y < 0.0 ? -b : b, sz = n.z < 0.0 ? -c : c;
    if (m) {
        const double t = (s->q1 - 1.0) / h, most = flattest * fmax(a, fmax(b, c));
        m->xx = fmin(most, a * a * t * h_a * (h * iA - h_a));
        m->yy = fmin(most, b * b * t * h_b * (h * iB - h_b));
        m->zz = fmin(most, c * c * t * h_c * (h * iC - h_c));
        m->xy = -sx * sy * t * h_a * h_b;
        m->xz = -sx * sz * t * h_a * h_c;
        m->yz = -sy * sz * t * h_b * h_c;
    }
    return v3(sx * h_a, sy * h_b, sz * h_c);
}

/* With A = |a nx| and so on, rho = |(A, B)|_q2, h = |(rho, C)|_q1:
 *   dh/drho = (rho/h)^(q1 - 1),  drho/dA = (A/rho)^(q2 - 1),  and with t = q - 1
 *   d2h/drho2 = t/h ((rho/h)^(q1 - 2) - (dh/drho)^2), and so on. */
vec3 superquadric_support_curved(const struct superquadric *s, vec3 n, struct symmetric *m)
{
    if (s->ellipsoid)
        return ellipsoid_support(s, n, m);
    if (s->one)
        return block_support(s, n, m);
    const double size = flat * (fabs(n.x) + fabs(n.y) + fabs(n.z)) * s->a[0];
    const double A = fmax(fabs(s->a[0] * n.x), size), B = fmax(fabs(s->a[1] * n.y), size);
    const double C = fmax(fabs(s->a[2] * n.z), size);
    const double Aq = pow(A, s->q2), Bq = pow(B, s->q2), Cq = pow(C, s->q1), S = Aq + Bq;
    const double rho = pow(S, s->inv_q2), rhoq = pow(rho, s->q1), U = rhoq + Cq;
    const double h = pow(U, s->inv_q1), hU = h / U, rS = rho / S;
    const double h_r = rhoq / rho * hU, h_c = Cq / C * hU; /* dh/drho, dh/dC */
    const double r_a = Aq / A * rS, r_b = Bq / B * rS;     /* drho/dA, drho/dB */
    const double sx = n.x < 0.0 ? -s->a[0] : s->a[0], sy = n.y < 0.0 ? -s->a[1] : s->a[1];
    const double sz = n.z < 0.0 ? -s->a[2] : s->a[2];
    if (m) {
        const double t1 = (s->q1 - 1.0) / h, t2 = (s->q2 - 1.0) / rho * h_r;
        const double h_rr = t1 * (h_r * h / rho - h_r * h_r), h_rc = -t1 * h_r * h_c;
        const double h_cc = t1 * (h_c * h / C - h_c * h_c);
        const double a = s->a[0], b = s->a[1], c = s->a[2],
                     most = flattest * fmax(a, fmax(b, c));
        m->xx = fmin(most, a * a * (h_rr * r_a * r_a + t2 * (r_a * rho / A - r_a * r_a)));
        m->yy = fmin(most, b * b * (h_rr * r_b * r_b + t2 * (r_b * rho / B - r_b * r_b)));
        m->zz = fmin(most, c * c * h_cc);
        m->xy = sx * sy * (h_rr - t2) * r_a * r_b;
        m->xz = sx * sz * h_rc * r_a;
        m->yz = sy * sz * h_rc * r_b;
    }
    return v3(sx * h_r * r_a, sy * h_r * r_b, sz * h_c);
}

/* Of p-norms |x|_q <= |x|_1^e |x|_2^(1 - e) with 1/q = e + (1 - e)/2, and geometric means are below arithmetic
 * ones. */
double superquadric_reach(const struct superquadric *s, vec3 n)
{
    const double A = fabs(s->a[0] * n.x), B = fabs(s->a[1] * n.y), C = fabs(s->a[2] * n.z);
    const double e1 = 2.0 * s->inv_q1 - 1.0, e2 = 2.0 * s->inv_q2 - 1.0;
    if (s->one)
        return e1 * (A + B + C) + (1.0 - e1) * sqrt(A * A + B * B + C * C);
    const double rho = e2 * (A + B) + (1.0 - e2) * sqrt(A * A + B * B);
    return e1 * (rho + C) + (1.0 - e1) * sqrt(rho * rho + C * C);
}

vec3 superquadric_support(const struct superquadric *s, vec3 n)
{
    return superquadric_support_curved(s, n, NULL);
}

/* The product of the two nonzero eigenvalues of the Hessian, which has n in its kernel: the trace of
 * its adjugate. */
double superquadric_curvature_radius(const struct superquadric *s, vec3 n)
{
    struct symmetric m;
    superquadric_support_curved(s, n, &m);
    const double minors =
        m.xx * m.yy - m.xy * m.xy + m.xx * m.zz - m.xz * m.xz + m.yy * m.zz - m.yz * m.yz;
    return sqrt(fmax(0.0, minors));
}

double superquadric_volume(const struct superquadric *s)
{
    const double e1 = 2.0 / s->n1, e2 = 2.0 / s->n2;
    return 2.0 * s->a[0] * s->a[1] * s->a[2] * e1 * e2 * gsl_sf_beta(0.5 * e1 + 1.0, e1) *
           gsl_sf_beta(0.5 * e2, 0.5 * e2);
}

/* Largest distance from the centre where |x/a|^n + |y/b|^n = 1. */
static double farthest(double a, double b, double n)
{
    const double most = fmax(a, b), least = fmin(a, b) / most;
    if (n == 2.0)
        return most;
    /* max of a^2 u^2 + b^2 v^2 on u^n + v^n = 1: Hoelder, with 2/n + 1/m = 1 */
    const double m = n / (n - 2.0);
    return most * pow(1.0 + pow(least, 2.0 * m), 0.5 / m);
}

double superquadric_radius(const struct superquadric *s)
{
    return farthest(farthest(s->a[0], s->a[1], s->n2), s->a[2], s->n1);
}

void superquadric_inertia(const struct superquadric *s, double i[3])
{
    const double e1 = 2.0 / s->n1, e2 = 2.0 / s->n2;
    const double aa = s->a[0] * s->a[0], bb = s->a[1] * s->a[1], cc = s->a[2] * s->a[2];
    const double k = 0.5 * s->a[0] * s->a[1] * s->a[2] * e1 * e2;
    const double round =
        gsl_sf_beta(1.5 * e2, 0.5 * e2) * gsl_sf_beta(0.5 * e1, 2.0 * e1 + 1.0);
    const double along =
        4.0 * gsl_sf_beta(0.5 * e2, 0.5 * e2 + 1.0) * gsl_sf_beta(1.5 * e1, e1 + 1.0);
    i[0] = k * (bb * round + cc * along);
    i[1] = k * (aa * round + cc * along);
    i[2] = k * (aa + bb) * round;
}

/* Of a convex body: polygon of the points at which tangents along `way` touch it; half of it, since
 * the other half is its image. */
double superquadric_shadow(const struct superquadric *s, vec3 way)
{
    enum { SIDES = 64 };
    const double *const a = s->a;
    if (s->ellipsoid) {
        const vec3 n = v3(way.x * a[1] * a[2], way.y * a[0] * a[2], way.z * a[0] * a[1]);
        return pi * v3_norm(n);
    }
    const vec3 u = fabs(way.z) < 0.7 ? v3(-way.y, way.x, 0.0) : v3(0.0, -way.z, way.y);
    const vec3 e = v3_scale(1.0 / v3_norm(u), u), f = v3_cross(way, e);
    vec3 old = superquadric_support(s, e);
    double area = 0.0;
    for (int k = 1; k <= SIDES; k++) {
        const double angle = pi * k / SIDES;
        const vec3 p = superquadric_support(s, v3_axpy(v3_scale(cos(angle), e), sin(angle), f));
        area += v3_dot(way, v3_cross(old, p));
        old = p;
    }
    return area;
}

/* Triangles of one octant, whose corners are the even directions of a triangle's barycentric lattice. */
double superquadric_area(const struct superquadric *s)
{
    enum { N = 150 };
    double area = 0.0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N - i; j++) {
            vec3 p[4];
            for (int k = 0; k < 4; k++) {
                const double u = (i + (k == 1 || k == 3)) / (double)N;
                const double v = (j + (k == 2 || k == 3)) / (double)N;
                const vec3 x = v3(s->a[0] * u, s->a[1] * v, s->a[2] * fmax(0.0, 1.0 - u - v));
                p[k] = v3_scale(1.0 / (superquadric_inside(s, x) + 1.0), x);
            }
            const vec3 one = v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0]));
            const vec3 two = v3_cross(v3_sub(p[1], p[3]), v3_sub(p[2], p[3]));
            area += 0.5 * v3_norm(one) + (i + j + 2 <= N ? 0.5 * v3_norm(two) : 0.0);
        }
    return 8.0 * area;
}
