/* verify/rolling_runs.h - a sphere on a plane, for tests that link one law of rolling with the linear
 * contact: at which slope it starts to roll, and whether it comes to rest. */
#ifndef ROLLING_RUNS_H
#define ROLLING_RUNS_H

#include "check.h"
#include <omp.h>
#include "csv.h"
#include "harness.h"

struct ball {
    double r, density, k; /* m, kg/m3, N/m: normal stiffness against the plane */
};

/* A sphere sunk by its weight, rolling; `material`: rows of its section, friction among them; `more`:
 * sections. */
static inline struct sim *sphere_with(struct ball b, double v, double dt, const char *material,
                                      const char *more)
{
    const double r = b.r, m = b.density * 4.0 / 3.0 * PI * r * r * r;
    char *const text = xprintf(
        "[grains a]\ndiameter = %.17g m\ndensity = %g kg/m3\nfill = point\nmaterial = m\n"
        "position = 0.5 0.05 %.17g m\nvelocity = %.17g 0 0 m/s\nspin = 0 %.17g 0 rad/s\n"
        "[domain]\nsize = 1 0.1 0.05 m\nx = periodic\ny = periodic\n[run]\nend = 100 s\n"
        "substeps = 1\ndt = %.17g s\n[material m]\nstiffness = %.17g N/m\nrestitution = 0.5\n"
        "%s%s",
        2.0 * r, b.density, r - m * 9.81 / b.k, v, v / r, dt, 2.0 * b.k, material, more);
    omp_set_num_threads(1);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

static inline struct sim *sphere_on_plane(double v, double dt, const char *material,
                                          const char *more)
{
    char *const rows = xprintf("friction = 0.9\n%s", material);
    struct sim *const s = sphere_with((struct ball){5e-3, 1056.0, 1e4}, v, dt, rows, more);
    xfree(rows);
    return s;
}

static inline void tilt(struct sim *s, double angle)
{
    s->domain.gravity = v3(9.81 * sin(angle), 0.0, -9.81 * cos(angle));
}

static inline double gain(struct sim *s, double time)
{
    const double before = s->grains.vel[0].x;
    const long steps = lrint(time / s->run.dt);
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

/* The table of slopes: rest, rolling and slipping, with the torque limit mu_r R F_n whose rows of the
 * scene `material` makes from mu_r. Acceleration and spin rate over 0.02 s, after the springs have filled;
 * what rests must not have left. */
static inline void check_slopes(char *(*material)(double mu_r), const char *more)
{
    const struct csv *const t = csv_read("incline.csv");
    for (int i = 0; i < t->n; i++) {
        const double mu = csv_value(t, i, "mu"), mu_r = csv_value(t, i, "mu_r");
        const double angle = csv_value(t, i, "alpha_deg"), want = csv_value(t, i, "a_m_s2");
        const char *const regime = csv_text(t, i, "regime");
        char *const rows = material(mu_r), *const all =
                                               xprintf("friction = %.17g\n%s", mu, rows);
        struct sim *const s =
            sphere_with((struct ball){5e-3, 1056.0, 1e4}, 0.0, 1e-5, all, more);
        tilt(s, angle * PI / 180.0);
        gain(s, want > 0.0 ? 0.06 : 0.3); /* what is held swings first */
        const double spin = s->grains.spin[0].y, time = 0.02, a = gain(s, time) / time;
        const double turn = 5e-3 * (s->grains.spin[0].y - spin) / time;
        const double want_turn = csv_value(t, i, "ang_acc_times_R");
        check(fabs(a - want) < 5e-3 * fmax(want, 0.1) &&
                  fabs(turn - want_turn) < 5e-3 * fmax(want_turn, 0.1),
              "%g deg, mu = %g, mu_r = %g, %s: %.5g m/s2, want %.5g; spin %.5g, want %.5g",
              angle, mu, mu_r, regime, a, want, turn, want_turn);
        sim_free(s);
        xfree(rows);
        xfree(all);
    }
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
    const long steps = lrint(time / s->run.dt);
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
