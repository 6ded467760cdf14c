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
static double k_n[PAIRS];

/* Of a pair of materials, as the loop needs them. */
struct constants {
    real kn, kt; /* N/m */
    real slack;  /* m/N, 1/kt; 0 without a tangential spring */
    real cn, ct; /* dashpots per sqrt(m*): 2 zeta sqrt(k) */
    real mu;
};
static struct constants constants[PAIRS];

void contact_init(struct scene *s, const struct materials *m)
{
    double restitution[PAIRS], ratio[PAIRS], friction[PAIRS];
    materials = m->n;
    if (m->n * m->n > PAIRS) {
        scene_error(s, "material", NULL, NULL, "at most 16 materials");
        return;
    }
    materials_pair_values(s, m, "stiffness", MIX_SERIES, k_n);
    materials_pair_values(s, m, "stiffness_ratio", MIX_GEOMETRIC, ratio);
    materials_pair_values(s, m, "restitution", MIX_GEOMETRIC, restitution);
    materials_pair_values(s, m, "friction", MIX_GEOMETRIC, friction);
    for (int p = 0; p < m->n * m->n && scene_errors(s) == 0; p++) {
        const double kt = ratio[p] * k_n[p], damping = 2.0 * damping_ratio(restitution[p]);
        constants[p] = (struct constants){.kn = (real)k_n[p],
                                          .kt = (real)kt,
                                          .slack = (real)(kt > 0.0 ? 1.0 / kt : 0.0),
                                          .cn = (real)(damping * sqrt(k_n[p])),
                                          .ct = (real)(damping * sqrt(kt)),
                                          .mu = (real)friction[p]};
    }
}

/* One material all over needs no look-up per contact. */
static inline __attribute__((always_inline)) void
forces(struct touch *t, real (*history)[TOUCH], bool one, struct constants only)
{
    real *const restrict sx = history[0], *const restrict sy = history[1];
    real *const restrict sz = history[2];
    const real dt = (real)t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct constants k = one ? only : constants[t->pair[c]];
        const real nx = t->nx[c], ny = t->ny[c], nz = t->nz[c];
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        const real damping = t->start[c] * sqrt(t->m_eff[c]);
        const real normal = k.kn * depth - k.cn * damping * t->vn[c];
        const real push = normal > 0.0 ? normal : 0.0;
        const real fn = depth > 0.0 ? push : 0.0;
        /* the spring of the last step, turned into the plane of this one, and its stretch */
        const real v = t->vx[c] * nx + t->vy[c] * ny + t->vz[c] * nz;
        const real vx = t->vx[c] - v * nx, vy = t->vy[c] - v * ny, vz = t->vz[c] - v * nz;
        const real along = sx[c] * nx + sy[c] * ny + sz[c] * nz;
        const real before = sx[c] * sx[c] + sy[c] * sy[c] + sz[c] * sz[c];
        const real px = sx[c] - along * nx, py = sy[c] - along * ny, pz = sz[c] - along * nz;
        const real after = px * px + py * py + pz * pz;
        const real turn = after > 0.0 ? sqrt(before / after) : 0.0;
        const real ex = turn * px + vx * dt, ey = turn * py + vy * dt, ez = turn * pz + vz * dt;
        const real ct = k.ct * damping;
        const real qx = -k.kt * ex - ct * vx, qy = -k.kt * ey - ct * vy,
                   qz = -k.kt * ez - ct * vz;
        const real q = sqrt(qx * qx + qy * qy + qz * qz), limit = k.mu * fn;
        const bool slides = q > limit;
        const real cut = slides ? limit / q : 1.0;
        const real fx = cut * qx, fy = cut * qy, fz = cut * qz;
        /* where it slides, the spring is what gives the force at the limit */
        sx[c] = slides ? -(fx + ct * vx) * k.slack : ex;
        sy[c] = slides ? -(fy + ct * vy) * k.slack : ey;
        sz[c] = slides ? -(fz + ct * vz) * k.slack : ez;
        t->fx[c] = fn * nx + fx;
        t->fy[c] = fn * ny + fy;
        t->fz[c] = fn * nz + fz;
        t->fn[c] = fn;
        t->kn[c] = k.kn;
    }
}

void contact_forces(struct touch *t, real (*history)[TOUCH])
{
    if (materials == 1)
        forces(t, history, true, constants[0]);
    else
        forces(t, history, false, constants[0]);
}

void contact_energy(struct touch *t, real (*history)[TOUCH])
{
    const real *const sx = history[0], *const sy = history[1], *const sz = history[2];
    for (int c = 0; c < t->n; c++) {
        const struct constants *const k = &constants[t->pair[c]];
        const double depth = (double)(t->depth[c] > 0.0 ? t->depth[c] : 0.0);
        const double stretch = (double)(sx[c] * sx[c] + sy[c] * sy[c] + sz[c] * sz[c]);
        t->energy[c] = 0.5 * ((double)k->kn * depth * depth + (double)k->kt * stretch);
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
