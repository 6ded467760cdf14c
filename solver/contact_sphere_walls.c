/* contact_sphere_walls.c - the wall contacts of spheres, a block of one wall at a time
 * (contact_wall_pack.h).
 *
 * Balls that are near several elements of a wall are looked at first, and contact_wall_crowds.c tells
 * which of these count. Then every block goes through the laws. Everything is decided grain by
 * grain in the order of the slots: the same on any number of threads. */
#include "contact_wall_crowds.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/contact.h"
#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_spheres.h"
#include "contact_walls.h"
#include "turn.h"

/* What a step takes of a block's geometry. */
struct sight {
    struct wall_looks look;
    double arm[3][TOUCH]; /* m, from the wall's pivot to the centre */
    struct ball_places places;
};

void spheres_places(const struct sim *s, const int *grain, struct wall_looks *l)
{
    for (int c = 0; c < l->n && BODY_IS_FLOAT; c++) {
        const vec3 x = s->grains.pos[grain[c]];
        l->x[c] = x.x;
        l->y[c] = x.y;
        l->z[c] = x.z;
    }
    for (int c = 0; c < l->n && !BODY_IS_FLOAT; c++) {
        const struct body *const body = &s->bodies[grain[c]];
        l->x[c] = (double)body->place[0];
        l->y[c] = (double)body->place[1];
        l->z[c] = (double)body->place[2];
    }
}

static void put_double(double *x, real8 a)
{
    const double8 wide = __builtin_convertvector(a, double8);
    memcpy(x, &wide, sizeof wide);
}

/* The grains' numbers and places. */
static void gather(const struct sim *s, struct block *b, struct wall_looks *l)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c += 8) {
        const int *const i = &b->c.i[c];
        real8 a[8];
        for (int k = 0; k < 8; k++)
            a[k] = take8((const real *)&s->bodies[i[k]].place); /* full comes behind */
        turn8(a);
        put_double(&l->x[c], a[0]);
        put_double(&l->y[c], a[1]);
        put_double(&l->z[c], a[2]);
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
    if (BODY_IS_FLOAT) /* places are no metres */
        spheres_places(s, b->c.i, l);
}

/* Takes in a block of the pack. */
static void take(const struct sim *s, struct block *b, struct wall_block *p, struct sight *v,
                 bool asked)
{
    const struct wall *const w = &s->walls.wall[p->wall];
    struct touch *const t = &b->t;
    const int materials = s->grains.n_materials;
    b->n = p->n;
    b->c.n = t->n = v->look.n = (p->n + TOUCH_LANES - 1) / TOUCH_LANES * TOUCH_LANES;
    b->kept = p->memory;
    memcpy(b->c.i, p->i, sizeof b->c.i);
    memcpy(b->c.j, p->i, sizeof b->c.j);
    if (asked || bond_history > 0)
        memcpy(b->slot, p->slot, sizeof b->slot);
    for (int c = 0; c < t->n; c++) {
        b->c.wall[c] = w;
        t->pair[c] = w->material;
    }
    for (int c = 0; c < t->n && materials > 1; c++)
        t->pair[c] += (int)s->bodies[p->i[c]].full[3] * materials;
    gather(s, b, &v->look);
}

/* Sees the wall from every ball. */
static void see(const struct sim *s, const struct wall_block *p, struct sight *v,
                const struct ball_walls *balls)
{
    struct wall_looks *const l = &v->look;
    memcpy(l->element, p->element, sizeof l->element);
    if (balls) {
        balls->place(s, p->i, p->ball, l->n, &v->places);
        for (int c = 0; c < l->n; c++) {
            l->x[c] += (double)v->places.off[0][c];
            l->y[c] += (double)v->places.off[1][c];
            l->z[c] += (double)v->places.off[2][c];
        }
    }
    if (p->kind == ON_FACE)
        walls_look_flat(s, &s->walls.wall[p->wall], (const double(*)[WALL_LOOKS])p->plane, l,
                        v->arm);
    else
        walls_look(s, &s->walls.wall[p->wall], l, v->arm);
}

/* Distances, normals and levers. */
static void reach_out(const struct sim *s, struct block *b, const struct wall_looks *l)
{
    struct touch *const t = &b->t;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        b->c.dx[c] = (real)l->ax[c];
        b->c.dy[c] = (real)l->ay[c];
        b->c.dz[c] = (real)l->az[c];
        t->r_j[c] = 0.0;
    }
    shape.overlaps(&s->grains, &b->c, t, &b->l);
}

/* What the contacts remember turns with the wall about the normal, by the angle w . n dt: sine and cosine by their
 * series, to round-off up to SMALL; beyond, from the tangent of half of it, whose series then gives
 * a rotation all the same. With the normal, laws turn it. */
