/* contact_wall_pack.c - active wall contacts between the slots and the blocks of the loop. */
#include "contact_wall_pack.h"

#include <string.h>
#include "contact_laws.h"
#include "contact_loop.h"
#include "sim.h"

_Static_assert((int)WALL_LOOKS == (int)TOUCH, "a block is looked at in one go");

void wall_pack_reserve(void **data, int *room, int n, size_t size)
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
    xfree(p->crowd);
    xfree(p->order);
}

void wall_pack_sort(const struct sim *s, struct wall_pack *p, int run)
{
    const struct slots *const l = &s->neighbours.walls;
    const int *const active = &l->active[l->begin[run * RUN]];
    const int n = l->n_active[run];
    int *const begin = xalloc((size_t)s->walls.n + 1, sizeof *begin);
    wall_pack_reserve((void **)&p->order, &p->order_room, n, sizeof *p->order);
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
    b->look.n = (b->n + TOUCH_LANES - 1) / TOUCH_LANES * TOUCH_LANES;
    for (int c = b->n; c < TOUCH; c++) {
        b->i[c] = b->i[last];
        b->slot[c] = b->slot[last];
        b->ball[c] = b->ball[last];
        b->look.element[c] = b->look.element[last];
        b->depth[c] = -(real)INFINITY;
        for (int row = 0; row < rows; row++)
            b->memory[row][c] = 0.0;
    }
}

static void note_crowd(struct wall_pack *p, int from, int to)
{
    if (to - from < 2)
        return;
    if (p->n_crowds == p->crowd_room) {
        const int more = 2 * p->crowd_room + 16;
        p->crowd = xrealloc(p->crowd, (size_t)p->crowd_room, (size_t)more, sizeof *p->crowd);
        p->crowd_room = more;
    }
    p->crowd[p->n_crowds++] = (struct wall_crowd){from, to};
}

/* Blocks that entries fill; a block is of one wall. */
static int blocks_of(const struct sim *s, const struct wall_entry *e, int n)
{
    int blocks = 0, of_wall = 0;
    for (int k = 0; k < n; k++) {
        const int wall = s->walls.wall_of[s->neighbours.walls.other[e[k].slot]];
        const bool turn =
            k == 0 || wall != s->walls.wall_of[s->neighbours.walls.other[e[k - 1].slot]];
        of_wall = turn ? 0 : of_wall + 1;
        blocks += of_wall % TOUCH == 0;
    }
    return blocks;
}

void wall_pack_build(struct sim *s, struct wall_pack *p, const struct wall_entry *e, int n,
                     void (*recall_lane)(const struct sim *s, struct wall_block *b, int c))
{
    const struct slots *const l = &s->neighbours.walls;
    const int rows = laws_rows();
    p->n_blocks = p->n_crowds = 0;
    if (n == 0)
        return;
    wall_pack_reserve((void **)&p->data, &p->room, blocks_of(s, e, n), wall_pack_size(rows));
    struct wall_block *b = NULL;
    int owner = -1, ball = 0, from = 0, at = 0;
    for (int k = 0; k < n; k++) {
        const int slot = e[k].slot, wall = s->walls.wall_of[l->other[slot]];
        const bool turn = !b || wall != b->wall;
        const bool apart = turn || l->owner[slot] != owner || e[k].ball != ball;
        if (apart)
            note_crowd(p, from, at);
        if (turn || b->n == TOUCH) {
            if (b)
                close_block(b, rows);
            at = p->n_blocks * TOUCH;
            b = wall_pack_block(p, p->n_blocks++, rows);
            b->wall = wall;
            b->n = 0;
            memset(b->off, 0, sizeof b->off);
        }
        if (apart) {
            from = at;
            owner = l->owner[slot];
            ball = e[k].ball;
        }
        const int c = b->n++;
        b->i[c] = owner;
        b->slot[c] = slot;
        b->ball[c] = ball;
        b->look.element[c] = l->other[slot] - s->walls.first[wall];
        recall_lane(s, b, c);
        at++;
    }
    note_crowd(p, from, at);
    close_block(b, rows);
}

void wall_pack_fill(struct sim *s, int run)
{
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    wall_pack_sort(s, p, run);
    wall_pack_build(s, p, p->order, p->n_order, recall);
}

void wall_pack_put_back(struct sim *s, int run)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct slots *const l = &nb->walls;
    const int rows = nb->rows;
    const real reach = (real)nb->reach;
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    for (int k = 0; k < p->n_blocks; k++) {
        const struct wall_block *const b = wall_pack_block(p, k, rows);
        for (int c = 0; c < b->n; c++) {
            const int slot = b->slot[c];
            l->live[slot] = (unsigned char)((b->depth[c] > -reach) + (b->depth[c] > (real)0.0));
            for (int row = 0; row < rows; row++)
                l->memory[(size_t)slot * rows + row] = b->memory[row][c];
        }
    }
    p->n_blocks = p->n_crowds = 0;
}
