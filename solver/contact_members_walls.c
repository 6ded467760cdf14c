/* contact_members_walls.c - member spheres against walls: in the blocks of contact_sphere_walls.c, a
 * contact for each member and element that come close.
 *
 * A wall slot keeps the memory of its contacts in records (contact_points.h) by the number of the
 * member. Which of the elements of a wall count is decided member by member. */
#include "contact_members.h"

#include <string.h>
#include "attitude.h"
#include "contact_facing.h"
#include "contact_points.h"
#include "contact_spheres.h"
#include "contact_wall_pack.h"

/* Entries that grow. */
struct entries {
    int n, room;
    struct wall_entry *e;
};

static void add_entry(struct entries *all, int slot, int ball)
{
    if (all->n == all->room) {
        const int more = 2 * all->room + 64;
        all->e = xrealloc(all->e, (size_t)all->room, (size_t)more, sizeof *all->e);
        all->room = more;
    }
    all->e[all->n++] = (struct wall_entry){slot, ball, ALONE};
}

static void recall(const struct sim *s, struct wall_block *b, int c)
{
    const struct cut cut = points_cut(s);
    const int slot = b->slot[c], first = s->contacts->members.first[s->grains.kind[b->i[c]]];
    const real *const record =
        members_record(&cut, &s->neighbours.walls.memory[(size_t)slot * s->neighbours.rows],
                       b->ball[c] - first);
    const real was = record && record_overlapped(record) ? (real)INFINITY : (real)0.0;
    b->depth[c] = record ? was : -(real)INFINITY;
    for (int row = 0; row < cut.rows; row++)
        b->memory[row][c] = record ? record[RECORD_HEAD + row] : (real)0.0;
}

/* The members of a grain that come close to elements of one wall: those of slots from..to-1. */
static void find(const struct sim *s, const struct wall_entry *slot, int n, struct entries *all)
{
    const struct slots *const l = &s->neighbours.walls;
    const int i = l->owner[slot->slot];
    const struct shape_pose pose = points_pose(s, i);
    const double margin = neighbours_inner_wall(&s->neighbours, i);
    int balls = 0;
    const struct shape_ball *const ball = shape.balls(pose.species, &balls);
    const int first = s->contacts->members.first[pose.species];
    for (int q = 0; q < balls; q++) {
        const vec3 c = mat3_turn(&pose.turn, v3_scale(pose.size, ball[q].centre));
        const double near = pose.size * ball[q].radius + margin;
        const vec3 x = v3_add(s->grains.pos[i], c);
        for (int k = 0; k < n; k++) {
            struct wall_seen seen;
            wall_look(s, l->other[slot[k].slot], &x, &seen);
            if (v3_dot(seen.view.away, seen.view.away) < near * near)
                add_entry(all, slot[k].slot, first + q);
        }
    }
}

static const struct ball_walls balls;

void members_walls_take(struct sim *s, int run)
{
    const struct slots *const l = &s->neighbours.walls;
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    struct entries all = {0};
    wall_pack_sort(s, p, run);
    for (int k = 0, to; k < p->n_order; k = to) {
        const int slot = p->order[k].slot, wall = s->walls.wall_of[l->other[slot]];
        for (to = k + 1; to < p->n_order && l->owner[p->order[to].slot] == l->owner[slot] &&
                         s->walls.wall_of[l->other[p->order[to].slot]] == wall;)
            to++;
        find(s, &p->order[k], to - k, &all);
    }
    wall_pack_build(s, p, all.e, all.n, &balls, recall);
    xfree(all.e);
}

