/* contact/hertz_mindlin.c - Hertz's normal force, Mindlin's no-slip tangential force, Coulomb's
 * limit, damping from restitution.
 *
 *   F_n = (4/3) E* sqrt(R*) depth^(3/2) - 2 sqrt(5/6) zeta sqrt(S_n m*) v_n, cut at zero
 *   S_n = 2 E* sqrt(R* depth)                                              [Hertz1882]
 *   dF_t = -k_t v_t dt,  k_t = 8 G* sqrt(R* depth)                         [Mindlin49]
 *   F_t <= mu F_n with damping 2 sqrt(5/6) zeta sqrt(k_t m*) v_t           [Tsuji92]
 *   1/E* = sum (1 - nu^2)/E,  1/G* = sum 2 (2 - nu)(1 + nu)/E,  1/R* = 1/r_i + 1/r_j
 * The tangential force is what is remembered; while the contact unloads it is scaled down with
 * k_t, so that an elastic contact cannot make energy [Thornton13, sec. 3].
 *
 * Misprints of the review mended here: eq. (7) has the tangential overlap under the root of k_t
 * (it is the normal one); eq. (10) has (1 - nu) for (2 - nu) (G* 2.4 times too large at nu =
 * 0.3); eqs (9), (10) name body i twice. zeta gives the restitution asked for although the
 * contact does not pull (restitution.c), or is given. */
#include "contact.h"

#include <string.h>
#include "../solver/elastic.h"
#include "pairs.h"
#include "spring.h"

const struct about contact_about = {
    .name = "hertz_mindlin",
    .summary = "Hertz with Tsuji's damping, Mindlin no-slip tangential force, Coulomb's limit",
    .equation = "F_n = 4/3 E* sqrt(R*) d^1.5 - c_n v_n; dF_t = -8 G* sqrt(R* d) v_t dt",
    .source = "[Hertz1882], [Mindlin49], [Tsuji92], [Thornton13]",
    .range = "elastic spheres, overlaps below a few % of the radius",
    .cost = "a spring in the plane with memory, its turn and its limit, a second root"};

const struct key contact_keys[] = {ELASTIC_KEYS, DAMPING_KEYS, FRICTION_KEYS, {0}};

const int contact_history = 4; /* tangential force of the spring, N; radius of the contact, m */

static struct elastic elastic;

/* Of a pair of materials, as the loop needs them. */
enum {
    HERTZ, /* Pa, 4/3 E* */
    SHEAR, /* Pa, 8 G* */
    CN,    /* Pa^1/2, dashpots per sqrt(a m*): 2 sqrt(5/6) zeta sqrt(2 E*) */
    CT,    /* Pa^1/2, 2 sqrt(5/6) zeta sqrt(8 G*) */
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
        const double damping = tsuji * zeta[p];
        table[p][HERTZ] = (real)(4.0 / 3.0 * elastic.e_star[p]);
        table[p][SHEAR] = (real)(8.0 * elastic.g_star[p]);
        table[p][CN] = (real)(damping * sqrt(2.0 * elastic.e_star[p]));
        table[p][CT] = (real)(damping * sqrt(8.0 * elastic.g_star[p]));
        table[p][MU] = (real)friction[p];
    }
}

/* In three loops, since a processor works on the contacts of a short loop side by side, and of a
 * long one after each other. */
void contact_forces(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH], a[TOUCH], damping[TOUCH];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
    real *const restrict hx = history[0], *const restrict hy = history[1];
    real *const restrict hz = history[2], *const restrict a_old = history[3];
    const real dt = (real)t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        a[c] = square_root(t->r_eff[c] * depth);
        damping[c] = t->start[c] * square_root(a[c] * t->m_eff[c]);
        t->kn[c] = k[HERTZ][c] * a[c];
        const real normal = t->kn[c] * depth - k[CN][c] * damping[c] * t->vn[c];
        t->fn[c] = normal > 0.0 ? normal : 0.0;
    }
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const bool unloads = a[c] < a_old[c]; /* k_t falls with it */
        const struct arrow held =
            spring_turn((struct arrow){hx[c], hy[c], hz[c]}, touch_normal(t, c),
                        unloads ? a[c] : 1.0, unloads ? a_old[c] : 1.0);
        hx[c] = held.x;
        hy[c] = held.y;
        hz[c] = held.z;
        a_old[c] = a[c];
    }
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct arrow n = touch_normal(t, c), held = {hx[c], hy[c], hz[c]};
        const struct arrow v = arrow_in_plane(touch_velocity(t, c), n);
        const struct spring f =
            spring_cut(arrow_axpy(held, -k[SHEAR][c] * a[c] * dt, v),
                       arrow_scale(-k[CT][c] * damping[c], v), k[MU][c] * t->fn[c]);
        hx[c] = f.held.x;
        hy[c] = f.held.y;
        hz[c] = f.held.z;
        t->fx[c] = t->fn[c] * n.x + f.total.x;
        t->fy[c] = t->fn[c] * n.y + f.total.y;
        t->fz[c] = t->fn[c] * n.z + f.total.z;
    }
}

void contact_damping(const struct touch *t, real *c)
{
    for (int k = 0; k < t->n; k++) {
        const real depth = t->depth[k] > 0.0 ? t->depth[k] : 0.0;
        c[k] = table[t->pair[k]][CN] * sqrt(sqrt(t->r_eff[k] * depth) * t->m_eff[k]);
    }
}

void contact_energy(struct touch *t, real (*history)[TOUCH])
{
    const real *const hx = history[0], *const hy = history[1], *const hz = history[2];
    for (int c = 0; c < t->n; c++) {
        const double depth = (double)(t->depth[c] > 0.0 ? t->depth[c] : 0.0);
        const double kt = (double)(table[t->pair[c]][SHEAR] * sqrt(t->r_eff[c] * depth));
        const double stored = (double)(hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c]);
        t->energy[c] =
            0.4 * (double)t->kn[c] * depth * depth + (kt > 0.0 ? 0.5 * stored / kt : 0.0);
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
