/* flow.c - what drives the fluid: velocities of the inflow sides, pressure gradients. */
#include "flow.h"

#include <math.h>

#define TURN 6.28318530717958647692

const struct key flow_keys[] = {
    {"flow", "start", KEY_REAL, "s", "[0, inf)", "0 s", "when the fluid begins to flow"},
    {"flow", "velocity", KEY_REAL, "m s-1", "[0, inf)", "0 m/s",
     "superficial velocity through the inflow sides, into the box (the mean of the profile)"},
    {"flow", "velocity_end", KEY_REAL, "m s-1", "same | [0, inf)", "same",
     "superficial velocity of the last level of a staircase"},
    {"flow", "steps", KEY_INT, "", "[1, 10000]", "1", "levels of the staircase"},
    {"flow", "hold", KEY_REAL, "s", "(0, inf)", "1 s", "how long each level is held"},
    {"flow", "ramp", KEY_REAL, "s", "[0, inf)", "0 s",
     "time in which the velocity grows from 0 at t = 0"},
    {"flow", "table", KEY_TEXT, "", "", "",
     "CSV file of the velocity: time in s, velocity in m/s; in place of the staircase"},
    {"flow", "profile", KEY_CHOICE, "", "uniform | parabolic", "uniform",
     "over an inflow side; parabolic between the sides across it that are walls"},
    {"flow", "pressure_gradient", KEY_VECTOR, "Pa m-1", "(-inf, inf)", "0 0 0 Pa/m",
     "mean pressure drop per length that drives periodic directions"},
    {"flow", "period", KEY_REAL, "s", "steady | (0, inf)", "steady",
     "the pressure gradient swings as cos(2 pi t/period)"},
    {"flow", "rate", KEY_VECTOR, "m s-1", "none | (-inf, inf)", "none",
     "mean superficial velocity held in periodic directions, by a gradient that adapts"},
    {0},
};

void flow_read(struct flow *f, struct scene *s)
{
    scene_declare(s, flow_keys);
    f->start = scene_real(s, "flow", NULL, "start");
    f->velocity = scene_real(s, "flow", NULL, "velocity");
    f->velocity_end = scene_word(s, "flow", NULL, "velocity_end", "same")
                          ? f->velocity
                          : scene_real(s, "flow", NULL, "velocity_end");
    f->steps = scene_int(s, "flow", NULL, "steps");
    f->hold = scene_real(s, "flow", NULL, "hold");
    f->course.value = f->velocity;
    f->course.ramp = scene_real(s, "flow", NULL, "ramp");
    course_read_table(&f->course, s, "flow", NULL, "table");
    f->profile = (enum profile)scene_choice(s, "flow", NULL, "profile");
    f->gradient = f->steady = scene_vector(s, "flow", NULL, "pressure_gradient");
    f->period = scene_word(s, "flow", NULL, "period", "steady")
                    ? (double)INFINITY
                    : scene_real(s, "flow", NULL, "period");
    f->held = !scene_word(s, "flow", NULL, "rate", "none");
    if (f->held)
        f->held_rate = scene_vector(s, "flow", NULL, "rate");
    if (f->steps == 1 && f->velocity_end != f->velocity)
        scene_error(s, "flow", NULL, "steps", "must be at least 2 to reach flow.velocity_end");
    if (f->steps > 1 && (f->course.n > 0 || f->course.ramp > 0.0))
        scene_error(s, "flow", NULL, "steps",
                    "a staircase takes neither flow.ramp nor flow.table");
    if (f->course.n > 0 && scene_given(s, "flow", NULL, "velocity"))
        scene_error(s, "flow", NULL, "velocity", "contradicts flow.table: give either one");
    if (f->held && v3_norm(f->steady) > 0.0)
        scene_error(s, "flow", NULL, "pressure_gradient",
                    "contradicts flow.rate: give either one");
    if (f->held && isfinite(f->period))
        scene_error(s, "flow", NULL, "period", "a flow rate that is held does not swing");
}

void flow_free(struct flow *f)
{
    course_free(&f->course);
}

int flow_level(const struct flow *f, double t)
{
    /* A step that ends on the edge of a level belongs to the level that ends there. */
    const double level = floor((t - f->start) / f->hold - 1e-9);
    if (!(level > 0.0))
        return 0;
    return level < f->steps - 1 ? (int)level : f->steps - 1;
}

double flow_velocity(const struct flow *f, double t)
{
    if (f->steps == 1)
        return course_at(&f->course, t);
    const double part = (double)flow_level(f, t) / (f->steps - 1);
    return f->velocity + part * (f->velocity_end - f->velocity);
}

double flow_most(const struct flow *f)
{
    return fmax(course_most(&f->course), fmax(f->velocity, f->velocity_end));
}

void flow_drive(struct flow *f, double t)
{
    if (!f->held)
        f->gradient =
            isfinite(f->period) ? v3_scale(cos(TURN * t / f->period), f->steady) : f->steady;
}
