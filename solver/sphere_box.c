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

struct ball_pair ball_pair(double a, double b)
{
    struct ball_pair p = {.a = a, .b = b, .w2 = 1.0 - a * a - b * b};
    if (p.w2 <= 0.0) {
        p.wedge = ball_wedge(a, b);
        return p;
    }
    p.w = sqrt(p.w2);
    p.at_a = atan2(p.w, a);
    p.at_b = atan2(p.w, b);
    p.at_corner = atan2(p.w, a * b);
    p.wedge = (2.0 * p.at_corner - a * (3.0 - a * a) * p.at_b - b * (3.0 - b * b) * p.at_a +
               2.0 * a * b * p.w) /
              (4.0 * pi);
    return p;
}

/* beyond(|a|, b) or beyond(a, |b|) or both, of a pair: mirrored planes have the rest. */
static double mirrored(const struct ball_pair *p, bool a, bool b)
{
    double v = p->wedge;
    if (a)
        v = ball_beyond(p->b) - v;
    if (b)
        v = ball_beyond(a ? -p->a : p->a) - v;
    return v;
}

/* The corner lies outside the ball: what ball_octant does in that case. */
static double octant_outside(const struct ball_pair *ab, const struct ball_pair *ac,
                             const struct ball_pair *bc)
{
    const bool a = ab->a < 0.0, b = ab->b < 0.0, c = ac->b < 0.0;
    double v = c ? mirrored(ab, a, b) : 0.0;
    if (b)
        v = mirrored(ac, a, false) - v;
    return a ? bc->wedge - v : v;
}

double ball_octant_of(const struct ball_pair *ab, const struct ball_pair *ac,
                      const struct ball_pair *bc)
{
    const double a = ab->a, b = ab->b, c = ac->b;
    if (ab->w2 <= c * c)
        return octant_outside(ab, ac, bc);
    const double phi_a = ab->at_b + ac->at_b - 0.5 * pi;
    const double phi_b = ab->at_a + bc->at_b - 0.5 * pi;
    const double phi_c = ac->at_a + bc->at_a - 0.5 * pi;
    const double on_a = 0.5 * ((1.0 - a * a) * phi_a - c * (ac->w - b) - b * (ab->w - c));
    const double on_b = 0.5 * ((1.0 - b * b) * phi_b - c * (bc->w - a) - a * (ab->w - c));
    const double on_c = 0.5 * ((1.0 - c * c) * phi_c - b * (bc->w - a) - a * (ac->w - b));
    const double corners = ab->at_corner + ac->at_corner + bc->at_corner - pi;
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
