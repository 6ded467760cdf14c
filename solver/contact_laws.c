/* contact_laws.c - the laws over one block of contacts. */
#include "contact_laws.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/cohesion/cohesion.h"
#include "../contact/contact.h"
#include "../contact/lubrication/lubrication.h"
#include "../contact/rolling/rolling.h"
#include "contact_loop.h"
#include "sim.h"
#include "turn.h"

int laws_rows(void)
{
    const int rows = contact_history + rolling_history + cohesion_history +
                     lubrication_history + bond_history;
    return (rows + 3) / 4 * 4;
}

static unsigned needs(void)
{
    return rolling_needs | cohesion_needs | lubrication_needs | bond_needs;
}

/* Velocities at the contact point, from those of the centres, spins and levers. */
void laws_velocities(struct block *b)
{
    struct touch *const t = &b->t;
    const struct levers *const l = &b->l;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real px = b->px[c], py = b->py[c], pz = b->pz[c];
        const real qx = b->qx[c], qy = b->qy[c], qz = b->qz[c];
        t->vx[c] = fma(py, l->iz[c],
                       fma(-pz, l->iy[c], fma(-qy, l->jz[c], fma(qz, l->jy[c], t->vx[c]))));
        t->vy[c] = fma(pz, l->ix[c],
                       fma(-px, l->iz[c], fma(-qz, l->jx[c], fma(qx, l->jz[c], t->vy[c]))));
        t->vz[c] = fma(px, l->iy[c],
                       fma(-py, l->ix[c], fma(-qx, l->jy[c], fma(qy, l->jx[c], t->vz[c]))));
        t->wx[c] = px - qx;
        t->wy[c] = py - qy;
        t->wz[c] = pz - qz;
        t->vn[c] = fma(t->nx[c], b->vx[c], fma(t->ny[c], b->vy[c], t->nz[c] * b->vz[c]));
    }
}

/* With A = 1/I of a grain and B = A m r^2, its inertia about the contact point is (1 + B)/A; of both
 * bodies together with one division; A = 0 of a frozen grain and of a wall. */
void laws_inertia(const struct grains *g, struct block *b)
{
    struct touch *const t = &b->t;
    double against[TOUCH];
    for (int c = 0; c < t->n; c++)
        against[c] = b->c.wall[c] ? 0.0 : g->inv_inertia[b->c.j[c]];
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const double ri = (double)t->r_i[c], rj = (double)t->r_j[c];
        const double ai = g->inv_inertia[b->c.i[c]], aj = against[c];
        const double bi = 1.0 + ai * g->mass[b->c.i[c]] * ri * ri;
        const double bj = 1.0 + aj * g->mass[b->c.j[c]] * rj * rj;
        t->inertia[c] = (real)(bi * bj / (ai * bj + aj * bi));
    }
}

/* What laws ask for only some of the time. */
static void extras(const struct grains *g, struct block *b, unsigned asked)
{
    struct touch *const t = &b->t;
    if (asked & TOUCH_SPIN)
        for (int c = 0; c < t->n; c++) {
            t->sx[c] = b->px[c];
            t->sy[c] = b->py[c];
            t->sz[c] = b->pz[c];
        }
    if (asked & TOUCH_INERTIA)
        laws_inertia(g, b);
    if (asked & TOUCH_COUPLES) {
        memset(t->mx, 0, sizeof t->mx);
        memset(t->my, 0, sizeof t->my);
        memset(t->mz, 0, sizeof t->mz);
    }
}

void laws_apply(struct sim *s, struct block *b)
{
    real(*h)[TOUCH] = b->kept ? b->kept : b->history;
    extras(&s->grains, b, needs());
    if (bond_history > 0)
        memset(b->t.broke, 0, sizeof b->t.broke);
    contact_forces(&b->t, h);
    h += contact_history;
    cohesion_forces(&b->t, h);
    h += cohesion_history;
    lubrication_forces(&b->t, h);
    h += lubrication_history;
    rolling_moments(&b->t, h);
    h += rolling_history;
    bond_forces(&b->t, h);
}

double laws_energy(struct block *b, double reach, const real *share)
{
    double sum = 0.0;
    real(*h)[TOUCH] = b->kept ? b->kept : b->history;
    contact_energy(&b->t, h);
    h += contact_history;
    cohesion_energy(&b->t, h);
    h += cohesion_history;
    lubrication_energy(&b->t, h);
    h += lubrication_history;
    rolling_energy(&b->t, h);
    h += rolling_history;
    bond_energy(&b->t, h);
    for (int c = 0; c < b->n; c++)
        if ((double)b->t.depth[c] > -reach)
            sum += share ? (double)share[c] * b->t.energy[c] : b->t.energy[c];
    return sum;
}

