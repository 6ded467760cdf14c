/* contact/bond/contact_bond.c - glue at a point: two springs that bear force, no moment.
 *
 *   F_n = k_n (depth - depth_0), broken in tension where -F_n > bond_strength
 *   dF_s = -k_s v_s dt,          broken in shear where |F_s| > bond_strength_shear
 *                                                        [PotyondyCundall04; the review, sec. 2.3]
 * depth_0 is the depth at which the bond was made. The springs act beside the law of contact, both
 * ways, and turn with the pair, about its axis too. Broken in either mode a bond bears nothing more
 * (the law of contact goes on), and it stays broken. */
#include "bond.h"

#include "../pairs.h"
#include "bonding.h"

const struct about bond_about = {
    .name = "contact_bond",
    .summary = "glue at a point: bears force, with tensile and shear strength",
    .equation = "F_n = k_n u_n, F_s = k_s u_s; broken where -F_n or |F_s| exceeds its strength",
    .source = "[PotyondyCundall04]",
    .range = "any; a chain of grains bends freely"};

const struct key bond_keys[] = {
    {"material", "bond_stiffness", KEY_REAL, "N m-1", "[0, inf)", NULL,
     "k_n of a bond; 0: not bonded"},
    {"material", "bond_stiffness_shear", KEY_REAL, "N m-1", "[0, inf)", NULL, "k_s of a bond"},
    {"material", "bond_strength", KEY_REAL, "N", "unbreakable | [0, inf)", NULL,
     "tensile strength"},
    {"material", "bond_strength_shear", KEY_REAL, "N", "unbreakable | [0, inf)", NULL,
     "shear strength"},
    {"pair", "bond_stiffness", KEY_REAL, "N m-1", "mixed | [0, inf)", "mixed",
     "k_n of a pair; 0: not bonded"},
    {"pair", "bond_stiffness_shear", KEY_REAL, "N m-1", "mixed | [0, inf)", "mixed",
     "k_s of a pair"},
    {"pair", "bond_strength", KEY_REAL, "N", "mixed | unbreakable | [0, inf)", "mixed",
     "tensile strength of a pair"},
    {"pair", "bond_strength_shear", KEY_REAL, "N", "mixed | unbreakable | [0, inf)", "mixed",
     "shear strength of a pair"},
    BOND_KEYS,
    {0},
};

const int bond_history = 5; /* state; depth_0, m; F_s, N */
const unsigned bond_needs = TOUCH_SPIN;

static struct bonding bonding;

/* Of a pair of materials, as the loop needs them. */
enum {
    KN,      /* N/m */
    KS,      /* N/m */
    TENSION, /* N */
    SHEAR,   /* N */
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void bond_init(struct scene *s, const struct materials *m)
{
    double kn[PAIRS_MAX], ks[PAIRS_MAX], tension[PAIRS_MAX], shear[PAIRS_MAX],
        stretch[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "bond_stiffness", MIX_GEOMETRIC, kn);
    materials_pair_values(s, m, "bond_stiffness_shear", MIX_GEOMETRIC, ks);
    materials_pair_optional(s, m, "bond_strength", "unbreakable", MIX_GEOMETRIC, tension, NULL);
    materials_pair_optional(s, m, "bond_strength_shear", "unbreakable", MIX_GEOMETRIC, shear,
                            NULL);
    for (int p = 0; p < m->n * m->n; p++) {
        tension[p] = isnan(tension[p]) ? (double)INFINITY : tension[p];
        shear[p] = isnan(shear[p]) ? (double)INFINITY : shear[p];
        stretch[p] = kn[p] > 0.0 ? tension[p] / kn[p] : 0.0;
        table[p][KN] = (real)kn[p];
        table[p][KS] = (real)ks[p];
        table[p][TENSION] = (real)tension[p];
        table[p][SHEAR] = (real)shear[p];
    }
    bonding_read(s, m, stretch, &bonding);
}

void bond_forces(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH];
    _Alignas(64) real broken[2][TOUCH]; /* tension, shear */
    real *const restrict state = history[0], *const restrict depth_0 = history[1];
    real *const restrict sx = history[2], *const restrict sy = history[3];
    real *const restrict sz = history[4];
    const real dt = (real)t->dt, zeta = (real)(2.0 * bonding.damping), gap = (real)bonding.gap;
    const real now = bonding_now(&bonding, t) ? 1.0 : 0.0;
    pairs_spread(t, &table[0][0], PARAMETERS, k);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c);
        const struct arrow v = arrow_in_plane(touch_velocity(t, c), n);
        const real angle = dt * bonding_roll(t, c, n);
        const real k_n = k[KN][c], k_s = k[KS][c];
        const bool old = state[c] > 0.0;
        const bool made = (now * k_n > 0.0) & (state[c] == 0.0) & (t->depth[c] >= -gap);
        const bool on = old | made;
        const real rest = made ? t->depth[c] : depth_0[c], step = old ? dt : 0.0;
        const real f_n = k_n * (t->depth[c] - rest);
        const struct arrow shear = arrow_axpy(
            bonding_turn((struct arrow){sx[c], sy[c], sz[c]}, n, angle), -k_s * step, v);
        const bool torn = on & (-f_n > k[TENSION][c]);
        const bool sheared = on & (sqrt(arrow_dot(shear, shear)) > k[SHEAR][c]);
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
        const real root = zeta * sqrt(t->m_eff[c]);
        const real normal = f_n - root * sqrt(k_n) * t->vn[c];
        const struct arrow side = arrow_axpy(shear, -root * sqrt(k_s), v);
        touch_add_force(t, c, arrow_scale(all, arrow_axpy(side, normal, n)));
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
        const double u = (double)(t->depth[c] - history[1][c]);
        double shear = 0.0;
        for (int a = 0; a < 3; a++)
            shear += (double)(history[2 + a][c] * history[2 + a][c]);
        if (!(history[0][c] > 0.0))
            continue;
        t->energy[c] += 0.5 * (double)k[KN] * u * u;
        if (k[KS] > 0.0)
            t->energy[c] += 0.5 * shear / (double)k[KS];
    }
}

double bond_range(void)
{
    return bonding.range;
}
