/* contact/bond/parallel_bond.c - cement between two grains: a disc of elastic material that bears
 * force and moment, and breaks where its outer fibre is stressed too much.
 *
 *   F_n = k_n A (depth - depth_0),  dF_s = -k_s A v_s dt           A = pi R^2    [PotyondyCundall04]
 *   dM_n = -k_s J w_n dt (twist),   dM_s = -k_n I w_s dt (bend)    I = pi R^4/4, J = pi R^4/2
 *   sigma = -F_n/A + |M_s| R/I > bond_strength: broken in tension  [the review, eq. 18]
 *   tau   = |F_s|/A + |M_n| R/J > bond_strength_shear: in shear    [the review, eq. 19]
 * with R = lambda min(r_i, r_j), k in Pa/m, depth_0 the depth at which the bond was made. It acts
 * beside the law of contact. Forces and moments turn with the pair, about its axis too.
 *
 * The review's eqs (16), (17) write totals where shear, twist and bend are increments, call I the
 * inertia about the contact point, and drop the signs. Once broken, a bond stays broken. */
#include "bond.h"

#include "../pairs.h"
#include "bonding.h"

#define PI 3.14159265358979323846

const struct about bond_about = {
    .name = "parallel_bond",
    .summary = "cement that bears force and moment, with tensile and shear strength",
    .equation =
        "F = k A u, M = k I theta; sigma = -F_n/A + |M_s| R/I, tau = |F_s|/A + |M_n| R/J",
    .source = "[PotyondyCundall04]",
    .range = "small strains of the cement"};

const struct key bond_keys[] = {
    {"material", "bond_stiffness", KEY_REAL, "Pa m-1", "[0, inf)", NULL,
     "k_n, normal stiffness per area; 0: not bonded"},
    {"material", "bond_stiffness_shear", KEY_REAL, "Pa m-1", "[0, inf)", NULL,
     "k_s, shear stiffness per area"},
    {"material", "bond_strength", KEY_REAL, "Pa", "unbreakable | [0, inf)", NULL,
     "tensile strength"},
    {"material", "bond_strength_shear", KEY_REAL, "Pa", "unbreakable | [0, inf)", NULL,
     "shear strength"},
    {"pair", "bond_stiffness", KEY_REAL, "Pa m-1", "mixed | [0, inf)", "mixed",
     "k_n of a pair; 0: not bonded"},
    {"pair", "bond_stiffness_shear", KEY_REAL, "Pa m-1", "mixed | [0, inf)", "mixed",
     "k_s of a pair"},
    {"pair", "bond_strength", KEY_REAL, "Pa", "mixed | unbreakable | [0, inf)", "mixed",
     "tensile strength of a pair"},
    {"pair", "bond_strength_shear", KEY_REAL, "Pa", "mixed | unbreakable | [0, inf)", "mixed",
     "shear strength of a pair"},
    {"bond", "radius", KEY_REAL, "1", "(0, inf)", "1",
     "lambda, radius of the bond over that of the smaller grain"},
    BOND_KEYS,
    {0},
};

/* state; depth_0, m; F_s, N; M_n, N m; M_s, N m */
const int bond_history = 9;
const unsigned bond_needs = TOUCH_COUPLES | TOUCH_SPIN | TOUCH_INERTIA;

static struct bonding bonding;
static real lambda;

