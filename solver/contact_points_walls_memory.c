/* contact_points_walls_memory.c - what contacts of grains of any shape with walls remember: records of
 * their slots (contact_points.h), found by id, or taken over from one that ended near by on the same wall. */
#include "contact_points_walls.h"

#include <string.h>

#define CLOSE 0.1 /* of the size: as in contact_points.c */

/* Whether some meeting goes on with this record. */
static bool goes_on(const struct meetings *all, const real *record)
{
    for (int k = 0; k < all->n; k++)
        if (all->m[k].record == record)
            return true;
    return false;
}

static void find_own(const struct sim *s, const struct cut *cut, struct meetings *all)
{
    const struct slots *const l = &s->neighbours.walls;
    for (int k = 0; k < all->n; k++) {
        struct meeting *const m = &all->m[k];
        real *const memory = &l->memory[(size_t)m->f.slot * s->neighbours.rows];
        for (int r = 0; r < points_used(cut, memory) && !m->record; r++) {
            real *const at = points_record(cut, memory, r);
            if (record_id(at) == m->p.id && !goes_on(all, at))
                m->record = at;
        }
        m->new = !m->record;
    }
}

/* A record of a contact that ended, near the new one on the same wall. */
static real *left_near(const struct sim *s, const struct cut *cut, const struct meetings *all,
                       const struct around *a, const struct meeting *m)
{
    const struct slots *const l = &s->neighbours.walls;
    double nearest = CLOSE * a->pose.size * (CLOSE * a->pose.size);
    real *best = NULL;
    for (int k = 0; k < a->n; k++) {
        if (s->walls.wall_of[l->other[a->slot[k]]] != m->f.wall || !l->live[a->slot[k]])
            continue;
        real *const memory = &l->memory[(size_t)a->slot[k] * s->neighbours.rows];
        for (int r = 0; r < points_used(cut, memory); r++) {
            real *const at = points_record(cut, memory, r);
            const vec3 d = v3_sub(m->place, v3((double)at[1], (double)at[2], (double)at[3]));
            if (at[0] == (real)0.0 || v3_dot(d, d) >= nearest || goes_on(all, at))
                continue;
            nearest = v3_dot(d, d);
            best = at;
        }
    }
    return best;
}

void meetings_remember(struct sim *s, const struct cut *cut, struct meetings *all,
                       const struct around *a, struct report *report)
{
    const struct slots *const l = &s->neighbours.walls;
    const size_t size = (size_t)(RECORD_HEAD + cut->rows);
    if ((size_t)all->n * size > all->taken_room) {
        all->taken_room = 2 * (size_t)all->n * size;
        xfree(all->taken);
        all->taken = xalloc(all->taken_room, sizeof *all->taken);
    }
    real *const taken = all->taken;
    find_own(s, cut, all);
    for (int k = 0; k < all->n; k++) {
        real *const from = all->m[k].new ? left_near(s, cut, all, a, &all->m[k]) : NULL;
        taken[(size_t)k * size] = (real)0.0;
        if (!from)
            continue;
        memcpy(&taken[(size_t)k * size], from, size * sizeof *from);
        if (!(all->m[k].p.share > 0.0 && all->m[k].p.share < 1.0)) /* others take it too */
            memset(from, 0, size * sizeof *from);
    }
    for (int k = 0; k < a->n; k++) {
        real *const memory = &l->memory[(size_t)a->slot[k] * s->neighbours.rows];
        for (int r = 0; r < points_used(cut, memory) && l->live[a->slot[k]]; r++) {
            real *const at = points_record(cut, memory, r);
            if (at[0] != (real)0.0 && !goes_on(all, at))
                memset(at, 0, size * sizeof *at);
        }
    }
    for (int k = 0; k < all->n; k++) {
        struct meeting *const m = &all->m[k];
        real *const memory = &l->memory[(size_t)m->f.slot * s->neighbours.rows];
        int r = 0;
        if (!m->new)
            continue;
        while (r < cut->most && points_record(cut, memory, r)[0] != (real)0.0)
            r++;
        if (r == cut->most) { /* no room: the run stops */
            report->points = cut->most + 1;
            continue;
        }
        m->record = points_record(cut, memory, r);
        points_use(cut, memory,
                   r >= points_used(cut, memory) ? r + 1 : points_used(cut, memory));
        if (taken[(size_t)k * size] != (real)0.0)
            memcpy(m->record, &taken[(size_t)k * size], size * sizeof *taken);
        else
            m->record[0] = RECORD_NEW;
    }
}
