/* contact/rolling/viscous.c - a torque that grows with the rolling velocity.
 *
 *   M = -mu_r R* F_n (r_i w_i - r_j w_j)                                 [Ai11, model B]
 * with the part of the velocity in the plane of contact. mu_r is no pure number here, but s/m
 * (the review does not say so). The rolling velocity does not tell rolling from a pair that turns
 * as one body: where the couple would drive the grains instead of braking them (only grains of
 * unlike radii), it is left out. The couple is at most what stops the relative spin within a
 * step. Published for discs in a plane (2-D), where w has one component; for spheres (3-D) w is a vector in
 * the plane of contact, and the law is the same. A rolling grain slows down as exp(-t/tau) and never comes to rest. */
#include "rolling.h"

#include "../pairs.h"
#include "../spring.h"

const struct about rolling_about = {
    .name = "viscous",
    .summary = "a torque proportional to the rolling velocity; no torque at rest",
    .equation = "M = -mu_r R* F_n (r_i w_i - r_j w_j)",
    .source = "[Ai11, model B]",
    .range = "grains that keep rolling"};

const struct key rolling_keys[] = {
    {"material", "rolling_viscosity", KEY_REAL, "s m-1", "[0, inf)", NULL,
     "mu_r of the torque mu_r R* F_n v_roll"},
    {"pair", "rolling_viscosity", KEY_REAL, "s m-1", "mixed | [0, inf)", "mixed",
     "rolling viscosity of a contact"},
    {0},
};

const int rolling_history = 0;
const unsigned rolling_needs = TOUCH_COUPLES | TOUCH_SPIN | TOUCH_INERTIA;

static real table[PAIRS_MAX];

void rolling_init(struct scene *s, const struct materials *m)
{
    double value[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "rolling_viscosity", MIX_GEOMETRIC, value);
    for (int p = 0; p < m->n * m->n; p++)
        table[p] = (real)value[p];
}

void rolling_moments(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    const real rate = (real)(1.0 / t->dt);
    _Alignas(64) real mu[1][TOUCH];
    pairs_spread(t, table, 1, mu);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), between = touch_spin(t, c);
        const struct arrow of_i = {t->sx[c], t->sy[c], t->sz[c]};
        const struct arrow of_j = arrow_axpy(of_i, -1.0, between);
        const struct arrow v =
            arrow_in_plane(arrow_axpy(arrow_scale(t->r_i[c], of_i), -t->r_j[c], of_j), n);
        const real along = arrow_dot(v, between), square = arrow_dot(v, v);
        const real asked = mu[0][c] * t->r_eff[c] * t->fn[c];
        const real most = along > 0.0 ? t->inertia[c] * rate * along / square : 0.0;
        touch_add_moment(t, c, arrow_scale(asked < most ? -asked : -most, v));
    }
}

void rolling_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}
