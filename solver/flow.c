/* flow.c - the staircase of superficial velocities that drives the fluid. */
#include "flow.h"

const struct key flow_keys[] = {
    {"flow", "start", KEY_REAL, "s", "[0, inf)", "0 s", "when the fluid begins to flow"},
    {"flow", "velocity", KEY_REAL, "m s-1", "[0, inf)", "0 m/s",
     "superficial velocity through the inflow sides, into the box"},
    {"flow", "velocity_end", KEY_REAL, "m s-1", "same | [0, inf)", "same",
     "superficial velocity of the last level of a staircase"},
    {"flow", "steps", KEY_INT, "", "[1, 10000]", "1", "levels of the staircase"},
    {"flow", "hold", KEY_REAL, "s", "(0, inf)", "1 s", "how long each level is held"},
    {"flow", "pressure_gradient", KEY_VECTOR, "Pa m-1", "(-inf, inf)", "0 0 0 Pa/m",
     "mean pressure drop per length that drives periodic directions"},
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
    f->gradient = scene_vector(s, "flow", NULL, "pressure_gradient");
    if (f->steps == 1 && f->velocity_end != f->velocity)
        scene_error(s, "flow", NULL, "steps", "must be at least 2 to reach flow.velocity_end");
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
        return f->velocity;
    const double part = (double)flow_level(f, t) / (f->steps - 1);
    return f->velocity + part * (f->velocity_end - f->velocity);
}