#define SMALL 0.1

static inline __attribute__((always_inline)) void
turn_about(const struct touch *t, real (*kept)[TOUCH], real wx, real wy, real wz, bool small)
{
    real *const restrict hx = kept[0], *const restrict hy = kept[1];
    real *const restrict hz = kept[2];
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real nx = t->nx[c], ny = t->ny[c], nz = t->nz[c];
        const real x = hx[c], y = hy[c], z = hz[c];
        const real a = wx * nx + wy * ny + wz * nz, q = a * a;
        real sine, less; /* less: 1 - cosine */
        if (small) {
            sine = a * (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q * (1.0 / 5040.0))));
            less = q * (0.5 - q * (1.0 / 24.0 - q * (1.0 / 720.0 - q * (1.0 / 40320.0))));
        } else {
            const real h =
                0.5 * a * (1.0 + q * (1.0 / 12.0 + q * (1.0 / 120.0 + q * (17.0 / 20160.0))));
            const real even = 1.0 / (1.0 + h * h);
            sine = 2.0 * h * even;
            less = 2.0 * h * h * even;
        }
        const real along = x * nx + y * ny + z * nz;
        hx[c] = x - less * (x - along * nx) + sine * (ny * z - nz * y);
        hy[c] = y - less * (y - along * ny) + sine * (nz * x - nx * z);
        hz[c] = z - less * (z - along * nz) + sine * (nx * y - ny * x);
    }
}

static void turn_memory(const struct sim *s, const struct wall_pose *pose, struct block *b)
{
    const vec3 by = v3_scale(s->run.dt, pose->half_spin);
    const real wx = (real)by.x, wy = (real)by.y, wz = (real)by.z;
    if (contact_history < 3)
        return;
    if (v3_norm(by) < SMALL)
        turn_about(&b->t, b->kept, wx, wy, wz, true);
    else
        turn_about(&b->t, b->kept, wx, wy, wz, false);
}

/* m/s, rad/s, of a wall: of its pivot, spin; at the half and at the full step. */
struct rates {
    vec3 half, full, half_spin, full_spin;
};

/* Velocities at the contact relative to the wall's, from those of the centre, spin and lever, and where it
 * turns by the lever from its pivot; vn from the centre's alone. */
static inline __attribute__((always_inline)) void
approach(struct block *b, const struct sight *v, const struct rates *r, bool turns)
{
    struct touch *const t = &b->t;
    const struct wall_looks *const l = &v->look;
    const real ux = (real)r->half.x, uy = (real)r->half.y, uz = (real)r->half.z;
    const real gx = (real)r->full.x, gy = (real)r->full.y, gz = (real)r->full.z;
    const real hx = (real)r->half_spin.x, hy = (real)r->half_spin.y, hz = (real)r->half_spin.z;
    const real fx = (real)r->full_spin.x, fy = (real)r->full_spin.y, fz = (real)r->full_spin.z;
#pragma omp simd
    for (int c = 0; c < t->n; c++) {
        const real px = b->px[c], py = b->py[c], pz = b->pz[c];
        const real x = b->l.ix[c], y = b->l.iy[c], z = b->l.iz[c];
        const real ax = turns ? (real)(v->arm[0][c] - l->ax[c]) : (real)0.0;
        const real ay = turns ? (real)(v->arm[1][c] - l->ay[c]) : (real)0.0;
        const real az = turns ? (real)(v->arm[2][c] - l->az[c]) : (real)0.0;
        real vx = t->vx[c] - ux, vy = t->vy[c] - uy, vz = t->vz[c] - uz;
        real wx = b->vx[c] - gx, wy = b->vy[c] - gy, wz = b->vz[c] - gz;
        if (turns) {
            vx -= fma(hy, az, -hz * ay);
            vy -= fma(hz, ax, -hx * az);
            vz -= fma(hx, ay, -hy * ax);
            wx -= fma(fy, az, -fz * ay);
            wy -= fma(fz, ax, -fx * az);
            wz -= fma(fx, ay, -fy * ax);
        }
        t->vx[c] = fma(py, z, fma(-pz, y, vx));
        t->vy[c] = fma(pz, x, fma(-px, z, vy));
        t->vz[c] = fma(px, y, fma(-py, x, vz));
        t->wx[c] = turns ? px - hx : px;
        t->wy[c] = turns ? py - hy : py;
        t->wz[c] = turns ? pz - hz : pz;
        t->vn[c] = fma(t->nx[c], wx, fma(t->ny[c], wy, t->nz[c] * wz));
    }
}

