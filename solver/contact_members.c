/* contact_members.c - contacts of grains that are rigid unions of spheres: member against member.
 *
 * A member of a grain with velocity v, spin w, whose centre lies at o from the grain's, is a sphere
 * of velocity v + w x o and spin w: it goes through what spheres go through (contact_spheres.h), in
 * the same blocks, and the force on it acts on the grain with the torque o x f besides its own.
 * (Where all grains are of one sphere they are spheres: contact_round.c.) Which members come close
 * is found when active slots are chosen (contact_members_pack.c); walls likewise
 * (contact_members_walls.c). */
#include "contact_members.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/rolling/rolling.h"
#include "attitude.h"
#include "contact_points.h"
#include "contact_spheres.h"
#include "turning.h"

/* Where members are and how they are turned: rows of the attitudes of i and j, and of the two members.
 */
struct turned {
    _Alignas(64) real i[8][TOUCH], j[8][TOUCH];
    real of[8][TOUCH];
};

static void take(struct block *b, struct member_block *p, int count)
{
    b->n = count;
    b->c.n = b->t.n = (count + TOUCH_LANES - 1) / TOUCH_LANES * TOUCH_LANES;
    b->kept = p->memory;
    memcpy(b->c.i, p->i, sizeof b->c.i);
    memcpy(b->c.j, p->j, sizeof b->c.j);
    memcpy(b->slot, p->slot, sizeof b->slot);
}

static void gather(const struct sim *s, const struct member_block *p, int n, struct turned *g)
{
    const struct attitude *const a = s->attitudes;
    const real4 *const row = s->contacts->members.row;
    for (int c = 0; c < n; c += 8) {
        real8 i[8], j[8], of[8];
        for (int k = 0; k < 8; k++) {
            i[k] = take8((const real *)&a[p->i[c + k]]);
            j[k] = take8((const real *)&a[p->j[c + k]]);
            of[k] = __builtin_shufflevector(row[p->of_i[c + k]], row[p->of_j[c + k]], 0, 1, 2,
                                            3, 4, 5, 6, 7);
        }
        turn8(i);
        turn8(j);
        turn8(of);
        for (int k = 0; k < 8; k++) {
            put8(&g->i[k][c], i[k]);
            put8(&g->j[k][c], j[k]);
            put8(&g->of[k][c], of[k]);
        }
    }
}

/* From the grains to the members: distances, velocities, radii; offsets to the levers' place. */
static void go_to_members(struct block *b, const struct turned *g)
{
    struct touch *const t = &b->t;
    struct levers *const l = &b->l;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real size_i = g->i[7][c], size_j = g->j[7][c];
        const struct offset i = members_offset(g->i[0][c], g->i[1][c], g->i[2][c], g->i[3][c],
                                               size_i, g->of[0][c], g->of[1][c], g->of[2][c]);
        const struct offset j = members_offset(g->j[0][c], g->j[1][c], g->j[2][c], g->j[3][c],
                                               size_j, g->of[4][c], g->of[5][c], g->of[6][c]);
        const real px = b->px[c], py = b->py[c], pz = b->pz[c];
        const real qx = b->qx[c], qy = b->qy[c], qz = b->qz[c];
        const real fx = g->i[4][c], fy = g->i[5][c], fz = g->i[6][c];
        const real hx = g->j[4][c], hy = g->j[5][c], hz = g->j[6][c];
        t->r_i[c] = size_i * g->of[3][c];
        t->r_j[c] = size_j * g->of[7][c];
        b->c.dx[c] += i.x - j.x;
        b->c.dy[c] += i.y - j.y;
        b->c.dz[c] += i.z - j.z;
        t->vx[c] += fma(py, i.z, -pz * i.y) - fma(qy, j.z, -qz * j.y);
        t->vy[c] += fma(pz, i.x, -px * i.z) - fma(qz, j.x, -qx * j.z);
        t->vz[c] += fma(px, i.y, -py * i.x) - fma(qx, j.y, -qy * j.x);
        b->vx[c] += fma(fy, i.z, -fz * i.y) - fma(hy, j.z, -hz * j.y);
        b->vy[c] += fma(fz, i.x, -fx * i.z) - fma(hz, j.x, -hx * j.z);
        b->vz[c] += fma(fx, i.y, -fy * i.x) - fma(hx, j.y, -hy * j.x);
        l->ix[c] = i.x;
        l->iy[c] = i.y;
        l->iz[c] = i.z;
        l->jx[c] = j.x;
        l->jy[c] = j.y;
        l->jz[c] = j.z;
    }
}

