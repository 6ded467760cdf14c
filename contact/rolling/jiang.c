/* contact/rolling/jiang.c - rolling and twisting over a contact of finite radius.
 *
 *   sphere (3-D)  dM_r = -k_r w_r dt, |M_r| <= zeta_c F_n R/4,  k_r = k_n R^2/4     [Jiang15]
 *                 dM_t = -k_t w_t dt, |M_t| <= 0.65 mu F_n R,   k_t = k_s R^2/2,  k_s = ratio k_n
 *                 R = beta 2 r_i r_j/(r_i + r_j), the contact radius (twice r_i against a plane)
 *   disc (2-D)    dM_r = -k_r w_r dt, |M_r| <= F_n B/6,         k_r = k_n B^2/12    [Jiang05]
 *                 B = beta 2 r_i r_j/(r_i + r_j), the width of the contact; no twist
 * with w_r the relative spin in the plane of contact and w_t about the normal, k_n the secant
 * normal stiffness. Both follow from springs spread evenly over a disc of radius R or a strip of width B:
 * the second moment of area gives k_r, and F_n R/4, F_n B/6 are the moments at which an edge lifts
 * off; in 3-D zeta_c > 1 lets the contact go on beyond that. The review prints the limits without the sign of what they limit, and M_r
 * where M_t is compared. Published without dashpots; rolling.damping adds them (within the limits),
 * by default so that what is held comes to rest. Where k_n falls the springs are eased with it, so
 * that no energy is made. */
#include "rolling.h"

#include "../pairs.h"
#include "rolling_spring.h"

const struct about rolling_about = {
    .name = "jiang",
    .summary = "rolling and twisting over a contact of finite radius; comes to rest",
    .equation =
        "|M_r| <= zeta_c F_n R/4, k_r = k_n R^2/4; |M_t| <= 0.65 mu F_n R, k_t = k_s R^2/2",
    .source = "[Jiang15]; discs: [Jiang05]",
    .range = "any; beta below 1",
    .cost = "two springs with memory, rolling and twisting, their limits and dashpots"};

const struct key rolling_keys[] = {
    {"material", "shape_parameter", KEY_REAL, "1", "[0, inf)", NULL,
     "beta, contact radius over 2 r_i r_j/(r_i + r_j)"},
    {"material", "crushing", KEY_REAL, "1", "[0, inf)", "2.1",
     "zeta_c, local crushing parameter (3-D)"},
    {"material", "friction", KEY_REAL, "1", "[0, inf)", NULL, "Coulomb's coefficient"},
    {"pair", "shape_parameter", KEY_REAL, "1", "mixed | [0, inf)", "mixed",
     "beta of a contact"},
    {"pair", "crushing", KEY_REAL, "1", "mixed | [0, inf)", "mixed", "zeta_c of a contact"},
    {"pair", "friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed", "friction of a contact"},
    {"rolling", "form", KEY_CHOICE, "", "sphere | disc", "sphere",
     "3-D: contact over a disc of radius beta R; or 2-D: over a strip of width beta R, grains "
     "that roll "
     "in a plane"},
    {"rolling", "shear_ratio", KEY_REAL, "1", "[0, inf)", "0.6666666666666667",
     "k_s/k_n, tangential over normal stiffness, for twisting"},
    {"rolling", "damping", KEY_REAL, "1", "[0, inf)", "0.3",
     "damping ratio of dashpots beside the springs, within the limits; 0 as published"},
    {0},
};

const int rolling_history = 5; /* M_r; M_t, N m; k_n, N/m */
const unsigned rolling_needs = TOUCH_COUPLES | TOUCH_INERTIA;

static real eta, half_ratio, root_ratio;
static real second; /* of the area of contact over R^2 and k_n: 1/4, of a strip 1/12 */
/* Of a pair of materials, as the loop needs them. */
enum {
    RADIUS, /* contact radius over R* */
    ROLL,   /* limits over F_n R* */
    TWIST,
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void rolling_init(struct scene *s, const struct materials *m)
{
    double beta[PAIRS_MAX], crushing[PAIRS_MAX], mu[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "shape_parameter", MIX_GEOMETRIC, beta);
    materials_pair_values(s, m, "crushing", MIX_GEOMETRIC, crushing);
    materials_pair_values(s, m, "friction", MIX_GEOMETRIC, mu);
    const bool disc = scene_choice(s, "rolling", NULL, "form") == 1;
    const double ratio = disc ? 0.0 : scene_real(s, "rolling", NULL, "shear_ratio");
    second = (real)(disc ? 1.0 / 12.0 : 0.25);
    half_ratio = (real)(0.5 * ratio);
    /* a sphere's own inertia is 2/7 of that about the contact point */
    root_ratio = (real)sqrt(2.0 / 7.0 * 2.0 * ratio);
    eta = (real)scene_real(s, "rolling", NULL, "damping");
    for (int p = 0; p < m->n * m->n; p++) {
        table[p][RADIUS] = (real)(2.0 * beta[p]);
        table[p][ROLL] = (real)(disc ? beta[p] / 3.0 : 0.5 * crushing[p] * beta[p]);
        table[p][TWIST] = (real)(disc ? 0.0 : 1.3 * mu[p] * beta[p]);
    }
}

void rolling_moments(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
    real *const restrict hx = history[0], *const restrict hy = history[1];
    real *const restrict hz = history[2], *const restrict twist = history[3];
    real *const restrict k_old = history[4];
    const real dt = (real)t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), w = touch_spin(t, c);
        const struct arrow roll = arrow_in_plane(w, n);
        const real radius = k[RADIUS][c] * t->r_eff[c], capacity = t->fn[c] * t->r_eff[c];
        const real kn = t->depth[c] > 0.0 ? t->kn[c] : 0.0;
        const real keep = kn < k_old[c] ? kn / k_old[c] : 1.0;
        const real k_r = second * kn * radius * radius;
        const real damping = 2.0 * eta * sqrt(t->inertia[c] * k_r);
        const struct rolling_spring of_roll = {.stiffness = k_r,
                                               .keep = keep,
                                               .damping = damping,
                                               .limit = k[ROLL][c] * capacity,
                                               .whole = true};
        const struct rolling_spring of_twist = {.stiffness = half_ratio * kn * radius * radius,
                                                .keep = keep,
                                                .damping = root_ratio * damping,
                                                .limit = k[TWIST][c] * capacity,
                                                .whole = true};
        const struct rolled r =
            rolling_spring(of_roll, (struct arrow){hx[c], hy[c], hz[c]}, n, roll, dt);
        const struct twisted o = twisting_spring(of_twist, twist[c], arrow_dot(w, n), dt);
        hx[c] = r.held.x;
        hy[c] = r.held.y;
        hz[c] = r.held.z;
        twist[c] = o.held;
        k_old[c] = kn;
        touch_add_moment(t, c, arrow_axpy(r.moment, o.moment, n));
    }
}

void rolling_energy(struct touch *t, real (*history)[TOUCH])
{
    const real *const hx = history[0], *const hy = history[1], *const hz = history[2];
    for (int c = 0; c < t->n; c++) {
        const double radius = (double)(table[t->pair[c]][RADIUS] * t->r_eff[c]);
        const double k = (double)history[4][c] * radius * radius;
        const double k_t = (double)half_ratio * k;
        const double held = (double)(hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c]);
        const double twist = (double)(history[3][c] * history[3][c]);
        t->energy[c] += (k > 0.0 ? 0.5 * held / ((double)second * k) : 0.0) +
                        (k_t > 0.0 ? 0.5 * twist / k_t : 0.0);
    }
}
