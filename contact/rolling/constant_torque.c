/* contact/rolling/constant_torque.c - a torque of constant size against rolling.
 *
 *   relative   M = -mu_r R* F_n w/|w|,       w = w_i - w_j                [Ai11, model A]
 *   weighted   M = -mu_r R* k_n depth w/|w|, w = (r_i w_i - r_j w_j)/(r_i + r_j)
 *                                                                        [ZhouEtAl99]
 * each with the part of w in the plane of contact: twisting is not resisted. The review prints
 * the second with + for - and with the radius of the grain at hand, which would give the two
 * grains unlike couples; R* stands here. Its weighted spin does not tell rolling from a pair that
 * turns as one body: where the couple would drive the grains instead of braking them (only
 * grains of unlike radii), it is left out.
 *
 * Published for discs in a plane (2-D), where w has one component; for spheres (3-D) w is a vector in the
 * plane of contact. The law is the same in both; only the inertia of the grain differs.
 *
 * The couple does not fall with the spin: a grain at rest is kicked to and fro by mu_r R* F_n dt/I
 * per step, and creeps on a slope. For what comes to rest take epsd or jiang. */
#include "rolling.h"

#include "../pairs.h"
#include "../spring.h"

const struct about rolling_about = {
    .name = "constant_torque",
    .summary = "a torque of constant size against rolling; does not come to rest",
    .equation = "M = -mu_r R* F_n w/|w|",
    .source = "[Ai11, model A], [ZhouEtAl99]",
    .range = "grains that keep rolling"};

const struct key rolling_keys[] = {
    {"material", "rolling_friction", KEY_REAL, "1", "[0, inf)", NULL,
     "coefficient of rolling friction, the tangent of the angle at which a sphere rolls"},
    {"pair", "rolling_friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed",
     "rolling friction of a contact"},
    {"rolling", "form", KEY_CHOICE, "", "relative | weighted", "relative",
     "spin and normal force that set the torque"},
    {0},
};

const int rolling_history = 0;
const unsigned rolling_needs = TOUCH_COUPLES | TOUCH_SPIN;

static bool weighted;
static real table[PAIRS_MAX];

void rolling_init(struct scene *s, const struct materials *m)
{
    double value[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    weighted = scene_choice(s, "rolling", NULL, "form") == 1;
    materials_pair_values(s, m, "rolling_friction", MIX_GEOMETRIC, value);
    for (int p = 0; p < m->n * m->n; p++)
        table[p] = (real)value[p];
}

static void relative(struct touch *t)
{
    _Alignas(64) real mu[1][TOUCH];
    pairs_spread(t, table, 1, mu);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow w = arrow_in_plane(touch_spin(t, c), touch_normal(t, c));
        const real size = sqrt(arrow_dot(w, w));
        const real torque = mu[0][c] * t->r_eff[c] * t->fn[c];
        touch_add_moment(t, c, arrow_scale(size > 0.0 ? -torque / size : 0.0, w));
    }
}

static void by_radius(struct touch *t)
{
    _Alignas(64) real mu[1][TOUCH];
    pairs_spread(t, table, 1, mu);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), between = touch_spin(t, c);
        const struct arrow of_i = {t->sx[c], t->sy[c], t->sz[c]};
        const struct arrow of_j = arrow_axpy(of_i, -1.0, between);
        const struct arrow w =
            arrow_in_plane(arrow_axpy(arrow_scale(t->r_i[c], of_i), -t->r_j[c], of_j), n);
        const real size = sqrt(arrow_dot(w, w));
        const bool brakes = arrow_dot(w, between) > 0.0;
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        const real torque = mu[0][c] * t->r_eff[c] * t->kn[c] * depth;
        touch_add_moment(t, c, arrow_scale(brakes ? -torque / size : 0.0, w));
    }
}

void rolling_moments(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    if (weighted)
        by_radius(t);
    else
        relative(t);
}

void rolling_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}
