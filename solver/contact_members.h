/* contact_members.h - the contacts of a run between member spheres, as the loop of contact_members.c keeps
 * them from one choice of active slots to the next (contact_pack.h does the same for spheres). */
#ifndef CONTACT_MEMBERS_H
#define CONTACT_MEMBERS_H

#include "../contact/touch.h"
#include "body.h"
#include "neighbours.h"

struct sim;
struct pack;

struct member_block {
    _Alignas(64) int i[TOUCH], j[TOUCH]; /* grains */
    int to[TOUCH];                       /* j as the run counts it (neighbours.to) */
    int of_i[TOUCH], of_j[TOUCH];        /* members: rows of the table */
    int slot[TOUCH];                     /* of a slot as many as its members come close */
    real depth[TOUCH];                   /* m, overlap at the last step */
    real memory[][TOUCH];                /* rows of the laws */
};

/* The members of all species: x y z, radius, units of size; those of species k from first[k] on. */
struct members {
    int *first; /* species + 1 */
    real4 *row;
};

static inline size_t member_block_size(int rows)
{
    return sizeof(struct member_block) + (size_t)rows * TOUCH * sizeof(real);
}

struct member_block *member_block(const struct pack *p, int block, int rows);

void members_create(struct sim *s);
void members_free(struct sim *s);
/* After every rebuild of the lists. */
void members_prepare(struct sim *s);

/* Packs the pairs of members that come close in the active slots of a run; those of its pack go back to
 * their slots. */
void members_take(struct sim *s, int run);
void members_put_back(struct sim *s, int run);

#endif
