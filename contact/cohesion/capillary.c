/* contact/cohesion/capillary.c - the pull of a liquid bridge.
 *
 * With R = 2 r_i r_j/(r_i + r_j) (twice r_i against a plane), gap H, bridge volume V:
 *   F_0 = 2 pi R gamma cos(theta) in contact, and across the gap
 *   contact     nothing                                         [the review, eq. 15, mended]
 *   willett     F_0/(1 + 1.05 s + 2.5 s^2), s = H sqrt(R/V)     [Willett00] (who print 2.1 and 10: their
 *               s is of half the gap)
 *   rabinovich  F_0 (1 - H/sqrt(H^2 + 2 V/(pi R)))              [Rabinovich05], which is F_0/(1 + H/(2 d)),
 *               d = (H/2) (-1 + sqrt(1 + 2 V/(pi R H^2)))
 *   rabinovich_ring   with their second term, the pull along the wetted ring,
 *               + 2 pi R gamma sin(a) sin(theta + a),  a^2 = (-H + sqrt(H^2 + 2 V/(pi R)))/R
 * The bridge forms at first touch and holds up to H = (1 + theta/2) V^(1/3) [Lian93]; its one row of
 * history says whether there is one. Every bridge has the volume of its pair of materials: liquid
 * is neither drawn from the grains nor shared out again.
 *
 * The review calls eq. (15) JKR and has sqrt(r_i r_j) for R: right for like spheres only, and JKR
 * (jkr.c) knows neither surface tension of a liquid nor contact angle. */
#include "cohesion.h"

#include "../pairs.h"
#include "../spring.h"

#define PI 3.14159265358979323846

const struct about cohesion_about = {
    .name = "capillary",
    .summary = "liquid bridge: forms at touch, ruptures at its distance",
    .equation = "F = 2 pi R gamma cos(theta) f(H), R = 2 r_i r_j/(r_i + r_j)",
    .source = "[Willett00], [Rabinovich05], [Lian93]",
    .range = "slow grains (no viscous pull), V below 0.01 R^3",
    .cost = "memory of the bridge, a root and a division"};

const struct key cohesion_keys[] = {
    {"material", "surface_tension", KEY_REAL, "N m-1", "[0, inf)", NULL,
     "gamma, of the liquid on this material"},
    {"material", "contact_angle", KEY_REAL, "rad", "[0, 1.5707]", "0 rad",
     "theta, of the liquid on this material; deg is taken too"},
    {"material", "bridge_volume", KEY_REAL, "m3", "[0, inf)", NULL, "V, of each bridge"},
    {"pair", "surface_tension", KEY_REAL, "N m-1", "mixed | [0, inf)", "mixed",
     "gamma of a contact; 0: dry"},
    {"pair", "contact_angle", KEY_REAL, "rad", "mixed | [0, 1.5707]", "mixed",
     "theta of a contact; mixed: the mean"},
    {"pair", "bridge_volume", KEY_REAL, "m3", "mixed | [0, inf)", "mixed",
     "V of a contact; mixed: the geometric mean"},
    {"cohesion", "form", KEY_CHOICE, "", "willett | rabinovich | contact | rabinovich_ring",
     "willett", "how the pull falls with the gap"},
    {0},
};

const int cohesion_history = 1; /* 1: there is a bridge */
const unsigned cohesion_needs = 0;

enum form { WILLETT, RABINOVICH, CONTACT, RING };
static enum form form;
static double range;

