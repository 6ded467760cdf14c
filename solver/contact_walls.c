/* contact_walls.c - which of the elements of walls that a grain touches count, and with what.
 *
 * Of the elements of one wall (the triangles of a mesh, the sides of a box, a tube and its caps) a
 * sphere touches the surface where its distance to the whole of them is least, nearby: at each inner
 * point of a face whose normal goes through the centre, and at an edge or vertex only if no other
 * element that has this point too comes nearer. So
 *   - nearest points that coincide are one contact: that of the face, if one of them is a face;
 *   - that of an edge or vertex which lies on another element does not count if the grain is nearer to
 *     that one, or if that one is met on its face.
 * On coplanar triangles a grain therefore feels one plane, at a convex edge one contact, at a concave
 * one two. When a contact goes over to another element of its wall, it takes its memory along: to the
 * one that is new, from the one that ended whose normal is nearest. Everything is decided grain by
 * grain in the order of the slots: the same on any number of threads. */
#include "contact_walls.h"

#include <string.h>
#include "../contact/contact.h"
#include "contact_loop.h"
#include "sim.h"

#define SAME 1e-6 /* of the radius: points nearer than this coincide */

enum { FEW = 64 };

/* An element that a grain touches, or has just left. */
struct facing {
    int slot, wall, local;
    vec3 away;       /* m, from its nearest point to the centre */
    double distance; /* m */
    double curvature;
    vec3 arm;
    enum wall_part part;
    bool counts, live;
};

void walls_choose(struct sim *s, int run, int first, int last)
{
    struct neighbours *const nb = &s->neighbours;
    struct slots *const l = &nb->walls;
    const double margin = nb->reach + nb->inner;
    int *const active = &l->active[l->begin[first]];
    int n = 0;
    for (int slot = l->begin[first]; slot < l->begin[last]; slot++) {
        const int i = l->owner[slot];
        const vec3 d = wall_see(s, l->other[slot], s->grains.pos[i]).view.away;
        const double cut = s->grains.radius[i] + margin;
        active[n] = slot;
        n += l->live[slot] || v3_dot(d, d) < cut * cut;
    }
    l->n_active[run] = n;
}

/* The nearest point of k lies on element m too: the distance of m from it is nothing. */
static bool shares(const struct sim *s, const struct facing *k, const struct facing *m,
                   vec3 centre, double tolerance)
{
    const vec3 point = v3_sub(centre, k->away);
    const int element = s->walls.first[m->wall] + m->local;
    return v3_norm(wall_see(s, element, point).view.away) < tolerance;
}

/* Of two elements that meet the grain in the same point: does m go before k? */
static bool before(const struct facing *m, const struct facing *k)
{
    if (m->part != k->part)
        return m->part < k->part;
    return m->distance < k->distance || (m->distance == k->distance && m->slot < k->slot);
}

static bool hidden(const struct sim *s, const struct facing *f, int n, int k, vec3 centre,
                   double tolerance)
{
    for (int m = 0; m < n; m++) {
        if (m == k || f[m].wall != f[k].wall)
            continue;
        const vec3 apart = v3_sub(f[k].away, f[m].away);
        if (v3_dot(apart, apart) < tolerance * tolerance) {
            if (before(&f[m], &f[k]))
                return true;
            continue;
        }
        const bool nearer = f[m].part == WALL_FACE || f[m].distance < f[k].distance;
        if (f[k].part != WALL_FACE && nearer && shares(s, &f[k], &f[m], centre, tolerance))
            return true;
    }
    return false;
}

/* A new contact takes the memory of one of the same wall that has just ended. */
static void pass_memory(struct sim *s, struct facing *f, int n, int k)
{
    struct slots *const l = &s->neighbours.walls;
    const size_t size = (size_t)s->neighbours.rows * sizeof *l->memory;
    double nearest = 0.0;
    int from = -1;
    for (int m = 0; m < n; m++) {
        if (f[m].counts || !f[m].live || f[m].wall != f[k].wall)
            continue;
        const double cosine = v3_dot(f[m].away, f[k].away) / (f[m].distance * f[k].distance);
        if (cosine > nearest) {
            nearest = cosine;
            from = m;
        }
    }
    if (from < 0)
        return;
    memcpy(&l->memory[(size_t)f[k].slot * s->neighbours.rows],
           &l->memory[(size_t)f[from].slot * s->neighbours.rows], size);
    l->live[f[k].slot] = l->live[f[from].slot];
    f[from].live = false; /* given away */
}

static void end_contact(const struct neighbours *nb, struct slots *l, int slot)
{
    l->live[slot] = 0;
    memset(&l->memory[(size_t)slot * nb->rows], 0, (size_t)nb->rows * sizeof *l->memory);
}

/* Marks what counts, and hands memory on. */
static void decide(struct sim *s, struct facing *f, int n, vec3 centre, double radius)
{
    const double reach = radius + s->neighbours.reach;
    struct slots *const l = &s->neighbours.walls;
    for (int k = 0; k < n; k++)
        f[k].counts = f[k].distance < reach && !hidden(s, f, n, k, centre, SAME * radius);
    if (n == 1 && (f[0].counts || !f[0].live))
        return;
    for (int k = 0; k < n && n > 1; k++)
        if (f[k].counts && !f[k].live)
            pass_memory(s, f, n, k);
    for (int k = 0; k < n; k++)
        if (!f[k].counts && l->live[f[k].slot])
            end_contact(&s->neighbours, l, f[k].slot);
}

