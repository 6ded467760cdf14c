/* contact_block.c - contacts of spheres with each other: one per slot, worked through shape and
 * laws in blocks. */
#include "contact_block.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_path.h"
#include "contact_spheres.h"
#include "contact_view.h"
#include "contact_wall_pack.h"
#include "sim.h"

/* Takes in a block of the pack. */
static void take(struct block *b, struct pack_block *p, int count, const int *slot, bool asked)
{
    b->n = count;
    b->c.n = b->t.n = (count + TOUCH_LANES - 1) / TOUCH_LANES * TOUCH_LANES;
    b->kept = p->memory;
    memcpy(b->c.i, p->i, sizeof b->c.i);
    memcpy(b->c.j, p->j, sizeof b->c.j);
    if (asked || bond_history > 0)
        memcpy(b->slot, slot, (size_t)count * sizeof *slot);
}

enum { NEAR_CACHE = 4 << 20 }; /* bytes: what a core has at hand, by the large */

/* Fetches the other bodies of a block in time, where all of them are more than a core has at hand. */
static void call(const struct sim *s, const struct pack_block *p)
{
    for (int c = 0; c < TOUCH; c++) {
        const struct body *const j = &s->bodies[p->j[c]];
        __builtin_prefetch(j);
        __builtin_prefetch((const char *)j + sizeof *j / 2);
    }
}

/* place and full of eight pairs, i less j: number k of them in out[k], the fourth and the eighth of no
 * meaning; places in steps of the frame, not yet by the nearest image. */
static inline __attribute__((always_inline)) void apart(const struct sim *s, const int *i,
                                                        const int *j, real8 out[8])
{
    const struct body *const all = s->bodies;
    real8 place[4], full[4];
    for (int k = 0; k < 4; k++) {
        const struct body *const i0 = &all[i[k]], *const i4 = &all[i[k + 4]];
        const struct body *const j0 = &all[j[k]], *const j4 = &all[j[k + 4]];
        place[k] = __builtin_convertvector(turn_join_places(i0->place, i4->place) -
                                               turn_join_places(j0->place, j4->place),
                                           real8);
        full[k] = turn_join(i0->full, i4->full) - turn_join(j0->full, j4->full);
    }
    turn_half(place, out);
    turn_half(full, out + 4);
}

/* Distances, not yet by the nearest image, and motion of the centres, i less j. */
void spheres_gather(const struct sim *s, struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c += 8) {
        const int *const i = &b->c.i[c], *const j = &b->c.j[c];
        real8 a[8], d[8];
        apart(s, i, j, a);
        put8(&b->c.dx[c], a[0]);
        put8(&b->c.dy[c], a[1]);
        put8(&b->c.dz[c], a[2]);
        put8(&b->vx[c], a[4]);
        put8(&b->vy[c], a[5]);
        put8(&b->vz[c], a[6]);
        spheres_turn_in(s, i, a);
        spheres_turn_in(s, j, d);
        put8(&t->vx[c], a[0] - d[0]);
        put8(&t->vy[c], a[1] - d[1]);
        put8(&t->vz[c], a[2] - d[2]);
        put8(&b->inv_m[c], a[3] + d[3]);
        put8(&b->px[c], a[4]);
        put8(&b->py[c], a[5]);
        put8(&b->pz[c], a[6]);
        put8(&t->r_i[c], a[7]);
        put8(&b->qx[c], d[4]);
        put8(&b->qy[c], d[5]);
        put8(&b->qz[c], d[6]);
        put8(&t->r_j[c], d[7]);
    }
}

/* What is the same for every block of a run. */
void spheres_open(const struct sim *s, struct block *b, const struct target *to)
{
    b->walls = false;
    b->t.dt = s->run.dt;
    b->t.time = to->time;
    memset(b->t.pair, 0, sizeof b->t.pair);
    for (int c = 0; c < TOUCH; c++)
        b->c.wall[c] = NULL;
}

void spheres_materials(const struct sim *s, struct block *b)
{
    if (s->grains.n_materials > 1)
        for (int c = 0; c < b->t.n; c++)
            b->t.pair[c] = (int)s->bodies[b->c.i[c]].full[3] * s->grains.n_materials +
                           (int)s->bodies[b->c.j[c]].full[3];
}

