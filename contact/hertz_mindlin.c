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
 * contact does not pull (restitution.c). */
#include "contact.h"

#include "../solver/restitution.h"

const struct about contact_about = {
    .name = "hertz_mindlin",
    .summary = "Hertz with Tsuji's damping, Mindlin no-slip tangential force, Coulomb's limit",
    .equation = "F_n = 4/3 E* sqrt(R*) d^1.5 - c_n v_n; dF_t = -8 G* sqrt(R* d) v_t dt",
    .source = "[Hertz1882], [Mindlin49], [Tsuji92], [Thornton13]",
    .range = "elastic spheres, overlaps below a few % of the radius"};

const struct key contact_keys[] = {
    {"material", "young", KEY_REAL, "Pa", "(0, inf)", NULL, "Young's modulus"},
    {"material", "poisson", KEY_REAL, "1", "(-1, 0.5]", NULL, "Poisson's ratio"},
    {"material", "restitution", KEY_REAL, "1", "(0, 1]", NULL,
     "rebound speed over impact speed"},
    {"material", "friction", KEY_REAL, "1", "[0, inf)", NULL, "Coulomb's coefficient"},
    {"pair", "restitution", KEY_REAL, "1", "mixed | (0, 1]", "mixed",
     "restitution of a contact"},
    {"pair", "friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed", "friction of a contact"},
    {0},
};

const int contact_history = 4; /* tangential force of the spring, N; depth, m */

enum { PAIRS = 256, MATERIALS = 16 };
static int materials;
static double e_star[PAIRS], g_star[PAIRS];
static double young[MATERIALS], poisson[MATERIALS];

/* Of a pair of materials, as the loop needs them. */
struct constants {
    real hertz; /* Pa, 4/3 E* */
    real shear; /* Pa, 8 G* */
    real cn;    /* Pa^1/2, dashpots per sqrt(a m*): 2 sqrt(5/6) zeta sqrt(2 E*) */
    real ct;    /* Pa^1/2, 2 sqrt(5/6) zeta sqrt(8 G*) */
    real mu;
};
static struct constants constants[PAIRS];

void contact_init(struct scene *s, const struct materials *m)
{
    const double tsuji = 2.0 * sqrt(5.0 / 6.0);
    double restitution[PAIRS], friction[PAIRS];
    materials = m->n;
    if (m->n > MATERIALS) {
        scene_error(s, "material", NULL, NULL, "at most %d materials", MATERIALS);
        return;
    }
    for (int a = 0; a < m->n; a++) {
        young[a] = scene_real(s, "material", m->name[a], "young");
        poisson[a] = scene_real(s, "material", m->name[a], "poisson");
    }
    materials_pair_values(s, m, "restitution", MIX_GEOMETRIC, restitution);
    materials_pair_values(s, m, "friction", MIX_GEOMETRIC, friction);
    for (int p = 0; p < m->n * m->n && scene_errors(s) == 0; p++) {
        const int a = p / m->n, b = p % m->n;
        const double na = poisson[a], nb = poisson[b];
        e_star[p] = 1.0 / ((1.0 - na * na) / young[a] + (1.0 - nb * nb) / young[b]);
        g_star[p] = 1.0 / (2.0 * (2.0 - na) * (1.0 + na) / young[a] +
                           2.0 * (2.0 - nb) * (1.0 + nb) / young[b]);
        const double damping = tsuji * damping_ratio(restitution[p]);
        constants[p] = (struct constants){.hertz = (real)(4.0 / 3.0 * e_star[p]),
                                          .shear = (real)(8.0 * g_star[p]),
                                          .cn = (real)(damping * sqrt(2.0 * e_star[p])),
                                          .ct = (real)(damping * sqrt(8.0 * g_star[p])),
                                          .mu = (real)friction[p]};
    }
}

