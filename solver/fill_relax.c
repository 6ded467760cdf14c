/* fill_relax.c - the least of E = sum of overlap^2/2 over all pairs [OHern03], by FIRE [Bitzek06].
 *
 * A grain's inertia is the number of its overlaps, so that no grain is stiffer than the others and
 * one step suits all sizes: a grain of 50 d among thousands of small ones moves as surely as they.
 * Each grain sums the forces of its own neighbours in the order of its list, and sums over all
 * grains go over fixed blocks: the same bits on any number of threads. */
#include "fill_relax.h"

#include <string.h>
#include "sim.h"

#define SKIN      0.40 /* of the least diameter, room to move before neighbours are sought anew */
#define STEP_MOST 0.6 /* stable below sqrt 2: unit springs, inertia = their number */
#define STEP      0.2
#define MIX       0.1
#define STRIDE    0.1 /* of its diameter, the farthest that a grain goes in a step */

enum { BLOCK = 1024, CORNERS = 8 };

/* Neighbours and sums of a block of grains. */
struct relax_block {
    int *near; /* of the grains one after the other */
    int n, capacity;
    double power, force, speed; /* F.v, F.F, v.v */
    double overlap, net, push, moved;
    long contacts;
};

struct relax {
    struct fill_grid *bed;
    const struct fill_region *region;
    const struct sim *walls;
    int first, n, blocks;
    double skin, swell, scale;
    bool *by_wall; /* near one, since the list was made */
    int *begin;    /* per grain, in its block's list */
    int *count;
    double *inertia;
    vec3 *vel, *force, *built;
    struct relax_block *block;
};

static int last_of(const struct relax *r, int block)
{
    const int end = r->first + (block + 1) * BLOCK;
    return end < r->n ? end : r->n;
}

/* Sorts the grains that move by cells of about two diameters, in layers. */
static void sort_by_place(struct fill_grid *b, int first)
{
    const double *const size = b->domain->size;
    const int n = b->n - first;
    const double edge = fmax(cbrt(size[0] * size[1] * size[2] / (n / 4.0 + 1.0)), 1e-300);
    int cells[3];
    for (int a = 0; a < 3; a++)
        cells[a] = (int)fmin(fmax(1.0, floor(size[a] / edge)), 500.0);
    const int total = cells[0] * cells[1] * cells[2];
    int *const begin = xalloc((size_t)total + 1, sizeof *begin);
    int *const home = xalloc((size_t)n, sizeof *home);
    struct placed *const sorted = xalloc((size_t)n, sizeof *sorted);
    for (int i = 0; i < n; i++) {
        const vec3 x = b->grain[first + i].pos;
        const double at[3] = {x.x, x.y, x.z};
        int c[3];
        for (int a = 0; a < 3; a++)
            c[a] = (int)fmin(fmax(0.0, floor(at[a] / size[a] * cells[a])), cells[a] - 1.0);
        home[i] = c[0] + cells[0] * (c[1] + cells[1] * c[2]);
        begin[home[i] + 1]++;
    }
    for (int c = 0; c < total; c++)
        begin[c + 1] += begin[c];
    for (int i = 0; i < n; i++)
        sorted[begin[home[i]]++] = b->grain[first + i];
    if (n > 0)
        memcpy(b->grain + first, sorted, (size_t)n * sizeof *sorted);
    xfree(begin);
    xfree(home);
    xfree(sorted);
}

/* The grid anew from the grains where they are. */
static void rebuild_grid(struct fill_grid *b)
{
    const int n = b->n;
    fill_grid_clear(b);
    for (int i = 0; i < n; i++) {
        b->grain[i].pos = domain_wrap(b->domain, b->grain[i].pos);
        fill_grid_add(b, b->grain[i]);
    }
}

static void list_block(struct relax *r, int k)
{
    struct relax_block *const list = &r->block[k];
    list->n = 0;
    for (int i = r->first + k * BLOCK; i < last_of(r, k); i++) {
        const int room = list->capacity - list->n;
        const int found = fill_grid_near(r->bed, i, r->skin, list->near + list->n, room);
        if (found > room) {
            const int more = list->n + found + BLOCK * 16;
            list->near =
                xrealloc(list->near, (size_t)list->capacity, (size_t)more, sizeof *list->near);
            list->capacity = more;
            fill_grid_near(r->bed, i, r->skin, list->near + list->n, found);
        }
        r->begin[i] = list->n;
        r->count[i] = found;
        list->n += found;
        r->built[i] = r->bed->grain[i].pos;
        const double d = r->bed->grain[i].diameter, margin = r->skin + STRIDE * d;
        r->by_wall[i] =
            r->walls && walls_gap(r->walls, r->built[i], 0.5 * d, margin, NULL) < margin;
    }
}

static void list_all(struct relax *r)
{
    rebuild_grid(r->bed);
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < r->blocks; k++)
        list_block(r, k);
}

