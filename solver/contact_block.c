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

void block_open(struct block *b)
{
    b->n = 0;
    b->fresh = b->walls = false;
    memset(b->t.pair, 0, sizeof b->t.pair); /* left so where there is one material */
}

/* Lanes without a contact of their own repeat the last one: numbers that laws can take. */
static int pad(struct block *b)
{
    const int last = b->n - 1;
    int n = b->n;
    for (; n % TOUCH_LANES != 0; n++) {
        b->c.i[n] = b->c.i[last];
        b->c.j[n] = b->c.j[last];
        b->c.wall[n] = b->c.wall[last];
        b->memory[n] = b->memory[last];
        b->d[n] = b->d[last];
        b->v[n] = b->v[last];
        b->full[n] = b->full[last];
        b->spin_i[n] = b->spin_i[last];
        b->spin_j[n] = b->spin_j[last];
        b->t.pair[n] = b->t.pair[last];
    }
    return n;
}

/* Distances by the nearest image, radii, reduced mass, velocities of the centres. */
static void unpack(const struct frame *f, struct block *b)
{
    struct touch *const t = &b->t;
    const real sx = f->scale[0], sy = f->scale[1], sz = f->scale[2];
    const real lx = f->image[0], ly = f->image[1], lz = f->image[2];
    const real ix = f->inv_image[0], iy = f->inv_image[1], iz = f->inv_image[2];
    const coordinate *const restrict d = (const coordinate *)b->d;
    const real *const restrict v = (const real *)b->v, *const restrict p =
                                                           (const real *)b->spin_i;
    const real *const restrict q = (const real *)b->spin_j;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real x = (real)d[4 * c] * sx, y = (real)d[4 * c + 1] * sy;
        const real z = (real)d[4 * c + 2] * sz;
        b->c.dx[c] = x - lx * rint(x * ix);
        b->c.dy[c] = y - ly * rint(y * iy);
        b->c.dz[c] = z - lz * rint(z * iz);
    }
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real ri = p[4 * c + 3], rj = q[4 * c + 3], m = v[4 * c + 3], sum = ri + rj;
        const real inverse = 1.0 / (sum * m);
        t->r_i[c] = ri;
        t->r_j[c] = rj;
        t->m_eff[c] = sum * inverse;
        t->r_eff[c] = rj > 0.0 ? ri * rj * m * inverse : ri;
        t->vx[c] = v[4 * c];
        t->vy[c] = v[4 * c + 1];
        t->vz[c] = v[4 * c + 2];
    }
}

