/* servo.c - a wall that moves until the grains bear the force or stress that is asked for:
 *   travel' = speed_max max(-1, min(1, e + I)),  e = gain (target - borne) / largest target
 *   I' = e / integral_time
 * the proportional-integral controller in the form of [AstromHagglund95, ch. 3]: e alone would
 * leave an error wherever the wall must keep moving, as on a sample that dilates. I rests while the
 * wall moves at its highest speed and while more than half of the target is missing, so that nothing
 * winds up on the way to the grains. With gain 1 it moves at its highest speed towards grains that
 * bear nothing. A wall on grains of stiffness k rings unless gain speed_max k dt is well below the
 * target, and unless integral_time is longer than target / (gain speed_max k). */
#include "sim.h"

#include <string.h>

void servo_read(struct wall *w, struct scene *scene)
{
    struct servo *const o = &w->servo;
    const char *const name = w->name;
    const bool force = scene_given(scene, "wall", name, "push");
    const bool stress = scene_given(scene, "wall", name, "stress");
    const bool table = scene_given(scene, "wall", name, "push_table");
    if (!force && !stress && !table)
        return;
    if (force && stress)
        scene_error(scene, "wall", name, "stress", "contradicts push: give either one");
    o->on = true;
    o->own_area = !scene_word(scene, "wall", name, "area", "auto");
    o->stress = stress || (table && !force && scene_given(scene, "wall", name, "area"));
    if (o->own_area)
        o->area = scene_real(scene, "wall", name, "area");
    if (force || stress)
        o->target.value = scene_real(scene, "wall", name, stress ? "stress" : "push");
    o->target.ramp = scene_real(scene, "wall", name, "push_ramp");
    course_read_table(&o->target, scene, "wall", name, "push_table");
    o->gain = scene_real(scene, "wall", name, "gain");
    o->speed_most = scene_real(scene, "wall", name, "speed_max");
    o->integral_time = scene_word(scene, "wall", name, "integral_time", "off")
                           ? (double)INFINITY
                       : scene_word(scene, "wall", name, "integral_time", "auto")
                           ? 0.0
                           : scene_real(scene, "wall", name, "integral_time");
    o->scale = course_most(&o->target);
    w->motion.direction = wall_unit_vector(scene, name, "direction");
    if (!(o->scale > 0.0))
        scene_error(scene, "wall", name, stress ? "stress" : "push", "must not be zero");
    if (fabs(v3_dot(w->motion.velocity, w->motion.direction)) >
        1e-9 * v3_norm(w->motion.velocity))
        scene_error(
            scene, "wall", name, "velocity",
            "a servo sets the speed along its direction: only across it may it be given");
    if (w->motion.amplitude > 0.0)
        scene_error(scene, "wall", name, "amplitude", "a servo cannot vibrate too");
}

static double component(vec3 v, int a)
{
    return a == 0 ? v.x : a == 1 ? v.y : v.z;
}

/* Where a wall that is flat across axis a stands, and whether grains are above it; or false. */
static bool flat_across(const struct sim *s, const struct wall *w, int a, double *at, bool *up)
{
    const double low = component(w->low, a), high = component(w->high, a);
    if (low != high || !isfinite(low))
        return false;
    vec3 above = w->middle;
    const double step = 1e-6 * s->domain.size[a];
    above = v3_add(above, v3(a == 0 ? step : 0.0, a == 1 ? step : 0.0, a == 2 ? step : 0.0));
    *at = low + component(w->pose.shift, a);
    *up = w->kind->behind ? !w->kind->behind(w->shape, above) : low < 0.5 * s->domain.size[a];
    return true;
}

/* m, between the innermost flat walls across axis a, or the period. */
static double span(const struct sim *s, int a)
{
    double low = 0.0, high = s->domain.size[a];
    for (int k = 0; k < s->walls.n && !s->domain.periodic[a]; k++) {
        double at;
        bool up;
        if (!flat_across(s, &s->walls.wall[k], a, &at, &up))
            continue;
        if (up)
            low = fmax(low, at);
        else
            high = fmin(high, at);
    }
    return fmax(high - low, 0.0);
}

double servo_area(const struct sim *s, const struct wall *w)
{
    if (w->servo.own_area)
        return w->servo.area;
    double area = 1.0;
    for (int a = 0; a < 3; a++)
        if (fabs(component(w->motion.direction, a)) < 0.5)
            area *= span(s, a);
    return area;
}

/* Auto: while it moves half a diameter of the finest grains at gain speed_max. */
static double integral_time(const struct sim *s, const struct servo *o)
{
    double d = (double)INFINITY;
    for (int k = 0; k < s->grains.n_species; k++)
        if (!s->grains.species[k].frozen)
            d = fmin(d, s->grains.species[k].diameter);
    return o->integral_time > 0.0 ? o->integral_time : 0.5 * d / (o->gain * o->speed_most);
}

void servo_speed(const struct sim *s, struct wall *w, double t)
{
    const struct servo *const o = &w->servo;
    const struct wall_motion *const m = &w->motion;
    w->state.speed = 0.0;
    if (t < m->start || t > m->stop)
        return;
    double borne = -v3_dot(w->force, m->direction);
    if (o->stress)
        borne /= fmax(servo_area(s, w), 1e-300);
    const double target = course_at(&o->target, t - m->start);
    const double error = o->gain * (target - borne) / o->scale;
    const double asked = error + w->state.integral;
    if (fabs(asked) < 1.0 && fabs(target - borne) < 0.5 * fabs(target))
        w->state.integral += error * s->run.dt / integral_time(s, o);
    w->state.speed = o->speed_most * fmax(-1.0, fmin(1.0, asked));
}
