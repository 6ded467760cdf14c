/* contact_block.c - contacts of spheres: one per slot, worked through shape and laws in blocks. */
#include "contact_block.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_path.h"
#include "contact_view.h"
#include "contact_walls.h"
#include "sim.h"
#include "turn.h"

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

/* The numbers of eight bodies from one of their halves on: number k of body c in out[k][c]. */
static inline __attribute__((always_inline)) void turn_in(const struct sim *s, const int *grain,
                                                          real8 out[8])
{
    for (int k = 0; k < 8; k++)
        out[k] = take8((const real *)&s->bodies[grain[k]].vel);
    turn8(out);
}

/* Distances, not yet by the nearest image, and motion of the centres, i less j. */
static void gather(const struct sim *s, struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c += 8) {
        const int *const i = &b->c.i[c], *const j = &b->c.j[c];
        real8 a[8], d[8];
        for (int k = 0; k < 8; k++)
            a[k] = body_apart(&s->bodies[i[k]], &s->bodies[j[k]]);
        turn8(a);
        put8(&b->c.dx[c], a[0]);
        put8(&b->c.dy[c], a[1]);
        put8(&b->c.dz[c], a[2]);
        put8(&b->vx[c], a[4]);
        put8(&b->vy[c], a[5]);
        put8(&b->vz[c], a[6]);
        turn_in(s, i, a);
        turn_in(s, j, d);
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
static void open_pairs(const struct sim *s, struct block *b, const struct target *to)
{
    b->walls = false;
    b->t.dt = s->run.dt;
    b->t.time = to->time;
    memset(b->t.pair, 0, sizeof b->t.pair);
    for (int c = 0; c < TOUCH; c++)
        b->c.wall[c] = NULL;
}

static void pair_materials(const struct sim *s, struct block *b)
{
    if (s->grains.n_materials > 1)
        for (int c = 0; c < b->t.n; c++)
            b->t.pair[c] = (int)s->bodies[b->c.i[c]].full[3] * s->grains.n_materials +
                           (int)s->bodies[b->c.j[c]].full[3];
}

/* The nearest image of the distances. */
static void nearest(const struct sim *s, struct block *b)
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
static void starts_pairs(struct touch *t, const real *began)
{
    for (int c = 0; c < t->n; c++)
        if (began[c] <= (real)0.0 && t->depth[c] > (real)0.0)
            t->start[c] = laws_first_part(t, c);
}

/* Two spheres [shapes/sphere.c], their reduced mass and radius, their velocities at the contact point:
 * the levers lie along the normal, so one product serves both spins. Notes the overlaps for the
 * next step. */
static void meet(const struct sim *s, struct block *b, real *restrict before, struct report *r)
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
        starts_pairs(t, began);
}

/* Lanes without a wall contact of their own repeat the last one. */
static void pad_walls(struct block *b)
{
    struct touch *const t = &b->t;
    int n = b->n;
    const int last = n - 1;
    for (; n % TOUCH_LANES != 0; n++) {
        real *const array[] = {b->c.dx, b->c.dy, b->c.dz, t->r_i, t->r_j, b->curve, b->inv_m,
                               t->vx,   t->vy,   t->vz,   b->vx,  b->vy,  b->vz,    b->px,
                               b->py,   b->pz,   b->qx,   b->qy,  b->qz};
        for (size_t k = 0; k < sizeof array / sizeof array[0]; k++)
            array[k][n] = array[k][last];
        b->slot[n] = b->slot[last];
        b->c.i[n] = b->c.i[last];
        b->c.j[n] = b->c.j[last];
        b->c.wall[n] = b->c.wall[last];
        t->pair[n] = t->pair[last];
    }
    b->c.n = t->n = n;
}

/* Reduced mass and radius against walls, whose curvature is given. */
static void reduce_walls(struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++) {
        t->m_eff[c] = 1.0 / b->inv_m[c];
        t->r_eff[c] = t->r_i[c] / (1.0 + b->curve[c] * t->r_i[c]);
    }
}

static void starts(struct block *b, const unsigned char *live)
{
    struct touch *const t = &b->t;
    int new = 0;
    for (int c = 0; c < t->n; c++)
        t->start[c] = 1.0;
    for (int c = 0; c < b->n; c++)
        new |= (live[b->slot[c]] != LIVE_OVERLAP) & (t->depth[c] > 0.0);
    for (int c = 0; c < b->n && new; c++)
        if (live[b->slot[c]] != LIVE_OVERLAP && t->depth[c] > 0.0)
            t->start[c] = laws_first_part(t, c);
}

/* The memory of a slot is a number of fours: taken as such, then turned. */
static void load_memory(struct block *b, const real *memory, int rows)
{
    const real *const restrict row = (const real *)b->row;
    for (int k = 0; k < rows; k += 4) {
        real(*const h)[TOUCH] = &b->history[k];
        for (int c = 0; c < b->t.n; c++)
            memcpy(&b->row[c], &memory[(size_t)b->slot[c] * rows + k], sizeof(real4));
#pragma omp simd
        for (int c = 0; c < b->t.n; c++) {
            h[0][c] = row[4 * c];
            h[1][c] = row[4 * c + 1];
            h[2][c] = row[4 * c + 2];
            h[3][c] = row[4 * c + 3];
        }
    }
}

