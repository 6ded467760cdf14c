/* forces/magnus.c - lift on a spinning grain.
 *
 *   F = (pi/8) rho d^2 C_L |u_r| (W x u_r)/|W|,    W = curl u/2 - omega,  u_r = u - v
 *   rubinow_keller  C_L = d |W|/|u_r|: F = (pi/8) rho d^3 (W x u_r)                [RubinowKeller61]
 *                   Re < 1
 *   oesterle        C_L = 0.45 + (d |W|/|u_r| - 0.45) exp(-0.05684 Re_W^0.4 Re^0.3) [OesterleDinh98]
 *                   Re = rho d |u_r|/mu < 140, Re_W = rho d^2 |W|/mu, |W| d/|u_r| 2 to 12;
 *                   tends to the other as Re -> 0
 *
 * A ball with back-spin rises. */
#include "force.h"

static const struct key keys[] = {
    {"forces", "magnus", KEY_CHOICE, "", "oesterle | rubinow_keller", "oesterle",
     "form of the lift: for Re up to 140, or the limit of small Reynolds numbers"},
    {0},
};

static bool fitted;

static void read_keys(struct scene *s)
{
    fitted = scene_choice(s, "forces", NULL, "magnus") == 0;
}

static vec3 lift(const struct force_view *v)
{
    const vec3 W = v3_axpy(v3_scale(-1.0, v->spin), 0.5, v->curl);
    const double w = v3_norm(W), slip = v3_norm(v->slip);
    if (!(w > 0.0 && slip > 0.0))
        return v3(0.0, 0.0, 0.0);
    const double ratio = v->d * w / slip;
    double lift = ratio;
    if (fitted) {
        const double re = v->rho * v->d * slip / v->mu, re_w = v->rho * v->d * v->d * w / v->mu;
        lift = 0.45 + (ratio - 0.45) * exp(-0.05684 * exp(0.4 * log(re_w) + 0.3 * log(re)));
    }
    const double pi = 3.14159265358979323846;
    return v3_scale(pi / 8.0 * v->rho * v->d * v->d * lift * slip / w, v3_cross(W, v->slip));
}

const struct force force_magnus = {
    .about = {.name = "magnus",
              .summary = "lift on a spinning grain",
              .equation = "F = (pi/8) rho d^2 C_L |u_r| (W x u_r)/|W|, W = curl u/2 - omega",
              .source = "[RubinowKeller61]; [OesterleDinh98]",
              .range = "Re < 140 (rubinow_keller: < 1); dilute",
              .cost = "two logarithms and two exponentials of the fit, two norms"},
    .keys = keys,
    .returned = true,
    .read = read_keys,
    .act = lift,
};
