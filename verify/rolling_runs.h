/* verify/rolling_runs.h - a sphere on a plane, for tests that link one law of rolling with the linear
 * contact: at which slope it starts to roll, and whether it comes to rest. */
#ifndef ROLLING_RUNS_H
#define ROLLING_RUNS_H

#include "check.h"
#include <omp.h>
#include "harness.h"

/* A sphere of 10 mm, sunk by its weight; `material`: rows of its section, `more`: sections. */
static inline struct sim *sphere_on_plane(double v, double dt, const char *material,
                                          const char *more)
{
    const double r = 5e-3, k = 1e4, m = 1056.0 * 4.0 / 3.0 * PI * r * r * r;
    char *const text = xprintf(
        "[grains a]\ndiameter = 10 mm\ndensity = 1056 kg/m3\nfill = point\nmaterial = m\n"
        "position = 0.5 0.05 %.17g m\nvelocity = %.17g 0 0 m/s\nspin = 0 %.17g 0 rad/s\n"
        "[domain]\nsize = 1 0.1 0.05 m\nx = periodic\ny = periodic\n[run]\nend = 100 s\n"
        "substeps = 1\ndt = %.17g s\n[material m]\nstiffness = 2e4 N/m\nrestitution = 0.5\n"
        "friction = 0.9\n%s%s",
        r - m * 9.81 / k, v, v / r, dt, material, more);
    omp_set_num_threads(1);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

static inline void tilt(struct sim *s, double angle)
{
    s->domain.gravity = v3(9.81 * sin(angle), 0.0, -9.81 * cos(angle));
}

static inline double gain(struct sim *s, double time)
{
    const double before = s->grains.vel[0].x;
    const long steps = (long)(time / s->run.dt);
    for (long k = 0; k < steps; k++)
        step(s);
    return s->grains.vel[0].x - before;
}

/* The plane is tilted slowly to 0.995 of the slope tan(angle) = slope, where the sphere must stay,
 * and then to 1.005 of it, where it must roll with (5/7) g (sin - slope cos). */
static inline void check_incline(double slope, const char *material, const char *more)
{
    struct sim *const s = sphere_on_plane(0.0, 1e-5, material, more);
    const double low = atan(0.995 * slope), high = atan(1.005 * slope), hold = 0.05;
    for (int k = 0; k < 10000; k++) {
        tilt(s, low * k / 10000);
        step(s);
    }
    const double want = 5.0 / 7.0 * 9.81 * (sin(high) - slope * cos(high)) * hold;
    gain(s, 0.03); /* it follows the plane */
    const double stays = gain(s, hold), speed = s->grains.vel[0].x;
    for (int k = 0; k < 2000; k++) {
        tilt(s, low + (high - low) * k / 2000);
        step(s);
    }
    gain(s, 0.03); /* the springs reach their limits */
    const double rolls = gain(s, hold);
    check(fabs(stays) < 0.2 * want && fabs(speed) < 0.2 * want,
          "%.4g deg: at 0.995 of the slope it stays (%.2g m/s gained, %.2g had)",
          180.0 / PI * atan(slope), stays, speed);
    check(fabs(rolls - want) < 0.2 * want,
          "%.4g deg: at 1.005 of the slope it rolls (%.3g m/s gained, want %.3g)",
          180.0 / PI * atan(slope), rolls, want);
    sim_free(s);
}

/* Rolls on a level plane: how far, and with what speed and spin when it has stopped. */
struct stop {
    double distance, speed, drift; /* m; m/s, largest over the last 0.1 s; m over it */
};

static inline struct stop roll_out(double v, double time, const char *material,
                                   const char *more)
{
    struct sim *const s = sphere_on_plane(v, 1e-5, material, more);
    struct stop out = {0};
    double travelled = 0.0;
    const long steps = (long)(time / s->run.dt);
    for (long k = 0; k < steps; k++) {
        step(s);
        travelled += s->grains.vel[0].x * s->run.dt;
        if (k > steps - 10000) {
            out.speed = fmax(out.speed, fabs(s->grains.vel[0].x));
            out.drift += s->grains.vel[0].x * s->run.dt;
        }
    }
    out.distance = travelled;
    sim_free(s);
    return out;
}

#endif
