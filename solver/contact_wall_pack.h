/* contact_wall_pack.h - the active wall contacts of a run as the loop of spheres keeps them from one
 * choice of active slots to the next (contact_pack.h does the same for pairs).
 *
 * A ball that is near one element of a wall has a lane of a block, which holds the memory of the
 * contact in place. A ball that is near several (triangles of a mesh, sides of a box) is a crowd: its
 * elements stand in blocks of their own, are looked at first, and only those that count have a lane. A
 * lane goes with the contact from element to element. */
#ifndef CONTACT_WALL_PACK_H
#define CONTACT_WALL_PACK_H

#include "../contact/touch.h"
#include "walls/wall_kind.h"

struct sim;

/* Contacts with one wall: their number, lanes behind them repeat the last one. */
struct wall_block {
    int wall, n;
    bool crowds; /* of balls near several elements */
    _Alignas(64) int i[TOUCH], slot[TOUCH];
    int ball[TOUCH]; /* of a grain of several (contact_members.h), its row; 0: it is a sphere */
    int of[TOUCH];   /* element within the wall; of crowds the entry */
    real depth[TOUCH];    /* m, overlap at the last step; below -reach: none */
    real memory[][TOUCH]; /* rows */
};

/* Of the balls of a block: m, centres from those of the grains (0 of spheres), radii; m/s, by the spin of
 * the full step. */
struct ball_places {
    _Alignas(64) real off[3][TOUCH], radius[TOUCH], own[3][TOUCH];
};

/* Elements of one wall, each near a ball that is near others too. */
struct crowd_block {
    int wall, n;
    _Alignas(64) int i[TOUCH], slot[TOUCH];
    int ball[TOUCH];
    int lane[TOUCH];        /* counted through the wall's blocks of crowds, or -1 */
    int counts[TOUCH];      /* touched, not hidden by another (contact_facing.h) */
    double distance[TOUCH]; /* m */
    double arm[3][TOUCH];   /* m, from the wall's pivot to the centre */
    struct wall_looks look;
    struct ball_places places;
};

/* The entries from..to-1 of a ball, counted through the crowd blocks, TOUCH each. */
struct wall_crowd {
    int from, to, of; /* of: the wall's lanes */
};

/* The lanes for the crowds of a wall: as many blocks as its entries take, of which the first are in use. */
struct wall_lanes {
    int block, n; /* the first of them; lanes in use */
};

/* A contact to be packed. */
struct wall_entry {
    int slot, ball;
};

struct wall_pack {
    int n_blocks, room; /* blocks */
    char *data;
    int n_entries, crowd_blocks, entry_room; /* blocks of crowds */
    struct crowd_block *entry;
    int n_crowds, crowd_room;
    struct wall_crowd *crowd;
    int n_lanes, lanes_room;
    struct wall_lanes *lanes;
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

/* The active slots of a run by wall, each wall's in their order. */
void wall_pack_sort(const struct sim *s, struct wall_pack *p, int run);
/* Packs n entries that are in the order of their walls, grains and balls; `recall` sets depth and
 * memory of a lane whose other numbers are there. */
void wall_pack_build(struct sim *s, struct wall_pack *p, const struct wall_entry *e, int n,
                     void (*recall)(const struct sim *s, struct wall_block *b, int c));
/* A lane for entry c of a crowd block: nothing is remembered. */
void wall_pack_begin(struct wall_pack *p, struct crowd_block *e, int c, int entry, int of);
/* Packs the active wall slots of a run; those of its pack go back to their slots. */
void wall_pack_fill(struct sim *s, int run);
void wall_pack_put_back(struct sim *s, int run);
void wall_pack_free(struct wall_pack *p);

#endif
