/* contact_laws.h - what the two paths of the contact loop share: the laws over a block of contacts
 * whose geometry, velocities and memory are in place, and what is made of their forces.
 *
 * contact_block.c finds one contact per slot (spheres), contact_points.c any number of them (other
 * shapes); both then go through these in the order of this file. */
#ifndef CONTACT_LAWS_H
#define CONTACT_LAWS_H

#include <string.h>
#include "contact_block.h"
#include "neighbours.h"

int laws_rows(void); /* reals of memory per contact, all laws together, in fours */

/* Velocities at the contact point, from those of the centres, spins and levers; vn from those of
 * the centres alone. */
void laws_velocities(struct block *b);

/* The force of a step stands for half a step before and after it. A contact that began within the
 * step was on for depth/|v_n| before: the part of a whole step that its dashpot acts for. Without
 * this the restitution is first order in the step. */
static inline real laws_first_part(const struct touch *t, int c)
{
    const real dt = (real)t->dt;
    const real since = t->vn[c] < 0.0 ? t->depth[c] / (-t->vn[c] * dt) : 0.5;
    return fmin(fmax(since, 0.0), 1.0) + 0.5;
}

/* kg m2, reduced inertia about the contact, t->inertia. */
void laws_inertia(const struct grains *g, struct block *b);
/* Forces, couples and memory of every contact. */
void laws_apply(struct sim *s, struct block *b);
/* Notes the bonds that broke; put in order where they are read. */
void laws_note_broken(struct sim *s, const struct block *b, const struct slots *l, double time);
/* Forces and torques into rows, b->on. */
void laws_pack(struct block *b);
/* The same where the contact point lies on the line of centres: from b->arm_i, arm_j. */
void laws_pack_line(struct block *b);
/* Between members of grains: likewise, with the offsets of the members from the grains' centres in b->l. */
void laws_pack_members(struct block *b);
/* Those on i alone: against walls. */
void laws_pack_i(struct block *b);
/* Adds the laws' couples to the torque, where there are any. */
void laws_couples(const struct block *b, double8 torque[3]);
/* J, stored by the contacts within `reach`; after laws_apply. */
double laws_energy(struct block *b, double reach, const real *share);

/* Eight numbers in double. By a loop, which gcc 12 turns into one conversion; of vectors it makes two
 * halves. */
static inline double8 laws_eight(const real *x)
{
    double wide[8];
    double8 a;
    for (int k = 0; k < 8; k++)
        wide[k] = (double)x[k];
    memcpy(&a, wide, sizeof a);
    return a;
}

static inline double8 laws_wide(const real row[8])
{
    return laws_eight(row);
}

static inline double4 laws_force(const struct block *b, int c)
{
    const real *const f = b->on[0][c];
    return (double4){(double)f[0], (double)f[1], (double)f[2], 0.0};
}

/* Reduced mass and radius. */
static inline void laws_reduce(struct block *b)
{
    struct touch *const t = &b->t;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real ri = t->r_i[c], rj = t->r_j[c], m = b->inv_m[c], sum = ri + rj;
        const real inverse = 1.0 / (sum * m);
        t->m_eff[c] = sum * inverse;
        t->r_eff[c] = ri * rj * m * inverse;
    }
}

/* Adds the forces to the sums: in strides, since neighbouring contacts mostly have one owner, and
 * an addition to what was just added to must wait for it. */
static inline void laws_add(const struct block *b, const int *restrict to,
                            const struct target *target)
{
    enum { STRIDE = 8 };
    struct sums *const own = target->sums - target->first, *const all = target->sums;
    for (int start = 0; start < STRIDE; start++)
        for (int c = start; c < b->n; c += STRIDE) {
            own[b->c.i[c]].both += laws_wide(b->on[0][c]);
            all[to[b->slot[c]]].both += laws_wide(b->on[1][c]);
        }
}

/* On walls, the torque is that about their pivot. */
static inline void laws_add_walls(const struct block *b, const struct target *target)
{
    for (int c = 0; c < b->n; c++) {
        const double8 on = laws_wide(b->on[0][c]);
        const vec3 turn = v3_cross(b->arm[c], v3(on[0], on[1], on[2]));
        struct sums *const wall = &target->wall[b->wall[c]];
        target->sums[b->c.i[c] - target->first].both += on;
        wall->both -= on + (double8){0.0, 0.0, 0.0, 0.0, turn.x, turn.y, turn.z, 0.0};
    }
}

/* Forces on frozen grains by the others. */
static inline void laws_add_skeleton(const struct grains *g, const struct block *b,
                                     struct report *r)
{
    for (int c = 0; c < b->n; c++) {
        if (g->inv_mass[b->c.i[c]] == 0.0)
            r->skeleton += laws_force(b, c);
        else if (g->inv_mass[b->c.j[c]] == 0.0)
            r->skeleton -= laws_force(b, c);
    }
}

#endif
