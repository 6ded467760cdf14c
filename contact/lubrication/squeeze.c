/* contact/lubrication/squeeze.c - leading terms of the film between two spheres, or a sphere and a
 * plane, in a viscous fluid.
 *
 * With R the reduced radius, h = gap/R, L = ln(range/gap), lambda = R/(r_i + r_j) (plane: 0):
 *   F_n = -6 pi mu R (1/h - R/range + (1/5 + lambda) L) v_n            [JeffreyOnishi84, X^A]
 *   W   =  6 pi mu R L (v_t^2/3 + u^2/5),  u = kappa v_t - 2 R w x n
 *   F_t = -(1/2) dW/dv_t,  M = -(1/2) dW/dw,  kappa = (r_i - r_j)/(r_i + r_j) (plane: -1)
 * v_n, v_t: relative velocity at the contact point; w: relative spin. W is the rate at which the
 * film loses energy to sliding (v_t) and to what both surfaces drag into the gap (u): derived here
 * for paraboloids. For w = 0 it is Jeffrey and Onishi's Y^A, (4/15) beta (2 + beta + 2 beta^2)/(1 +
 * beta)^3, and for a plane it has the 8/15, 2/15 and 2/5 of [Goldman67] for translation, its
 * torque, and rotation. Twisting has no leading term.
 *
 * 1/h and L are counted from their values at the range, so that the force sets in from zero. Below
 * gap_min (roughness), and in contact, the film is that at gap_min. A coefficient c acts as
 * m/(4 dt) at most, with the reduced mass m: no film throws grains apart, however long the step;
 * stiffer films than that want a shorter step. The drag of the mean flow comes on top. */
#include "lubrication.h"

#include "../spring.h"

const struct about lubrication_about = {
    .name = "squeeze",
    .summary = "film between near grains: squeezing, sliding, rolling",
    .equation = "F_n = -6 pi mu R* (R*/gap + (1/5 + R*/(r_i + r_j)) ln(R*/gap)) v_n",
    .source = "[JeffreyOnishi84], [Goldman67]",
    .range = "gap Reynolds number below 1, gaps below half the reduced radius"};

const struct key lubrication_keys[] = {
    {"fluid", "viscosity", KEY_REAL, "Pa s", "[0, inf)", NULL, "dynamic viscosity"},
    {"lubrication", "gap_min", KEY_REAL, "m", "(0, inf)", NULL,
     "gap below which the film grows no stiffer: the grains' roughness"},
    {"lubrication", "range", KEY_REAL, "m", "(0, inf)", NULL, "gap at which the film sets in"},
    {"lubrication", "shear", KEY_CHOICE, "", "on | off", "on",
     "forces and couples of sliding and rolling too"},
    {0},
};

const int lubrication_history = 0;
const unsigned lubrication_needs = TOUCH_COUPLES;

static double range;
static real viscous; /* 6 pi mu, Pa s */
static real gap_min, gap_max;
static real shear; /* 1 or 0 */

void lubrication_init(struct scene *s, const struct materials *m)
{
    (void)m;
    const double mu = scene_real(s, "fluid", NULL, "viscosity");
    const double least = scene_real(s, "lubrication", NULL, "gap_min");
    range = scene_real(s, "lubrication", NULL, "range");
    if (range <= least)
        scene_error(s, "lubrication", NULL, "range", "must be more than gap_min = %g m", least);
    viscous = (real)(6.0 * 3.14159265358979323846 * mu);
    gap_min = (real)least;
    gap_max = (real)range;
    shear = scene_choice(s, "lubrication", NULL, "shear") == 0 ? 1.0 : 0.0;
}

/* A dashpot may take a quarter of the relative velocity in a step at most: several films act on a
 * grain. */
SPRING_INLINE real bounded(real c, real m_over_dt)
{
    const real most = 0.25 * m_over_dt;
    return c < most ? c : most;
}

/* ln(range/gap); a loop of its own, since the logarithm is a call. */
static void logarithms(const struct touch *t, real *out)
{
    for (int c = 0; c < t->n; c++) {
        const real gap = -t->depth[c] > gap_min ? -t->depth[c] : gap_min;
        out[c] = gap < gap_max ? log(gap_max / gap) : 0.0;
    }
}

void lubrication_forces(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    _Alignas(64) real film[TOUCH];
    const real dt = (real)t->dt;
    logarithms(t, film);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), w = touch_spin(t, c);
        const struct arrow v = arrow_in_plane(touch_velocity(t, c), n);
        const real r = t->r_eff[c], gap = -t->depth[c] > gap_min ? -t->depth[c] : gap_min;
        const bool plane = !(t->r_j[c] > 0.0), on = gap < gap_max;
        const real inv_sum = 1.0 / (t->r_i[c] + t->r_j[c]), rate = t->m_eff[c] / dt;
        const real lambda = plane ? 0.0 : r * inv_sum;
        const real kappa = plane ? -1.0 : (t->r_i[c] - t->r_j[c]) * inv_sum;
        const real squeeze = r * (1.0 / gap - 1.0 / gap_max) + (0.2 + lambda) * film[c];
        const real cn = on ? bounded(viscous * r * squeeze, rate) : 0.0;
        const real side = shear * viscous * r * film[c];
        /* sliding and rolling, as one coefficient that bounds both */
        const real ct = on ? bounded(side, 0.25 * rate) : 0.0;
        const struct arrow u = arrow_axpy(arrow_scale(kappa, v), -2.0 * r, arrow_cross(w, n));
        struct arrow f = arrow_scale(-ct * (1.0 / 3.0), v);
        f = arrow_axpy(f, -ct * 0.2 * kappa, u);
        f = arrow_axpy(f, -cn * t->vn[c], n);
        touch_add_force(t, c, f);
        touch_add_moment(t, c, arrow_scale(2.0 * r * 0.2 * ct, arrow_cross(n, u)));
    }
}

void lubrication_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)t;
    (void)history;
}

double lubrication_range(void)
{
    return range;
}
