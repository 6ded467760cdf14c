/* contact/rolling/matter.c - springs of constant stiffness against rolling and against twisting,
 * each with its limit.
 *
 *   dM_r = -k_r w_r dt, |M_r| <= mu_r F_n R*      w_r: relative spin in the plane of contact
 *   dM_t = -k_t w_t dt, |M_t| <= mu_o F_n R*      w_t: about the normal        [Kondic99]
 * Published for spheres (3-D). In a plane (2-D) the spins are along the one axis, w_t is nought, and the
 * first line is the whole law.
 *
 * The review prints M_r and theta_r in the line of the torsion, where M_t and theta_t are meant,
 * and the limits without the sign of what they limit. Published without dashpots: a grain held by
 * the springs then swings for ever; rolling.damping brings it to rest. */
#include "rolling.h"

#include "../pairs.h"
#include "rolling_spring.h"

const struct about rolling_about = {
    .name = "matter",
    .summary = "springs of constant stiffness against rolling and twisting, with limits",
    .equation =
        "dM_r = -k_r w_r dt, |M_r| <= mu_r F_n R*; dM_t = -k_t w_t dt, |M_t| <= mu_o F_n R*",
    .source = "[Kondic99]",
    .range = "any",
    .cost = "two springs with memory, rolling and twisting, their limits and dashpots"};

const struct key rolling_keys[] = {
    {"material", "rolling_friction", KEY_REAL, "1", "[0, inf)", NULL,
     "mu_r, coefficient of rolling friction"},
    {"material", "torsion_friction", KEY_REAL, "1", "[0, inf)", NULL,
     "mu_o, coefficient of friction against twisting"},
    {"material", "rolling_stiffness", KEY_REAL, "N m", "[0, inf)", NULL,
     "k_r, per rad, of a contact"},
    {"material", "torsion_stiffness", KEY_REAL, "N m", "[0, inf)", NULL,
     "k_t, per rad, of a contact"},
    {"pair", "rolling_friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed",
     "rolling friction of a contact"},
    {"pair", "torsion_friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed",
     "torsion friction of a contact"},
    {"pair", "rolling_stiffness", KEY_REAL, "N m", "mixed | [0, inf)", "mixed",
     "rolling stiffness of a contact"},
    {"pair", "torsion_stiffness", KEY_REAL, "N m", "mixed | [0, inf)", "mixed",
     "torsion stiffness of a contact"},
    {"rolling", "damping", KEY_REAL, "1", "[0, inf)", "0",
     "damping ratio of dashpots beside the springs, within the limits; 0 as published"},
    {0},
};

const int rolling_history = 4; /* M_r; M_t, N m */
const unsigned rolling_needs = TOUCH_COUPLES | TOUCH_INERTIA;

static real eta;
/* Of a pair of materials, as the loop needs them. */
enum {
    MU_R,
    MU_T,
    K_R,
    K_T,
    ROOT_R,
    ROOT_T, /* of 2/7 k_t: a sphere's own inertia is 2/7 of that about the contact point */
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void rolling_init(struct scene *s, const struct materials *m)
{
    double mu_r[PAIRS_MAX], mu_t[PAIRS_MAX], k_r[PAIRS_MAX], k_t[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "rolling_friction", MIX_GEOMETRIC, mu_r);
    materials_pair_values(s, m, "torsion_friction", MIX_GEOMETRIC, mu_t);
    materials_pair_values(s, m, "rolling_stiffness", MIX_GEOMETRIC, k_r);
    materials_pair_values(s, m, "torsion_stiffness", MIX_GEOMETRIC, k_t);
    eta = (real)scene_real(s, "rolling", NULL, "damping");
    for (int p = 0; p < m->n * m->n; p++) {
        table[p][MU_R] = (real)mu_r[p];
        table[p][MU_T] = (real)mu_t[p];
        table[p][K_R] = (real)k_r[p];
        table[p][K_T] = (real)k_t[p];
        table[p][ROOT_R] = (real)sqrt(k_r[p]);
        table[p][ROOT_T] = (real)sqrt(2.0 / 7.0 * k_t[p]);
    }
}

void rolling_moments(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
    real *const restrict hx = history[0], *const restrict hy = history[1];
    real *const restrict hz = history[2], *const restrict twist = history[3];
    const real dt = (real)t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), w = touch_spin(t, c);
        const struct arrow roll = arrow_in_plane(w, n);
        const real capacity = t->fn[c] * t->r_eff[c];
        const real damping = 2.0 * eta * sqrt(t->inertia[c]);
        const struct rolling_spring of_roll = {.stiffness = k[K_R][c],
                                               .keep = 1.0,
                                               .damping = damping * k[ROOT_R][c],
                                               .limit = k[MU_R][c] * capacity,
                                               .whole = true};
        const struct rolling_spring of_twist = {.stiffness = k[K_T][c],
                                                .keep = 1.0,
                                                .damping = damping * k[ROOT_T][c],
                                                .limit = k[MU_T][c] * capacity,
                                                .whole = true};
        const struct rolled r =
            rolling_spring(of_roll, (struct arrow){hx[c], hy[c], hz[c]}, n, roll, dt);
        const struct twisted o = twisting_spring(of_twist, twist[c], arrow_dot(w, n), dt);
        hx[c] = r.held.x;
        hy[c] = r.held.y;
        hz[c] = r.held.z;
        twist[c] = o.held;
        touch_add_moment(t, c, arrow_axpy(r.moment, o.moment, n));
    }
}

void rolling_energy(struct touch *t, real (*history)[TOUCH])
{
    const real *const hx = history[0], *const hy = history[1], *const hz = history[2];
    for (int c = 0; c < t->n; c++) {
        const double k_r = (double)table[t->pair[c]][K_R];
        const double k_t = (double)table[t->pair[c]][K_T];
        const double held = (double)(hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c]);
        const double twist = (double)(history[3][c] * history[3][c]);
        t->energy[c] +=
            (k_r > 0.0 ? 0.5 * held / k_r : 0.0) + (k_t > 0.0 ? 0.5 * twist / k_t : 0.0);
    }
}
