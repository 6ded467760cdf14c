/* contact/linear.c - linear spring and dashpot, normal and tangential, with Coulomb's limit.
 *
 *   F_n = k_n depth - c_n v_n, cut at zero                                    [CundallStrack79]
 *   F_t = -k_t s - c_t v_t,   |F_t| <= mu F_n,  ds = v_t dt
 * with k_n = k_i k_j/(k_i + k_j), springs in series, or as given for the pair. The review's eqs
 * (4), (5) print the inverse, (k_i + k_j)/(k_i k_j), whose unit is m/N. Dashpots either from
 * restitution, c = 2 zeta sqrt(k m*), where zeta gives the restitution asked for although the
 * contact does not pull (restitution.c), or from damping_ratio (that zeta), or constant
 * coefficients c_n, c_t as given [Ma23, eqs 13, 14]. What the tangential spring bears turns with
 * the contact plane and is cut where the contact slides. */
#include "contact.h"

#include "../solver/elastic.h"
#include "pairs.h"
#include "spring.h"

const struct about contact_about = {
    .name = "linear",
    .summary = "linear spring and dashpot, Coulomb friction with a tangential spring",
    .equation = "F_n = k_n d - c_n v_n; F_t = -k_t s - c_t v_t, |F_t| <= mu F_n",
    .source = "[CundallStrack79]; restitution [SchwagerPoeschel07, eq. 13]",
    .range = "any speed; k chosen for overlaps below a few % of the radius",
    .cost = "a spring in the plane with memory, its turn and its limit"};

const struct key contact_keys[] = {
    {"material", "stiffness", KEY_REAL, "N m-1", "(0, inf)", NULL,
     "normal stiffness of a body; a pair has the two in series"},
    {"material", "stiffness_ratio", KEY_REAL, "1", "[0, 1]", "0.2857142857142857",
     "tangential over normal stiffness"},
    DAMPING_KEYS,
    {"material", "damping", KEY_REAL, "N s m-1", "none | [0, inf)", "none",
     "normal damping coefficient of a contact, instead of restitution"},
    {"material", "damping_tangential", KEY_REAL, "N s m-1", "damping | [0, inf)", "damping",
     "tangential damping coefficient; damping: the normal one"},
    FRICTION_KEYS,
    {"pair", "stiffness", KEY_REAL, "N m-1", "mixed | (0, inf)", "mixed",
     "normal stiffness of a contact; mixed: the two bodies in series"},
    {"pair", "stiffness_ratio", KEY_REAL, "1", "mixed | [0, 1]", "mixed",
     "tangential over normal stiffness of a contact"},
    {"pair", "damping", KEY_REAL, "N s m-1", "mixed | none | [0, inf)", "mixed",
     "normal damping coefficient of a contact"},
    {"pair", "damping_tangential", KEY_REAL, "N s m-1", "mixed | damping | [0, inf)", "mixed",
     "tangential damping coefficient of a contact"},
    {0},
};

const int contact_history = 3; /* what the tangential spring bears, N */

static int materials;
static double k_n[PAIRS_MAX];

