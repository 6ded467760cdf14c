/* contact_walls.c - which wall slots are looked at; the sums of the forces on walls. */
#include "contact_walls.h"

#include "contact_loop.h"
#include "sim.h"

/* The slots of a run wall by wall, each wall's in their order. Free with xfree. */
static int *by_wall(const struct sim *s, int from, int to)
{
    const int *const other = s->neighbours.walls.other;
    int *const begin = xalloc((size_t)s->walls.n + 1, sizeof *begin);
    int *const order = xalloc((size_t)(to - from) + 1, sizeof *order);
    for (int slot = from; slot < to; slot++)
        begin[s->walls.wall_of[other[slot]] + 1]++;
    for (int k = 0; k < s->walls.n; k++)
        begin[k + 1] += begin[k];
    for (int slot = from; slot < to; slot++)
        order[begin[s->walls.wall_of[other[slot]]]++] = slot;
    xfree(begin);
    return order;
}

/* Marks those of n slots of a wall, WALL_LOOKS at most, that are within the thin skin. */
static void mark_near(const struct sim *s, int wall, const int *slot, int n, bool *near)
{
    const struct neighbours *const nb = &s->neighbours;
    struct wall_looks l;
    double arm[3][WALL_LOOKS];
    l.n = (n + 7) / 8 * 8;
    for (int c = 0; c < l.n; c++) {
        const int of = slot[c < n ? c : n - 1];
        const vec3 x = s->grains.pos[nb->walls.owner[of]];
        l.element[c] = nb->walls.other[of] - s->walls.first[wall];
        l.x[c] = x.x;
        l.y[c] = x.y;
        l.z[c] = x.z;
    }
    walls_look(s, &s->walls.wall[wall], &l, arm);
    for (int c = 0; c < n; c++) {
        const int i = nb->walls.owner[slot[c]];
        const double cut = s->grains.radius[i] + neighbours_inner_wall(nb, i);
        const double square = l.ax[c] * l.ax[c] + l.ay[c] * l.ay[c] + l.az[c] * l.az[c];
        near[c] = square < cut * cut;
    }
}

void walls_choose(struct sim *s, int run, int first, int last)
{
    struct slots *const l = &s->neighbours.walls;
    const int from = l->begin[first], to = l->begin[last];
    l->n_active[run] = 0;
    if (from == to)
        return;
    int *const order = by_wall(s, from, to), *const active = &l->active[from];
    bool *const is_near = xalloc((size_t)(to - from), sizeof *is_near);
    for (int k = 0, end; k < to - from; k = end) {
        const int wall = s->walls.wall_of[l->other[order[k]]];
        bool near[WALL_LOOKS];
        for (end = k + 1; end < to - from && end < k + WALL_LOOKS &&
                          s->walls.wall_of[l->other[order[end]]] == wall;)
            end++;
        mark_near(s, wall, &order[k], end - k, near);
        for (int c = k; c < end; c++)
            is_near[order[c] - from] = near[c - k];
    }
    for (int slot = from; slot < to; slot++)
        if (l->live[slot] || is_near[slot - from])
            active[l->n_active[run]++] = slot;
    xfree(order);
    xfree(is_near);
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
