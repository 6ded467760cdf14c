/* contact_wall_pack.c - active wall contacts between the slots and the blocks of the loop. */
#include "contact_wall_pack.h"

#include <string.h>
#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_wall_crowds.h"
#include "sim.h"

_Static_assert((int)WALL_LOOKS == (int)TOUCH, "a block is looked at in one go");

/* *data has room for n at least; what was there is lost. */
static void reserve(void **data, int *room, int n, size_t size)
{
    if (n <= *room)
        return;
    *room = n + n / 4 + 1;
    xfree(*data);
    *data = xalloc((size_t)*room, size);
}

void wall_pack_free(struct wall_pack *p)
{
    xfree(p->data);
    xfree(p->entry);
    xfree(p->crowd);
    xfree(p->lanes);
    xfree(p->order);
}

void wall_pack_sort(const struct sim *s, struct wall_pack *p, int run)
{
    const struct slots *const l = &s->neighbours.walls;
    const int *const active = &l->active[l->begin[run * s->neighbours.run]];
    const int n = l->n_active[run];
    int *const begin = xalloc((size_t)s->walls.n + 1, sizeof *begin);
    reserve((void **)&p->order, &p->order_room, n, sizeof *p->order);
    p->n_order = n;
    for (int k = 0; k < n; k++)
        begin[s->walls.wall_of[l->other[active[k]]] + 1]++;
    for (int w = 0; w < s->walls.n; w++)
        begin[w + 1] += begin[w];
    for (int k = 0; k < n; k++)
        p->order[begin[s->walls.wall_of[l->other[active[k]]]]++].slot = active[k];
    xfree(begin);
}

/* What is known of a slot's overlap at the last step: none; within the reach of a law; some. */
static real depth_before(const struct slots *l, int slot)
{
    const unsigned char live = l->live[slot];
    return live == 0 ? -(real)INFINITY : live == LIVE_OVERLAP ? (real)INFINITY : (real)0.0;
}

static void recall(const struct sim *s, struct wall_block *b, int c)
{
    const struct slots *const l = &s->neighbours.walls;
    const int rows = s->neighbours.rows, slot = b->slot[c];
    b->depth[c] = depth_before(l, slot);
    for (int row = 0; row < rows; row++)
        b->memory[row][c] = l->memory[(size_t)slot * rows + row];
}

/* The lanes behind the last contact repeat it, without what it remembers. */
static void close_block(struct wall_block *b, int rows)
{
    const int last = b->n - 1;
    for (int c = b->n; c < TOUCH && last >= 0; c++) {
        b->i[c] = b->i[last];
        b->slot[c] = b->slot[last];
        b->ball[c] = b->ball[last];
        b->element[c] = b->element[last];
        b->counts[c] = 0;
        for (int k = 0; k < 6; k++)
            b->plane[k][c] = b->plane[k][last];
        b->depth[c] = -(real)INFINITY;
        for (int row = 0; row < rows; row++)
            b->memory[row][c] = 0.0;
    }
}

static int blocks_for(int n)
{
    return (n + TOUCH - 1) / TOUCH;
}

/* The entries of one wall from k on. */
struct part {
    int wall, from, to;
    int n[LANE_KINDS]; /* how many of each kind */
};

static int wall_of(const struct sim *s, const struct wall_entry *e)
{
    return s->walls.wall_of[s->neighbours.walls.other[e->slot]];
}

int wall_entries_end(const struct sim *s, const struct wall_entry *e, int k, int n)
{
    const int *const owner = s->neighbours.walls.owner;
    int end = k + 1;
    while (end < n && e[end].ball == e[k].ball && owner[e[end].slot] == owner[e[k].slot] &&
           wall_of(s, &e[end]) == wall_of(s, &e[k]))
        end++;
    return end;
}