/* Of a pair of materials, as the loop needs them. */
enum {
    KN, /* N/m */
    KT, /* N/m */
    CN, /* dashpots per sqrt(m*): 2 zeta sqrt(k) */
    CT,
    BN, /* N s/m, dashpots besides */
    BT,
    MU,
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void contact_init(struct scene *s, const struct materials *m)
{
    double zeta[PAIRS_MAX], bn[PAIRS_MAX], bt[PAIRS_MAX], ratio[PAIRS_MAX], friction[PAIRS_MAX];
    materials = m->n;
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "stiffness", MIX_SERIES, k_n);
    materials_pair_values(s, m, "stiffness_ratio", MIX_GEOMETRIC, ratio);
    materials_pair_optional(s, m, "damping", "none", MIX_GEOMETRIC, bn, NULL);
    materials_pair_optional(s, m, "damping_tangential", "damping", MIX_GEOMETRIC, bt, NULL);
    elastic_damping(s, m, (double)NAN, true, zeta);
    materials_pair_values(s, m, "friction", MIX_GEOMETRIC, friction);
    for (int p = 0; p < m->n * m->n; p++) {
        const char *const name = m->name[p / m->n];
        if (isnan(bn[p]) && isnan(zeta[p]))
            scene_error(s, "material", name, "restitution",
                        "must be given, or damping_ratio or damping instead");
        else if (!isnan(bn[p]) && !isnan(zeta[p]))
            scene_error(s, "material", name, "damping",
                        "restitution or damping_ratio is given too: give one of the three");
    }
    for (int p = 0; p < m->n * m->n && scene_errors(s) == 0; p++) {
        const double kt = ratio[p] * k_n[p];
        const bool by_zeta = !isnan(zeta[p]);
        const double damping = by_zeta ? 2.0 * zeta[p] : 0.0, b = by_zeta ? 0.0 : bn[p];
        table[p][KN] = (real)k_n[p];
        table[p][KT] = (real)kt;
        table[p][CN] = (real)(damping * sqrt(k_n[p]));
        table[p][CT] = (real)(damping * sqrt(kt));
        table[p][BN] = (real)b;
        table[p][BT] = (real)(by_zeta || isnan(bt[p]) ? b : bt[p]);
        table[p][MU] = (real)friction[p];
    }
}

void contact_forces(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
    real *const restrict hx = history[0], *const restrict hy = history[1];
    real *const restrict hz = history[2];
    const real dt = (real)t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c);
        const struct arrow v = arrow_in_plane(touch_velocity(t, c), n);
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0, start = t->start[c];
        const real root = sqrt(t->m_eff[c]);
        const real normal = k[KN][c] * depth - start * (k[CN][c] * root + k[BN][c]) * t->vn[c];
        const real push = normal > 0.0 ? normal : 0.0;
        const real fn = depth > 0.0 ? push : 0.0;
        const struct arrow held = spring_turn((struct arrow){hx[c], hy[c], hz[c]}, n, 1.0, 1.0);
        const struct spring f =
            spring_cut(arrow_axpy(held, -k[KT][c] * dt, v),
                       arrow_scale(-start * (k[CT][c] * root + k[BT][c]), v), k[MU][c] * fn);
        hx[c] = f.held.x;
        hy[c] = f.held.y;
        hz[c] = f.held.z;
        t->fx[c] = fn * n.x + f.total.x;
        t->fy[c] = fn * n.y + f.total.y;
        t->fz[c] = fn * n.z + f.total.z;
        t->fn[c] = fn;
        t->kn[c] = k[KN][c];
    }
}

void contact_damping(const struct touch *t, real *c)
{
    for (int k = 0; k < t->n; k++) {
        const real *const p = table[t->pair[k]];
        c[k] = t->depth[k] > 0.0 ? p[CN] * sqrt(t->m_eff[k]) + p[BN] : 0.0;
    }
}

void contact_energy(struct touch *t, real (*history)[TOUCH])
{
    const real *const hx = history[0], *const hy = history[1], *const hz = history[2];
    for (int c = 0; c < t->n; c++) {
        const real *const k = table[t->pair[c]];
        const double depth = (double)(t->depth[c] > 0.0 ? t->depth[c] : 0.0);
        const double stored = (double)(hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c]);
        t->energy[c] = 0.5 * (double)k[KN] * depth * depth +
                       (k[KT] > 0.0 ? 0.5 * stored / (double)k[KT] : 0.0);
    }
}

double contact_duration(int a, int b, double m_eff, double r_eff, double v)
{
    (void)r_eff;
    (void)v;
    const int p = a * materials + b;
    const double damping = (double)table[p][CN] * sqrt(m_eff) + (double)table[p][BN];
    return duration_damped(3.14159265358979323846 * sqrt(m_eff / k_n[p]),
                           damping / (2.0 * sqrt(k_n[p] * m_eff)));
}

double contact_rayleigh(int a, double radius, double density)
{
    (void)a;
    (void)radius;
    (void)density;
    return (double)INFINITY;
}
