/* contact_sphere_walls.c - the wall contacts of spheres, a block of one wall at a time.
 *
 * All elements are looked at first. Where a grain is near several elements of a wall,
 * contact_facing.c tells which of them count: on coplanar triangles a grain feels one plane, at a
 * convex edge one contact, at a concave one two. When a contact goes over to another element of its
 * wall, it takes its memory along: to the one that is new, from the one that ended whose normal is
 * nearest. Everything is decided grain by grain in the order of the slots: the same on any number of
 * threads. */
#include "contact_walls.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/contact.h"
#include "contact_facing.h"
#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_spheres.h"
#include "contact_wall_pack.h"
#include "sim.h"
#include "turn.h"

#define SAME 1e-6 /* of the radius: points nearer than this coincide */

enum { FEW = 32 };

/* One of a crowd. */
struct member {
    struct wall_block *block;
    int c;
};

static struct member member(const struct wall_pack *p, int entry)
{
    return (struct member){wall_pack_block(p, entry / TOUCH, laws_rows()), entry % TOUCH};
}

static bool is_live(const struct sim *s, const struct member *m)
{
    return m->block->depth[m->c] > -(real)s->neighbours.reach;
}

static struct facing facing_of(const struct sim *s, const struct member *m)
{
    const struct wall_block *const b = m->block;
    const int c = m->c;
    struct facing f = {.slot = b->slot[c], .wall = b->wall, .local = b->look.element[c]};
    f.centre = v3_add(s->grains.pos[b->i[c]],
                      v3((double)b->off[0][c], (double)b->off[1][c], (double)b->off[2][c]));
    f.away = v3(b->look.ax[c], b->look.ay[c], b->look.az[c]);
    f.distance = b->distance[c];
    f.part = (enum wall_part)b->look.part[c];
    f.live = is_live(s, m);
    return f;
}

/* A new contact takes the memory of one that has just ended. */
static void pass_memory(struct facing *f, const struct member *of, int n, int k)
{
    double nearest = 0.0;
    int from = -1;
    for (int m = 0; m < n; m++) {
        if (f[m].counts || !f[m].live)
            continue;
        const double cosine = v3_dot(f[m].away, f[k].away) / (f[m].distance * f[k].distance);
        if (cosine > nearest) {
            nearest = cosine;
            from = m;
        }
    }
    if (from < 0)
        return;
    const struct member *const a = &of[from], *const b = &of[k];
    for (int row = 0; row < laws_rows(); row++)
        b->block->memory[row][b->c] = a->block->memory[row][a->c];
    b->block->depth[b->c] = a->block->depth[a->c];
    f[from].live = false; /* given away */
}

/* Of the elements that a grain is near marks those that count, and hands memory on. */
static void decide(const struct sim *s, const struct wall_pack *p, struct wall_crowd crowd)
{
    struct facing few[FEW], *f = few;
    struct member some[FEW], *of = some;
    int n = 0;
    if (crowd.to - crowd.from > FEW) {
        f = xalloc((size_t)(crowd.to - crowd.from), sizeof *f);
        of = xalloc((size_t)(crowd.to - crowd.from), sizeof *of);
    }
    for (int e = crowd.from; e < crowd.to; e++) {
        of[n] = member(p, e);
        n += of[n].block->counts[of[n].c] || is_live(s, &of[n]);
    }
    for (int k = 0; k < n && n > 1; k++)
        f[k] = facing_of(s, &of[k]);
    for (int k = 0; k < n && n > 1; k++) {
        int *const counts = &of[k].block->counts[of[k].c];
        const double same = SAME * s->grains.radius[of[k].block->i[of[k].c]];
        *counts = f[k].counts = *counts && !facing_hidden(s, f, n, k, same);
    }
    for (int k = 0; k < n && n > 1; k++)
        if (f[k].counts && !f[k].live)
            pass_memory(f, of, n, k);
    if (f != few) {
        xfree(f);
        xfree(of);
    }
}

static void look(const struct sim *s, struct wall_block *b, const struct ball_walls *balls)
{
    const struct grains *const g = &s->grains;
    const double reach = s->neighbours.reach;
    struct wall_looks *const l = &b->look;
    double near[TOUCH];
    if (balls)
        balls->place(s, b);
    for (int c = 0; c < l->n; c++) {
        const vec3 x = g->pos[b->i[c]];
        l->x[c] = x.x + (double)b->off[0][c];
        l->y[c] = x.y + (double)b->off[1][c];
        l->z[c] = x.z + (double)b->off[2][c];
        near[c] = (balls ? (double)b->radius[c] : g->radius[b->i[c]]) + reach;
    }
    walls_look(s, &s->walls.wall[b->wall], l, b->arm);
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const double x = l->ax[c], y = l->ay[c], z = l->az[c];
        b->distance[c] = sqrt(x * x + y * y + z * z);
        b->counts[c] = b->distance[c] < near[c];
    }
    for (int c = b->n; c < l->n; c++)
        b->counts[c] = 0;
}

