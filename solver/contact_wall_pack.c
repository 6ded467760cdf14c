/* contact_wall_pack.c - active wall contacts between the slots and the blocks of the loop. */
#include "contact_wall_pack.h"

#include "contact_loop.h"
#include "sim.h"

_Static_assert((int)WALL_LOOKS == (int)TOUCH, "a block is looked at in one go");

/* *data has room for n entries at least; what was there is lost. */
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
    xfree(p->crowd);
    xfree(p->order);
}

/* The active slots by wall, each wall's in their order; returns how many blocks they fill. */
static int sort_by_wall(const struct sim *s, struct wall_pack *p, const int *active, int n)
{
    const struct slots *const l = &s->neighbours.walls;
    int *const begin = xalloc((size_t)s->walls.n + 1, sizeof *begin);
    int blocks = 0;
    reserve((void **)&p->order, &p->order_room, n, sizeof *p->order);
    p->n_order = n;
    for (int k = 0; k < n; k++)
        begin[s->walls.wall_of[l->other[active[k]]] + 1]++;
    for (int w = 0; w < s->walls.n; w++) {
        blocks += (begin[w + 1] + TOUCH - 1) / TOUCH;
        begin[w + 1] += begin[w];
    }
    for (int k = 0; k < n; k++)
        p->order[begin[s->walls.wall_of[l->other[active[k]]]]++] = active[k];
    xfree(begin);
    return blocks;
}

/* What is known of a slot's overlap at the last step: none; within the reach of a law; some. */
static real depth_before(const struct slots *l, int slot)
{
    const unsigned char live = l->live[slot];
    return live == 0 ? -(real)INFINITY : live == LIVE_OVERLAP ? (real)INFINITY : (real)0.0;
}

static void enter(const struct sim *s, struct wall_block *b, int c, int slot)
{
    const struct slots *const l = &s->neighbours.walls;
    const int rows = s->neighbours.rows;
    b->i[c] = l->owner[slot];
    b->slot[c] = slot;
    b->look.element[c] = l->other[slot] - s->walls.first[b->wall];
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

void wall_pack_fill(struct sim *s, int run)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct slots *const l = &nb->walls;
    struct wall_pack *const p = &s->contacts->wall_pack[run];
    const int rows = nb->rows, n = l->n_active[run];
    p->n_blocks = p->n_crowds = 0;
    if (n == 0)
        return;
    const int blocks = sort_by_wall(s, p, &l->active[l->begin[run * RUN]], n);
    reserve((void **)&p->data, &p->room, blocks, wall_pack_size(rows));
    struct wall_block *b = NULL;
    int owner = -1, from = 0, at = 0;
    for (int k = 0; k < n; k++) {
        const int slot = p->order[k], wall = s->walls.wall_of[l->other[slot]];
        const bool turn = !b || wall != b->wall, apart = turn || l->owner[slot] != owner;
        if (apart)
            note_crowd(p, from, at);
        if (turn || b->n == TOUCH) {
            if (b)
                close_block(b, rows);
            at = p->n_blocks * TOUCH;
            b = wall_pack_block(p, p->n_blocks++, rows);
            b->wall = wall;
            b->n = 0;
        }
        if (apart) {
            from = at;
            owner = l->owner[slot];
        }
        enter(s, b, b->n++, slot);
        at++;
    }
    note_crowd(p, from, at);
    close_block(b, rows);
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
