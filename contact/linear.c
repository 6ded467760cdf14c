/* contact/linear.c - linear spring and dashpot, normal and tangential, with Coulomb's limit.
 *
 *   F_n = k_n depth - 2 zeta sqrt(k_n m_eff) v_n, cut at zero                [CundallStrack79]
 *   F_t = -k_t s - 2 zeta sqrt(k_t m_eff) v_t,   |F_t| <= mu F_n,  ds = v_t dt
 * with k_n = k_i k_j/(k_i + k_j), springs in series. The review's eqs (4), (5) print the
 * inverse, (k_i + k_j)/(k_i k_j), whose unit is m/N. zeta gives the restitution asked for
 * although the contact does not pull (restitution.c). The spring s turns with the contact plane
 * and is cut where the contact slides. */
#include "contact.h"

#include "../solver/restitution.h"

const struct about contact_about = {
    .name = "linear",
    .summary = "linear spring and dashpot, Coulomb friction with a tangential spring",
    .equation = "F_n = k_n d - c_n v_n; F_t = -k_t s - c_t v_t, |F_t| <= mu F_n",
    .source = "[CundallStrack79]; restitution [SchwagerPoeschel07, eq. 13]",
    .range = "any speed; k chosen for overlaps below a few % of the radius"};

const struct key contact_keys[] = {
    {"material", "stiffness", KEY_REAL, "N m-1", "(0, inf)", NULL,
     "normal stiffness of a body; a pair has the two in series"},
    {"material", "stiffness_ratio", KEY_REAL, "1", "[0, 1]", "0.2857142857142857",
     "tangential over normal stiffness"},
    {"material", "restitution", KEY_REAL, "1", "(0, 1]", NULL,
     "rebound speed over impact speed"},
    {"material", "friction", KEY_REAL, "1", "[0, inf)", NULL, "Coulomb's coefficient"},
    {"pair", "stiffness", KEY_REAL, "N m-1", "mixed | (0, inf)", "mixed",
     "normal stiffness of a contact; mixed: the two bodies in series"},
    {"pair", "stiffness_ratio", KEY_REAL, "1", "mixed | [0, 1]", "mixed",
     "tangential over normal stiffness of a contact"},
    {"pair", "restitution", KEY_REAL, "1", "mixed | (0, 1]", "mixed",
     "restitution of a contact"},
    {"pair", "friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed", "friction of a contact"},
    {0},
};

const int contact_history = 3; /* s, m */

enum { PAIRS = 256 }; /* 16 materials */
static int materials;
static double k_n[PAIRS], k_t[PAIRS], zeta[PAIRS], mu[PAIRS];

void contact_init(struct scene *s, const struct materials *m)
{
    double restitution[PAIRS], ratio[PAIRS];
    materials = m->n;
    if (m->n * m->n > PAIRS) {
        scene_error(s, "material", NULL, NULL, "at most 16 materials");
        return;
    }
    materials_pair_values(s, m, "stiffness", MIX_SERIES, k_n);
    materials_pair_values(s, m, "stiffness_ratio", MIX_GEOMETRIC, ratio);
    materials_pair_values(s, m, "restitution", MIX_GEOMETRIC, restitution);
    materials_pair_values(s, m, "friction", MIX_GEOMETRIC, mu);
    for (int p = 0; p < m->n * m->n && scene_errors(s) == 0; p++) {
        k_t[p] = ratio[p] * k_n[p];
        zeta[p] = damping_ratio(restitution[p]);
    }
}

void contact_forces(struct touch *t, double (*history)[TOUCH])
{
    double *const sx = history[0], *const sy = history[1], *const sz = history[2];
    const double dt = t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const int p = t->pair[c];
        const double nx = t->nx[c], ny = t->ny[c], nz = t->nz[c];
        const double depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        const double damping = 2.0 * zeta[p] * sqrt(t->m_eff[c]) * t->start[c];
        const double normal = k_n[p] * depth - damping * sqrt(k_n[p]) * t->vn[c];
        const double push = normal > 0.0 ? normal : 0.0;
        const double fn = depth > 0.0 ? push : 0.0;
        /* the spring of the last step, turned into the plane of this one, and its stretch */
        const double v = t->vx[c] * nx + t->vy[c] * ny + t->vz[c] * nz;
        const double vx = t->vx[c] - v * nx, vy = t->vy[c] - v * ny, vz = t->vz[c] - v * nz;
        const double along = sx[c] * nx + sy[c] * ny + sz[c] * nz;
        const double before = sx[c] * sx[c] + sy[c] * sy[c] + sz[c] * sz[c];
        const double px = sx[c] - along * nx, py = sy[c] - along * ny, pz = sz[c] - along * nz;
        const double after = px * px + py * py + pz * pz;
        const double turn = after > 0.0 ? sqrt(before / after) : 0.0;
        const double ex = turn * px + vx * dt, ey = turn * py + vy * dt,
                     ez = turn * pz + vz * dt;
        const double kt = k_t[p], ct = damping * sqrt(kt);
        const double qx = -kt * ex - ct * vx, qy = -kt * ey - ct * vy, qz = -kt * ez - ct * vz;
        const double q = sqrt(qx * qx + qy * qy + qz * qz), limit = mu[p] * fn;
        const double cut = q > limit ? limit / q : 1.0;
        const double fx = cut * qx, fy = cut * qy, fz = cut * qz;
        /* where it slides, the spring is what gives the force at the limit */
        const double slack = kt > 0.0 ? 1.0 / kt : 0.0;
        sx[c] = q > limit ? -(fx + ct * vx) * slack : ex;
        sy[c] = q > limit ? -(fy + ct * vy) * slack : ey;
        sz[c] = q > limit ? -(fz + ct * vz) * slack : ez;
        t->fx[c] = fn * nx + fx;
        t->fy[c] = fn * ny + fy;
        t->fz[c] = fn * nz + fz;
        t->mx[c] = t->my[c] = t->mz[c] = 0.0;
        t->fn[c] = fn;
        t->energy[c] = 0.5 * k_n[p] * depth * depth +
                       0.5 * kt * (sx[c] * sx[c] + sy[c] * sy[c] + sz[c] * sz[c]);
    }
}

double contact_duration(int a, int b, double m_eff, double r_eff, double v)
{
    (void)r_eff;
    (void)v;
    return 3.14159265358979323846 * sqrt(m_eff / k_n[a * materials + b]);
}

double contact_rayleigh(int a, double radius, double density)
{
    (void)a;
    (void)radius;
    (void)density;
    return (double)INFINITY;
}