/* What the contacts remember turns with the wall about the normal, by the angle 2 h, h = tan(h') the
 * series of the tangent: a rotation whatever the angle, and by that angle to round-off where it is
 * small. With the normal, laws turn it. */
static void turn_memory(const struct sim *s, const struct wall_pose *pose, struct wall_block *b)
{
    const double wx = pose->half_spin.x, wy = pose->half_spin.y, wz = pose->half_spin.z;
    const double half_dt = 0.5 * s->run.dt;
    real *const restrict hx = b->memory[0], *const restrict hy = b->memory[1];
    real *const restrict hz = b->memory[2];
    if (contact_history < 3)
        return;
#pragma omp simd
    for (int c = 0; c < b->look.n; c++) {
        const double over = 1.0 / b->distance[c];
        const double nx = b->look.ax[c] * over, ny = b->look.ay[c] * over;
        const double nz = b->look.az[c] * over, x = (double)hx[c], y = (double)hy[c],
                     z = (double)hz[c];
        const double a = (wx * nx + wy * ny + wz * nz) * half_dt, q = a * a;
        const double t = a * (1.0 + q * (1.0 / 3.0 + q * (2.0 / 15.0 + q * (17.0 / 315.0))));
        const double even = 1.0 / (1.0 + t * t), sine = 2.0 * t * even;
        const double less = 2.0 * t * t * even; /* 1 - cosine */
        const double along = x * nx + y * ny + z * nz;
        hx[c] = (real)(x - less * (x - along * nx) + sine * (ny * z - nz * y));
        hy[c] = (real)(y - less * (y - along * ny) + sine * (nz * x - nx * z));
        hz[c] = (real)(z - less * (z - along * nz) + sine * (nx * y - ny * x));
    }
}

/* The grains' numbers. */
static void gather(const struct sim *s, struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c += 8) {
        const int *const i = &b->c.i[c];
        real8 a[8];
        for (int k = 0; k < 8; k++)
            a[k] = take8((const real *)&s->bodies[i[k]].place); /* full comes behind */
        turn8(a);
        put8(&b->vx[c], a[4]);
        put8(&b->vy[c], a[5]);
        put8(&b->vz[c], a[6]);
        spheres_turn_in(s, i, a);
        put8(&t->vx[c], a[0]);
        put8(&t->vy[c], a[1]);
        put8(&t->vz[c], a[2]);
        put8(&b->inv_m[c], a[3]);
        put8(&b->px[c], a[4]);
        put8(&b->py[c], a[5]);
        put8(&b->pz[c], a[6]);
        put8(&t->r_i[c], a[7]);
    }
}

/* Takes in a block of the pack: grains and wall. */
static void take(const struct sim *s, struct block *b, struct wall_block *p)
{
    const struct wall *const w = &s->walls.wall[p->wall];
    const struct wall_looks *const l = &p->look;
    struct touch *const t = &b->t;
    const int materials = s->grains.n_materials;
    b->n = p->n;
    b->c.n = t->n = l->n;
    b->kept = p->memory;
    memcpy(b->c.i, p->i, sizeof b->c.i);
    memcpy(b->c.j, p->i, sizeof b->c.j);
    memcpy(b->slot, p->slot, sizeof b->slot);
    for (int c = 0; c < t->n; c++) {
        b->c.wall[c] = w;
        t->pair[c] = w->material;
    }
    for (int c = 0; c < t->n && materials > 1; c++)
        t->pair[c] += (int)s->bodies[p->i[c]].full[3] * materials;
    gather(s, b);
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        b->c.dx[c] = (real)l->ax[c];
        b->c.dy[c] = (real)l->ay[c];
        b->c.dz[c] = (real)l->az[c];
        t->r_j[c] = 0.0;
        t->start[c] = 1.0;
        b->qx[c] = b->qy[c] = b->qz[c] = 0.0;
    }
}

/* Velocities relative to the wall's at the contact point. */
static void move(const struct sim *s, struct block *b, struct wall_block *p)
{
    const struct wall *const w = &s->walls.wall[p->wall];
    const struct wall_pose *const pose = &w->pose;
    const struct wall_looks *const l = &p->look;
    const vec3 belt = w->motion.surface, zero = v3(0.0, 0.0, 0.0);
    const bool moves = w->motion.moves && !s->walls.still;
    const vec3 half = moves ? v3_add(belt, pose->half) : belt;
    const vec3 full = moves ? v3_add(belt, pose->velocity) : belt;
    const vec3 h = moves ? pose->half_spin : zero, f = moves ? pose->spin : zero;
    struct touch *const t = &b->t;
#pragma omp simd
    for (int c = 0; c < t->n; c++) { /* levers: from the pivot */
        const double x = p->arm[0][c] - l->ax[c], y = p->arm[1][c] - l->ay[c];
        const double z = p->arm[2][c] - l->az[c];
        t->vx[c] -= (real)(half.x + (h.y * z - h.z * y));
        t->vy[c] -= (real)(half.y + (h.z * x - h.x * z));
        t->vz[c] -= (real)(half.z + (h.x * y - h.y * x));
        b->vx[c] -= (real)(full.x + (f.y * z - f.z * y));
        b->vy[c] -= (real)(full.y + (f.z * x - f.x * z));
        b->vz[c] -= (real)(full.z + (f.x * y - f.y * x));
        b->qx[c] = (real)h.x;
        b->qy[c] = (real)h.y;
        b->qz[c] = (real)h.z;
    }
    if (moves && (h.x != 0.0 || h.y != 0.0 || h.z != 0.0))
        turn_memory(s, pose, p);
}