/* The nearest image of the distances. */
void spheres_nearest(const struct sim *s, struct block *b)
{
    const struct frame *const f = &s->frame;
    const real sx = f->scale[0], sy = f->scale[1], sz = f->scale[2];
    const real lx = f->image[0], ly = f->image[1], lz = f->image[2];
    const real ix = f->inv_image[0], iy = f->inv_image[1], iz = f->inv_image[2];
#pragma omp simd
    for (int c = 0; c < b->t.n; c++) {
        const real x = b->c.dx[c] * sx, y = b->c.dy[c] * sy, z = b->c.dz[c] * sz;
        b->c.dx[c] = fma(-lx, rint(x * ix), x);
        b->c.dy[c] = fma(-ly, rint(y * iy), y);
        b->c.dz[c] = fma(-lz, rint(z * iz), z);
    }
}

/* Dashpots of contacts that began within the step. */
void spheres_starts(struct touch *t, const real *began)
{
    for (int c = 0; c < t->n; c++)
        if (began[c] <= (real)0.0 && t->depth[c] > (real)0.0)
            t->start[c] = laws_first_part(t, c);
}

/* Two spheres [shapes/sphere.c], their reduced mass and radius, their velocities at the contact point:
 * the levers lie along the normal, so one product serves both spins. Notes the overlaps for the
 * next step. */
void spheres_meet(const struct sim *s, struct block *b, real *restrict before, struct report *r)
{
    struct touch *const t = &b->t;
    const real most = (real)s->run.overlap_max;
    _Alignas(64) real began[TOUCH];
    int deep = 0, begun = 0;
#pragma omp simd reduction(| : deep, begun)
    for (int c = 0; c < t->n; c++) {
        const real x = b->c.dx[c], y = b->c.dy[c], z = b->c.dz[c];
        const real ri = t->r_i[c], rj = t->r_j[c], sum = ri + rj, m = b->inv_m[c];
        const real square = fma(x, x, fma(y, y, z * z));
        const real inverse = inverse_root(square), half = 0.5 * (sum - square * inverse);
        const real nx = x * inverse, ny = y * inverse, nz = z * inverse;
        const real depth = 2.0 * half, arm_i = ri - half, arm_j = rj - half;
        const real px = b->px[c], py = b->py[c], pz = b->pz[c];
        const real qx = b->qx[c], qy = b->qy[c], qz = b->qz[c];
        const real wx = fma(arm_i, px, arm_j * qx), wy = fma(arm_i, py, arm_j * qy);
        const real wz = fma(arm_i, pz, arm_j * qz);
        const real over = 1.0 / (sum * m);
        t->m_eff[c] = sum * over;
        t->r_eff[c] = ri * rj * m * over;
        b->arm_i[c] = arm_i;
        b->arm_j[c] = arm_j;
        t->nx[c] = nx;
        t->ny[c] = ny;
        t->nz[c] = nz;
        t->vx[c] = fma(wz, ny, fma(-wy, nz, t->vx[c]));
        t->vy[c] = fma(wx, nz, fma(-wz, nx, t->vy[c]));
        t->vz[c] = fma(wy, nx, fma(-wx, ny, t->vz[c]));
        t->wx[c] = px - qx;
        t->wy[c] = py - qy;
        t->wz[c] = pz - qz;
        t->vn[c] = fma(nx, b->vx[c], fma(ny, b->vy[c], nz * b->vz[c]));
        t->start[c] = 1.0;
        t->depth[c] = depth;
        deep |= depth > most * (ri < rj ? ri : rj);
        begun |= (before[c] <= (real)0.0) & (depth > (real)0.0);
        began[c] = before[c];
        before[c] = depth;
    }
    r->too_deep = r->too_deep || deep;
    if (begun)
        spheres_starts(t, began);
}

static void mark(const struct block *b, struct slots *l, real reach)
{
    for (int c = 0; c < b->n; c++)
        l->live[b->slot[c]] =
            (unsigned char)((b->t.depth[c] > -reach) + (b->t.depth[c] > (real)0.0));
}

/* Counts, energy, the largest overlap; the forces of single contacts where someone looks, which
 * goes by the marks of the slots. */