/* Forces and torques into rows: force and torque on i; if `both`, on j. */
static inline __attribute__((always_inline)) void pack(struct block *b, bool couples, bool both)
{
    const struct touch *const t = &b->t;
    const struct levers *const l = &b->l;
    const real8 zero = {0.0};
    for (int c = 0; c < t->n; c += 8) {
        const real8 fx = take8(&t->fx[c]), fy = take8(&t->fy[c]), fz = take8(&t->fz[c]);
        const real8 mx = couples ? take8(&t->mx[c]) : zero,
                    my = couples ? take8(&t->my[c]) : zero;
        const real8 mz = couples ? take8(&t->mz[c]) : zero;
        const real8 ix = take8(&l->ix[c]), iy = take8(&l->iy[c]), iz = take8(&l->iz[c]);
        real8 i[8] = {fx,
                      fy,
                      fz,
                      zero,
                      iy * fz - iz * fy + mx,
                      iz * fx - ix * fz + my,
                      ix * fy - iy * fx + mz,
                      zero};
        turn_columns(i, &b->on[0][c]);
        if (!both)
            continue;
        const real8 jx = take8(&l->jx[c]), jy = take8(&l->jy[c]), jz = take8(&l->jz[c]);
        real8 j[8] = {-fx,
                      -fy,
                      -fz,
                      zero,
                      jz * fy - jy * fz - mx,
                      jx * fz - jz * fx - my,
                      jy * fx - jx * fy - mz,
                      zero};
        turn_columns(j, &b->on[1][c]);
    }
}

void laws_pack(struct block *b)
{
    if (needs() & TOUCH_COUPLES)
        pack(b, true, true);
    else
        pack(b, false, true);
}

/* The levers are -arm_i and arm_j times the normal: one product gives both torques. With offsets
 * (from the centres of grains to those of the members that touch) their torque comes on top. */
static inline __attribute__((always_inline)) void pack_line(struct block *b, bool couples,
                                                            bool offsets)
{
    const struct touch *const t = &b->t;
    const struct levers *const l = &b->l;
    const real8 zero = {0.0};
    for (int c = 0; c < t->n; c += 8) {
        const real8 fx = take8(&t->fx[c]), fy = take8(&t->fy[c]), fz = take8(&t->fz[c]);
        const real8 nx = take8(&t->nx[c]), ny = take8(&t->ny[c]), nz = take8(&t->nz[c]);
        const real8 mx = couples ? take8(&t->mx[c]) : zero,
                    my = couples ? take8(&t->my[c]) : zero;
        const real8 mz = couples ? take8(&t->mz[c]) : zero;
        const real8 x = nz * fy - ny * fz, y = nx * fz - nz * fx, z = ny * fx - nx * fy;
        const real8 arm_i = take8(&b->arm_i[c]), arm_j = take8(&b->arm_j[c]);
        real8 i[8] = {fx, fy, fz, zero, arm_i * x + mx, arm_i * y + my, arm_i * z + mz, zero};
        real8 j[8] = {-fx, -fy, -fz, zero, arm_j * x - mx, arm_j * y - my, arm_j * z - mz,
                      zero};
        if (offsets) {
            const real8 ix = take8(&l->ix[c]), iy = take8(&l->iy[c]), iz = take8(&l->iz[c]);
            const real8 jx = take8(&l->jx[c]), jy = take8(&l->jy[c]), jz = take8(&l->jz[c]);
            i[4] += iy * fz - iz * fy;
            i[5] += iz * fx - ix * fz;
            i[6] += ix * fy - iy * fx;
            j[4] -= jy * fz - jz * fy;
            j[5] -= jz * fx - jx * fz;
            j[6] -= jx * fy - jy * fx;
        }
        turn_columns(i, &b->on[0][c]);
        turn_columns(j, &b->on[1][c]);
    }
}

void laws_pack_line(struct block *b)
{
    if (needs() & TOUCH_COUPLES)
        pack_line(b, true, false);
    else
        pack_line(b, false, false);
}

void laws_pack_members(struct block *b)
{
    if (needs() & TOUCH_COUPLES)
        pack_line(b, true, true);
    else
        pack_line(b, false, true);
}

void laws_pack_i(struct block *b)
{
    if (needs() & TOUCH_COUPLES)
        pack(b, true, false);
    else
        pack(b, false, false);
}

void laws_couples(const struct block *b, double8 torque[3])
{
    if (!(needs() & TOUCH_COUPLES))
        return;
    for (int c = 0; c < b->t.n; c += 8) {
        torque[0] += laws_eight(&b->t.mx[c]);
        torque[1] += laws_eight(&b->t.my[c]);
        torque[2] += laws_eight(&b->t.mz[c]);
    }
}

/* Notes the bonds that broke; put in order where they are read. */
void laws_note_broken(struct sim *s, const struct block *b, const struct slots *l, double time)
{
    const struct grains *const g = &s->grains;
    if (bond_history == 0)
        return;
    for (int c = 0; c < b->n; c++) {
        if (b->t.broke[c] == 0)
            continue;
        const vec3 arm = v3((double)b->l.ix[c], (double)b->l.iy[c], (double)b->l.iz[c]);
        const int i = b->c.i[c];
        const struct broken bond = {.time = time,
                                    .point = v3_add(g->pos[i], arm),
                                    .i = g->id[i],
                                    .j =
                                        b->walls ? -1 - l->other[b->slot[c]] : g->id[b->c.j[c]],
                                    .mode = b->t.broke[c]};
#pragma omp critical(note_broken)
        {
            struct break_list *const list = &s->contacts->broken;
            if (list->n == list->room) {
                const int room = 2 * list->room + 64;
                list->bond =
                    xrealloc(list->bond, (size_t)list->room, (size_t)room, sizeof *list->bond);
                list->room = room;
            }
            list->bond[list->n++] = bond;
        }
    }
}