/* Net force on grain i; sums of its block. */
static vec3 push_grain(struct relax *r, struct relax_block *s, int i)
{
    const struct placed *const g = r->bed->grain, *const p = &g[i];
    vec3 net = v3(0.0, 0.0, 0.0);
    int touching = 0;
    for (int m = r->begin[i]; m < r->begin[i] + r->count[i]; m++) {
        const struct placed *const q = &g[s->near[m]];
        const vec3 d = domain_minimum_image(r->bed->domain, v3_sub(p->pos, q->pos));
        const double touch = 0.5 * r->scale * (p->diameter + q->diameter);
        const double apart = (1.0 + r->swell) * touch;
        const double square = v3_dot(d, d);
        if (square >= apart * apart)
            continue;
        const double distance = sqrt(square), depth = apart - distance;
        s->overlap =
            fmax(s->overlap, (touch - distance) / (r->scale * fmin(p->diameter, q->diameter)));
        s->push += depth;
        touching++;
        /* two centres in one place part along x, the earlier one up */
        net = distance > 0.0 ? v3_axpy(net, depth / distance, d)
                             : v3_add(net, v3(i < s->near[m] ? depth : -depth, 0.0, 0.0));
    }
    s->contacts += touching;
    r->inertia[i] = fmax(fmax(1.0, 0.9 * r->inertia[i]), touching);
    return net;
}

/* Of a force, one coordinate: not against a bound that the grain rests on. */
static void rest(double x, double lo, double hi, double *f)
{
    if ((x <= lo && *f < 0.0) || (x >= hi && *f > 0.0))
        *f = 0.0;
}

/* What is left of a force on a grain that rests on walls. */
static vec3 borne(const struct relax *r, int i, vec3 f)
{
    const struct placed *const p = &r->bed->grain[i];
    const struct fill_region *const g = &r->region[p->species];
    const double radius = 0.5 * r->scale * p->diameter;
    if (r->by_wall[i])
        f = walls_bear(r->walls, p->pos, radius * (1.0 + 1e-9), f);
    if (!g->open[0])
        rest(p->pos.x, g->from[0] + radius, g->to[0] - radius, &f.x);
    if (!g->open[1])
        rest(p->pos.y, g->from[1] + radius, g->to[1] - radius, &f.y);
    if (!g->open[2])
        rest(p->pos.z, g->from[2] + radius, g->to[2] - radius, &f.z);
    return f;
}

static void push_block(struct relax *r, int k)
{
    struct relax_block *const s = &r->block[k];
    s->power = s->force = s->speed = s->overlap = s->net = s->push = 0.0;
    s->contacts = 0;
    for (int i = r->first + k * BLOCK; i < last_of(r, k); i++) {
        const vec3 f = r->force[i] = borne(r, i, push_grain(r, s, i));
        s->power += v3_dot(f, r->vel[i]);
        s->force += v3_dot(f, f) / r->inertia[i];
        s->speed += v3_dot(r->vel[i], r->vel[i]) * r->inertia[i];
        s->net = fmax(s->net, v3_norm(f));
    }
}

/* Keeps one coordinate inside; what would leave stops. */
static void bound(double *x, double *v, double lo, double hi)
{
    if (*x < lo || *x > hi) {
        *x = *x < lo ? lo : hi;
        *v = 0.0;
    }
}

/* Puts a grain that has entered walls back on their surfaces, and stops it there. */
static void keep_clear(const struct relax *r, double radius, vec3 *x, vec3 *v)
{
    for (int k = 0; k < CORNERS; k++) {
        vec3 way;
        const double gap = walls_escape(r->walls, *x, radius, &way);
        if (gap >= 0.0)
            return;
        *x = v3_axpy(*x, -gap, way);
        *v = v3_axpy(*v, fmax(0.0, -v3_dot(*v, way)), way);
    }
}

static void bound_grain(const struct relax *r, int i, vec3 *x, vec3 *v)
{
    const struct placed *const p = &r->bed->grain[i];
    const struct fill_region *const g = &r->region[p->species];
    const double radius = 0.5 * r->scale * p->diameter;
    if (!g->open[0])
        bound(&x->x, &v->x, g->from[0] + radius, g->to[0] - radius);
    if (!g->open[1])
        bound(&x->y, &v->y, g->from[1] + radius, g->to[1] - radius);
    if (!g->open[2])
        bound(&x->z, &v->z, g->from[2] + radius, g->to[2] - radius);
    if (r->by_wall[i]) /* last: walls, and the box is one, are harder than a region */
        keep_clear(r, radius, x, v);
}

static void move_block(struct relax *r, int k, double step, double keep, double steer)
{
    struct relax_block *const s = &r->block[k];
    s->moved = 0.0;
    for (int i = r->first + k * BLOCK; i < last_of(r, k); i++) {
        struct placed *const p = &r->bed->grain[i];
        const vec3 a = v3_scale(1.0 / r->inertia[i], r->force[i]);
        vec3 v = v3_axpy(v3_scale(keep, r->vel[i]), steer, a);
        v = v3_axpy(v, step, a);
        const double speed = v3_norm(v) * step, most = STRIDE * p->diameter;
        if (speed > most)
            v = v3_scale(most / speed, v);
        vec3 x = v3_axpy(p->pos, step, v);
        bound_grain(r, i, &x, &v);
        p->pos = x;
        r->vel[i] = v;
        const vec3 moved = v3_sub(x, r->built[i]);
        s->moved = fmax(s->moved, v3_dot(moved, moved));
    }
}

