/* contact_wall_pack.h - the active wall contacts of a run as the loop of spheres keeps them from one
 * choice of active slots to the next (contact_pack.h does the same for pairs).
 *
 * A ball that is near one element of a wall has a lane of a block, which holds the memory of the
 * contact in place, and where it stays above a face the plane of it. A ball that is near several
 * (triangles of a mesh, sides of a box) is a crowd: its elements stand in a list, and only those that
 * count get lanes, in blocks like the others'. A lane goes with the contact from element to element
 * (contact_wall_crowds.c). */
#ifndef CONTACT_WALL_PACK_H
#define CONTACT_WALL_PACK_H

#include "../contact/touch.h"
#include "walls/wall_kind.h"

struct sim;
struct ball_walls;

/* What a block's contacts need to be seen: they stay on a face until slots are chosen anew, whose plane is
 * all there is; their element is known; it is that of several which counts. */
enum wall_lane { ON_FACE, ALONE, OF_CROWD, LANE_KINDS };

/* Contacts with one wall: their number, lanes behind them repeat the last one. */
struct wall_block {
    int wall, n;
    enum wall_lane kind;
    _Alignas(64) int i[TOUCH], slot[TOUCH];
    int ball[TOUCH]; /* of a grain of several (contact_members.h), its row; 0: it is a sphere */
    int element[TOUCH]; /* within the wall */
    int counts
        [TOUCH]; /* 0: hidden by another element (contact_facing.h), or behind the last one */
    double plane[6][TOUCH]; /* of ON_FACE: m, a point, and the unit normal; frame of the wall */
    real depth[TOUCH];      /* m, overlap at the last step; below -reach: none */
    real memory[][TOUCH];   /* rows */
};

/* Of the balls of a block: m, centres from those of the grains (0 of spheres), radii; m/s, by the spin of
 * the full step. */
struct ball_places {
    _Alignas(64) real off[3][TOUCH], radius[TOUCH], own[3][TOUCH];
};

/* An element near a ball that is near others too. */
struct crowd_entry {
    int i, slot, ball, element, patch;
    int lane; /* counted through the wall's blocks of crowds; -1: none */
};

/* The entries from..to-1 of a ball. */
struct wall_crowd {
    int from, to, of; /* of: the wall's lanes */
};

/* The lanes for the crowds of a wall: as many blocks as its entries take, of which the first are in use. */
struct wall_lanes {
    int wall, block, n; /* the first of them; lanes in use */
};

/* A contact to be packed. */
struct wall_entry {
    int slot, ball;
    enum wall_lane kind; /* set by wall_pack_build */
};

struct wall_pack {
    int n_blocks, room; /* blocks */
    char *data;
    int n_entries, entry_room;
    struct crowd_entry *entry;
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
/* Packs n entries that are in the order of their walls, grains and balls (and leaves fewer of them);
 * balls: as of contact_spheres.h; `recall` sets depth and memory of a lane whose other numbers are there. */
void wall_pack_build(struct sim *s, struct wall_pack *p, struct wall_entry *e, int n,
                     const struct ball_walls *balls,
                     void (*recall)(const struct sim *s, struct wall_block *b, int c));
/* Where those of the ball of entry k end. */
int wall_entries_end(const struct sim *s, const struct wall_entry *e, int k, int n);
/* A lane for an entry: nothing is remembered. */
void wall_pack_begin(struct wall_pack *p, struct crowd_entry *e,
                     const struct wall_crowd *crowd);
/* The block of a lane, whose place in it is lane % TOUCH. */
struct wall_block *wall_pack_lane(const struct wall_pack *p, const struct wall_crowd *crowd,
                                  int lane);
/* Packs the active wall slots of a run; those of its pack go back to their slots. */
void wall_pack_fill(struct sim *s, int run);
void wall_pack_put_back(struct sim *s, int run);
void wall_pack_free(struct wall_pack *p);

#endif
