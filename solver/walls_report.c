/* walls_report.c - work of the walls, their time series and their lines of the summary. */
#include "sim.h"

#include <ctype.h>
#include <string.h>

double walls_work(const struct sim *s)
{
    double work = 0.0;
    for (int k = 0; k < s->walls.n; k++) {
        const struct wall *const w = &s->walls.wall[k];
        work -= v3_dot(w->impulse, w->motion.surface) + w->state.work;
    }
    return work;
}

/* "wall_lid_" of [wall lid]: letters that a name in netCDF may hold. */
static char *prefix(const struct wall *w)
{
    char *const text = xprintf("wall_%s", w->name);
    for (char *c = text; *c; c++)
        if (!isalnum((unsigned char)*c))
            *c = '_';
    return text;
}

/* Keeps a text as long as the walls. */
static const char *keep(struct walls *all, char *text)
{
    all->text =
        xrealloc(all->text, (size_t)all->n_texts, (size_t)all->n_texts + 1, sizeof *all->text);
    return all->text[all->n_texts++] = text;
}

static void add(struct sim *s, const struct wall *w, const char *what, const char *unit,
                const char *of, const double *value)
{
    char *const start = prefix(w);
    const char *const name = keep(&s->walls, xprintf("%s_%s", start, what));
    const char *const text = keep(&s->walls, xprintf("%s wall %s", of, w->name));
    series_add(&s->series, name, unit, text, value);
    xfree(start);
}

static void add_vector(struct sim *s, const struct wall *w, const char *what, const char *unit,
                       const char *of, const vec3 *value)
{
    const char *const axis[] = {"x", "y", "z"};
    const double *const at[] = {&value->x, &value->y, &value->z};
    for (int a = 0; a < 3; a++) {
        char *const name = xprintf("%s_%s", what, axis[a]);
        add(s, w, name, unit, of, at[a]);
        xfree(name);
    }
}

void walls_open(struct sim *s)
{
    s->walls.skeleton_impulse = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < s->walls.n; k++) {
        struct wall *const w = &s->walls.wall[k];
        w->impulse = w->turn_impulse = v3(0.0, 0.0, 0.0);
        w->state.work = w->state.power = 0.0;
        w->series.force = w->force;
        if (w->kind == &wall_side)
            continue;
        add_vector(s, w, "force", "N", "mean force of the grains on", &w->series.force);
        add_vector(s, w, "torque", "N m", "mean torque of the grains, about its pivot, on",
                   &w->series.torque);
        if (!w->motion.moves)
            continue;
        add_vector(s, w, "shift", "m", "displacement of", &w->pose.shift);
        if (w->motion.turns)
            add(s, w, "angle", "rad", "angle turned by", &w->pose.angle);
        add(s, w, "work", "J", "work of the grains on", &w->state.work);
        if (w->servo.on)
            add(s, w, w->servo.stress ? "stress" : "push", w->servo.stress ? "Pa" : "N",
                w->servo.stress ? "stress on" : "force along the servo's direction on",
                &w->series.pushed);
    }
}

static void line(struct sim *s, const char *start, const char *what, double value,
                 const char *unit)
{
    char *const key = xprintf("%s_%s", start, what);
    summary_number(&s->summary, key, value, unit);
    xfree(key);
}

void walls_report(struct sim *s)
{
    for (int k = 0; k < s->walls.n; k++) {
        const struct wall *const w = &s->walls.wall[k];
        if (w->kind == &wall_side)
            continue;
        char *const start = prefix(w);
        line(s, start, "force_x", w->series.force.x, "N");
        line(s, start, "force_y", w->series.force.y, "N");
        line(s, start, "force_z", w->series.force.z, "N");
        line(s, start, "torque_x", w->series.torque.x, "N m");
        line(s, start, "torque_y", w->series.torque.y, "N m");
        line(s, start, "torque_z", w->series.torque.z, "N m");
        if (w->motion.moves) {
            line(s, start, "shift_x", w->pose.shift.x, "m");
            line(s, start, "shift_y", w->pose.shift.y, "m");
            line(s, start, "shift_z", w->pose.shift.z, "m");
            line(s, start, "work", w->state.work, "J");
        }
        if (w->servo.on)
            line(s, start, w->servo.stress ? "stress" : "push", w->series.pushed,
                 w->servo.stress ? "Pa" : "N");
        xfree(start);
    }
}