/* The sums of all blocks, in their order. */
static struct relax_block total(const struct relax *r)
{
    struct relax_block t = {0};
    for (int k = 0; k < r->blocks; k++) {
        const struct relax_block *const s = &r->block[k];
        t.power += s->power;
        t.force += s->force;
        t.speed += s->speed;
        t.push += s->push;
        t.contacts += s->contacts;
        t.overlap = fmax(t.overlap, s->overlap);
        t.net = fmax(t.net, s->net);
        t.moved = fmax(t.moved, s->moved);
    }
    return t;
}

static void relax_open(struct relax *r, struct fill_grid *b, int first,
                       const struct fill_region *region, const struct relax_goal *goal)
{
    const size_t n = (size_t)b->n + 1;
    double least = (double)INFINITY, widest = 0.0;
    for (int i = first; i < b->n; i++) {
        least = fmin(least, b->grain[i].diameter);
        widest = fmax(widest, b->grain[i].diameter);
    }
    *r = (struct relax){.bed = b,
                        .region = region,
                        .walls = goal->walls,
                        .first = first,
                        .n = b->n,
                        .swell = goal->swell,
                        .scale = goal->scale};
    r->skin = SKIN * least + goal->swell * widest;
    r->blocks = (b->n - first + BLOCK - 1) / BLOCK;
    r->begin = xalloc(n, sizeof *r->begin);
    r->count = xalloc(n, sizeof *r->count);
    r->inertia = xalloc(n, sizeof *r->inertia);
    r->vel = xalloc(n, sizeof *r->vel);
    r->force = xalloc(n, sizeof *r->force);
    r->built = xalloc(n, sizeof *r->built);
    r->by_wall = xalloc(n, sizeof *r->by_wall);
    r->block = xalloc((size_t)r->blocks + 1, sizeof *r->block);
}

static void relax_close(struct relax *r)
{
    for (int k = 0; k < r->blocks; k++)
        xfree(r->block[k].near);
    void *const all[] = {r->begin, r->count, r->inertia, r->vel,
                         r->force, r->built, r->by_wall, r->block};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

/* Largest depth in a wall over the diameter: in a corner that is narrower than the grain. */
static double into_walls(const struct relax *r)
{
    double worst = 0.0;
    for (int i = r->first; i < r->n; i++) {
        const struct placed *const p = &r->bed->grain[i];
        const double d = r->scale * p->diameter;
        if (r->by_wall[i])
            worst = fmax(worst, -walls_gap(r->walls, p->pos, 0.5 * d, 0.0, NULL) / d);
    }
    return worst > 1e-9 ? worst : 0.0;
}

struct relaxed fill_relax(struct fill_grid *b, int first, const struct fill_region *region,
                          const struct relax_goal *goal)
{
    struct relax r;
    struct relaxed result = {0};
    double step = STEP, mix = MIX;
    int downhill = 0;
    sort_by_place(b, first);
    relax_open(&r, b, first, region, goal);
    const double room = r.skin - goal->swell * b->widest;
    list_all(&r);
    for (int i = first; i < b->n; i++) /* those that have grown into a wall */
        bound_grain(&r, i, &b->grain[i].pos, &r.vel[i]);
    for (;; result.sweeps++) {
#pragma omp parallel for schedule(static)
        for (int k = 0; k < r.blocks; k++)
            push_block(&r, k);
        const struct relax_block t = total(&r);
        result.overlap = t.overlap;
        result.balance = t.contacts > 0 ? t.net / (t.push / (double)t.contacts) : 0.0;
        if (t.overlap <= goal->overlap || result.balance <= goal->balance ||
            result.sweeps == goal->sweeps)
            break;
        if (t.power > 0.0 && ++downhill > 5) {
            step = fmin(1.1 * step, STEP_MOST);
            mix *= 0.99;
        }
        const bool uphill = t.power <= 0.0 && result.sweeps > 0;
        if (uphill) {
            downhill = 0;
            step = fmax(0.5 * step, 0.02);
            mix = MIX;
        }
        const double keep = uphill ? 0.0 : 1.0 - mix;
        const double steer = uphill || t.force == 0.0 ? 0.0 : mix * sqrt(t.speed / t.force);
#pragma omp parallel for schedule(static)
        for (int k = 0; k < r.blocks; k++)
            move_block(&r, k, step, keep, steer);
        if (sqrt(total(&r).moved) > 0.5 * room)
            list_all(&r);
    }
    rebuild_grid(b);
    result.overlap = fmax(result.overlap, into_walls(&r));
    relax_close(&r);
    return result;
}
