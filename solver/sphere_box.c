/* sphere_box.c - volume of a ball's part beyond one, two or three orthogonal planes.
 *
 * By the divergence theorem about the centre, a part bounded by the unit sphere and planes x_k
 * = a_k (the part lies beyond each) has the volume V = (Omega - sum_k a_k A_k)/3 with Omega its
 * area on the sphere and A_k its area on plane k. By Gauss and Bonnet, with phi_k the angle of
 * its arc on plane k (an arc's geodesic curvature times its length is a_k phi_k) and alpha the
 * exterior angles at its corners, Omega = 2 pi - sum_k a_k phi_k - sum alpha,   tan alpha_ab =
 * w_ab/(-a b), w_ab = sqrt(1 - a^2 - b^2), where w_ab is also the coordinate at which the edge
 * of planes a and b leaves the ball. The forms hold for any signs as long as the edge (the
 * corner, for three planes) lies inside the ball. If it does not, a plane with a < 0 is
 * mirrored: beyond(a) + beyond(-a) = all.
 *
 * Every angle is an atan2, so nothing is lost next to tangency: the derivative of V by w_ab is
 * of the order of w_ab, and the round-off of the root cancels. Derived for this program; the
 * same volumes by other ways are in [StrobletAl16]. */
#include "sphere_box.h"

#include <stdbool.h>

static const double pi = 3.14159265358979323846;

double ball_beyond(double a)
{
    if (a >= 1.0)
        return 0.0;
    if (a <= -1.0)
        return 1.0;
    return 0.25 * (1.0 - a) * (1.0 - a) * (2.0 + a);
}

double ball_wedge(double a, double b)
{
    const double w2 = 1.0 - a * a - b * b;
    if (w2 <= 0.0) { /* the two circles do not cross */
        if (a >= 0.0)
            return b >= 0.0 ? 0.0 : ball_beyond(a);
        return b >= 0.0 ? ball_beyond(b) : fmax(0.0, ball_beyond(a) + ball_beyond(b) - 1.0);
    }
    const double w = sqrt(w2);
    const double v = 2.0 * atan2(w, a * b) - a * (3.0 - a * a) * atan2(w, b) -
                     b * (3.0 - b * b) * atan2(w, a) + 2.0 * a * b * w;
    return v / (4.0 * pi);
}

/* The part of a face's terms: arc of angle phi and area A on the disc x = a, where y > b and
 * z > c; `out` and `up` are the coordinates at which the edges z = c and y = b leave the ball.
 * Returns a phi + a A. */
static double face(double a, double b, double c, double out, double up)
{
    const double phi = atan2(up, b) - atan2(c, out);
    const double area = 0.5 * ((1.0 - a * a) * phi - c * (out - b) - b * (up - c));
    return a * (phi + area);
}

double ball_octant(double a, double b, double c)
{
    if (a * a + b * b + c * c >= 1.0) {
        if (a < 0.0)
            return ball_wedge(b, c) - ball_octant(-a, b, c);
        if (b < 0.0)
            return ball_wedge(a, c) - ball_octant(a, -b, c);
        if (c < 0.0)
            return ball_wedge(a, b);
        return 0.0;
    }
    const double a2 = a * a, b2 = b * b, c2 = c * c;
    const double w_ab = sqrt(1.0 - a2 - b2), w_ac = sqrt(1.0 - a2 - c2);
    const double w_bc = sqrt(1.0 - b2 - c2);
    const double corners = atan2(w_ab, -a * b) + atan2(w_ac, -a * c) + atan2(w_bc, -b * c);
    const double faces =
        face(a, b, c, w_ac, w_ab) + face(b, a, c, w_bc, w_ab) + face(c, a, b, w_bc, w_ac);
    return (2.0 * pi - corners - faces) / (4.0 * pi);
}

/* atan2(y, x) for y >= 0, not both 0, without a branch: the ratio of the smaller to the larger is brought
 * below tan(pi/8) and goes into a rational function [Moshier89, atan], good to 2e-16. */
static inline double angle(double y, double x)
{
    const double ax = fabs(x), low = y < ax ? y : ax, high = y < ax ? ax : y;
    const bool second = low > 0.41421356237309503 * high;
    const double t = (second ? low - high : low) / (second ? low + high : high), z = t * t;
    const double p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z -
                       7.500855792314704667340e1) *
                          z -
                      1.228866684490136173410e2) *
                         z -
                     6.485021904942025371773e1;
    const double q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
                       4.328810604912902668951e2) *
                          z +
                      4.853903996359136964868e2) *
                         z +
                     1.945506571482613964425e2;
    const double small = t + t * z * p / q;
    const double octant = second ? 0.25 * pi + small : small;
    const double quadrant = y < ax ? octant : 0.5 * pi - octant;
    return x < 0.0 ? pi - quadrant : quadrant;
}

