/* verify/two_bodies.h - tests that every law with restitution must pass; included by a test
 * that links one law and gives its material. */
#ifndef TWO_BODIES_H
#define TWO_BODIES_H

#include "check.h"
#include "harness.h"

#define TWO                                                                                    \
    "[grains a]\ndiameter = 10 mm\ndensity = 2385 kg/m3\nfill = point\n"                       \
    "position = 40 50.3 50.7 mm\nvelocity = 0.5 0 0 m/s\nmaterial = m\n"                       \
    "[grains b]\ndiameter = 14 mm\ndensity = 1723 kg/m3\nfill = point\n"                       \
    "position = 52.1 50.3 50.7 mm\nvelocity = -0.3 0 0 m/s\nmaterial = m\n"                    \
    "[domain]\nsize = 100 100 100 mm\ngravity = 0 0 0 m/s2\nx = periodic\n"                    \
    "y = periodic\nz = periodic\n[run]\nend = 1 s\nsubsteps = 1\n"

/* Head-on impact of unlike spheres: rebound over impact speed. */
static inline double rebound(const char *material, double e, double dt)
{
    char *const text =
        xprintf(TWO "dt = %.17g s\n[material m]\n%srestitution = %.17g\nfriction = 0.3\n", dt,
                material, e);
    struct sim *const s = sim_from(text);
    bool touched = false;
    for (long k = 0; k < 100000000; k++) {
        step(s);
        touched = touched || s->neighbours.touching > 0;
        if (touched && s->neighbours.touching == 0)
            break;
    }
    const double out = s->grains.vel[grain_at(s, 1)].x - s->grains.vel[grain_at(s, 0)].x;
    sim_free(s);
    xfree(text);
    return out / 0.8;
}

static inline void check_restitution(const char *material, double dt)
{
    const double asked[] = {0.05, 0.137, 0.3, 0.5123, 0.8, 0.95, 1.0};
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        char *const text = xprintf("head-on restitution, e = %g", asked[i]);
        check_rel(rebound(material, asked[i], dt), asked[i], 1e-3, text);
        xfree(text);
    }
}

/* A sphere bounces elastically on the floor for 1e5 steps: energy at the top of the last
 * flight. */
static inline void check_energy(const char *material, double dt)
{
    char *const text =
        xprintf("[grains a]\ndiameter = 10 mm\ndensity = 2385 kg/m3\nfill = point\n"
                "position = 20 20 7 mm\nmaterial = m\n[domain]\nsize = 40 40 40 mm\n"
                "[run]\nend = 1e9 s\nsubsteps = 100\ndt = %.17g s\n[material m]\n%s"
                "restitution = 1\nfriction = 0.3\n",
                dt, material);
    struct sim *const s = sim_from(text);
    ledger_start(s);
    const double start = s->ledger.potential;
    double worst = 0.0;
    long bounces = 0;
    bool down = false;
    for (int k = 0; k < 1000; k++) {
        step(s);
        const struct ledger *const l = &s->ledger;
        const double floor_energy = 9.81 * 5e-3 * l->mass; /* potential is counted from z = 0 */
        worst = fmax(worst, fabs(l->kinetic + l->potential + l->elastic - start) /
                                (start - floor_energy));
        bounces += down && s->grains.vel[0].z > 0.0;
        down = s->grains.vel[0].z < 0.0;
    }
    check(bounces >= 3, "the sphere bounces: %ld times in 1e5 steps", bounces);
    check(worst < 1e-4, "elastic energy drift over 1e5 steps: %.3g, at most 1e-4", worst);
    sim_free(s);
    xfree(text);
}

/* Forty grains collide in a periodic box, with friction and loss: their momentum stays. */
static inline void check_momentum(const char *material, double dt)
{
    char *const text = xprintf(
        "[grains a]\ndiameter = 3 mm\ndensity = 2385 kg/m3\nfill = random\ncount = 20\n"
        "velocity = 1 0.3 -0.2 m/s\nspin = 20 5 -3 rad/s\nmaterial = m\n"
        "[grains b]\ndiameter = 2 mm\ndensity = 1723 kg/m3\nfill = random\ncount = 20\n"
        "velocity = -1 -0.7 0.4 m/s\nmaterial = m\n"
        "[domain]\nsize = 12 12 12 mm\ngravity = 0 0 0 m/s2\nx = periodic\ny = periodic\n"
        "z = periodic\n[run]\nend = 1 s\nsubsteps = 20000\ndt = %.17g s\n[material m]\n%s"
        "restitution = 0.7\nfriction = 0.3\n",
        dt, material);
    struct sim *const s = sim_from(text);
    ledger_start(s);
    const double before = s->ledger.kinetic;
    step(s);
    check(s->ledger.kinetic < 0.95 * before,
          "grains collide: kinetic energy falls to %.3g of its start",
          s->ledger.kinetic / before);
    check(s->ledger.momentum_error < 1e-13,
          "momentum in a periodic box kept to round-off: %.3g", s->ledger.momentum_error);
    check(s->ledger.dissipated >= 0.0, "contacts dissipate: %.3g J", s->ledger.dissipated);
    sim_free(s);
    xfree(text);
}

#endif