static void guard(const struct block *b, real most, struct report *r)
{
    int deep = 0;
    for (int c = 0; c < b->t.n; c++) {
        const real rj = b->t.r_j[c] > 0.0 ? b->t.r_j[c] : b->t.r_i[c];
        const real smaller = b->t.r_i[c] < rj ? b->t.r_i[c] : rj;
        deep |= b->t.depth[c] > most * smaller;
    }
    r->too_deep = r->too_deep || deep;
}

static void mark(const struct block *b, struct slots *l, real reach)
{
    for (int c = 0; c < b->n; c++)
        l->live[b->slot[c]] =
            (unsigned char)((b->t.depth[c] > -reach) + (b->t.depth[c] > (real)0.0));
}

/* Keeps what is to be remembered of each contact, nothing where there is none. */
static void keep(const struct sim *s, struct block *b, struct slots *l)
{
    const real reach = (real)s->neighbours.reach;
    const int rows = s->neighbours.rows;
    struct touch *const t = &b->t;
    mark(b, l, reach);
    for (int k = 0; k < rows; k += 4)
        for (int c = 0; c < t->n; c += 8) {
            const real8 gap = -take8(&t->depth[c]);
            const lane8 touches = gap < reach;
            real8 h[4], pairs[4];
            for (int m = 0; m < 4; m++)
                h[m] = (real8)((lane8)take8(&b->history[k + m][c]) & touches);
            turn4(h, pairs);
            for (int m = 0; m < 4; m++) { /* rows m and m + 4 */
                real two[8];
                put8(two, pairs[m]);
                if (c + m < b->n)
                    memcpy(&l->memory[(size_t)b->slot[c + m] * rows + k], two, sizeof(real4));
                if (c + m + 4 < b->n)
                    memcpy(&l->memory[(size_t)b->slot[c + m + 4] * rows + k], two + 4,
                           sizeof(real4));
            }
        }
}

/* Counts, energy, the largest overlap; the forces of single contacts where someone looks, which
 * goes by the marks of the slots. */
static void report_all(const struct sim *s, struct block *b, struct slots *l, struct report *r)
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

/* From overlap to forces; everything that is asked of the bodies is in the block. */
static void work(struct sim *s, struct block *b, struct slots *l, const struct target *to)
{
    b->t.dt = s->run.dt;
    b->t.time = to->time;
    shape.overlaps(&s->grains, &b->c, &b->t, &b->l);
    laws_velocities(b);
    starts(b, l->live);
    load_memory(b, l->memory, s->neighbours.rows);
    laws_apply(s, b);
    laws_note_broken(s, b, l, to->time);
    keep(s, b, l);
    laws_pack(b);
    guard(b, (real)s->run.overlap_max, to->report);
    if (to->asked)
        report_all(s, b, l, to->report);
}

/* Adds the forces to the sums: in strides, since neighbouring contacts mostly have one owner, and
 * an addition to what was just added to must wait for it. */
static void add(const struct block *b, const int *restrict to, const struct target *target)
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
static void forget(struct block *b, int rows, real reach)
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
    const struct pack *const pack = &s->contacts->pack[to->first / RUN];
    const int rows = s->neighbours.rows;
    open_pairs(s, b, to);
    for (int from = 0; from < count; from += TOUCH) {
        struct pack_block *const p = pack_block(pack, from / TOUCH, rows);
        take(b, p, count - from < TOUCH ? count - from : TOUCH, slot + from, to->asked);
        gather(s, b);
        nearest(s, b);
        pair_materials(s, b);
        meet(s, b, p->depth, to->report);
        laws_apply(s, b);
        if (bond_history > 0) {
            levers_pairs(b);
            laws_note_broken(s, b, l, to->time);
        }
        forget(b, rows, (real)s->neighbours.reach);
        laws_pack_line(b);
        add(b, p->to, to);
        if (to->asked)
            report_all(s, b, l, to->report);
        if (s->grains.n_frozen > 0)
            laws_add_skeleton(&s->grains, b, to->report);
    }
    b->n = 0;
    b->kept = NULL;
}

void block_work_walls(struct sim *s, struct block *b, const struct target *to)
{
    if (b->n == 0)
        return;
    b->walls = true;
    pad_walls(b);
    reduce_walls(b);
    work(s, b, &s->neighbours.walls, to);
    laws_add_walls(b, to);
    b->n = 0;
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
                                             .walls = walls_enter,
                                             .view = contact_view_slots,
                                             .seen_size = seen_size,
                                             .stop = contact_stop_spheres,
                                             .take = pack_fill,
                                             .put_back = pack_put_back};
