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
    int ball[TOUCH]; /* of a grain of several (contact_members.h), its row; 0: it is a sphere */
    int counts[TOUCH]; /* the element is touched, not hidden by another (contact_facing.h) */
    double x[TOUCH], y[TOUCH], z[TOUCH]; /* m, centres */
    double distance[TOUCH];              /* m, length of look.ax, ay, az */
    double arm[3][TOUCH];                /* m, from the wall's pivot to the centre */
    struct wall_looks look;
    /* Of the balls: m, centres from those of the grains (0 of spheres), radii; m/s, by the spin of
     * the full step */
    real off[3][TOUCH], radius[TOUCH], own[3][TOUCH];
    real depth[TOUCH];    /* m, overlap at the last step; below -reach: none */
    real memory[][TOUCH]; /* rows */
};

/* Contacts of a grain with several elements of a wall: entries from..to-1, counted through the
 * blocks, TOUCH each. */
struct wall_crowd {
    int from, to;
};

/* A contact to be packed. */
struct wall_entry {
    int slot, ball;
};

struct wall_pack {
    int n_blocks, room; /* blocks */
    char *data;
    int n_crowds, crowd_room;
    struct wall_crowd *crowd;
    int n_order, order_room;
    struct wall_entry *order; /* the active slots by wall */
};

static inline size_t wall_pack_size(int rows)
{
    return sizeof(struct wall_block) + (size_t)rows * TOUCH * sizeof(real);
}

static inline struct wall_block *wall_pack_block(const struct wall_pack *p, int block, int rows)
{
    return (struct wall_block *)(void *)(p->data + (size_t)block * wall_pack_size(rows));
}

/* *data has room for n entries at least; what was there is lost. */
void wall_pack_reserve(void **data, int *room, int n, size_t size);
/* The active slots of a run by wall, each wall's in their order. */
void wall_pack_sort(const struct sim *s, struct wall_pack *p, int run);
/* Packs n entries that are in the order of their walls, grains and balls; `recall` sets depth and
 * memory of a lane whose other numbers are there. */
void wall_pack_build(struct sim *s, struct wall_pack *p, const struct wall_entry *e, int n,
                     void (*recall)(const struct sim *s, struct wall_block *b, int c));
/* Packs the active wall slots of a run; those of its pack go back to their slots. */
void wall_pack_fill(struct sim *s, int run);
void wall_pack_put_back(struct sim *s, int run);
void wall_pack_free(struct wall_pack *p);

#endif
