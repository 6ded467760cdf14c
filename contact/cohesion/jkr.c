/* contact/cohesion/jkr.c - adhesion of elastic spheres (Johnson, Kendall, Roberts).
 *
 *   F = 4 E/(3 R) a^3 - sqrt(8 pi w E) a^(3/2),  depth = a^2/R - sqrt(2 pi a w/E)
 *                                                                                       [JKR71]
 * with E = E*, R = R*, contact radius a and work of adhesion w (2 gamma for like surfaces). The
 * branch is the one on which a grows with depth: the grains snap into contact at depth 0, pull
 * with at most 3/2 pi w R, are joined by a neck when drawn apart, and come off at depth -(3/4)
 * (pi^2 w^2 R/E^2)^(1/3), at the fold. The one row of history says whether they are joined.
 *
 * This law adds what JKR has beyond Hertz at the same depth, so with hertz, hertz_mindlin or
 * hertz_mindlin_liu (which read the same moduli) the sum is JKR. Friction keeps Coulomb's limit of
 * the Hertz force; dashpots do not act in the neck.
 *
 * In numbers of the pair, a = y^2 L, L = (w R^2/E)^(1/3), y = y_0 (1 + z) with the fold at y_0 =
 * (2 pi)^(1/6)/4^(1/3), the depth reads z^2 (z^2 + 4 z + 6) = (depth - depth_off)/(y_0^4 L^2/R),
 * solved for z by Newton: the fold is no trouble then. */
#include "cohesion.h"

#include <string.h>
#include "../../solver/elastic.h"
#include "../pairs.h"
#include "../spring.h"

#define PI       3.14159265358979323846
#define FOLD     0.8557429192115829 /* y_0 = (2 pi)^(1/6)/4^(1/3) */
#define FOLD_4   0.5362573492777564 /* y_0^4 */
#define REACH    1.6087720478332690 /* 3 y_0^4: depth_off, negative, over L^2/R* */
#define SQRT_8PI 5.0132565492620005

const struct about cohesion_about = {
    .name = "jkr",
    .summary = "adhesive elastic spheres: pull-off force 3/2 pi w R*, necking",
    .equation = "F = 4 E* a^3/(3 R*) - sqrt(8 pi w E*) a^1.5, d = a^2/R* - sqrt(2 pi a w/E*)",
    .source = "[JKR71]",
    .range = "with a Hertz law; soft, large, sticky: Tabor's number above 5",
    .cost = "the contact radius is a root of a quartic: cube root and square roots"};

const struct key cohesion_keys[] = {
    ELASTIC_KEYS,
    {"material", "work_of_adhesion", KEY_REAL, "J m-2", "[0, inf)", NULL,
     "w, of this material with itself: twice its surface energy"},
    {"pair", "work_of_adhesion", KEY_REAL, "J m-2", "mixed | [0, inf)", "mixed",
     "w of a pair; mixed: the geometric mean"},
    {"cohesion", "largest_radius", KEY_REAL, "m", "(0, inf)", "10 mm",
     "largest reduced radius of a contact, for the reach of necks"},
    {0},
};

const int cohesion_history = 1; /* 1: joined */
const unsigned cohesion_needs = 0;

static double range;

/* Of a pair of materials, as the loop needs them. */
enum {
    HERTZ,  /* Pa, 4/3 E* */
    LENGTH, /* m^(1/3), (w/E*)^(1/3): L over R*^(2/3) */
    WORK,   /* J/m2, w */
    PARAMETERS
};
static real table[PAIRS_MAX][PARAMETERS];

