/* contact_block.c - shape and laws over one block of contacts. */
#include "contact_block.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/cohesion/cohesion.h"
#include "../contact/contact.h"
#include "../contact/lubrication/lubrication.h"
#include "../contact/rolling/rolling.h"
#include "contact_loop.h"
#include "sim.h"
#include "turn.h"

/* Takes in slots; lanes without a contact of their own repeat the last one: numbers that laws
 * can take. */
static void take(struct block *b, const struct slots *l, const int *slot, int count)
{
    const int *const restrict owner = l->owner, *const restrict other = l->other;
    int n = count;
    b->n = count;
    b->walls = false;
    memcpy(b->slot, slot, (size_t)count * sizeof *slot);
    for (; n % TOUCH_LANES != 0; n++)
        b->slot[n] = slot[count - 1];
    b->c.n = b->t.n = n;
#pragma omp simd
    for (int c = 0; c < n; c++) {
        const int i = owner[b->slot[c]], j = other[b->slot[c]];
        b->c.i[c] = i;
        b->c.j[c] = j;
    }
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

static void pair_up(const struct sim *s, struct block *b)
{
    const struct frame *const f = &s->frame;
    const real sx = f->scale[0], sy = f->scale[1], sz = f->scale[2];
    const real lx = f->image[0], ly = f->image[1], lz = f->image[2];
    const real ix = f->inv_image[0], iy = f->inv_image[1], iz = f->inv_image[2];
    struct touch *const t = &b->t;
    gather(s, b);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real x = b->c.dx[c] * sx, y = b->c.dy[c] * sy, z = b->c.dz[c] * sz;
        b->c.dx[c] = fma(-lx, rint(x * ix), x);
        b->c.dy[c] = fma(-ly, rint(y * iy), y);
        b->c.dz[c] = fma(-lz, rint(z * iz), z);
    }
    if (s->grains.n_materials == 1)
        memset(t->pair, 0, sizeof t->pair);
    else
        for (int c = 0; c < t->n; c++)
            t->pair[c] = (int)s->bodies[b->c.i[c]].full[3] * s->grains.n_materials +
                         (int)s->bodies[b->c.j[c]].full[3];
    for (int c = 0; c < t->n; c++)
        b->c.wall[c] = NULL;
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

static void reduce(struct block *b)
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

/* Velocities at the contact point, from those of the centres, spins and levers. */
static void velocities(struct block *b)
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

/* The force of a step stands for half a step before and after it. A contact that began within the
 * step was on for depth/|v_n| before: the part of a whole step that its dashpot acts for. Without
 * this the restitution is first order in the step. */
static real first_part(const struct touch *t, int c)
{
    const real dt = (real)t->dt;
    const real since = t->vn[c] < 0.0 ? t->depth[c] / (-t->vn[c] * dt) : 0.5;
    return fmin(fmax(since, 0.0), 1.0) + 0.5;
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
            t->start[c] = first_part(t, c);
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

/* What laws ask for only some of the time. */
static void extras(const struct grains *g, struct block *b, unsigned needs)
{
    struct touch *const t = &b->t;
    if (needs & TOUCH_SPIN)
        for (int c = 0; c < t->n; c++) {
            t->sx[c] = b->px[c];
            t->sy[c] = b->py[c];
            t->sz[c] = b->pz[c];
        }
    if (needs & TOUCH_INERTIA)
        for (int c = 0; c < t->n; c++) {
            const int i = b->c.i[c], j = b->c.j[c];
            const bool wall = b->c.wall[c] != NULL;
            const double ri = (double)t->r_i[c], rj = (double)t->r_j[c];
            double inverse = 0.0;
            if (g->inv_mass[i] > 0.0)
                inverse += 1.0 / (1.0 / g->inv_inertia[i] + g->mass[i] * ri * ri);
            if (!wall && g->inv_mass[j] > 0.0)
                inverse += 1.0 / (1.0 / g->inv_inertia[j] + g->mass[j] * rj * rj);
            t->inertia[c] = (real)(1.0 / inverse);
        }
    if (needs & TOUCH_COUPLES) {
        memset(t->mx, 0, sizeof t->mx);
        memset(t->my, 0, sizeof t->my);
        memset(t->mz, 0, sizeof t->mz);
    }
}

static void apply_laws(struct block *b)
{
    real(*h)[TOUCH] = b->history;
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

static double energy(struct block *b, double reach)
{
    double sum = 0.0;
    real(*h)[TOUCH] = b->history;
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
            sum += b->t.energy[c];
    return sum;
}

/* Forces and torques into rows: force and torque on i; torque on j. */
static inline __attribute__((always_inline)) void pack(struct block *b, bool couples)
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
        const real8 jx = take8(&l->jx[c]), jy = take8(&l->jy[c]), jz = take8(&l->jz[c]);
        real8 i[8] = {fx,
                      fy,
                      fz,
                      zero,
                      iy * fz - iz * fy + mx,
                      iz * fx - ix * fz + my,
                      ix * fy - iy * fx + mz,
                      zero};
        real8 j[8] = {-fx,
                      -fy,
                      -fz,
                      zero,
                      jz * fy - jy * fz - mx,
                      jx * fz - jz * fx - my,
                      jy * fx - jx * fy - mz,
                      zero};
        turn8(i);
        turn8(j);
        for (int k = 0; k < 8; k++) {
            put8(b->on[0][c + k], i[k]);
            put8(b->on[1][c + k], j[k]);
        }
    }
}

static inline double8 wide(const real row[8])
{
    real8 a;
    memcpy(&a, row, sizeof a);
    return __builtin_convertvector(a, double8);
}

static inline double4 force_of(const struct block *b, int c)
{
    const real *const f = b->on[0][c];
    return (double4){(double)f[0], (double)f[1], (double)f[2], 0.0};
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

/* Keeps what is to be remembered of each contact, nothing where there is none. */
static void keep(const struct sim *s, struct block *b, struct slots *l)
{
    const real reach = (real)s->neighbours.reach;
    const int rows = s->neighbours.rows;
    struct touch *const t = &b->t;
    for (int c = 0; c < b->n; c++)
        l->live[b->slot[c]] =
            (unsigned char)((t->depth[c] > -reach) + (t->depth[c] > (real)0.0));
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

/* Adds the forces to the sums: in strides, since neighbouring contacts mostly have one owner, and
 * an addition to what was just added to must wait for it. */
static void add(const struct block *b, const int *restrict to, const struct target *target)
{
    enum { STRIDE = 8 };
    struct sums *const own = target->sums - target->first, *const all = target->sums;
    for (int start = 0; start < STRIDE; start++)
        for (int c = start; c < b->n; c += STRIDE) {
            own[b->c.i[c]].both += wide(b->on[0][c]);
            all[to[b->slot[c]]].both += wide(b->on[1][c]);
        }
}

/* On walls, the torque is that about their pivot. */
static void add_walls(const struct block *b, const struct target *target)
{
    for (int c = 0; c < b->n; c++) {
        const double8 on = wide(b->on[0][c]);
        const vec3 turn = v3_cross(b->arm[c], v3(on[0], on[1], on[2]));
        struct sums *const wall = &target->wall[b->wall[c]];
        target->sums[b->c.i[c] - target->first].both += on;
        wall->both -= on + (double8){0.0, 0.0, 0.0, 0.0, turn.x, turn.y, turn.z, 0.0};
    }
}

/* Forces on frozen grains by the others. */
static void add_skeleton(const struct grains *g, const struct block *b, struct report *r)
{
    for (int c = 0; c < b->n; c++) {
        if (g->inv_mass[b->c.i[c]] == 0.0)
            r->skeleton += force_of(b, c);
        else if (g->inv_mass[b->c.j[c]] == 0.0)
            r->skeleton -= force_of(b, c);
    }
}

/* Counts, energy, the largest overlap; the forces of single contacts where someone looks. */
static void report_all(const struct sim *s, struct block *b, struct report *r)
{
    const double reach = s->neighbours.reach;
    r->energy += energy(b, reach);
    for (int c = 0; c < b->n; c++) {
        const double depth = (double)b->t.depth[c], ri = (double)b->t.r_i[c];
        const double rj = b->t.r_j[c] > 0.0 ? (double)b->t.r_j[c] : ri;
        r->touching += depth > 0.0;
        r->overlap = fmax(r->overlap, depth / fmin(ri, rj));
        if (s->contacts->watched)
            s->contacts->seen[b->walls][b->slot[c]] = force_of(b, c);
    }
}

/* Notes the bonds that broke; put in order where they are read. */
static void note_broken(struct sim *s, const struct block *b, const struct slots *l,
                        double time)
{
    const struct grains *const g = &s->grains;
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

/* From overlap to forces; everything that is asked of the bodies is in the block. */
static void work(struct sim *s, struct block *b, struct slots *l, const struct target *to)
{
    const unsigned needs = rolling_needs | cohesion_needs | lubrication_needs | bond_needs;
    b->t.dt = s->run.dt;
    b->t.time = to->time;
    shape_overlaps(&s->grains, &b->c, &b->t, &b->l);
    velocities(b);
    starts(b, l->live);
    load_memory(b, l->memory, s->neighbours.rows);
    extras(&s->grains, b, needs);
    if (bond_history > 0)
        memset(b->t.broke, 0, sizeof b->t.broke);
    apply_laws(b);
    if (bond_history > 0)
        note_broken(s, b, l, to->time);
    keep(s, b, l);
    if (needs & TOUCH_COUPLES)
        pack(b, true);
    else
        pack(b, false);
    guard(b, (real)s->run.overlap_max, to->report);
    if (to->asked)
        report_all(s, b, to->report);
}

void block_work(struct sim *s, struct block *b, const int *slot, int count,
                const struct target *to)
{
    struct slots *const l = &s->neighbours.pairs;
    for (int from = 0; from < count; from += TOUCH) {
        take(b, l, slot + from, count - from < TOUCH ? count - from : TOUCH);
        pair_up(s, b);
        reduce(b);
        work(s, b, l, to);
        add(b, s->neighbours.to, to);
        if (s->grains.n_frozen > 0)
            add_skeleton(&s->grains, b, to->report);
    }
    b->n = 0;
}

void block_work_walls(struct sim *s, struct block *b, const struct target *to)
{
    if (b->n == 0)
        return;
    b->walls = true;
    pad_walls(b);
    reduce_walls(b);
    work(s, b, &s->neighbours.walls, to);
    add_walls(b, to);
    b->n = 0;
}
