/* contact_sphere_walls.c - the wall contacts of spheres: which elements count is told by
 * contact_facing.c.
 *
 * On coplanar triangles a grain feels one plane, at a convex edge one contact, at a concave one two.
 * When a contact goes over to another element of its wall, it takes its memory along: to the one that
 * is new, from the one that ended whose normal is nearest. Everything is decided grain by grain in the
 * order of the slots: the same on any number of threads. */
#include "contact_walls.h"

#include <string.h>
#include "contact_facing.h"
#include "contact_loop.h"
#include "sim.h"

#define SAME 1e-6 /* of the radius: points nearer than this coincide */

enum { FEW = 64 };

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
static void decide(struct sim *s, struct facing *f, int n, double radius)
{
    const double reach = radius + s->neighbours.reach;
    struct slots *const l = &s->neighbours.walls;
    for (int k = 0; k < n; k++)
        f[k].counts = f[k].distance < reach && !facing_hidden(s, f, n, k, SAME * radius);
    if (n == 1 && (f[0].counts || !f[0].live))
        return;
    for (int k = 0; k < n && n > 1; k++)
        if (f[k].counts && !f[k].live)
            pass_memory(s, f, n, k);
    for (int k = 0; k < n; k++)
        if (!f[k].counts && l->live[f[k].slot])
            end_contact(&s->neighbours, l, f[k].slot);
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
            facing_turn(s, f, w,
                        &s->neighbours.walls.memory[(size_t)f->slot * s->neighbours.rows]);
    }
    b->slot[c] = f->slot;
    b->c.i[c] = b->c.j[c] = i;
    b->c.wall[c] = w;
    b->wall[c] = f->wall;
    b->arm[c] = f->arm;
    b->curve[c] =
        f->curvature == 0.0 ? 0.0 : (real)(1.0 / facing_matched(r, f->curvature) - 1.0 / r);
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
            f[n] = facing_look(s, active[k], l->other[active[k]], s->grains.pos[i]);
            f[n].live = l->live[active[k]];
            n += f[n].live || f[n].distance < s->grains.radius[i] + reach;
        }
        if (n > 0)
            decide(s, f, n, s->grains.radius[i]);
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
