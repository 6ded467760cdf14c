/* contact_pack.c - active contacts between the slots and the blocks of the loop. */
#include "contact_pack.h"

#include "contact_loop.h"
#include "sim.h"

static void reserve(struct pack *p, int n, int rows)
{
    const int blocks = (n + TOUCH - 1) / TOUCH;
    if (blocks <= p->room)
        return;
    p->room = blocks + blocks / 8;
    xfree(p->data);
    p->data = xalloc((size_t)p->room, pack_size(rows));
}

/* A slot's overlap at the last step, as far as it is known: whether there was one. */
static real depth_before(const struct slots *l, int slot)
{
    return l->live[slot] == LIVE_OVERLAP ? (real)INFINITY : -(real)INFINITY;
}

void pack_fill(struct sim *s, int run)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct slots *const l = &nb->pairs;
    const int *const active = &l->active[l->begin[run * s->neighbours.run]];
    const int n = l->n_active[run], rows = nb->rows;
    struct pack *const p = &s->contacts->pack[run];
    reserve(p, n, rows);
    p->n = n;
    for (int k = 0; k < (n + TOUCH - 1) / TOUCH * TOUCH; k++) {
        struct pack_block *const b = pack_block(p, k / TOUCH, rows);
        const int c = k % TOUCH, slot = active[k < n ? k : n - 1];
        b->i[c] = l->owner[slot];
        b->j[c] = l->other[slot];
        b->to[c] = nb->to[slot];
        b->depth[c] = depth_before(l, slot);
        for (int row = 0; row < rows; row++)
            b->memory[row][c] = l->memory[(size_t)slot * rows + row];
    }
}

void pack_put_back(struct sim *s, int run)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct slots *const l = &nb->pairs;
    const int rows = nb->rows;
    const real reach = (real)nb->reach;
    struct pack *const p = &s->contacts->pack[run];
    if (p->n == 0) /* a run that is no longer, perhaps */
        return;
    const int *const active = &l->active[l->begin[run * s->neighbours.run]];
    for (int k = 0; k < p->n; k++) {
        const struct pack_block *const b = pack_block(p, k / TOUCH, rows);
        const int c = k % TOUCH, slot = active[k];
        l->live[slot] = (unsigned char)((b->depth[c] > -reach) + (b->depth[c] > (real)0.0));
        for (int row = 0; row < rows; row++)
            l->memory[(size_t)slot * rows + row] = b->memory[row][c];
    }
    p->n = 0;
}