/* Radius of a sphere on a plane that touches like this one on a surface that is curved one way, by the
 * geometric mean of the two radii of curvature [Johnson85, eq. 4.28]. */
static double matched(double radius, double curvature)
{
    return radius / sqrt(fmax(1.0 + curvature * radius, 0.01));
}

/* What the contact remembers turns with the wall about the normal; with the normal, laws turn it. */
static void turn_memory(struct sim *s, const struct facing *f, const struct wall *w)
{
    if (contact_history < 3)
        return;
    const vec3 n = v3_scale(1.0 / f->distance, f->away);
    const double angle = v3_dot(w->pose.half_spin, n) * s->run.dt;
    real *const h = &s->neighbours.walls.memory[(size_t)f->slot * s->neighbours.rows];
    const vec3 held = v3((double)h[0], (double)h[1], (double)h[2]);
    if (angle == 0.0)
        return;
    const vec3 part = v3_scale(v3_dot(held, n), n), flat = v3_sub(held, part);
    const vec3 turned =
        v3_add(part, v3_axpy(v3_scale(cos(angle), flat), sin(angle), v3_cross(n, flat)));
    h[0] = (real)turned.x;
    h[1] = (real)turned.y;
    h[2] = (real)turned.z;
}

static void enter(struct sim *s, struct block *b, int i, const struct facing *f)
{
    const struct wall *const w = &s->walls.wall[f->wall];
    const struct body *const body = &s->bodies[i];
    const int c = b->n++;
    const double r = (double)body->spin[3];
    vec3 half = w->motion.surface, full = half, spin = v3(0.0, 0.0, 0.0);
    if (w->motion.moves && !s->walls.still) {
        const vec3 lever = v3_sub(f->arm, f->away); /* pivot to the contact point */
        const struct wall_pose *const p = &w->pose;
        half = v3_add(half, v3_add(p->half, v3_cross(p->half_spin, lever)));
        full = v3_add(full, v3_add(p->velocity, v3_cross(p->spin, lever)));
        spin = p->half_spin;
        if (f->live)
            turn_memory(s, f, w);
    }
    b->slot[c] = f->slot;
    b->c.i[c] = b->c.j[c] = i;
    b->c.wall[c] = w;
    b->wall[c] = f->wall;
    b->arm[c] = f->arm;
    b->curve[c] = f->curvature == 0.0 ? 0.0 : (real)(1.0 / matched(r, f->curvature) - 1.0 / r);
    b->c.dx[c] = (real)f->away.x;
    b->c.dy[c] = (real)f->away.y;
    b->c.dz[c] = (real)f->away.z;
    b->t.r_i[c] = body->spin[3];
    b->t.r_j[c] = 0.0;
    b->inv_m[c] = body->vel[3];
    b->t.vx[c] = body->vel[0] - (real)half.x;
    b->t.vy[c] = body->vel[1] - (real)half.y;
    b->t.vz[c] = body->vel[2] - (real)half.z;
    b->vx[c] = body->full[0] - (real)full.x;
    b->vy[c] = body->full[1] - (real)full.y;
    b->vz[c] = body->full[2] - (real)full.z;
    b->px[c] = body->spin[0];
    b->py[c] = body->spin[1];
    b->pz[c] = body->spin[2];
    b->qx[c] = (real)spin.x;
    b->qy[c] = (real)spin.y;
    b->qz[c] = (real)spin.z;
    b->t.pair[c] = (int)body->full[3] * s->grains.n_materials + w->material;
}

static void look(const struct sim *s, int slot, int i, struct facing *f)
{
    const struct slots *const l = &s->neighbours.walls;
    const int element = l->other[slot], wall = s->walls.wall_of[element];
    const struct wall_seen seen = wall_see(s, element, s->grains.pos[i]);
    *f = (struct facing){.slot = slot,
                         .wall = wall,
                         .local = element - s->walls.first[wall],
                         .away = seen.view.away,
                         .distance = v3_norm(seen.view.away),
                         .curvature = seen.view.curvature,
                         .arm = seen.arm,
                         .part = seen.view.part,
                         .live = l->live[slot]};
}

void walls_enter(struct sim *s, int run, struct block *b, const struct target *to)
{
    const struct slots *const l = &s->neighbours.walls;
    const int *const active = &l->active[l->begin[to->first]];
    const double reach = s->neighbours.reach;
    b->n = 0;
    for (int k = 0; k < l->n_active[run];) {
        const int i = l->owner[active[k]];
        int end = k;
        while (end < l->n_active[run] && l->owner[active[end]] == i)
            end++;
        struct facing few[FEW], *const f =
                                    end - k > FEW ? xalloc((size_t)(end - k), sizeof *f) : few;
        int n = 0;
        for (; k < end; k++) {
            look(s, active[k], i, &f[n]);
            n += f[n].live || f[n].distance < s->grains.radius[i] + reach;
        }
        if (n > 0)
            decide(s, f, n, s->grains.pos[i], s->grains.radius[i]);
        for (int m = 0; m < n; m++) {
            if (!f[m].counts)
                continue;
            enter(s, b, i, &f[m]);
            if (b->n == TOUCH)
                block_work_walls(s, b, to);
        }
        if (f != few)
            xfree(f);
    }
    block_work_walls(s, b, to);
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
