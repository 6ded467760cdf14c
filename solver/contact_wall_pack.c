/* contact_wall_pack.c - active wall contacts between the slots and the blocks of the loop. */
#include "contact_wall_pack.h"

#include <string.h>
#include "contact_laws.h"
#include "contact_loop.h"
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
    const int *const active = &l->active[l->begin[run * RUN]];
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
        b->of[c] = b->of[last];
        b->depth[c] = -(real)INFINITY;
        for (int row = 0; row < rows; row++)
            b->memory[row][c] = 0.0;
    }
}

static void close_entries(struct crowd_block *b)
{
    const int last = b->n - 1;
    for (int c = b->n; c < TOUCH; c++) {
        b->i[c] = b->i[last];
        b->ball[c] = b->ball[last];
        b->look.element[c] = b->look.element[last];
    }
    b->look.n = (b->n + TOUCH_LANES - 1) / TOUCH_LANES * TOUCH_LANES;
}

static int blocks_for(int n)
{
    return (n + TOUCH - 1) / TOUCH;
}

/* The entries of one wall from k on. */
struct part {
    int wall, from, to;
    int alone, crowded; /* of how many balls that are near one element; the other entries */
};

static int wall_of(const struct sim *s, const struct wall_entry *e)
{
    return s->walls.wall_of[s->neighbours.walls.other[e->slot]];
}

/* Where the entries of the ball of entry k end. */
static int end_of_ball(const struct slots *l, const struct wall_entry *e, int k, int to)
{
    int end = k + 1;
    while (end < to && e[end].ball == e[k].ball && l->owner[e[end].slot] == l->owner[e[k].slot])
        end++;
    return end;
}

static struct part next_part(const struct sim *s, const struct wall_entry *e, int from, int n)
{
    const struct slots *const l = &s->neighbours.walls;
    struct part p = {.wall = wall_of(s, &e[from]), .from = from, .to = from};
    while (p.to < n && wall_of(s, &e[p.to]) == p.wall)
        p.to++;
    for (int k = from, end; k < p.to; k = end) {
        end = end_of_ball(l, e, k, p.to);
        if (end == k + 1)
            p.alone++;
        else
            p.crowded += end - k;
    }
    return p;
}

static void make_room(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                      int n)
{
    int blocks = 0, entries = 0, crowds = 0, lanes = 0;
    for (int k = 0; k < n;) {
        const struct part of = next_part(s, e, k, n);
        blocks += blocks_for(of.alone) + blocks_for(of.crowded);
        entries += blocks_for(of.crowded);
        crowds += of.crowded / 2;
        lanes += of.crowded > 0;
        k = of.to;
    }
    reserve((void **)&p->data, &p->room, blocks, wall_pack_size(laws_rows()));
    reserve((void **)&p->entry, &p->entry_room, entries, sizeof *p->entry);
    reserve((void **)&p->crowd, &p->crowd_room, crowds, sizeof *p->crowd);
    reserve((void **)&p->lanes, &p->lanes_room, lanes, sizeof *p->lanes);
}

static struct wall_block *new_block(struct wall_pack *p, int wall, bool crowds)
{
    struct wall_block *const b = wall_pack_block(p, p->n_blocks++, laws_rows());
    b->wall = wall;
    b->n = 0;
    b->crowds = crowds;
    return b;
}

static void write_lane(const struct sim *s, struct wall_block *b, int c,
                       const struct wall_entry *e, int of)
{
    b->i[c] = s->neighbours.walls.owner[e->slot];
    b->slot[c] = e->slot;
    b->ball[c] = e->ball;
    b->of[c] = of;
}

typedef void recall_lane(const struct sim *s, struct wall_block *b, int c);

/* Balls that are near one element. */
static void pack_alone(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                       const struct part *of, recall_lane *recalled)
{
    const struct slots *const l = &s->neighbours.walls;
    struct wall_block *b = NULL;
    for (int k = of->from, end; k < of->to; k = end) {
        end = end_of_ball(l, e, k, of->to);
        if (end > k + 1)
            continue;
        if (!b || b->n == TOUCH)
            b = new_block(p, of->wall, false);
        write_lane(s, b, b->n, &e[k], l->other[e[k].slot] - s->walls.first[of->wall]);
        recalled(s, b, b->n);
        b->n++;
    }
    if (b)
        close_block(b, laws_rows());
}