static struct part next_part(const struct sim *s, const struct wall_entry *e, int from, int n)
{
    struct part p = {.wall = wall_of(s, &e[from]), .from = from, .to = from};
    for (; p.to < n && wall_of(s, &e[p.to]) == p.wall; p.to++)
        p.n[e[p.to].kind]++;
    return p;
}

static void make_room(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                      int n)
{
    int blocks = 0, entries = 0, crowds = 0, lanes = 0;
    for (int k = 0; k < n;) {
        const struct part of = next_part(s, e, k, n);
        for (int kind = 0; kind < LANE_KINDS; kind++)
            blocks += blocks_for(of.n[kind]);
        entries += of.n[OF_CROWD];
        crowds += of.n[OF_CROWD] / 2;
        lanes += of.n[OF_CROWD] > 0;
        k = of.to;
    }
    reserve((void **)&p->data, &p->room, blocks, wall_pack_size(laws_rows()));
    reserve((void **)&p->entry, &p->entry_room, entries, sizeof *p->entry);
    reserve((void **)&p->crowd, &p->crowd_room, crowds, sizeof *p->crowd);
    reserve((void **)&p->lanes, &p->lanes_room, lanes, sizeof *p->lanes);
}

static struct wall_block *new_block(struct wall_pack *p, int wall, enum wall_lane kind)
{
    struct wall_block *const b = wall_pack_block(p, p->n_blocks++, laws_rows());
    b->wall = wall;
    b->n = 0;
    b->kind = kind;
    return b;
}

static void write_lane(const struct sim *s, struct wall_block *b, int c,
                       const struct wall_entry *e)
{
    const int element = s->neighbours.walls.other[e->slot];
    b->i[c] = s->neighbours.walls.owner[e->slot];
    b->slot[c] = e->slot;
    b->ball[c] = e->ball;
    b->element[c] = element - s->walls.first[b->wall];
    b->counts[c] = 1;
}

typedef void recall_lane(const struct sim *s, struct wall_block *b, int c);

static void write_plane(const struct sim *s, struct wall_block *b, int c, int slot)
{
    struct wall_flat plane;
    double within;
    wall_flat_at(s, s->neighbours.walls.other[slot], v3(0.0, 0.0, 0.0), &plane, &within);
    b->plane[0][c] = plane.point.x;
    b->plane[1][c] = plane.point.y;
    b->plane[2][c] = plane.point.z;
    b->plane[3][c] = plane.normal.x;
    b->plane[4][c] = plane.normal.y;
    b->plane[5][c] = plane.normal.z;
}

/* Those that nothing is to be decided about. */
static void pack_lanes(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                       const struct part *of, enum wall_lane kind, recall_lane *recalled)
{
    struct wall_block *b = NULL;
    for (int k = of->from; k < of->to; k++) {
        if (e[k].kind != kind)
            continue;
        if (!b || b->n == TOUCH)
            b = new_block(p, of->wall, kind);
        write_lane(s, b, b->n, &e[k]);
        recalled(s, b, b->n);
        if (kind == ON_FACE)
            write_plane(s, b, b->n, e[k].slot);
        b->n++;
    }
    if (b)
        close_block(b, laws_rows());
}

/* A lane where the contact lives; returns its number or -1. */
static int take_lane(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                     recall_lane *recalled)
{
    struct wall_lanes *const lanes = &p->lanes[p->n_lanes - 1];
    struct wall_block *const b =
        wall_pack_block(p, lanes->block + lanes->n / TOUCH, laws_rows());
    write_lane(s, b, b->n, e);
    recalled(s, b, b->n);
    if (!(b->depth[b->n] > -(real)s->neighbours.reach))
        return -1;
    b->n++;
    return lanes->n++;
}