static void move(const struct sim *s, struct block *b, int wall, const struct sight *v)
{
    const struct wall *const w = &s->walls.wall[wall];
    const struct wall_pose *const pose = &w->pose;
    const vec3 belt = w->motion.surface, h = pose->half_spin, f = pose->spin;
    struct rates r = {belt, belt, {0}, {0}};
    if (w->motion.moves && !s->walls.still)
        r = (struct rates){v3_add(belt, pose->half), v3_add(belt, pose->velocity), h, f};
    if (v3_dot(r.half_spin, r.half_spin) + v3_dot(r.full_spin, r.full_spin) == 0.0) {
        approach(b, v, &r, false);
        return;
    }
    approach(b, v, &r, true);
    turn_memory(s, pose, b);
}

/* Reduced masses and radii: on a curved wall those of the sphere that touches a plane like this one. Overlaps
 * are noted for the next step; contacts that do not count are none. */
static void meet(const struct sim *s, struct block *b, struct wall_block *p,
                 const struct wall_looks *l, struct report *r)
{
    struct touch *const t = &b->t;
    const real most = (real)s->run.overlap_max, gap = (real)s->neighbours.reach;
    _Alignas(64) real before[TOUCH];
    int deep = 0, begun = 0;
#pragma omp simd reduction(| : deep, begun)
    for (int c = 0; c < t->n; c++) {
        const real ri = t->r_i[c], square = fma((real)l->curvature[c], ri, 1.0);
        const real depth = p->counts[c] ? t->depth[c] : -gap - ri;
        t->m_eff[c] = (real)1.0 / b->inv_m[c];
        t->r_eff[c] = ri * inverse_root(square > (real)0.01 ? square : (real)0.01);
        t->start[c] = 1.0;
        deep |= depth > most * ri;
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
static void add(struct block *b, int of, const struct sight *v, const struct target *to)
{
    struct sums *const own = to->sums - to->first, *const wall = &to->wall[of];
    double8 force[3] = {{0.0}}, torque[3] = {{0.0}};
    laws_pack_i(b);
    for (int c = 0; c < b->n; c++)
        own[b->c.i[c]].both += laws_wide(b->on[0][c]);
    for (int c = 0; c < b->t.n; c += 8) {
        const double8 x = laws_eight(&b->t.fx[c]), y = laws_eight(&b->t.fy[c]);
        const double8 z = laws_eight(&b->t.fz[c]);
        double8 ax, ay, az;
        memcpy(&ax, &v->arm[0][c], sizeof ax);
        memcpy(&ay, &v->arm[1][c], sizeof ay);
        memcpy(&az, &v->arm[2][c], sizeof az);
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

/* Contacts of a block in full. */
static void work(struct sim *s, struct block *b, struct wall_block *p, const struct target *to,
                 const struct ball_walls *balls)
{
    struct slots *const l = &s->neighbours.walls;
    const int rows = laws_rows();
    struct sight v;
    take(s, b, p, &v, to->asked);
    see(s, p, &v, balls);
    if (balls) {
        balls->enter(b, &v.places);
        for (int c = 0; c < b->n; c++)
            b->wall[c] = p->wall;
    }
    reach_out(s, b, &v.look);
    move(s, b, p->wall, &v);
    meet(s, b, p, &v.look, to->report);
    laws_apply(s, b);
    if (balls)
        balls->leave(b, &v.places, v.arm);
    laws_note_broken(s, b, l, to->time);
    spheres_forget(b, rows, (real)s->neighbours.reach);
    add(b, p->wall, &v, to);
    if (to->asked && balls)
        balls->report(s, b, to->report);
    else if (to->asked)
        spheres_report(s, b, l, to->report);
}

/* Elements that have no lane are touched by nobody. */
static void clear_marks(const struct wall_pack *pack, struct slots *l)
{
    for (int k = 0; k < pack->n_entries; k++)
        l->live[pack->entry[k].slot] = 0;
}

void ball_walls(struct sim *s, int run, struct block *b, const struct target *to,
                const struct ball_walls *balls)
{
    struct wall_pack *const pack = &s->contacts->wall_pack[run];
    const int rows = laws_rows();
    wall_crowds_decide(s, pack, balls);
    if (to->asked && !balls)
        clear_marks(pack, &s->neighbours.walls);
    b->walls = true;
    b->t.dt = s->run.dt;
    b->t.time = to->time;
    for (int k = 0; k < pack->n_blocks; k++) {
        struct wall_block *const p = wall_pack_block(pack, k, rows);
        if (p->n > 0)
            work(s, b, p, to, balls);
    }
    b->n = 0;
    b->kept = NULL;
}

void sphere_walls(struct sim *s, int run, struct block *b, const struct target *to)
{
    ball_walls(s, run, b, to, NULL);
}