/* Velocities at the contact point, from those of the centres, spins and levers. */
static void velocities(struct block *b)
{
    struct touch *const t = &b->t;
    const struct levers *const l = &b->l;
    const real *const restrict p = (const real *)b->spin_i, *const restrict q =
                                                                (const real *)b->spin_j;
    const real *const restrict u = (const real *)b->full;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real px = p[4 * c], py = p[4 * c + 1], pz = p[4 * c + 2];
        const real qx = q[4 * c], qy = q[4 * c + 1], qz = q[4 * c + 2];
        t->vx[c] += py * l->iz[c] - pz * l->iy[c] - (qy * l->jz[c] - qz * l->jy[c]);
        t->vy[c] += pz * l->ix[c] - px * l->iz[c] - (qz * l->jx[c] - qx * l->jz[c]);
        t->vz[c] += px * l->iy[c] - py * l->ix[c] - (qx * l->jy[c] - qy * l->jx[c]);
        t->wx[c] = px - qx;
        t->wy[c] = py - qy;
        t->wz[c] = pz - qz;
        t->vn[c] = t->nx[c] * u[4 * c] + t->ny[c] * u[4 * c + 1] + t->nz[c] * u[4 * c + 2];
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

static void starts(struct block *b)
{
    for (int c = 0; c < b->t.n; c++)
        b->t.start[c] = 1.0;
    for (int c = 0; c < b->n && b->fresh; c++)
        if (!*b->live[c])
            b->t.start[c] = first_part(&b->t, c);
}

/* The memory of a slot is a number of fours: taken as such, then turned. */
static void load_memory(struct block *b, int rows)
{
    const real *const restrict row = (const real *)b->row[0];
    for (int k = 0; k < rows; k += 4) {
        real(*const h)[TOUCH] = &b->history[k];
        for (int c = 0; c < b->t.n; c++)
            memcpy(&b->row[0][c], b->memory[c] + k, sizeof(real4));
#pragma omp simd
        for (int c = 0; c < b->t.n; c++) {
            h[0][c] = row[4 * c];
            h[1][c] = row[4 * c + 1];
            h[2][c] = row[4 * c + 2];
            h[3][c] = row[4 * c + 3];
        }
    }
}

static void store_memory(struct block *b, int rows)
{
    real *const restrict row = (real *)b->row[0];
    for (int k = 0; k < rows; k += 4) {
        real(*const h)[TOUCH] = &b->history[k];
#pragma omp simd
        for (int c = 0; c < b->t.n; c++) {
            row[4 * c] = h[0][c];
            row[4 * c + 1] = h[1][c];
            row[4 * c + 2] = h[2][c];
            row[4 * c + 3] = h[3][c];
        }
        for (int c = 0; c < b->n; c++)
            memcpy(b->memory[c] + k, &b->row[0][c], sizeof(real4));
    }
}

/* What laws ask for only some of the time. */
static void extras(const struct grains *g, struct block *b, unsigned needs)
{
    struct touch *const t = &b->t;
    if (needs & TOUCH_SPIN)
        for (int c = 0; c < t->n; c++) {
            t->sx[c] = b->spin_i[c][0];
            t->sy[c] = b->spin_i[c][1];
            t->sz[c] = b->spin_i[c][2];
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

/* Forces and torques into rows, the sign of those on j turned. */
static inline __attribute__((always_inline)) void pack(struct block *b, bool couples)
{
    const struct touch *const t = &b->t;
    const struct levers *const l = &b->l;
    real *const restrict f = (real *)b->row[0], *const restrict on_i = (real *)b->row[1];
    real *const restrict on_j = (real *)b->row[2];
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real fx = t->fx[c], fy = t->fy[c], fz = t->fz[c];
        const real mx = couples ? t->mx[c] : 0.0, my = couples ? t->my[c] : 0.0;
        const real mz = couples ? t->mz[c] : 0.0;
        f[4 * c] = fx;
        f[4 * c + 1] = fy;
        f[4 * c + 2] = fz;
        f[4 * c + 3] = 0.0;
        on_i[4 * c] = l->iy[c] * fz - l->iz[c] * fy + mx;
        on_i[4 * c + 1] = l->iz[c] * fx - l->ix[c] * fz + my;
        on_i[4 * c + 2] = l->ix[c] * fy - l->iy[c] * fx + mz;
        on_i[4 * c + 3] = 0.0;
        on_j[4 * c] = -(l->jy[c] * fz - l->jz[c] * fy + mx);
        on_j[4 * c + 1] = -(l->jz[c] * fx - l->jx[c] * fz + my);
        on_j[4 * c + 2] = -(l->jx[c] * fy - l->jy[c] * fx + mz);
        on_j[4 * c + 3] = 0.0;
    }
}

static inline double4 wide(real4 a)
{
    return __builtin_convertvector(a, double4);
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

/* What is remembered, and whether there is a contact at all. */
static void keep(const struct sim *s, struct block *b)
{
    const real reach = (real)s->neighbours.reach;
    const size_t size = (size_t)s->neighbours.rows * sizeof(real);
    store_memory(b, s->neighbours.rows);
    for (int c = 0; c < b->n; c++) {
        const bool touches = b->t.depth[c] > -reach;
        *b->live[c] = touches;
        if (!touches)
            memset(b->memory[c], 0, size);
    }
}

/* Adds the forces to the sums: in strides, since neighbouring contacts mostly have one owner, and
 * an addition to what was just added to must wait for it. */
static void add(struct block *b, struct sums *sums, double4 *wall_force)
{
    enum { STRIDE = 8 };
    for (int start = 0; start < STRIDE; start++)
        for (int c = start; c < b->n; c += STRIDE) {
            const double4 force = wide(b->row[0][c]);
            struct sums *const from = &sums[b->from[c]];
            from->force += force;
            from->torque += wide(b->row[1][c]);
            if (b->walls && b->to[c] < 0) {
                wall_force[-1 - b->to[c]] -= force;
                continue;
            }
            struct sums *const to = &sums[b->to[c]];
            to->force -= force;
            to->torque += wide(b->row[2][c]);
        }
}

/* Forces on frozen grains by the others. */
static void add_skeleton(const struct grains *g, const struct block *b, struct report *r)
{
    for (int c = 0; c < b->n; c++) {
        if (b->to[c] < 0)
            continue;
        if (g->inv_mass[b->c.i[c]] == 0.0)
            r->skeleton += wide(b->row[0][c]);
        else if (g->inv_mass[b->c.j[c]] == 0.0)
            r->skeleton -= wide(b->row[0][c]);
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
        r->touching += depth > -reach;
        r->overlap = fmax(r->overlap, depth / fmin(ri, rj));
        if (s->contacts->watched) {
            const int list = b->to[c] < 0;
            const struct slots *const l = list ? &s->neighbours.walls : &s->neighbours.pairs;
            s->contacts->seen[list][b->live[c] - l->live] = wide(b->row[0][c]);
        }
    }
}

void block_work(struct sim *s, struct block *b, struct sums *sums, struct report *report,
                double4 *wall_force, bool asked)
{
    const unsigned needs = rolling_needs | cohesion_needs | lubrication_needs | bond_needs;
    b->c.n = b->t.n = pad(b);
    b->t.dt = s->run.dt;
    b->t.time = s->t;
    unpack(&s->frame, b);
    shape_overlaps(&s->grains, &b->c, &b->t, &b->l);
    velocities(b);
    starts(b);
    load_memory(b, s->neighbours.rows);
    extras(&s->grains, b, needs);
    if (bond_history > 0)
        memset(b->t.broke, 0, sizeof b->t.broke);
    apply_laws(b);
    keep(s, b);
    if (needs & TOUCH_COUPLES)
        pack(b, true);
    else
        pack(b, false);
    guard(b, (real)s->run.overlap_max, report);
    if (asked)
        report_all(s, b, report);
    add(b, sums, wall_force);
    if (s->grains.n_frozen > 0)
        add_skeleton(&s->grains, b, report);
    b->n = 0;
    b->fresh = b->walls = false;
}