void spheres_report(const struct sim *s, struct block *b, struct slots *l, struct report *r)
{
    const double reach = s->neighbours.reach;
    mark(b, l, (real)reach);
    r->energy += laws_energy(b, reach, NULL);
    for (int c = 0; c < b->n; c++) {
        const double depth = (double)b->t.depth[c], ri = (double)b->t.r_i[c];
        const double rj = b->t.r_j[c] > 0.0 ? (double)b->t.r_j[c] : ri;
        r->touching += depth > 0.0;
        r->overlap = fmax(r->overlap, depth / fmin(ri, rj));
        if (s->contacts->watched)
            ((double4 *)s->contacts->seen[b->walls])[b->slot[c]] = laws_force(b, c);
    }
}

/* In strides, since neighbouring contacts mostly have one owner, and an addition to what was just added
 * to must wait for it. */
void spheres_add(const struct block *b, const int *restrict to, const struct target *target)
{
    enum { STRIDE = 8 };
    struct sums *const own = target->sums - target->first, *const all = target->sums;
    for (int start = 0; start < STRIDE; start++)
        for (int c = start; c < b->n; c += STRIDE) {
            own[b->c.i[c]].both += laws_wide(b->on[0][c]);
            all[to[c]].both += laws_wide(b->on[1][c]);
        }
}

/* Levers, where someone asks for them. */
static void levers_pairs(struct block *b)
{
    for (int c = 0; c < b->t.n; c++) {
        b->l.ix[c] = -b->arm_i[c] * b->t.nx[c];
        b->l.iy[c] = -b->arm_i[c] * b->t.ny[c];
        b->l.iz[c] = -b->arm_i[c] * b->t.nz[c];
    }
}

/* Where no law reaches, nothing is remembered. */
void spheres_forget(struct block *b, int rows, real reach)
{
    for (int k = 0; k < rows; k++) {
        real *const restrict h = b->kept[k];
#pragma omp simd
        for (int c = 0; c < b->t.n; c++)
            h[c] = b->t.depth[c] > -reach ? h[c] : (real)0.0;
    }
}

static void work_pairs(struct sim *s, struct block *b, const int *slot, int count,
                       const struct target *to)
{
    struct slots *const l = &s->neighbours.pairs;
    const struct pack *const pack = &s->contacts->pack[to->first / s->neighbours.run];
    const int rows = s->neighbours.rows;
    const bool far = (size_t)s->grains.n * sizeof *s->bodies > NEAR_CACHE;
    spheres_open(s, b, to);
    for (int from = 0; from < count; from += TOUCH) {
        struct pack_block *const p = pack_block(pack, from / TOUCH, rows);
        take(b, p, count - from < TOUCH ? count - from : TOUCH, slot + from, to->asked);
        if (far && from + TOUCH < count)
            call(s, pack_block(pack, from / TOUCH + 1, rows));
        spheres_gather(s, b);
        spheres_nearest(s, b);
        spheres_materials(s, b);
        spheres_meet(s, b, p->depth, to->report);
        laws_apply(s, b);
        if (bond_history > 0) {
            levers_pairs(b);
            laws_note_broken(s, b, l, to->time);
        }
        spheres_forget(b, rows, (real)s->neighbours.reach);
        laws_pack_line(b);
        spheres_add(b, p->to, to);
        if (to->asked)
            spheres_report(s, b, l, to->report);
        if (s->grains.n_frozen > 0)
            laws_add_skeleton(&s->grains, b, to->report);
    }
    b->n = 0;
    b->kept = NULL;
}

static void take_run(struct sim *s, int run)
{
    pack_fill(s, run);
    wall_pack_fill(s, run);
}

static void put_back_run(struct sim *s, int run)
{
    pack_put_back(s, run);
    wall_pack_put_back(s, run);
}

static int rows(const struct sim *s)
{
    (void)s;
    return laws_rows();
}

static size_t seen_size(const struct sim *s)
{
    (void)s;
    return sizeof(double4);
}

const struct contact_path contact_spheres = {.rows = rows,
                                             .pairs = work_pairs,
                                             .walls = sphere_walls,
                                             .view = contact_view_slots,
                                             .seen_size = seen_size,
                                             .stop = contact_stop_spheres,
                                             .take = take_run,
                                             .put_back = put_back_run,
                                             .from_bodies = true};