void cohesion_init(struct scene *s, const struct materials *m)
{
    static struct elastic elastic;
    double w[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    elastic_read(s, m, &elastic);
    materials_pair_values(s, m, "work_of_adhesion", MIX_GEOMETRIC, w);
    const double widest = scene_real(s, "cohesion", NULL, "largest_radius");
    range = 0.0;
    for (int p = 0; p < m->n * m->n && scene_errors(s) == 0; p++) {
        const double length = cbrt(w[p] / elastic.e_star[p]);
        table[p][HERTZ] = (real)(4.0 / 3.0 * elastic.e_star[p]);
        table[p][LENGTH] = (real)length;
        table[p][WORK] = (real)w[p];
        range = fmax(range, REACH * length * length * cbrt(widest));
    }
}

/* Cube root of a normal positive number, by arithmetic alone: a third of the exponent, then
 * Halley's iteration, which triples the digits. */
SPRING_INLINE real cube_root(real x)
{
    const float coarse = (float)x;
    uint32_t bits;
    float guess;
    memcpy(&bits, &coarse, sizeof bits);
    bits = bits / 3u + 709921077u;
    memcpy(&guess, &bits, sizeof guess);
    real y = guess;
    for (int i = 0; i < 3; i++) {
        const real cube = y * y * y;
        y = y * (cube + 2.0 * x) / (2.0 * cube + x);
    }
    return y;
}

/* z of z^2 (z^2 + 4 z + 6) = square; the start is within a quarter, Newton doubles the digits. */
SPRING_INLINE real neck(real square)
{
    const real k = sqrt(square);
    real z = sqrt(1.0 + k) - 1.0 + 1e-30;
    for (int i = 0; i < 5; i++) {
        const real root = z * z + 4.0 * z + 6.0;
        z -= (z * z * root - square) / (z * (4.0 * z * z + 12.0 * z + 12.0));
    }
    return z;
}

void cohesion_forces(struct touch *t, real (*history)[TOUCH])
{
    _Alignas(64) real k[PARAMETERS][TOUCH], *const restrict joined = history[0];
    pairs_spread(t, &table[0][0], PARAMETERS, k);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real r = t->r_eff[c], third = cube_root(r), depth = t->depth[c];
        const real unit = k[LENGTH][c] * k[LENGTH][c] * third; /* m, L^2/R* */
        const bool sticks = unit > 0.0;
        const real excess = sticks ? depth / (sticks ? unit : 1.0) + REACH : 0.0;
        const bool on = sticks && (depth >= 0.0 || (joined[c] > 0.0 && excess > 0.0));
        const real z = neck((excess > 0.0 ? excess : 0.0) / FOLD_4), y = FOLD * (1.0 + z);
        const real cube = y * y * y;
        const real adhesive = k[WORK][c] * r * cube * (4.0 / 3.0 * cube - SQRT_8PI);
        const real press = depth > 0.0 ? depth : 0.0;
        const real f = on ? adhesive - k[HERTZ][c] * sqrt(r * press) * press : 0.0;
        joined[c] = on ? 1.0 : 0.0;
        t->fx[c] += f * t->nx[c];
        t->fy[c] += f * t->ny[c];
        t->fz[c] += f * t->nz[c];
    }
}

/* Elastic energy less work of adhesion on the contact's circle, less Hertz's: the integral of the
 * force along the branch, (8 E/15 R^2) a^5 - (4/3)(E m/R) a^(7/2) + pi w a^2 with m = sqrt(2
 * pi w/E). Zero when off. */
void cohesion_energy(struct touch *t, real (*history)[TOUCH])
{
    for (int c = 0; c < t->n; c++) {
        const real *const k = table[t->pair[c]];
        if (!(history[0][c] > 0.0))
            continue;
        const double w = (double)k[WORK], e = 0.75 * (double)k[HERTZ], r = (double)t->r_eff[c];
        const double length = (double)k[LENGTH] * cbrt(r * r), unit = length * length / r;
        const double depth = (double)t->depth[c], press = fmax(depth, 0.0);
        const double y =
            FOLD * (1.0 + (double)neck((real)(fmax(depth / unit + REACH, 0.0) / FOLD_4)));
        const double a = y * y * length, m = sqrt(2.0 * PI * w / e);
        t->energy[c] += 8.0 * e / (15.0 * r * r) * pow(a, 5.0) -
                        4.0 / 3.0 * e * m / r * pow(a, 3.5) + PI * w * a * a -
                        0.4 * (double)k[HERTZ] * sqrt(r) * pow(press, 2.5);
    }
}

double cohesion_range(void)
{
    return range;
}
