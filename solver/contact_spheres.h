/* contact_spheres.h - what contacts of spheres with each other (contact_block.c) and with walls
 * (contact_sphere_walls.c) share. */
#ifndef CONTACT_SPHERES_H
#define CONTACT_SPHERES_H

#include "contact_block.h"
#include "neighbours.h"
#include "sim.h"
#include "turn.h"

/* The numbers of eight bodies from one of their halves on: number k of body c in out[k][c]. */
static inline __attribute__((always_inline)) void
spheres_turn_in(const struct sim *s, const int *grain, real8 out[8])
{
    const real4 *row[8];
    for (int k = 0; k < 8; k++)
        row[k] = &s->bodies[grain[k]].vel; /* spin comes behind */
    turn_rows(row, out);
}

/* Contacts of spheres with each other, a block of them (b->n, b->c.i, b->c.j, b->kept are given), in this
 * order: what is the same for every block of a run, once; places and motion of the centres, the
 * nearest image of the distances, materials; then overlaps and velocities at the contact, with
 * `before`: the overlaps of the last step, which come to be those of this one. */
void spheres_open(const struct sim *s, struct block *b, const struct target *to);
void spheres_gather(const struct sim *s, struct block *b);
void spheres_nearest(const struct sim *s, struct block *b);
void spheres_materials(const struct sim *s, struct block *b);
void spheres_meet(const struct sim *s, struct block *b, real *restrict before,
                  struct report *r);
/* Adds the forces of a block to the sums of i and of j, the grain `to` as the run counts it. */
void spheres_add(const struct block *b, const int *restrict to, const struct target *target);
/* Dashpots of contacts that began within the step; began: overlaps at the last one. */
void spheres_starts(struct touch *t, const real *began);
/* Where no law reaches, nothing is remembered. */
void spheres_forget(struct block *b, int rows, real reach);
/* Counts, energy, the largest overlap; the forces of single contacts where someone looks, which
 * goes by the marks of the slots. */
void spheres_report(const struct sim *s, struct block *b, struct slots *l, struct report *r);

/* Grains of several balls (contact_members.c) meet walls by each of them: what that takes beyond spheres. */
struct ball_places;
struct ball_walls {
    /* Of n balls, rows of the members' table, of these grains. */
    void (*place)(const struct sim *s, const int *grain, const int *ball, int n,
                  struct ball_places *p);
    /* From the grains to the balls: velocities and radii of a block. */
    void (*enter)(struct block *b, const struct ball_places *p);
    /* Levers and arms (m, from the wall's pivot) from the balls' centres to the grains'. */
    void (*leave)(struct block *b, const struct ball_places *p, double (*arm)[TOUCH]);
    /* In place of spheres_report. */
    void (*report)(struct sim *s, struct block *b, struct report *r);
};

/* m, the centres of these grains, l->n of them, to l->x, y, z. */
void spheres_places(const struct sim *s, const int *grain, struct wall_looks *l);

/* The same with balls; NULL: spheres. */
void ball_walls(struct sim *s, int run, struct block *b, const struct target *to,
                const struct ball_walls *balls);
/* The wall contacts of a run. Forces on the walls, and their torques about the pivots, are added to
 * those of the target. */
void sphere_walls(struct sim *s, int run, struct block *b, const struct target *to);

#endif