/* Reduced masses and radii: on a curved wall those of the sphere that touches a plane like this one. */
static void reduce(struct block *b, const struct wall_looks *l)
{
    struct touch *const t = &b->t;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const double r = (double)t->r_i[c], square = 1.0 + l->curvature[c] * r;
        t->m_eff[c] = (real)1.0 / b->inv_m[c];
        t->r_eff[c] = (real)(r / sqrt(square > 0.01 ? square : 0.01));
    }
}

/* Overlaps are noted for the next step; contacts that do not count are none. */
static void meet(const struct sim *s, struct block *b, struct wall_block *p, struct report *r)
{
    struct touch *const t = &b->t;
    const real most = (real)s->run.overlap_max, gap = (real)s->neighbours.reach;
    _Alignas(64) real before[TOUCH];
    int deep = 0, begun = 0;
#pragma omp simd reduction(| : deep, begun)
    for (int c = 0; c < t->n; c++) {
        const real depth = p->counts[c] ? t->depth[c] : -gap - t->r_i[c];
        deep |= depth > most * t->r_i[c];
        begun |= (p->depth[c] <= (real)0.0) & (depth > (real)0.0);
        before[c] = p->depth[c];
        p->depth[c] = t->depth[c] = depth;
    }
    r->too_deep = r->too_deep || deep;
    if (begun)
        spheres_starts(t, before);
}

/* Force and torque on each grain to its sum; on the wall, with the torque about its pivot, to
 * the wall's, eight by eight and these in order. */
static void add(struct block *b, const struct wall_block *p, const struct target *to)
{
    struct sums *const own = to->sums - to->first, *const wall = &to->wall[p->wall];
    double8 force[3] = {{0.0}}, torque[3] = {{0.0}};
    laws_pack_i(b);
    for (int c = 0; c < b->n; c++)
        own[b->c.i[c]].both += laws_wide(b->on[0][c]);
    for (int c = 0; c < b->t.n; c += 8) {
        const double8 x = laws_eight(&b->t.fx[c]), y = laws_eight(&b->t.fy[c]);
        const double8 z = laws_eight(&b->t.fz[c]);
        double8 ax, ay, az;
        memcpy(&ax, &p->arm[0][c], sizeof ax);
        memcpy(&ay, &p->arm[1][c], sizeof ay);
        memcpy(&az, &p->arm[2][c], sizeof az);
        ax += laws_eight(&b->l.ix[c]);
        ay += laws_eight(&b->l.iy[c]);
        az += laws_eight(&b->l.iz[c]);
        force[0] += x;
        force[1] += y;
        force[2] += z;
        torque[0] += ay * z - az * y;
        torque[1] += az * x - ax * z;
        torque[2] += ax * y - ay * x;
    }
    laws_couples(b, torque);
    for (int k = 0; k < 8; k++)
        wall->both -= (double8){force[0][k],  force[1][k],  force[2][k],  0.0,
                                torque[0][k], torque[1][k], torque[2][k], 0.0};
}

void ball_walls(struct sim *s, int run, struct block *b, const struct target *to,
                const struct ball_walls *balls)
{
    struct wall_pack *const pack = &s->contacts->wall_pack[run];
    struct slots *const l = &s->neighbours.walls;
    const int rows = laws_rows();
    for (int k = 0; k < pack->n_blocks; k++)
        look(s, wall_pack_block(pack, k, rows), balls);
    for (int k = 0; k < pack->n_crowds; k++)
        decide(s, pack, pack->crowd[k]);
    b->walls = true;
    b->t.dt = s->run.dt;
    b->t.time = to->time;
    for (int k = 0; k < pack->n_blocks; k++) {
        struct wall_block *const p = wall_pack_block(pack, k, rows);
        take(s, b, p);
        if (balls)
            balls->enter(b, p);
        move(s, b, p);
        reduce(b, &p->look);
        shape.overlaps(&s->grains, &b->c, &b->t, &b->l);
        laws_velocities(b);
        meet(s, b, p, to->report);
        laws_apply(s, b);
        if (balls)
            balls->leave(b, p);
        laws_note_broken(s, b, l, to->time);
        spheres_forget(b, rows, (real)s->neighbours.reach);
        add(b, p, to);
        if (to->asked && balls)
            balls->report(s, b, to->report);
        else if (to->asked)
            spheres_report(s, b, l, to->report);
    }
    b->n = 0;
    b->kept = NULL;
}

void sphere_walls(struct sim *s, int run, struct block *b, const struct target *to)
{
    ball_walls(s, run, b, to, NULL);
}
