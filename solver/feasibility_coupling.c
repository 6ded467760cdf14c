/* feasibility_coupling.c - the limits of grains and fluid together. Those of two-way coupling were
 * found by ./run.sh extremes (scenes/studies/extremes.study) and hold with the margin that is told. */
#include "feasibility.h"

#include <string.h>
#include "../drag/drag.h"
#include "fluid_state.h"
#include "sim.h"

/* kg/s; of a grain at a slip speed */
static double kappa_at(const struct sim *s, int grain, double eps, double speed)
{
    const double d = drag_grains_diameter(s, grain);
    const struct drag_point p = {.eps = eps,
                                 .re = drag_reynolds(eps, speed, d, s->fluid.rho, s->fluid.mu),
                                 .d = d,
                                 .y = 1.0,
                                 .grain = &s->coupling.drag_of.kind[s->grains.kind[grain]]};
    return drag_kappa(&p, s->fluid.mu);
}

/* Relaxation of each species in a dense bed, the harder case. */
void feasibility_relaxation(const struct sim *s, struct feasibility *f)
{
    char name[64];
    for (int k = 0; k < s->grains.n_species; k++) {
        const int i = feasibility_grain(s, k);
        const double kappa = i < 0 ? 0.0 : kappa_at(s, i, 0.4, flow_most(&s->flow) / 0.4);
        if (!(kappa > 0.0))
            continue;
        snprintf(name, sizeof name, "drag relaxation, %.32s", s->grains.species[k].name);
        feasibility_add(f, name, "s", s->fluid.dt, s->grains.mass[i] / kappa,
                        !s->coupling.implicit,
                        s->coupling.implicit ? "implicit: accuracy only, at porosity 0.4"
                                             : "explicit, at porosity 0.4");
    }
}

/* A grain alone, V |rho_s - rho| g = kappa v, and what flows in; by iteration, each halfway on a
 * logarithmic scale, for kappa grows as v^(0 to 1). */
double feasibility_sinking(const struct sim *s, int species)
{
    const int i = feasibility_grain(s, species);
    const vec3 g = {s->domain.gravity.x, s->domain.gravity.y, s->domain.gravity.z};
    double v = 1e-6;
    if (!s->fluid.exists || i < 0 || !(kappa_at(s, i, 1.0, v) > 0.0))
        return (double)INFINITY;
    const double volume = s->grains.volume[i];
    const double pull =
        fabs(s->grains.species[species].density - s->fluid.rho) * volume * v3_norm(g);
    for (int n = 0; n < 60; n++)
        v = sqrt(fmax(v, 1e-30) * pull / kappa_at(s, i, 1.0, v));
    return v + fluid_expected_velocity(s);
}

/* The share of a cell that one grain of the species fills, 1 at most. */
static double share_of_cell(const struct sim *s, int grain)
{
    const double *const h = s->grid.h;
    return fmin(1.0, s->grains.volume[grain] / (h[0] * h[1] * h[2]));
}

/* Grains much lighter than the fluid: the pressure gradient that moves them is that of the step
 * before, which two-way coupling bears only while the grains in a cell are heavier than what the
 * fluid there makes them follow. Of a suspension of mean solid fraction e: rho_s/rho_f > e (1 - e);
 * edges on 1.5, 8 and 20 % at 1.10, 0.99 and 1.06 of it, hence the margin. Of a sphere alone, which
 * fills e of its cell: edges at 0.049, 0.0102, 0.0029, 0.00085 for cells of 1, 2, 4, 8 d, which is
 * 0.055 e^0.6; wider answers of porosity/ bear more. The step enters little: with a quarter and
 * four times of it the edges moved by 20 %. Added mass counts as the grain's own, for its coupling
 * is implicit. */
#define LIGHTEST       1.25
#define LIGHTEST_ALONE 0.07
#define LIGHTEST_POWER 0.6

static void lightness_line(const struct sim *s, int species, double solid,
                           struct feasibility *f)
{
    const struct species *const sp = &s->grains.species[species];
    const int i = feasibility_grain(s, species);
    char name[64];
    if (i < 0 || sp->density >= s->fluid.rho)
        return;
    const double alone = LIGHTEST_ALONE * pow(share_of_cell(s, i), LIGHTEST_POWER);
    snprintf(name, sizeof name, "lightness, %.32s", sp->name);
    feasibility_add(f, name, "1", fmax(LIGHTEST * solid * (1.0 - solid), alone),
                    sp->density / s->fluid.rho + s->coupling.forces.added, true,
                    "the ratio of densities, added mass with it, must be larger");
}

/* The viscous force on grains, V div tau, is that of the step before; where drag ties them to the
 * fluid the mixture takes its share e of the stress explicitly: nu dt sum 1/h^2 < 3/e, e the mean
 * solid fraction and what one grain adds to its cell. Edges (implicit viscosity, suspensions of 4,
 * 8 and 15 %, cells of 1, 2, 4 d) at 3.2 to 5.2/e, 4.1 after four times as long. */
#define STRESS_SHARE 3.0

static void stress_line(const struct sim *s, int species, double solid, struct feasibility *f)
{
    const int i = feasibility_grain(s, species);
    const double viscous = 4.0 * fluid_viscous_limit(s); /* 1/(nu sum 1/h^2) */
    char name[64];
    if (i < 0 || !s->fluid.implicit_viscosity || !(s->coupling.forces.viscous > 0.0) ||
        !isfinite(viscous))
        return;
    snprintf(name, sizeof name, "viscous force on grains, %.32s",
             s->grains.species[species].name);
    feasibility_add(f, name, "s", s->fluid.dt,
                    STRESS_SHARE * viscous / (solid + share_of_cell(s, i)), true,
                    "explicit; forces = -viscous does without");
}

void feasibility_coupling(const struct sim *s, struct feasibility *f)
{
    const double box = s->domain.size[0] * s->domain.size[1] * s->domain.size[2];
    double solid = 0.0;
    if (!s->fluid.equation || s->coupling.ways != 2)
        return;
    for (int i = 0; i < s->grains.n; i++)
        solid += s->grains.volume[i] / box;
    for (int k = 0; k < s->grains.n_species; k++) {
        lightness_line(s, k, solid, f);
        stress_line(s, k, solid, f);
    }
}
