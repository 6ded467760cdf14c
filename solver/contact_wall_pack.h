/* contact_wall_pack.h - the active wall contacts of a run as the loop of spheres keeps them from one
 * choice of active slots to the next: in blocks of one wall each, owner by owner, their memory in
 * place (contact_pack.h does the same for pairs). */
#ifndef CONTACT_WALL_PACK_H
#define CONTACT_WALL_PACK_H

#include "../contact/touch.h"
#include "walls/wall_kind.h"

struct sim;

struct wall_block {
    int wall, n; /* of all its contacts; their number, lanes behind them repeat the last one */
    _Alignas(64) int i[TOUCH], slot[TOUCH];
    int counts[TOUCH]; /* the element is touched, not hidden by another (contact_facing.h) */
    double x[TOUCH], y[TOUCH], z[TOUCH]; /* m, centres */
    double distance[TOUCH];              /* m, length of look.ax, ay, az */
    double arm[3][TOUCH];                /* m, from the wall's pivot to the centre */
    struct wall_looks look;
    real depth[TOUCH];    /* m, overlap at the last step; below -reach: none */
    real memory[][TOUCH]; /* rows */
};

/* Contacts of a grain with several elements of a wall: entries from..to-1, counted through the
 * blocks, TOUCH each. */
struct wall_crowd {
    int from, to;
};

struct wall_pack {
    int n_blocks, room; /* blocks */
    char *data;
    int n_crowds, crowd_room;
    struct wall_crowd *crowd;
    int n_order, order_room;
    int *order; /* the active slots by wall */
};

static inline size_t wall_pack_size(int rows)
{
    return sizeof(struct wall_block) + (size_t)rows * TOUCH * sizeof(real);
}

static inline struct wall_block *wall_pack_block(const struct wall_pack *p, int block, int rows)
{
    return (struct wall_block *)(void *)(p->data + (size_t)block * wall_pack_size(rows));
}

/* Packs the active wall slots of a run; those of its pack go back to their slots. */
void wall_pack_fill(struct sim *s, int run);
void wall_pack_put_back(struct sim *s, int run);
void wall_pack_free(struct wall_pack *p);

#endif