/* A lane where the contact lives; returns its number or -1. */
static int take_lane(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                     int entry, recall_lane *recalled)
{
    struct wall_lanes *const lanes = &p->lanes[p->n_lanes - 1];
    struct wall_block *const b =
        wall_pack_block(p, lanes->block + lanes->n / TOUCH, laws_rows());
    write_lane(s, b, b->n, e, entry);
    recalled(s, b, b->n);
    if (!(b->depth[b->n] > -(real)s->neighbours.reach))
        return -1;
    b->n++;
    return lanes->n++;
}

static struct crowd_block *new_entries(struct wall_pack *p, int wall)
{
    struct crowd_block *const b = &p->entry[p->crowd_blocks++];
    b->wall = wall;
    b->n = 0;
    memset(&b->places, 0, sizeof b->places);
    return b;
}

/* Balls that are near several. */
static void pack_crowds(const struct sim *s, struct wall_pack *p, const struct wall_entry *e,
                        const struct part *of, recall_lane *recalled)
{
    const struct slots *const l = &s->neighbours.walls;
    struct crowd_block *b = NULL;
    int entry = p->crowd_blocks * TOUCH;
    p->lanes[p->n_lanes++] = (struct wall_lanes){.block = p->n_blocks};
    for (int k = 0; k < blocks_for(of->crowded); k++)
        new_block(p, of->wall, true);
    for (int k = of->from, end; k < of->to; k = end) {
        end = end_of_ball(l, e, k, of->to);
        if (end == k + 1)
            continue;
        p->crowd[p->n_crowds++] = (struct wall_crowd){entry, entry + end - k, p->n_lanes - 1};
        for (int m = k; m < end; m++, entry++) {
            if (!b || b->n == TOUCH)
                b = new_entries(p, of->wall);
            const int c = b->n++;
            b->i[c] = l->owner[e[m].slot];
            b->slot[c] = e[m].slot;
            b->ball[c] = e[m].ball;
            b->look.element[c] = l->other[e[m].slot] - s->walls.first[of->wall];
            b->lane[c] = take_lane(s, p, &e[m], entry, recalled);
            if (b->n == TOUCH)
                close_entries(b);
        }
    }
    close_entries(b);
    for (int k = p->lanes[p->n_lanes - 1].block; k < p->n_blocks; k++)
        close_block(wall_pack_block(p, k, laws_rows()), laws_rows());
}

void wall_pack_build(struct sim *s, struct wall_pack *p, const struct wall_entry *e, int n,
                     recall_lane *recalled)
{
    p->n_blocks = p->n_crowds = p->n_lanes = p->crowd_blocks = 0;
    make_room(s, p, e, n);
    for (int k = 0; k < n;) {
        const struct part of = next_part(s, e, k, n);
        if (of.alone > 0)
            pack_alone(s, p, e, &of, recalled);
        if (of.crowded > 0)
            pack_crowds(s, p, e, &of, recalled);
        k = of.to;
    }
}

void wall_pack_begin(struct wall_pack *p, struct crowd_block *e, int c, int entry, int of)
{
    struct wall_lanes *const lanes = &p->lanes[of];
    const int lane = lanes->n++, rows = laws_rows();
    struct wall_block *const b = wall_pack_block(p, lanes->block + lane / TOUCH, rows);
    const int at = b->n++;
    b->i[at] = e->i[c];
    b->slot[at] = e->slot[c];
    b->ball[at] = e->ball[c];
    b->of[at] = entry;
    b->depth[at] = -(real)INFINITY;
    for (int row = 0; row < rows; row++)
        b->memory[row][at] = 0.0;
    e->lane[c] = lane;
    close_block(b, rows);
}

void wall_pack_fill(struct sim *s, int run)
{
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    wall_pack_sort(s, p, run);
    wall_pack_build(s, p, p->order, p->n_order, recall);
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
    for (int k = 0; k < p->crowd_blocks; k++)
        for (int c = 0; c < p->entry[k].n; c++) {
            const int slot = p->entry[k].slot[c];
            l->live[slot] = 0;
            memset(&l->memory[(size_t)slot * nb->rows], 0, size);
        }
    for (int k = 0; k < p->n_blocks; k++) {
        const struct wall_block *const b = wall_pack_block(p, k, nb->rows);
        for (int c = 0; c < b->n; c++)
            put_back(nb, b, c);
    }
    p->n_blocks = p->n_crowds = p->crowd_blocks = 0;
}