/* Of a pair of materials, as the loop needs them. */
enum {
    PULL,    /* N/m, 4 pi gamma cos(theta): F_0 over the reduced radius */
    INV_V,   /* 1/m3, 2/V: R/V over the reduced radius; 0 without liquid */
    SPREAD,  /* m3, V/pi: 2 V/(pi R) times the reduced radius */
    RUPTURE, /* m */
    TANGENT, /* tan(theta) */
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void cohesion_init(struct scene *s, const struct materials *m)
{
    double gamma[PAIRS_MAX], theta[PAIRS_MAX], volume[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    form = (enum form)scene_choice(s, "cohesion", NULL, "form");
    materials_pair_values(s, m, "surface_tension", MIX_GEOMETRIC, gamma);
    materials_pair_values(s, m, "contact_angle", MIX_MEAN, theta);
    materials_pair_values(s, m, "bridge_volume", MIX_GEOMETRIC, volume);
    range = 0.0;
    for (int p = 0; p < m->n * m->n; p++) {
        const double v = volume[p];
        const double rupture = form == CONTACT ? 0.0 : (1.0 + 0.5 * theta[p]) * cbrt(v);
        const bool wet = v > 0.0 && gamma[p] > 0.0;
        table[p][PULL] = (real)(wet ? 4.0 * PI * gamma[p] * cos(theta[p]) : 0.0);
        table[p][INV_V] = (real)(wet ? 2.0 / v : 0.0);
        table[p][SPREAD] = (real)(wet ? v / PI : 1.0);
        table[p][RUPTURE] = (real)(wet ? rupture : 0.0);
        table[p][TANGENT] = (real)tan(theta[p]);
        range = fmax(range, wet ? rupture : 0.0);
    }
}

/* sin(a) sin(theta + a)/cos(theta) from a^2, by series for angles up to a right one. */
SPRING_INLINE real ring(real a2, real tangent)
{
    const real sine =
        sqrt(a2) *
        (1.0 -
         a2 / 6.0 *
             (1.0 -
              a2 / 20.0 *
                  (1.0 - a2 / 42.0 *
                             (1.0 - a2 / 72.0 *
                                        (1.0 - a2 / 110.0 *
                                                   (1.0 - a2 / 156.0 * (1.0 - a2 / 210.0)))))));
    const real cosine = sqrt(1.0 - sine * sine);
    return sine * (tangent * cosine + sine);
}

/* What is left of F_0 across a gap. */
SPRING_INLINE real left(enum form f, real gap, real inv_v, real spread, real tangent,
                        real r_eff)
{
    const real across = sqrt(gap * gap + spread / r_eff);
    if (f == RABINOVICH)
        return 1.0 - gap / across;
    if (f == RING) {
        const real a2 = 0.5 * (across - gap) / r_eff, most = 2.4674; /* of a right angle */
        return 1.0 - gap / across + ring(a2 < most ? a2 : most, tangent);
    }
    if (f == WILLETT) {
        const real s = gap * sqrt(r_eff * inv_v);
        return 1.0 / (1.0 + 1.05 * s + 2.5 * s * s);
    }
    return 1.0;
}

SPRING_INLINE void forces(struct touch *t, real *restrict bridge, enum form f, real (*k)[TOUCH])
{
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real gap = t->depth[c] < 0.0 ? -t->depth[c] : 0.0;
        const bool touches = t->depth[c] >= 0.0, holds = gap <= k[RUPTURE][c];
        const bool on = touches || (bridge[c] > 0.0 && holds);
        const real part = left(f, gap, k[INV_V][c], k[SPREAD][c], k[TANGENT][c], t->r_eff[c]);
        const real pull = on ? -k[PULL][c] * t->r_eff[c] * part : 0.0;
        bridge[c] = on ? 1.0 : 0.0;
        t->fx[c] += pull * t->nx[c];
        t->fy[c] += pull * t->ny[c];
        t->fz[c] += pull * t->nz[c];
    }
}

void cohesion_forces(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
    if (form == WILLETT)
        forces(t, history[0], WILLETT, k);
    else if (form == RABINOVICH)
        forces(t, history[0], RABINOVICH, k);
    else if (form == RING)
        forces(t, history[0], RING, k);
    else
        forces(t, history[0], CONTACT, k);
}

/* Integral of the pull over F_0 from contact to a gap. */
static double work(double gap, double r_eff, const real *k)
{
    if (form == RABINOVICH) {
        const double spread = (double)k[SPREAD] / r_eff;
        return gap - sqrt(gap * gap + spread) + sqrt(spread);
    }
    if (form == RING) { /* Simpson's rule: no closed form */
        enum { PANELS = 32 };
        double sum = 0.0;
        for (int i = 0; i <= 2 * PANELS; i++) {
            const double at = gap * i / (2.0 * PANELS);
            sum += (i == 0 || i == 2 * PANELS ? 1.0
                    : i % 2                   ? 4.0
                                              : 2.0) *
                   (double)left(RING, (real)at, 0.0, k[SPREAD], k[TANGENT], (real)r_eff);
        }
        return sum * gap / (6.0 * PANELS);
    }
    const double rate = sqrt(r_eff * (double)k[INV_V]), root = sqrt(8.8975) * rate;
    if (form == WILLETT && rate > 0.0)
        return 2.0 / root *
               (atan((5.0 * rate * rate * gap + 1.05 * rate) / root) -
                atan(1.05 * rate / root));
    return 0.0;
}

/* Zero when ruptured: what the pull has yet to take from the grains. */
void cohesion_energy(struct touch *t, real (*history)[TOUCH])
{
    for (int c = 0; c < t->n; c++) {
        const real *const k = table[t->pair[c]];
        const double r_eff = (double)t->r_eff[c], depth = (double)t->depth[c];
        const double gap = fmax(-depth, 0.0), pull = (double)k[PULL] * r_eff;
        if (history[0][c] > 0.0)
            t->energy[c] -=
                pull * (work((double)k[RUPTURE], r_eff, k) - work(gap, r_eff, k) +
                        fmax(depth, 0.0) * (double)left(form, 0.0, k[INV_V], k[SPREAD],
                                                        k[TANGENT], (real)r_eff));
    }
}

double cohesion_range(void)
{
    return range;
}
