/* contact/hertz.c - Hertz's normal force and nothing else: smooth elastic spheres.
 *
 *   F_n = (4/3) E* sqrt(R*) depth^(3/2) - 2 sqrt(5/6) zeta sqrt(S_n m*) v_n, cut at zero
 *   S_n = 2 E* sqrt(R* depth)                                    [Hertz1882], [Tsuji92]
 * zeta is zero unless restitution or damping_ratio is given; it gives the restitution asked for
 * although the contact does not pull (restitution.c). */
#include "contact.h"

#include <string.h>
#include "../solver/elastic.h"
#include "pairs.h"
#include "spring.h"

const struct about contact_about = {
    .name = "hertz",
    .summary = "Hertz's normal force, elastic unless restitution is given; no friction",
    .equation = "F_n = 4/3 E* sqrt(R*) d^1.5 - c_n v_n",
    .source = "[Hertz1882], [Tsuji92]",
    .range = "smooth elastic spheres, overlaps below a few % of the radius"};

const struct key contact_keys[] = {ELASTIC_KEYS, DAMPING_KEYS, {0}};

const int contact_history = 0;

static struct elastic elastic;

/* Of a pair of materials, as the loop needs them. */
enum {
    HERTZ, /* Pa, 4/3 E* */
    CN,    /* Pa^1/2, dashpot per sqrt(a m*): 2 sqrt(5/6) zeta sqrt(2 E*) */
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void contact_init(struct scene *s, const struct materials *m)
{
    const double tsuji = 2.0 * sqrt(5.0 / 6.0);
    double zeta[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    elastic_read(s, m, &elastic);
    elastic_damping(s, m, 0.0, false, zeta);
    memcpy(elastic.zeta, zeta, sizeof zeta);
    for (int p = 0; p < m->n * m->n && scene_errors(s) == 0; p++) {
        table[p][HERTZ] = (real)(4.0 / 3.0 * elastic.e_star[p]);
        table[p][CN] = (real)(tsuji * zeta[p] * sqrt(2.0 * elastic.e_star[p]));
    }
}

void contact_forces(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    _Alignas(64) real k[PARAMETERS][TOUCH];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        const real a = sqrt(t->r_eff[c] * depth), damping = t->start[c] * sqrt(a * t->m_eff[c]);
        const real kn = k[HERTZ][c] * a;
        const real normal = kn * depth - k[CN][c] * damping * t->vn[c];
        const real fn = normal > 0.0 ? normal : 0.0;
        t->fx[c] = fn * t->nx[c];
        t->fy[c] = fn * t->ny[c];
        t->fz[c] = fn * t->nz[c];
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

void contact_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    for (int c = 0; c < t->n; c++) {
        const double depth = (double)(t->depth[c] > 0.0 ? t->depth[c] : 0.0);
        t->energy[c] = 0.4 * (double)t->kn[c] * depth * depth;
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