/* One material all over needs no look-up per contact. */
static inline __attribute__((always_inline)) void
forces(struct touch *t, real (*history)[TOUCH], bool one, struct constants only)
{
    real *const restrict hx = history[0], *const restrict hy = history[1];
    real *const restrict hz = history[2], *const restrict depth_old = history[3];
    const real dt = (real)t->dt;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const struct constants k = one ? only : constants[t->pair[c]];
        const real nx = t->nx[c], ny = t->ny[c], nz = t->nz[c];
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        const real a = sqrt(t->r_eff[c] * depth), damping = t->start[c] * sqrt(a * t->m_eff[c]);
        const real kn = k.hertz * a, kt = k.shear * a;
        const real normal = kn * depth - k.cn * damping * t->vn[c];
        const real fn = normal > 0.0 ? normal : 0.0;
        /* the force of the spring: scaled down in unloading, turned, stretched */
        const real v = t->vx[c] * nx + t->vy[c] * ny + t->vz[c] * nz;
        const real vx = t->vx[c] - v * nx, vy = t->vy[c] - v * ny, vz = t->vz[c] - v * nz;
        const real along = hx[c] * nx + hy[c] * ny + hz[c] * nz;
        const real before = hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c];
        const real px = hx[c] - along * nx, py = hy[c] - along * ny, pz = hz[c] - along * nz;
        const real after = px * px + py * py + pz * pz;
        const bool unloads = depth < depth_old[c];
        const real up = unloads ? depth * before : before;
        const real down = unloads ? depth_old[c] * after : after;
        const real keep = down > 0.0 ? sqrt(up / down) : 0.0;
        const real ex = keep * px - kt * vx * dt, ey = keep * py - kt * vy * dt,
                   ez = keep * pz - kt * vz * dt;
        const real ct = k.ct * damping;
        const real qx = ex - ct * vx, qy = ey - ct * vy, qz = ez - ct * vz;
        const real q = sqrt(qx * qx + qy * qy + qz * qz), limit = k.mu * fn;
        const bool slides = q > limit;
        const real cut = slides ? limit / q : 1.0;
        const real fx = cut * qx, fy = cut * qy, fz = cut * qz;
        /* where it slides, the spring is what gives the force at the limit */
        hx[c] = slides ? fx + ct * vx : ex;
        hy[c] = slides ? fy + ct * vy : ey;
        hz[c] = slides ? fz + ct * vz : ez;
        depth_old[c] = depth;
        t->fx[c] = fn * nx + fx;
        t->fy[c] = fn * ny + fy;
        t->fz[c] = fn * nz + fz;
        t->fn[c] = fn;
        t->kn[c] = kn;
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
    const real *const hx = history[0], *const hy = history[1], *const hz = history[2];
    for (int c = 0; c < t->n; c++) {
        const double depth = (double)(t->depth[c] > 0.0 ? t->depth[c] : 0.0);
        const double kt = (double)(constants[t->pair[c]].shear * sqrt(t->r_eff[c] * depth));
        const double stored = (double)(hx[c] * hx[c] + hy[c] * hy[c] + hz[c] * hz[c]);
        t->energy[c] =
            0.4 * (double)t->kn[c] * depth * depth + (kt > 0.0 ? 0.5 * stored / kt : 0.0);
    }
}

/* [Hertz1882]: t_c = 2.87 (m*^2/(R* E*^2 v))^(1/5) */
double contact_duration(int a, int b, double m_eff, double r_eff, double v)
{
    const double e = e_star[a * materials + b];
    return 2.87 * pow(m_eff * m_eff / (r_eff * e * e * v), 0.2);
}

/* [LiXuThornton05]: pi r sqrt(rho/G)/(0.1631 nu + 0.8766) */
double contact_rayleigh(int a, double radius, double density)
{
    const double shear = young[a] / (2.0 * (1.0 + poisson[a]));
    return 3.14159265358979323846 * radius * sqrt(density / shear) /
           (0.1631 * poisson[a] + 0.8766);
}
