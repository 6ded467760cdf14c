/* contact/hertz_mindlin_liu.c - Hertz's normal force with a tangential force in closed form of the
 * tangential displacement, which softens towards Coulomb's limit.
 *
 *   F_n = k_n depth^(3/2) - sqrt(5) zeta sqrt(m* k_n) depth^(1/4) v_n, cut at zero,
 *   k_n = (4/3) E* sqrt(R*)                                                   [LiLiuJi23, eq. 16]
 *   F_t = -mu k_n depth^(3/2) (1 - (1 - s/s_max)^(3/2)) - c_t v_t,  s <= s_max, F_t <= mu F_n,
 *   s_max = mu depth E* / (4 G*), which is mu depth (2 - nu)/(2 - 2 nu) for like bodies,
 *   c_t = zeta_t sqrt(6 mu m* k_n depth^(3/2) sqrt(1 - s/s_max)/s_max)        [LiLiuJi23, eq. 17]
 * with the displacement s turned with the contact plane.
 *
 * Misprints mended: eq. (16) has depth^(1/2) for depth^(1/4), and lacks sqrt(5), in the damping;
 * eq. (17) takes the dashpot's c_t from c_n, but it must be a pure number: zeta_t = zeta/(2 (1 +
 * nu)). c_t is then 2 zeta_t sqrt(m* k_t) with the tangent stiffness k_t. Deviations: zeta gives
 * the restitution asked for although the contact does not pull (restitution.c); the total is cut
 * at mu times the whole normal force; while the contact loads, s falls as depth^(-1/2), which
 * leaves the force of a small s as it is: the closed form at a fixed s would make energy, since
 * its stiffness grows with the load. */
#include "contact.h"

#include <string.h>
#include "../solver/elastic.h"
#include "pairs.h"
#include "spring.h"

const struct about contact_about = {
    .name = "hertz_mindlin_liu",
    .summary = "Hertz with Tsuji's damping, tangential force in closed form, Coulomb's limit",
    .equation =
        "F_n = k_n d^1.5 - c_n v_n; F_t = -mu k_n d^1.5 (1 - (1 - s/s_max)^1.5) - c_t v_t",
    .source = "[LiLiuJi23, eqs 16, 17], [Hertz1882], [Mindlin49], [Tsuji92]",
    .range = "elastic bodies, overlaps below a few % of the radius",
    .cost = "the same as hertz_mindlin and powers 1.5 and 0.5 of the spring over its limit"};

const struct key contact_keys[] = {ELASTIC_KEYS, DAMPING_KEYS, FRICTION_KEYS, {0}};

const int contact_history = 4; /* s, m; depth, m */

static struct elastic elastic;

