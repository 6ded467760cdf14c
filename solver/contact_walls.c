/* contact_walls.c - which wall slots are looked at; the sums of the forces on walls. */
#include "contact_walls.h"

#include "contact_loop.h"
#include "sim.h"

void walls_choose(struct sim *s, int run, int first, int last)
{
    struct neighbours *const nb = &s->neighbours;
    struct slots *const l = &nb->walls;
    int *const active = &l->active[l->begin[first]];
    int n = 0;
    for (int slot = l->begin[first]; slot < l->begin[last]; slot++) {
        const int i = l->owner[slot];
        struct wall_seen seen;
        wall_look(s, l->other[slot], &s->grains.pos[i], &seen);
        const vec3 d = seen.view.away;
        const double cut = s->grains.radius[i] + neighbours_inner_wall(nb, i);
        active[n] = slot;
        n += l->live[slot] || v3_dot(d, d) < cut * cut;
    }
    l->n_active[run] = n;
}

void walls_flush(struct sim *s)
{
    const struct contact_work *const c = s->contacts;
    for (int k = 0; k < s->walls.n; k++) {
        struct wall *const w = &s->walls.wall[k];
        struct sums sum = {0};
        for (int run = 0; run < c->runs; run++) {
            struct sums *const of = &c->wall_sum[(size_t)run * s->walls.n + k];
            sum.both += of->both;
            *of = (struct sums){0};
        }
        vec3 force, torque;
        sums_part(sum.both, &force, &torque);
        w->sum = v3_add(w->sum, force);
        w->torque_sum = v3_add(w->torque_sum, torque);
    }
}

/* Means over the steps since the last time. */
static void note_series(const struct sim *s, struct wall *w, vec3 impulse, vec3 turn,
                        double time)
{
    w->series.force = w->force;
    w->series.torque = w->torque;
    if (time > 0.0) {
        w->series.force = v3_scale(1.0 / time, v3_sub(w->impulse, impulse));
        w->series.torque = v3_scale(1.0 / time, v3_sub(w->turn_impulse, turn));
    }
    w->series.pushed = -v3_dot(w->series.force, w->motion.direction);
    if (w->servo.on && w->servo.stress)
        w->series.pushed /= servo_area(s, w);
}

void walls_collect(struct sim *s, int steps)
{
    const double dt = s->run.dt;
    for (int k = 0; k < s->walls.n; k++) {
        struct wall *const w = &s->walls.wall[k];
        const vec3 impulse = w->impulse, turn = w->turn_impulse;
        struct sums now = {0};
        for (int run = 0; run < s->neighbours.runs; run++) {
            const struct sums *const of =
                &s->contacts->wall_force[(size_t)run * s->walls.n + k];
            now.both += of->both;
        }
        vec3 force, torque;
        sums_part(now.both, &force, &torque);
        walls_impulse(&w->force_before, &w->sum, &w->impulse, force, steps, dt);
        walls_impulse(&w->torque_before, &w->torque_sum, &w->turn_impulse, torque, steps, dt);
        w->force = w->force_before;
        w->torque = w->torque_before;
        note_series(s, w, impulse, turn, steps * dt);
    }
}