void members_walls_put_back(struct sim *s, int run)
{
    struct slots *const l = &s->neighbours.walls;
    const struct cut cut = points_cut(s);
    const int *const first = s->contacts->members.first;
    const real reach = (real)s->neighbours.reach;
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    for (int k = 0; k < p->n_order; k++) {
        l->live[p->order[k].slot] = 0;
        points_use(&cut, &l->memory[(size_t)p->order[k].slot * s->neighbours.rows], 0);
    }
    for (int k = 0; k < p->n_blocks; k++) {
        const struct wall_block *const b = wall_pack_block(p, k, cut.rows);
        for (int c = 0; c < b->n; c++) {
            real *const memory = &l->memory[(size_t)b->slot[c] * s->neighbours.rows];
            const int used = points_used(&cut, memory);
            const bool over = b->depth[c] > (real)0.0;
            unsigned char *const live = &l->live[b->slot[c]];
            if (!(b->depth[c] > -reach))
                continue;
            if (used >= cut.most) {
                s->contacts->report[run].points = used + 1;
                continue;
            }
            real *const record = points_record(&cut, memory, used);
            *live = over || *live == LIVE_OVERLAP ? LIVE_OVERLAP : LIVE_REACH;
            points_use(&cut, memory, used + 1);
            record[0] = (real)(2 * (b->ball[c] - first[s->grains.kind[b->i[c]]] + 1) + over);
            record[1] = record[2] = record[3] = 0.0;
            for (int row = 0; row < cut.rows; row++)
                record[RECORD_HEAD + row] = b->memory[row][c];
        }
    }
    p->n_blocks = p->n_crowds = p->n_entries = p->n_order = 0;
}

static void place(const struct sim *s, const int *grain, const int *ball, int n,
                  struct ball_places *p)
{
    for (int c = 0; c < n; c++) {
        const struct attitude *const a = &s->attitudes[grain[c]];
        const real4 row = s->contacts->members.row[ball[c]];
        const real size = a->spin[3];
        const struct offset o = members_offset(a->turn[0], a->turn[1], a->turn[2], a->turn[3],
                                               size, row[0], row[1], row[2]);
        p->off[0][c] = o.x;
        p->off[1][c] = o.y;
        p->off[2][c] = o.z;
        p->radius[c] = size * row[3];
        p->own[0][c] = fma(a->spin[1], o.z, -a->spin[2] * o.y);
        p->own[1][c] = fma(a->spin[2], o.x, -a->spin[0] * o.z);
        p->own[2][c] = fma(a->spin[0], o.y, -a->spin[1] * o.x);
    }
}

static void enter(struct block *b, const struct ball_places *p)
{
    struct touch *const t = &b->t;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real x = p->off[0][c], y = p->off[1][c], z = p->off[2][c];
        const real px = b->px[c], py = b->py[c], pz = b->pz[c];
        t->r_i[c] = p->radius[c];
        t->vx[c] += fma(py, z, -pz * y);
        t->vy[c] += fma(pz, x, -px * z);
        t->vz[c] += fma(px, y, -py * x);
        b->vx[c] += p->own[0][c];
        b->vy[c] += p->own[1][c];
        b->vz[c] += p->own[2][c];
    }
}

static void leave(struct block *b, const struct ball_places *p, double (*arm)[TOUCH])
{
#pragma omp simd
    for (int c = 0; c < b->t.n; c++) {
        b->l.ix[c] += p->off[0][c];
        b->l.iy[c] += p->off[1][c];
        b->l.iz[c] += p->off[2][c];
        arm[0][c] -= (double)p->off[0][c];
        arm[1][c] -= (double)p->off[1][c];
        arm[2][c] -= (double)p->off[2][c];
    }
}

static const struct ball_walls balls = {
    .place = place, .enter = enter, .leave = leave, .report = members_report};

/* Of the contacts with walls that are too deep the last. */
static void find_deep(const struct sim *s, int run, struct report *r)
{
    const struct wall_pack *const p = &s->contacts->wall_pack[run];
    for (int k = 0; k < p->n_blocks; k++) {
        const struct wall_block *const b = wall_pack_block(p, k, laws_rows());
        for (int c = 0; c < b->n; c++) {
            const real radius =
                s->attitudes[b->i[c]].spin[3] * s->contacts->members.row[b->ball[c]][3];
            const double allowed = s->run.overlap_max * (double)radius;
            if (!((double)b->depth[c] > allowed))
                continue;
            r->i = b->i[c];
            r->j = -1 - b->wall;
            r->deep = (double)b->depth[c];
            r->allowed = allowed;
        }
    }
}

void members_walls(struct sim *s, int run, struct block *b, const struct target *to)
{
    const struct slots *const l = &s->neighbours.walls;
    const struct report *const r = to->report;
    const bool before = r->too_deep;
    if (to->asked)
        members_forget_reports(s, true, &l->active[l->begin[run * s->neighbours.run]],
                               l->n_active[run]);
    ball_walls(s, run, b, to, &balls);
    if (r->too_deep && !before)
        find_deep(s, run, to->report);
}
