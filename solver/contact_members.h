/* contact_members.h - the contacts of a run between member spheres, as the loop of
 * contact_members.c keeps them from one choice of active slots to the next (contact_pack.h does the
 * same for spheres). */
#ifndef CONTACT_MEMBERS_H
#define CONTACT_MEMBERS_H

#include "../contact/touch.h"
#include "body.h"
#include "neighbours.h"

struct sim;
struct pack;
struct block;
struct cut;
struct report;
struct target;

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

struct offset {
    real x, y, z;
};

/* size q v q*, with t = 2 u x v of q = (w, u): v + w t + u x t. */
static inline struct offset members_offset(real w, real ux, real uy, real uz, real size, real x,
                                           real y, real z)
{
    const real vx = size * x, vy = size * y, vz = size * z;
    const real tx = 2.0 * fma(uy, vz, -uz * vy), ty = 2.0 * fma(uz, vx, -ux * vz);
    const real tz = 2.0 * fma(ux, vy, -uy * vx);
    return (struct offset){fma(w, tx, fma(uy, tz, fma(-uz, ty, vx))),
                           fma(w, ty, fma(uz, tx, fma(-ux, tz, vy))),
                           fma(w, tz, fma(ux, ty, fma(-uy, tx, vz)))};
}

void members_create(struct sim *s);
void members_free(struct sim *s);
/* After every rebuild of the lists. */
void members_prepare(struct sim *s);

/* The record of a contact that was; NULL: there is none. */
const real *members_record(const struct cut *cut, real *memory, int id);
/* Marks of the slots, counts, energy, overlaps of a block; single contacts where someone looks.
 * Before the first block of a step that is asked for: nothing is known of its slots. */
void members_report(struct sim *s, struct block *b, struct report *r);
void members_forget_reports(struct sim *s, bool walls, const int *slot, int count);

/* The wall contacts of a run, see contact_path.h; and of its pack. */
void members_walls(struct sim *s, int run, struct block *b, const struct target *to);
void members_walls_take(struct sim *s, int run);
void members_walls_put_back(struct sim *s, int run);

/* Packs the pairs of members that come close in the active slots of a run; those of its pack go back to
 * their slots. */
void members_take(struct sim *s, int run);
void members_put_back(struct sim *s, int run);

#endif