static void pack_crowds(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                        const struct part *of, recall_lane *recalled)
{
    const struct slots *const l = &s->neighbours.walls;
    const int first = p->n_blocks, lanes = p->n_lanes++;
    p->lanes[lanes] = (struct wall_lanes){.wall = of->wall, .block = first};
    for (int k = 0; k < blocks_for(of->n[OF_CROWD]); k++)
        new_block(p, of->wall, OF_CROWD);
    for (int k = of->from, end; k < of->to; k = end) {
        end = wall_entries_end(s, e, k, of->to);
        if (e[k].kind != OF_CROWD)
            continue;
        p->crowd[p->n_crowds++] =
            (struct wall_crowd){p->n_entries, p->n_entries + end - k, lanes};
        for (int m = k; m < end; m++)
            p->entry[p->n_entries++] =
                (struct crowd_entry){.i = l->owner[e[m].slot],
                                     .slot = e[m].slot,
                                     .ball = e[m].ball,
                                     .element = l->other[e[m].slot] - s->walls.first[of->wall],
                                     .patch = wall_patch(s, l->other[e[m].slot]),
                                     .lane = take_lane(s, p, &e[m], recalled)};
    }
    for (int k = first; k < p->n_blocks; k++)
        close_block(wall_pack_block(p, k, laws_rows()), laws_rows());
}

void wall_pack_build(struct sim *s, struct wall_pack *p, struct wall_entry *e, int n,
                     const struct ball_walls *balls, recall_lane *recalled)
{
    n = wall_crowds_thin(s, e, n, balls);
    p->n_blocks = p->n_crowds = p->n_lanes = p->n_entries = 0;
    make_room(s, p, e, n);
    for (int k = 0; k < n;) {
        const struct part of = next_part(s, e, k, n);
        pack_lanes(s, p, e, &of, ON_FACE, recalled);
        pack_lanes(s, p, e, &of, ALONE, recalled);
        if (of.n[OF_CROWD] > 0)
            pack_crowds(s, p, e, &of, recalled);
        k = of.to;
    }
}

struct wall_block *wall_pack_lane(const struct wall_pack *p, const struct wall_crowd *crowd,
                                  int lane)
{
    return wall_pack_block(p, p->lanes[crowd->of].block + lane / TOUCH, laws_rows());
}

void wall_pack_begin(struct wall_pack *p, struct crowd_entry *e, const struct wall_crowd *crowd)
{
    const int lane = p->lanes[crowd->of].n++;
    struct wall_block *const b = wall_pack_lane(p, crowd, lane);
    const int c = b->n++;
    b->i[c] = e->i;
    b->slot[c] = e->slot;
    b->ball[c] = e->ball;
    b->element[c] = e->element;
    b->depth[c] = -(real)INFINITY;
    for (int row = 0; row < laws_rows(); row++)
        b->memory[row][c] = 0.0;
    e->lane = lane;
    close_block(b, laws_rows());
}

void wall_pack_fill(struct sim *s, int run)
{
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    wall_pack_sort(s, p, run);
    wall_pack_build(s, p, p->order, p->n_order, NULL, recall);
}

/* A contact's memory to its slot. */
static void put_back(const struct neighbours *nb, const struct wall_block *b, int c)
{
    const struct slots *const l = &nb->walls;
    const int slot = b->slot[c];
    l->live[slot] = (unsigned char)((b->depth[c] > -(real)nb->reach) + (b->depth[c] > 0.0));
    for (int row = 0; row < nb->rows; row++)
        l->memory[(size_t)slot * nb->rows + row] = b->memory[row][c];
}

void wall_pack_put_back(struct sim *s, int run)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct slots *const l = &nb->walls;
    const size_t size = (size_t)nb->rows * sizeof *l->memory;
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    for (int k = 0; k < p->n_entries; k++) {
        l->live[p->entry[k].slot] = 0;
        memset(&l->memory[(size_t)p->entry[k].slot * nb->rows], 0, size);
    }
    for (int k = 0; k < p->n_blocks; k++) {
        const struct wall_block *const b = wall_pack_block(p, k, nb->rows);
        for (int c = 0; c < b->n; c++)
            put_back(nb, b, c);
    }
    p->n_blocks = p->n_crowds = p->n_entries = 0;
}