/* Of a pair of materials, as the loop needs them. */
enum {
    KN,     /* Pa/m */
    KS,     /* Pa/m */
    ROOT_N, /* sqrt(pi k_n) */
    ROOT_S, /* sqrt(pi k_s) */
    SIGMA,  /* Pa */
    TAU,    /* Pa */
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void bond_init(struct scene *s, const struct materials *m)
{
    double kn[PAIRS_MAX], ks[PAIRS_MAX], sigma[PAIRS_MAX], tau[PAIRS_MAX], stretch[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "bond_stiffness", MIX_GEOMETRIC, kn);
    materials_pair_values(s, m, "bond_stiffness_shear", MIX_GEOMETRIC, ks);
    materials_pair_optional(s, m, "bond_strength", "unbreakable", MIX_GEOMETRIC, sigma, NULL);
    materials_pair_optional(s, m, "bond_strength_shear", "unbreakable", MIX_GEOMETRIC, tau,
                            NULL);
    lambda = (real)scene_real(s, "bond", NULL, "radius");
    for (int p = 0; p < m->n * m->n; p++) {
        sigma[p] = isnan(sigma[p]) ? (double)INFINITY : sigma[p];
        tau[p] = isnan(tau[p]) ? (double)INFINITY : tau[p];
        stretch[p] = kn[p] > 0.0 ? sigma[p] / kn[p] : 0.0;
        table[p][KN] = (real)kn[p];
        table[p][KS] = (real)ks[p];
        table[p][ROOT_N] = (real)sqrt(PI * kn[p]);
        table[p][ROOT_S] = (real)sqrt(PI * ks[p]);
        table[p][SIGMA] = (real)sigma[p];
        table[p][TAU] = (real)tau[p];
    }
    bonding_read(s, m, stretch, &bonding);
}

void bond_forces(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH];
    _Alignas(64) real broken[2][TOUCH]; /* tension, shear */
    real *const restrict state = history[0], *const restrict depth_0 = history[1];
    real *const restrict sx = history[2], *const restrict sy = history[3];
    real *const restrict sz = history[4], *const restrict mn = history[5];
    real *const restrict bx = history[6], *const restrict by = history[7];
    real *const restrict bz = history[8];
    const real dt = (real)t->dt, zeta = (real)(2.0 * bonding.damping), gap = (real)bonding.gap;
    const real now = bonding_now(&bonding, t) ? 1.0 : 0.0;
    pairs_spread(t, &table[0][0], PARAMETERS, k);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), w = touch_spin(t, c);
        const struct arrow v = arrow_in_plane(touch_velocity(t, c), n);
        const real w_n = arrow_dot(w, n), angle = dt * bonding_roll(t, c, n);
        const struct arrow w_s = arrow_in_plane(w, n);
        const real least = t->r_j[c] > 0.0 && t->r_j[c] < t->r_i[c] ? t->r_j[c] : t->r_i[c];
        const real r = lambda * least, area = PI * r * r, inertia = 0.25 * area * r * r;
        const real k_n = k[KN][c] * area, k_s = k[KS][c] * area;
        const real k_b = k[KN][c] * inertia, k_t = k[KS][c] * 2.0 * inertia;
        const bool old = state[c] > 0.0;
        const bool made = (now * k_n > 0.0) & (state[c] == 0.0) & (t->depth[c] >= -gap);
        const bool on = old | made;
        const real rest = made ? t->depth[c] : depth_0[c], step = old ? dt : 0.0;
        const real f_n = k_n * (t->depth[c] - rest);
        const struct arrow shear = arrow_axpy(
            bonding_turn((struct arrow){sx[c], sy[c], sz[c]}, n, angle), -k_s * step, v);
        const struct arrow bend = arrow_axpy(
            bonding_turn((struct arrow){bx[c], by[c], bz[c]}, n, angle), -k_b * step, w_s);
        const real twist = mn[c] - k_t * step * w_n;
        const real per_area = 1.0 / area, per_section = 4.0 * PI * r * per_area * per_area;
        const real sigma = sqrt(arrow_dot(bend, bend)) * per_section - f_n * per_area;
        const real size = twist > 0.0 ? twist : -twist;
        const real tau = sqrt(arrow_dot(shear, shear)) * per_area + 0.5 * size * per_section;
        const bool torn = on & (sigma > k[SIGMA][c]), sheared = on & (tau > k[TAU][c]);
        const bool breaks = torn | sheared;
        const real bound = on ? 1.0 : 0.0, all = breaks ? 0.0 : bound; /* whether it bears */
        broken[0][c] = torn ? 1.0 : 0.0;
        broken[1][c] = sheared ? 1.0 : 0.0;
        const real bonded = on ? 1.0 : state[c];
        state[c] = breaks ? -1.0 : bonded;
        depth_0[c] = rest;
        sx[c] = all * shear.x;
        sy[c] = all * shear.y;
        sz[c] = all * shear.z;
        mn[c] = all * twist;
        bx[c] = all * bend.x;
        by[c] = all * bend.y;
        bz[c] = all * bend.z;
        /* dashpots 2 zeta sqrt(k m): sqrt(k_n A) = sqrt(pi k_n) R, sqrt(k_n I) half of that times R */
        const real root_m = zeta * r * sqrt(t->m_eff[c]);
        const real root_i = 0.5 * zeta * r * r * sqrt(t->inertia[c]);
        const real normal = f_n - root_m * k[ROOT_N][c] * t->vn[c];
        const struct arrow side = arrow_axpy(shear, -root_m * k[ROOT_S][c], v);
        const struct arrow couple = arrow_axpy(bend, -root_i * k[ROOT_N][c], w_s);
        const real about = twist - root_i * (real)1.4142135623730951 * k[ROOT_S][c] * w_n;
        touch_add_force(t, c, arrow_scale(all, arrow_axpy(side, normal, n)));
        touch_add_moment(t, c, arrow_scale(all, arrow_axpy(couple, about, n)));
    }
    for (int c = 0; c < t->n; c++)
        t->broke[c] = (unsigned char)(broken[0][c] > 0.0   ? BROKE_TENSION
                                      : broken[1][c] > 0.0 ? BROKE_SHEAR
                                                           : 0);
}

void bond_energy(struct touch *t, real (*history)[TOUCH])
{
    for (int c = 0; c < t->n; c++) {
        const real *const k = table[t->pair[c]];
        const double least = (double)(t->r_j[c] > 0.0 ? fmin(t->r_i[c], t->r_j[c]) : t->r_i[c]);
        const double r = (double)lambda * least, area = PI * r * r;
        const double inertia = 0.25 * area * r * r;
        const double kn = (double)k[KN], ks = (double)k[KS];
        if (!(history[0][c] > 0.0))
            continue;
        const double u = (double)(t->depth[c] - history[1][c]);
        double shear = 0.0, bend = 0.0;
        for (int a = 0; a < 3; a++) {
            shear += (double)(history[2 + a][c] * history[2 + a][c]);
            bend += (double)(history[6 + a][c] * history[6 + a][c]);
        }
        const double twist = (double)(history[5][c] * history[5][c]);
        t->energy[c] += 0.5 * kn * area * u * u + 0.5 * bend / (kn * inertia);
        if (ks > 0.0)
            t->energy[c] += 0.5 * shear / (ks * area) + 0.25 * twist / (ks * inertia);
    }
}

double bond_range(void)
{
    return bonding.range;
}