static inline double beyond(double a)
{
    const double x = a > 1.0 ? 1.0 : a < -1.0 ? -1.0 : a;
    return 0.25 * (1.0 - x) * (1.0 - x) * (2.0 + x);
}

void ball_pairs_find(struct ball_pairs *p)
{
    const int n = (p->n + BALL_LANES - 1) / BALL_LANES * BALL_LANES;
    for (int i = p->n; i < n; i++)
        p->a[i] = p->b[i] = 0.0;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        const double a = p->a[i], b = p->b[i], w2 = 1.0 - a * a - b * b;
        const bool crosses = w2 > 0.0;
        const double w = sqrt(crosses ? w2 : 1.0);
        const double at_a = angle(w, a), at_b = angle(w, b), at_corner = angle(w, a * b);
        const double crossing = (2.0 * at_corner - a * (3.0 - a * a) * at_b -
                                 b * (3.0 - b * b) * at_a + 2.0 * a * b * w) /
                                (4.0 * pi);
        const double of_a = beyond(a), of_b = beyond(b), both = of_a + of_b - 1.0;
        const double apart =
            a < 0.0 ? (b < 0.0 ? (both > 0.0 ? both : 0.0) : of_b) : (b < 0.0 ? of_a : 0.0);
        p->w2[i] = w2;
        p->w[i] = w;
        p->at_a[i] = at_a;
        p->at_b[i] = at_b;
        p->at_corner[i] = at_corner;
        p->wedge[i] = crosses ? crossing : apart;
    }
}

/* beyond(|a|, b) or beyond(a, |b|) or both, of a pair: mirrored planes have the rest. */
static double mirrored(const struct ball_pairs *p, int i, bool a, bool b)
{
    double v = p->wedge[i];
    if (a)
        v = beyond(p->b[i]) - v;
    if (b)
        v = beyond(a ? -p->a[i] : p->a[i]) - v;
    return v;
}

/* The corner lies outside the ball: what ball_octant does in that case. */
static double octant_outside(const struct ball_pairs *p, int ab, int ac, int bc)
{
    const bool a = p->a[ab] < 0.0, b = p->b[ab] < 0.0, c = p->b[ac] < 0.0;
    double v = c ? mirrored(p, ab, a, b) : 0.0;
    if (b)
        v = mirrored(p, ac, a, false) - v;
    return a ? p->wedge[bc] - v : v;
}

double ball_octant_of(const struct ball_pairs *p, int ab, int ac, int bc)
{
    const double a = p->a[ab], b = p->b[ab], c = p->b[ac];
    if (p->w2[ab] <= c * c)
        return octant_outside(p, ab, ac, bc);
    const double w_ab = p->w[ab], w_ac = p->w[ac], w_bc = p->w[bc];
    const double phi_a = p->at_b[ab] + p->at_b[ac] - 0.5 * pi;
    const double phi_b = p->at_a[ab] + p->at_b[bc] - 0.5 * pi;
    const double phi_c = p->at_a[ac] + p->at_a[bc] - 0.5 * pi;
    const double on_a = 0.5 * ((1.0 - a * a) * phi_a - c * (w_ac - b) - b * (w_ab - c));
    const double on_b = 0.5 * ((1.0 - b * b) * phi_b - c * (w_bc - a) - a * (w_ab - c));
    const double on_c = 0.5 * ((1.0 - c * c) * phi_c - b * (w_bc - a) - a * (w_ac - b));
    const double corners = p->at_corner[ab] + p->at_corner[ac] + p->at_corner[bc] - pi;
    return (corners - a * (phi_a + on_a) - b * (phi_b + on_b) - c * (phi_c + on_c)) /
           (4.0 * pi);
}

double sphere_box_overlap(vec3 centre, double radius, vec3 lo, vec3 hi)
{
    const vec3 a = v3_scale(1.0 / radius, v3_sub(lo, centre));
    const vec3 b = v3_scale(1.0 / radius, v3_sub(hi, centre));
    const double part = ball_octant(a.x, a.y, a.z) - ball_octant(b.x, a.y, a.z) -
                        ball_octant(a.x, b.y, a.z) - ball_octant(a.x, a.y, b.z) +
                        ball_octant(b.x, b.y, a.z) + ball_octant(b.x, a.y, b.z) +
                        ball_octant(a.x, b.y, b.z) - ball_octant(b.x, b.y, b.z);
    return fmax(0.0, part) * (4.0 / 3.0 * pi) * radius * radius * radius;
}
