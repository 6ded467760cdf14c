/* contact/rolling/epsd.c - elastic-plastic spring and dashpot against rolling.
 *
 *   M = M_k + M_d,  dM_k = -k_r w dt,  |M_k| <= M_m = mu_r R* F_n            [Ai11, model C]
 *   M_d = -C_r w where |M_k| < M_m, -f C_r w at the limit,  C_r = 2 eta_r sqrt(I_r k_r)
 *   k_r = q k_n mu_r^2 R*^2, q = 2.25 for spheres (3-D), 3 for discs (2-D)
 * with the part of the relative spin w in the plane of contact (twisting is not resisted), k_n the
 * secant normal stiffness and I_r the reduced inertia about the contact point. The review's row
 * compares M_k with itself, where M_m is meant, and lacks k_r and the branch f C_r. Where k_r
 * falls (a Hertz contact unloads) the spring is eased with it, so that no energy is made. */
#include "rolling.h"

#include "../pairs.h"
#include "rolling_spring.h"

const struct about rolling_about = {
    .name = "epsd",
    .summary = "elastic-plastic spring and dashpot against rolling; comes to rest",
    .equation = "dM_k = -k_r w dt, |M_k| <= mu_r R* F_n; M_d = -2 eta_r sqrt(I_r k_r) w",
    .source = "[Ai11, model C]",
    .range = "any",
    .cost = "a spring with memory, its turn, its limit and a root for its dashpot"};

const struct key rolling_keys[] = {
    {"material", "rolling_friction", KEY_REAL, "1", "[0, inf)", NULL,
     "coefficient of rolling friction, the tangent of the angle at which a sphere rolls"},
    {"pair", "rolling_friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed",
     "rolling friction of a contact"},
    {"rolling", "form", KEY_CHOICE, "", "sphere | disc", "sphere",
     "3-D or 2-D: what stiffness_factor = auto is"},
    {"rolling", "stiffness_factor", KEY_REAL, "1", "auto | (0, inf)", "auto",
     "q in k_r = q k_n mu_r^2 R*^2; auto: 2.25 for spheres, 3 for discs"},
    {"rolling", "damping", KEY_REAL, "1", "[0, inf)", "0.3", "eta_r, damping ratio"},
    {"rolling", "plastic_damping", KEY_REAL, "1", "[0, 1]", "0",
     "f, part of the damping that acts at the limit"},
    {0},
};

const int rolling_history = 4; /* M_k, N m; k_r, N m */
const unsigned rolling_needs = TOUCH_COUPLES | TOUCH_INERTIA;

static real factor, eta, plastic;
static real table[PAIRS_MAX];

void rolling_init(struct scene *s, const struct materials *m)
{
    double value[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "rolling_friction", MIX_GEOMETRIC, value);
    const bool disc = scene_choice(s, "rolling", NULL, "form") == 1;
    factor = scene_word(s, "rolling", NULL, "stiffness_factor", "auto")
                 ? (real)(disc ? 3.0 : 2.25)
                 : (real)scene_real(s, "rolling", NULL, "stiffness_factor");
    eta = (real)scene_real(s, "rolling", NULL, "damping");
    plastic = (real)scene_real(s, "rolling", NULL, "plastic_damping");
    for (int p = 0; p < m->n * m->n; p++)
        table[p] = (real)value[p];
}

void rolling_moments(struct touch *t, real (*history)[TOUCH])
{
    real *const restrict hx = history[0], *const restrict hy = history[1];
    real *const restrict hz = history[2], *const restrict k_old = history[3];
    const real dt = (real)t->dt;
    _Alignas(64) real mu[1][TOUCH];
    pairs_spread(t, table, 1, mu);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), roll = arrow_in_plane(touch_spin(t, c), n);
        const real arm = mu[0][c] * t->r_eff[c];
        const real kn = t->depth[c] > 0.0 ? t->kn[c] : 0.0, k = factor * kn * arm * arm;
        const struct rolling_spring spring = {.stiffness = k,
                                              .keep = k < k_old[c] ? k / k_old[c] : 1.0,
                                              .damping = 2.0 * eta * sqrt(t->inertia[c] * k),
                                              .plastic = plastic,
                                              .limit = arm * t->fn[c]};
        const struct rolled r =
            rolling_spring(spring, (struct arrow){hx[c], hy[c], hz[c]}, n, roll, dt);
        hx[c] = r.held.x;
        hy[c] = r.held.y;
        hz[c] = r.held.z;
        k_old[c] = k;
        touch_add_moment(t, c, r.moment);
    }
}

void rolling_energy(struct touch *t, real (*history)[TOUCH])
{
    const real *const hx = history[0], *const hy = history[1], *const hz = history[2];
    for (int c = 0; c < t->n; c++) {
        const double k = (double)history[3][c];
        const double held = (double)(hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c]);
        t->energy[c] += k > 0.0 ? 0.5 * held / k : 0.0;
    }
}