/* Of a pair of materials, as the loop needs them. */
enum {
    HERTZ,     /* Pa, 4/3 E* */
    CN,        /* Pa^1/2, dashpot per sqrt(a m*): 2 sqrt(5/6) zeta sqrt(2 E*) */
    CT,        /* 1, 2 zeta_t */
    S_MAX,     /* 1, s_max/depth */
    INV_S_MAX, /* 1, its inverse; 0 without friction */
    MU,
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void contact_init(struct scene *s, const struct materials *m)
{
    const double tsuji = 2.0 * sqrt(5.0 / 6.0);
    double zeta[PAIRS_MAX], friction[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    elastic_read(s, m, &elastic);
    elastic_damping(s, m, (double)NAN, false, zeta);
    memcpy(elastic.zeta, zeta, sizeof zeta);
    materials_pair_values(s, m, "friction", MIX_GEOMETRIC, friction);
    for (int p = 0; p < m->n * m->n && scene_errors(s) == 0; p++) {
        const double e = elastic.e_star[p], s_max = friction[p] * e / (4.0 * elastic.g_star[p]);
        const double nu =
            0.5 * (elastic.poisson[p / m->n] + elastic.poisson[p % m->n]); /* unlike: mean */
        table[p][HERTZ] = (real)(4.0 / 3.0 * e);
        table[p][CN] = (real)(tsuji * zeta[p] * sqrt(2.0 * e));
        table[p][CT] = (real)(zeta[p] / (1.0 + nu));
        table[p][S_MAX] = (real)s_max;
        table[p][INV_S_MAX] = (real)(s_max > 0.0 ? 1.0 / s_max : 0.0);
        table[p][MU] = (real)friction[p];
    }
}

void contact_forces(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
    real *const restrict hx = history[0], *const restrict hy = history[1];
    real *const restrict hz = history[2], *const restrict depth_old = history[3];
    const real dt = (real)t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c);
        const struct arrow v = arrow_in_plane(touch_velocity(t, c), n);
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        const real a = sqrt(t->r_eff[c] * depth), kn = k[HERTZ][c] * a, elastic_n = kn * depth;
        const real normal =
            elastic_n - k[CN][c] * t->start[c] * sqrt(a * t->m_eff[c]) * t->vn[c];
        const real fn = normal > 0.0 ? normal : 0.0;
        const bool loads = depth > depth_old[c];
        const struct arrow turned = spring_turn((struct arrow){hx[c], hy[c], hz[c]}, n,
                                                loads ? sqrt(depth_old[c] / depth) : 1.0, 1.0);
        const struct arrow to = arrow_axpy(turned, dt, v);
        const real size = sqrt(arrow_dot(to, to)), most = k[S_MAX][c] * depth;
        const real inverse = size > 0.0 ? 1.0 / size : 0.0;
        const struct arrow s = arrow_scale(size > most ? most * inverse : 1.0, to);
        /* q = 1 - s/s_max */
        const real x =
            size < most ? size * (k[INV_S_MAX][c] / (depth > 0.0 ? depth : 1.0)) : 1.0;
        const real q = x < 1.0 ? 1.0 - x : 0.0, root = sqrt(q);
        const real mobilised = k[MU][c] * elastic_n * (1.0 - q * root);
        const struct arrow spring = arrow_scale(-mobilised * inverse, to);
        /* tangent stiffness 1.5 mu F_n^e sqrt(q)/s_max = 1.5 mu k_n/(s_max/depth) sqrt(q) */
        const real tangent = 1.5 * k[MU][c] * k[INV_S_MAX][c] * kn * root;
        const struct arrow dashpot =
            arrow_scale(-k[CT][c] * t->start[c] * sqrt(t->m_eff[c] * tangent), v);
        const struct spring f = spring_cut(spring, dashpot, k[MU][c] * fn);
        hx[c] = s.x;
        hy[c] = s.y;
        hz[c] = s.z;
        depth_old[c] = depth;
        t->fx[c] = fn * n.x + f.total.x;
        t->fy[c] = fn * n.y + f.total.y;
        t->fz[c] = fn * n.z + f.total.z;
        t->fn[c] = fn;
        t->kn[c] = kn;
    }
}

void contact_damping(const struct touch *t, real *c)
{
    for (int k = 0; k < t->n; k++) {
        const real depth = t->depth[k] > 0.0 ? t->depth[k] : 0.0;
        c[k] = table[t->pair[k]][CN] * sqrt(sqrt(t->r_eff[k] * depth) * t->m_eff[k]);
    }
}

/* The spring's is the integral of its force over s, mu F_n^e s_max (x - 0.4 (1 - (1 -
 * x)^(5/2))). */
void contact_energy(struct touch *t, real (*history)[TOUCH])
{
    const real *const hx = history[0], *const hy = history[1], *const hz = history[2];
    for (int c = 0; c < t->n; c++) {
        const real *const k = table[t->pair[c]];
        const double depth = (double)(t->depth[c] > 0.0 ? t->depth[c] : 0.0);
        const double most = (double)k[S_MAX] * depth, kn = (double)t->kn[c];
        const double s = sqrt((double)(hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c]));
        const double x = most > 0.0 ? fmin(s / most, 1.0) : 0.0;
        t->energy[c] = 0.4 * kn * depth * depth + (double)k[MU] * kn * depth * most *
                                                      (x - 0.4 * (1.0 - pow(1.0 - x, 2.5)));
    }
}

double contact_duration(int a, int b, double m_eff, double r_eff, double v)
{
    return elastic_duration(&elastic, a, b, m_eff, r_eff, v);
}

double contact_rayleigh(int a, double radius, double density)
{
    return elastic_rayleigh(&elastic, a, radius, density);
}
