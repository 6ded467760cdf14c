/* run.c - the clock of a run. */
#include "run.h"

#include "../contact/contact.h"
#include "feasibility.h"
#include "sim.h"

const struct key run_keys[] = {
    {"run", "end", KEY_REAL, "s", "(0, inf)", NULL, "simulated time, after settling"},
    {"run", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto",
     "time step of the grains; auto: run.safety of the shortest limit"},
    {"run", "safety", KEY_REAL, "1", "(0, 1]", "0.2", "part of the limit that dt = auto takes"},
    {"run", "substeps", KEY_INT, "", "[1, 1000000]", "100",
     "grain steps per record of the ledger in a dry scene, fewer where an output is due (with "
     "a "
     "fluid: fluid.dt over run.dt)"},
    {"run", "settle_time", KEY_REAL, "s", "(0, inf)", "10 s",
     "longest settling for fill = settle; a bed that moves still is refused"},
    {"run", "settle_energy", KEY_REAL, "1", "(0, 1)", "1e-5",
     "a bed has settled when its kinetic energy is this part of m g d per grain"},
    {"run", "overlap_max", KEY_REAL, "1", "(0, 1)", "0.1",
     "overlap, as part of the smaller radius, that stops the run"},
    {"run", "speed", KEY_REAL, "m s-1", "auto | (0, inf)", "auto",
     "highest expected speed of a grain, for time-step limits; auto: start plus free fall"},
    {"run", "force", KEY_CHOICE, "", "off | on", "off",
     "run in spite of broken time-step limits"},
    {"run", "seed", KEY_INT, "", "[0, 2147483647]", "1", "seed of every random number"},
    {"output", "every", KEY_REAL, "s", "ends | (0, inf)", "ends",
     "time between outputs of grains and fields; ends: first and last only"},
    {"output", "series", KEY_REAL, "s", "auto | (0, inf)", "auto",
     "time between samples of the time series; auto: 500 samples"},
    {"output", "bed", KEY_CHOICE, "", "none | start | end", "none",
     "writes bed.nc, which fill = file of another scene takes: the grains at the start "
     "(settled, "
     "if they settle), or at the end"},
    {"output", "slice", KEY_CHOICE, "", "auto | x | y | z | off", "auto",
     "across which axis pictures of the fluid are cut; auto: a thin direction, else y"},
    {"output", "slice_at", KEY_REAL, "m", "middle | [0, inf)", "middle", "where they are cut"},
    {0},
};

void run_read(struct sim *s, struct scene *scene)
{
    struct run *const r = &s->run;
    scene_declare(scene, run_keys);
    r->end = scene_real(scene, "run", NULL, "end");
    r->settle_time = scene_real(scene, "run", NULL, "settle_time");
    r->settle_energy = scene_real(scene, "run", NULL, "settle_energy");
    r->overlap_max = scene_real(scene, "run", NULL, "overlap_max");
    r->speed = scene_word(scene, "run", NULL, "speed", "auto")
                   ? 0.0
                   : scene_real(scene, "run", NULL, "speed");
    r->force = scene_choice(scene, "run", NULL, "force") == 1;
    r->seed = (unsigned long)scene_int(scene, "run", NULL, "seed");
    r->output_every = scene_word(scene, "output", NULL, "every", "ends")
                          ? (double)INFINITY
                          : scene_real(scene, "output", NULL, "every");
    r->save_bed = (enum save_bed)scene_choice(scene, "output", NULL, "bed");
    scene_choice(scene, "output", NULL, "slice"); /* for the pictures: read from run.nc */
    if (!scene_word(scene, "output", NULL, "slice_at", "middle"))
        scene_real(scene, "output", NULL, "slice_at");
    r->series_asked = !scene_word(scene, "output", NULL, "series", "auto");
    r->series_every =
        r->series_asked ? scene_real(scene, "output", NULL, "series") : r->end / 500.0;
}

void run_steps(struct sim *s, struct scene *scene)
{
    struct run *const r = &s->run;
    r->substeps = r->record = scene_int(scene, "run", NULL, "substeps");
    if (scene_word(scene, "run", NULL, "dt", "auto")) {
        const double limit = feasibility_grain_limit(s);
        r->dt = scene_real(scene, "run", NULL, "safety") * limit;
        if (isinf(limit)) /* nothing touches: the fluid's step, or a thousandth of the run */
            r->dt = s->fluid.exists ? s->fluid.dt / fmax(1.0, s->fluid.pieces)
                                    : r->end / (1000.0 * r->substeps);
    } else {
        r->dt = scene_real(scene, "run", NULL, "dt");
        if (r->force) /* a study forces its step on scenes that have a safety, too */
            scene_real(scene, "run", NULL, "safety");
    }
    if (scene_errors(scene) > 0 || !(r->dt > 0.0)) {
        r->dt = r->dt > 0.0 ? r->dt : 1.0;
        return;
    }
    if (s->fluid.exists) {
        const double ratio = s->fluid.dt / r->dt;
        if (ratio > 1e7) {
            scene_error(scene, "fluid", NULL, "dt",
                        "is more than 1e7 steps of the grains (%g s)", r->dt);
            return;
        }
        r->substeps = ratio > 1.0 ? (int)ceil(ratio - 1e-9) : 1;
        if (ratio < 1.0 - 1e-9 && scene_given(scene, "run", NULL, "dt"))
            scene_error(scene, "run", NULL, "dt", "must not be longer than fluid.dt, %g s",
                        s->fluid.dt);
        r->dt = s->fluid.dt / r->substeps;
    }
}

void run_until(struct sim *s, double due)
{
    struct run *const r = &s->run;
    if (s->fluid.exists)
        return;
    const double left = ceil((fmin(due, r->end) - s->t) / r->dt - 1e-6);
    r->substeps = r->record - (int)(s->clock % r->record);
    if (left < r->substeps)
        r->substeps = left > 1.0 ? (int)left : 1;
}
