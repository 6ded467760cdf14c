/* elastic.c - moduli, damping and times of elastic bodies in contact. */
#include "elastic.h"

#include <math.h>
#include "restitution.h"

void elastic_read(struct scene *s, const struct materials *m, struct elastic *e)
{
    e->n = m->n;
    for (int a = 0; a < m->n; a++) {
        e->young[a] = scene_real(s, "material", m->name[a], "young");
        e->poisson[a] = scene_real(s, "material", m->name[a], "poisson");
    }
    materials_pair_optional(s, m, "e_star", "moduli", MIX_GEOMETRIC, e->e_star, NULL);
    materials_pair_optional(s, m, "g_star", "moduli", MIX_GEOMETRIC, e->g_star, NULL);
    for (int p = 0; p < m->n * m->n; p++) {
        const double ea = e->young[p / m->n], eb = e->young[p % m->n];
        const double na = e->poisson[p / m->n], nb = e->poisson[p % m->n];
        if (isnan(e->e_star[p]))
            e->e_star[p] = 1.0 / ((1.0 - na * na) / ea + (1.0 - nb * nb) / eb);
        if (isnan(e->g_star[p]))
            e->g_star[p] =
                1.0 / (2.0 * (2.0 - na) * (1.0 + na) / ea + 2.0 * (2.0 - nb) * (1.0 + nb) / eb);
    }
}

void elastic_damping(struct scene *s, const struct materials *m, double otherwise,
                     bool may_lack, double *zeta)
{
    double e[PAIRS_MAX];
    bool own_e[PAIRS_MAX], own_zeta[PAIRS_MAX];
    materials_pair_optional(s, m, "restitution", "none", MIX_GEOMETRIC, e, own_e);
    materials_pair_optional(s, m, "damping_ratio", "none", MIX_GEOMETRIC, zeta, own_zeta);
    for (int p = 0; p < m->n * m->n; p++) {
        const char *const a = m->name[p / m->n];
        const bool by_e = !isnan(e[p]) && !(own_zeta[p] && !own_e[p] && !isnan(zeta[p]));
        const bool by_zeta = !isnan(zeta[p]) && !(own_e[p] && !own_zeta[p] && !isnan(e[p]));
        if (by_e && by_zeta && p / m->n <= p % m->n)
            scene_error(s, "material", a, "damping_ratio",
                        "restitution is given too: give one of the two");
        else if (by_e)
            zeta[p] = e[p] > 0.0 ? damping_ratio(e[p]) : 0.0;
        else if (!by_zeta)
            zeta[p] = otherwise;
        if (isnan(zeta[p]) && !may_lack && p / m->n <= p % m->n)
            scene_error(s, "material", a, "restitution",
                        "must be given, or damping_ratio instead");
    }
}

double elastic_duration(const struct elastic *e, int a, int b, double m_eff, double r_eff,
                        double v)
{
    const double e_star = e->e_star[a * e->n + b];
    return duration_damped(2.87 * pow(m_eff * m_eff / (r_eff * e_star * e_star * v), 0.2),
                           e->zeta[a * e->n + b]);
}

double duration_damped(double t, double zeta)
{
    return t * fmin(1.0, 4.0 * 0.75 * damping_step(zeta) / 3.14159265358979323846);
}

double elastic_rayleigh(const struct elastic *e, int a, double radius, double density)
{
    const double shear = e->young[a] / (2.0 * (1.0 + e->poisson[a]));
    return 3.14159265358979323846 * radius * sqrt(density / shear) /
           (0.1631 * e->poisson[a] + 0.8766);
}