/* From the centres of the members to the contact. */
static void levers_to_contact(struct block *b)
{
    struct levers *const l = &b->l;
    const struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++) {
        l->ix[c] -= b->arm_i[c] * t->nx[c];
        l->iy[c] -= b->arm_i[c] * t->ny[c];
        l->iz[c] -= b->arm_i[c] * t->nz[c];
        l->jx[c] += b->arm_j[c] * t->nx[c];
        l->jy[c] += b->arm_j[c] * t->ny[c];
        l->jz[c] += b->arm_j[c] * t->nz[c];
    }
}

/* The deepest is told of. */
static void note_deep(const struct sim *s, const struct block *b, struct report *r)
{
    const real most = (real)s->run.overlap_max;
    for (int c = 0; c < b->n; c++) {
        const real allowed = most * fmin(b->t.r_i[c], b->t.r_j[c]);
        if (b->t.depth[c] > allowed) {
            r->i = b->c.i[c];
            r->j = b->c.j[c];
            r->deep = (double)b->t.depth[c];
            r->allowed = (double)allowed;
        }
    }
}

/* Marks of the slots, counts, energy, overlaps; single contacts where someone looks. */
void members_report(struct sim *s, struct block *b, struct report *r)
{
    struct slots *const l = b->walls ? &s->neighbours.walls : &s->neighbours.pairs;
    const double reach = s->neighbours.reach;
    r->energy += laws_energy(b, reach, NULL);
    for (int c = 0; c < b->n; c++) {
        const double depth = (double)b->t.depth[c];
        unsigned char *const live = &l->live[b->slot[c]];
        if (!(depth > -reach))
            continue;
        *live = depth > 0.0 || *live == LIVE_OVERLAP ? LIVE_OVERLAP : LIVE_REACH;
        r->touching += depth > 0.0;
        r->overlap =
            fmax(r->overlap,
                 depth / (double)(b->walls ? b->t.r_i[c] : fmin(b->t.r_i[c], b->t.r_j[c])));
        if (s->contacts->watched)
            points_note_seen(s, b, c, r);
    }
}

void members_forget_reports(struct sim *s, bool walls, const int *slot, int count)
{
    struct slots *const l = walls ? &s->neighbours.walls : &s->neighbours.pairs;
    for (int k = 0; k < count; k++) {
        l->live[slot[k]] = 0;
        points_forget_seen(s, walls, slot[k]);
    }
}

static void work_pairs(struct sim *s, struct block *b, const int *slot, int count,
                       const struct target *to)
{
    const struct pack *const pack = &s->contacts->pack[to->first / s->neighbours.run];
    const int rows = laws_rows();
    if (to->asked)
        members_forget_reports(s, false, slot, count);
    spheres_open(s, b, to);
    for (int from = 0; from < pack->n; from += TOUCH) {
        struct member_block *const p = member_block(pack, from / TOUCH, rows);
        struct turned g;
        take(b, p, pack->n - from < TOUCH ? pack->n - from : TOUCH);
        spheres_gather(s, b);
        gather(s, p, b->t.n, &g);
        spheres_nearest(s, b);
        go_to_members(b, &g);
        spheres_materials(s, b);
        const bool before = to->report->too_deep;
        spheres_meet(s, b, p->depth, to->report);
        if (to->report->too_deep && !before)
            note_deep(s, b, to->report);
        laws_apply(s, b);
        spheres_forget(b, rows, (real)s->neighbours.reach);
        laws_pack_members(b);
        spheres_add(b, p->to, to);
        if (to->asked || bond_history > 0)
            levers_to_contact(b);
        laws_note_broken(s, b, &s->neighbours.pairs, to->time);
        if (to->asked)
            members_report(s, b, to->report);
        if (s->grains.n_frozen > 0)
            laws_add_skeleton(&s->grains, b, to->report);
    }
    b->n = 0;
    b->kept = NULL;
}

static bool turns(const struct sim *s)
{
    (void)s;
    return true;
}

static void take_run(struct sim *s, int run)
{
    members_take(s, run);
    members_walls_take(s, run);
}

static void put_back_run(struct sim *s, int run)
{
    members_put_back(s, run);
    members_walls_put_back(s, run);
}

const struct contact_path contact_members = {.rows = points_rows,
                                             .pairs = work_pairs,
                                             .walls = members_walls,
                                             .view = points_view,
                                             .seen_size = points_seen_size,
                                             .stop = points_stop,
                                             .create = members_create,
                                             .free = members_free,
                                             .prepare = members_prepare,
                                             .take = take_run,
                                             .put_back = put_back_run,
                                             .turning = &turning,
                                             .turns = turns};
