/* contact_points.h - any number of contacts in a slot: what pairs and walls have in common.
 *
 * The memory of a slot: shape.memory reals of the shape; SLOT_HEAD reals; and the records, one for each
 * contact that there may be: RECORD_HEAD reals - a code, zero for a free record, else made of the id of
 * the contact and of whether it overlapped; its place in the frame of the slot's owner - and the rows of
 * the laws. */
#ifndef CONTACT_POINTS_H
#define CONTACT_POINTS_H

#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_path.h"
#include "contact_view.h"
#include "sim.h"

enum { SLOT_HEAD = 4, RECORD_HEAD = 4, POINTS_MOST = 256 };
/* The head of a slot: how many records, from the first on, may be in use; m, by how much more than the reach
 * the bodies are apart at least, 0: not known; m, by how much they may have come nearer since the shape was
 * last asked, and whether it has been. */
enum { HEAD_USED, HEAD_APART, HEAD_NEARER, HEAD_ASKED };
#define RECORD_NEW (real)2.0 /* a code: in use, did not overlap */

/* How the memory of slots is cut. */
struct cut {
    int head;  /* in reals from the start of the slot's memory */
    int first; /* record, likewise */
    int rows;  /* of the laws */
    int most;  /* records */
};

struct cut points_cut(const struct sim *s);

static inline real *points_record(const struct cut *c, real *memory, int k)
{
    return memory + c->first + k * (RECORD_HEAD + c->rows);
}

/* Records that may be in use. */
static inline int points_used(const struct cut *c, const real *memory)
{
    return (int)memory[c->head + HEAD_USED];
}

static inline void points_use(const struct cut *c, real *memory, int records)
{
    memory[c->head + HEAD_USED] = (real)records;
}

static inline int record_id(const real *record)
{
    return (int)record[0] / 2 - 1; /* -1: free */
}

static inline bool record_overlapped(const real *record)
{
    return (int)record[0] % 2 == 1;
}

/* A contact of a block that is being filled. */
struct point_of {
    int slot, i, j; /* j = i: a wall */
    real *record;
    bool was; /* it overlapped at the step before */
    const struct shape_point *p;
};

/* What paths with such slots have in common, see contact_path.h. */
int points_rows(const struct sim *s);
void points_view(const struct sim *s, struct contact_view *v);
size_t points_seen_size(const struct sim *s);
void points_stop(const struct sim *s);

struct shape_pose points_pose(const struct sim *s, int i);

/* What pairs and walls write alike: geometry, memory, masses, the spin of i. Returns its lane. */
int points_enter(const struct sim *s, struct block *b, const struct point_of *o);

/* Gives each of n points of a pair its record: that of its id, else of a contact that has just ended nearer
 * than `close` (m) to its `place`, else a free one; clears those that ended. Returns up to where records
 * are in use. */
int points_match(const struct cut *cut, real *memory, const struct shape_point *p,
                 const vec3 *place, int n, double close, int *record);

/* The dashpot of faces that rock on each other (contact_rocking.c): after the laws the couples of the block's
 * contacts that have a lever; then their parts, to the rows of torques. */
void points_rock(const struct sim *s, struct block *b);
void points_add_rocking(struct block *b);

/* Works what is in the block, and empties it. */
void points_work(struct sim *s, struct block *b, const struct target *to);

/* Someone looks at single contacts, and a slot is worked anew. */
void points_forget_seen(const struct sim *s, bool walls, int slot);
/* Keeps a contact, whose levers and row of force are there, for who looks at it. */
void points_note_seen(const struct sim *s, const struct block *b, int c, struct report *r);

/* The wall slots of a run (contact_points_walls.c). */
void points_walls(struct sim *s, int run, struct block *b, const struct target *to);

#endif
