/* contact/cohesion/van_der_waals.c - Hamaker's attraction of two spheres near each other.
 *
 *   F = A R* / (6 s^2),  s = max(gap, separation_min),  for gaps up to the range    [Hamaker37]
 * the limit of Hamaker's sum for gaps small against the radii; in contact the pull is that at
 * separation_min, the least distance of the surfaces (0.165 nm for smooth ones, the height of
 * asperities for rough ones). At the range the force stops short. */
#include "cohesion.h"

#include "../pairs.h"
#include "../spring.h"

const struct about cohesion_about = {
    .name = "van_der_waals",
    .summary = "Hamaker's attraction with a least separation and a cut-off",
    .equation = "F = A R*/(6 s^2)",
    .source = "[Hamaker37]",
    .range = "gaps small against the radii, no retardation"};

const struct key cohesion_keys[] = {
    {"material", "hamaker", KEY_REAL, "J", "[0, inf)", NULL,
     "A, Hamaker's constant, of this material with itself"},
    {"pair", "hamaker", KEY_REAL, "J", "mixed | [0, inf)", "mixed",
     "A of a pair; mixed: the geometric mean"},
    {"cohesion", "separation_min", KEY_REAL, "m", "(0, inf)", NULL,
     "least separation: the pull grows no further"},
    {"cohesion", "range", KEY_REAL, "m", "(0, inf)", NULL, "gap beyond which there is no pull"},
    {0},
};

const int cohesion_history = 0;
const unsigned cohesion_needs = 0;

static double range, least;
static real table[PAIRS_MAX]; /* A/6 */

void cohesion_init(struct scene *s, const struct materials *m)
{
    double hamaker[PAIRS_MAX];
    if (!materials_fit(s, m))
        return;
    materials_pair_values(s, m, "hamaker", MIX_GEOMETRIC, hamaker);
    least = scene_real(s, "cohesion", NULL, "separation_min");
    range = scene_real(s, "cohesion", NULL, "range");
    if (range <= least)
        scene_error(s, "cohesion", NULL, "range", "must be more than separation_min = %g m",
                    least);
    for (int p = 0; p < m->n * m->n; p++)
        table[p] = (real)(hamaker[p] / 6.0);
}

void cohesion_forces(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    _Alignas(64) real k[1][TOUCH];
    const real near = (real)least, far = (real)range;
    pairs_spread(t, table, 1, k);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real gap = -t->depth[c], s = gap > near ? gap : near;
        const real pull = gap <= far ? -k[0][c] * t->r_eff[c] / (s * s) : 0.0;
        t->fx[c] += pull * t->nx[c];
        t->fy[c] += pull * t->ny[c];
        t->fz[c] += pull * t->nz[c];
    }
}

/* Zero at the range. */
void cohesion_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    for (int c = 0; c < t->n; c++) {
        const double gap = -(double)t->depth[c], s = fmax(gap, least);
        const double k = (double)table[t->pair[c]] * (double)t->r_eff[c];
        if (gap <= range)
            t->energy[c] -= k * (1.0 / s - 1.0 / range + (s - gap) / (s * s));
    }
}

double cohesion_range(void)
{
    return range;
}
