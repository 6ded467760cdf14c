/* forces/saffman.c - lift on a grain that lags or leads in a shear [Saffman65], with the correction of
 * its corrigendum (6.46, not 81.2) and, for Reynolds numbers that are not small, [Mei92].
 *
 *   F = 1.615 d^2 sqrt(rho mu/|w|) (u_r x w) C,    w = curl u,  u_r = u - v
 *   saffman  C = 1:  Re << sqrt(Re_w) << 1,  Re = rho d u_r/mu,  Re_w = rho d^2 |w|/mu
 *   mei      C = (1 - 0.3314 sqrt(b)) exp(-Re/10) + 0.3314 sqrt(b)   Re <= 40
 *            C = 0.0524 sqrt(b Re)                                   Re > 40,   b = d |w|/(2 u_r)
 *            fitted to 0.1 < Re < 100, 0.005 < b < 0.4; jumps by some % of the force at Re = 40
 *
 * A grain that lags behind is lifted towards the faster fluid. */
#include "force.h"

static const struct key keys[] = {
    {"forces", "saffman", KEY_CHOICE, "", "mei | saffman", "mei",
     "form of the lift: with Mei's correction, or Saffman's limit of small Reynolds numbers"},
    {0},
};

static bool corrected;

static void read_keys(struct scene *s)
{
    corrected = scene_choice(s, "forces", NULL, "saffman") == 0;
}

static double mei(double re, double b)
{
    if (re > 40.0)
        return 0.0524 * sqrt(b * re);
    const double part = 0.3314 * sqrt(b);
    return (1.0 - part) * exp(-0.1 * re) + part;
}

static vec3 lift(const struct force_view *v)
{
    const double w = v3_norm(v->curl), slip = v3_norm(v->slip);
    if (!(w > 0.0 && slip > 0.0))
        return v3(0.0, 0.0, 0.0);
    double size = 1.615 * v->d * v->d * sqrt(v->rho * v->mu / w);
    if (corrected)
        size *= mei(v->rho * v->d * slip / v->mu, 0.5 * v->d * w / slip);
    return v3_scale(size, v3_cross(v->slip, v->curl));
}

const struct force force_saffman = {
    .about = {.name = "saffman",
              .summary = "lift on a grain that lags or leads in a shear",
              .equation = "F = 1.615 d^2 sqrt(rho mu/|w|) (u_r x w) C(Re, d |w|/(2 u_r))",
              .source = "[Saffman65] and corrigendum; [Mei92]",
              .range = "Re < 100, d |w|/(2 u_r) 0.005 to 0.4; dilute",
              .cost = "an exponential of the fit and four roots"},
    .keys = keys,
    .returned = true,
    .read = read_keys,
    .act = lift,
};
