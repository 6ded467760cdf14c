/* contact_loop.c - the contact loop.
 *
 * The list of pairs is cut into fixed runs of grains. A thread takes a run, keeps the pairs
 * that touch, and works them through the laws in blocks of TOUCH contacts, structure of arrays,
 * which the compiler vectorises. The force of a contact goes to a record of its own; then each
 * grain gathers its records in the order of the list. No two threads write to one place, and no
 * sum depends on who computed what: the same bits on any number of threads. */
#include "contact_loop.h"

#include <limits.h>
#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/cohesion/cohesion.h"
#include "../contact/contact.h"
#include "../contact/rolling/rolling.h"
#include "../shapes/shape.h"
#include "sim.h"

enum { RUN = 128 }; /* grains per run */

struct record {
    vec3 force;              /* N, on the owner; the opposite on the other */
    vec3 torque_i, torque_j; /* N m */
};

/* What a run of grains reports. */
struct report {
    double overlap; /* of the smaller radius */
    int worst;      /* slot of the largest overlap */
    long touching;
    double energy; /* J */
    vec3 wall_force[WALLS_MAX];
    vec3 skeleton_force; /* N, on frozen grains */
};

struct contact_work {
    size_t capacity;
    struct record
        *record;    /* record 0 is zero; those of a run are packed from 1 + its first slot */
    int *record_of; /* per slot; 0: no contact */
    int *records;   /* n + 1; of the grain as owner: from records[i] on, count[i] of them */
    int *count;
    int runs, runs_most; /* of the grains at hand; room in `report` */
    struct report *report;
    int worst; /* slot of the largest overlap */
};

/* One block in the making. */
struct block {
    struct candidates c;
    struct touch t;
    struct levers l;
    real history[HISTORY_MAX][TOUCH];
};

int contact_rows(void)
{
    return contact_history + rolling_history + cohesion_history + bond_history;
}

double contact_reach(void)
{
    return fmax(cohesion_range(), bond_range());
}

void contact_create(struct sim *s, struct scene *scene)
{
    const struct grains *const g = &s->grains;
    const char **const names = xalloc((size_t)g->n_materials + 1, sizeof *names);
    for (int m = 0; m < g->n_materials; m++)
        names[m] = g->materials[m].name;
    const struct materials materials = {.n = g->n_materials, .name = names};
    contact_init(scene, &materials);
    rolling_init(scene, &materials);
    cohesion_init(scene, &materials);
    bond_init(scene, &materials);
    xfree(names);
    s->contacts = xalloc(1, sizeof *s->contacts);
    grains_follow(&s->grains, (void **)&s->contacts->records, sizeof *s->contacts->records);
    grains_follow(&s->grains, (void **)&s->contacts->count, sizeof *s->contacts->count);
}

void contact_free(struct sim *s)
{
    if (!s->contacts)
        return;
    xfree(s->contacts->record);
    xfree(s->contacts->record_of);
    xfree(s->contacts->records);
    xfree(s->contacts->count);
    xfree(s->contacts->report);
    xfree(s->contacts);
}

void contact_prepare(struct sim *s)
{
    struct contact_work *const w = s->contacts;
    const int runs = (s->grains.n + RUN - 1) / RUN;
    if (runs > w->runs_most) {
        xfree(w->report);
        w->report = xalloc((size_t)runs, sizeof *w->report);
        w->runs_most = runs;
    }
    w->runs = runs;
    if (w->record && w->capacity >= s->neighbours.n_slots)
        return;
    xfree(w->record);
    xfree(w->record_of);
    w->capacity = s->neighbours.n_slots + s->neighbours.n_slots / 8 + 64;
    w->record = xalloc(w->capacity + 1, sizeof *w->record);
    w->record_of = xalloc(w->capacity, sizeof *w->record_of);
}

/* Velocities, masses and materials of the contacts of a block, from its normals and levers. */
static void load_motion(const struct sim *s, struct block *b)
{
    const struct grains *const g = &s->grains;
    const int materials = g->n_materials;
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++) {
        const int i = b->c.i[c], j = b->c.j[c];
        const struct wall *const wall = b->c.wall[c];
        const vec3 ai = v3(b->l.ix[c], b->l.iy[c], b->l.iz[c]);
        const vec3 aj = v3(b->l.jx[c], b->l.jy[c], b->l.jz[c]);
        const vec3 n = v3(t->nx[c], t->ny[c], t->nz[c]);
        vec3 v = v3_add(g->vel[i], v3_cross(g->spin[i], ai)), full = g->vel_full[i];
        vec3 w = g->spin[i];
        double inv_m = g->inv_mass[i];
        int other;
        if (wall) {
            v = v3_sub(v, wall->velocity);
            other = wall->material;
        } else {
            v = v3_sub(v, v3_add(g->vel[j], v3_cross(g->spin[j], aj)));
            full = v3_sub(full, g->vel_full[j]);
            w = v3_sub(w, g->spin[j]);
            inv_m += g->inv_mass[j];
            other = grain_material(g, j);
        }
        t->pair[c] = grain_material(g, i) * materials + other;
        t->m_eff[c] = 1.0 / inv_m;
        t->vx[c] = v.x;
        t->vy[c] = v.y;
        t->vz[c] = v.z;
        t->vn[c] = v3_dot(n, full); /* a wall moves in its own plane */
        t->wx[c] = w.x;
        t->wy[c] = w.y;
        t->wz[c] = w.z;
        t->sx[c] = g->spin[i].x;
        t->sy[c] = g->spin[i].y;
        t->sz[c] = g->spin[i].z;
        const double of_i = 1.0 / g->inv_inertia[i] + g->mass[i] * t->r_i[c] * t->r_i[c];
        const double of_j = 1.0 / g->inv_inertia[j] + g->mass[j] * t->r_j[c] * t->r_j[c];
        t->inertia[c] = wall ? of_i : 1.0 / (1.0 / of_i + 1.0 / of_j);
    }
}

/* The force of a step stands for half a step before and after it. A contact that began within the
 * step was on for depth/|v_n| before: the part of a whole step that its dashpot acts for. Without
 * this the restitution is first order in the step. */
static double first_part(const struct touch *t, int c)
{
    const double since = t->vn[c] < 0.0 ? t->depth[c] / (-t->vn[c] * t->dt) : 0.5;
    return fmin(fmax(since, 0.0), 1.0) + 0.5;
}

static void load_history(const struct neighbours *nb, struct block *b)
{
    for (int c = 0; c < b->t.n; c++) {
        const int slot = b->c.slot[c];
        const double *const h = &nb->history[(size_t)slot * nb->rows];
        const double keep = nb->live[slot] ? 1.0 : 0.0;
        for (int k = 0; k < nb->rows; k++)
            b->history[k][c] = keep != 0.0 ? h[k] : 0.0;
        b->t.start[c] = keep != 0.0 ? 1.0 : first_part(&b->t, c);
    }
}

static void apply_laws(struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++) {
        t->mx[c] = t->my[c] = t->mz[c] = 0.0;
        t->broke[c] = 0;
    }
    real(*h)[TOUCH] = b->history;
    contact_forces(&b->t, h);
    h += contact_history;
    cohesion_forces(&b->t, h);
    h += cohesion_history;
    rolling_moments(&b->t, h);
    h += rolling_history;
    bond_forces(&b->t, h);
    h = b->history;
    contact_energy(&b->t, h);
    h += contact_history;
    cohesion_energy(&b->t, h);
    h += cohesion_history;
    rolling_energy(&b->t, h);
    h += rolling_history;
    bond_energy(&b->t, h);
}

/* Writes the records and the history; returns the next free record. */
static int store(struct sim *s, const struct block *b, struct report *r, int next)
{
    struct neighbours *const nb = &s->neighbours;
    struct contact_work *const w = s->contacts;
    const struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++) {
        const int slot = b->c.slot[c];
        if (!(t->depth[c] > -nb->reach)) {
            nb->live[slot] = 0;
            continue;
        }
        const vec3 f = v3(t->fx[c], t->fy[c], t->fz[c]), m = v3(t->mx[c], t->my[c], t->mz[c]);
        const vec3 ai = v3(b->l.ix[c], b->l.iy[c], b->l.iz[c]);
        const vec3 aj = v3(b->l.jx[c], b->l.jy[c], b->l.jz[c]);
        struct record *const record = &w->record[next];
        record->force = f;
        record->torque_i = v3_add(v3_cross(ai, f), m);
        record->torque_j = v3_scale(-1.0, v3_add(v3_cross(aj, f), m));
        w->record_of[slot] = next++;
        w->count[b->c.i[c]]++;
        nb->live[slot] = 1;
        double *const h = &nb->history[(size_t)slot * nb->rows];
        for (int k = 0; k < nb->rows; k++)
            h[k] = b->history[k][c];
        r->energy += t->energy[c];
        r->touching++;
        const double r_j = t->r_j[c] > 0.0 ? t->r_j[c] : t->r_i[c];
        const double overlap = t->depth[c] / fmin(t->r_i[c], r_j);
        if (overlap > r->overlap) {
            r->overlap = overlap;
            r->worst = slot;
        }
        if (b->c.wall[c]) {
            vec3 *const sum = &r->wall_force[b->c.wall[c] - s->walls.wall];
            *sum = v3_sub(*sum, f);
        } else if (s->grains.inv_mass[b->c.i[c]] == 0.0) {
            r->skeleton_force = v3_add(r->skeleton_force, f);
        } else if (s->grains.inv_mass[b->c.j[c]] == 0.0) {
            r->skeleton_force = v3_sub(r->skeleton_force, f);
        }
    }
    return next;
}

static int work_block(struct sim *s, struct block *b, struct report *r, int next)
{
    b->t.n = b->c.n;
    b->t.dt = s->run.dt;
    b->t.time = s->t;
    shape_overlaps(&s->grains, &b->c, &b->t, &b->l);
    load_motion(s, b);
    load_history(&s->neighbours, b);
    apply_laws(b);
    b->c.n = 0;
    return store(s, b, r, next);
}

/* The slot as the next candidate of the block, kept if its bodies are within reach: it is
 * written in any case and counted if so, without a branch that could be guessed wrong. */
static void offer_grain(struct sim *s, struct block *b, int slot)
{
    const struct grains *const g = &s->grains;
    const int i = s->neighbours.owner[slot], j = s->neighbours.other[slot], c = b->c.n;
    const vec3 d = domain_minimum_image(&s->domain, v3_sub(g->pos[i], g->pos[j]));
    const double cut = g->radius[i] + g->radius[j] + s->neighbours.reach;
    const bool near = v3_dot(d, d) < cut * cut;
    b->c.i[c] = i;
    b->c.j[c] = j;
    b->c.slot[c] = slot;
    b->c.wall[c] = NULL;
    b->c.dx[c] = d.x;
    b->c.dy[c] = d.y;
    b->c.dz[c] = d.z;
    b->c.n += near;
    s->neighbours.live[slot] &= near;
}

static void offer_wall(struct sim *s, struct block *b, int slot)
{
    const struct grains *const g = &s->grains;
    const int i = s->neighbours.owner[slot], c = b->c.n;
    const struct wall *const wall = &s->walls.wall[-1 - s->neighbours.other[slot]];
    const double above = v3_dot(v3_sub(g->pos[i], wall->point), wall->normal);
    const bool near = above < g->radius[i] + s->neighbours.reach;
    b->c.i[c] = b->c.j[c] = i;
    b->c.slot[c] = slot;
    b->c.wall[c] = wall;
    b->c.dx[c] = above * wall->normal.x;
    b->c.dy[c] = above * wall->normal.y;
    b->c.dz[c] = above * wall->normal.z;
    b->c.n += near;
    s->neighbours.live[slot] &= near;
}

static void work_run(struct sim *s, int run)
{
    struct neighbours *const nb = &s->neighbours;
    struct contact_work *const w = s->contacts;
    struct report *const r = &w->report[run];
    const int first = run * RUN;
    const int last = first + RUN < s->grains.n ? first + RUN : s->grains.n;
    struct block b;
    int next = 1 + nb->begin[first];
    b.c.n = 0;
    *r = (struct report){.worst = -1};
    memset(&w->count[first], 0, (size_t)(last - first) * sizeof *w->count);
    memset(&w->record_of[nb->begin[first]], 0,
           (size_t)(nb->begin[last] - nb->begin[first]) * sizeof *w->record_of);
    for (int slot = nb->begin[first]; slot < nb->begin[last]; slot++) {
        if (nb->other[slot] >= 0)
            offer_grain(s, &b, slot);
        else
            offer_wall(s, &b, slot);
        if (b.c.n == TOUCH)
            next = work_block(s, &b, r, next);
    }
    if (b.c.n > 0)
        work_block(s, &b, r, next);
    next = 1 + nb->begin[first];
    for (int i = first; i < last; i++) {
        w->records[i] = next;
        next += w->count[i];
    }
}

static void die_overlap(const struct sim *s, int slot, double overlap)
{
    const struct grains *const g = &s->grains;
    const int i = s->neighbours.owner[slot], j = s->neighbours.other[slot];
    char other[64];
    if (j < 0)
        snprintf(other, sizeof other, "wall %s", s->walls.wall[-1 - j].name);
    else
        snprintf(other, sizeof other, "grain %d", g->id[j]);
    die(EXIT_UNSTABLE,
        "grain %d overlaps %s by %.3g of its radius at t = %.9g s, at %.6g %.6g %.6g m, speed "
        "%.3g "
        "m/s: more than run.overlap_max = %g; take a shorter run.dt or stiffer grains",
        g->id[i], other, overlap, s->t, g->pos[i].x, g->pos[i].y, g->pos[i].z,
        v3_norm(g->vel[i]), s->run.overlap_max);
}

/* Impulses take half of each step's force at either end, as the kicks do. */
static void half_impulses(struct sim *s)
{
    const double half = 0.5 * s->run.dt;
    struct walls *const w = &s->walls;
    for (int k = 0; k < w->n; k++)
        w->wall[k].impulse = v3_axpy(w->wall[k].impulse, half, w->wall[k].force);
    w->skeleton_impulse = v3_axpy(w->skeleton_impulse, half, w->skeleton_force);
}

/* Adds the reports of the runs, in their order. */
static void collect(struct sim *s)
{
    struct contact_work *const w = s->contacts;
    half_impulses(s);
    s->overlap = s->elastic = 0.0;
    s->neighbours.touching = 0;
    s->walls.skeleton_force = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < s->walls.n; k++)
        s->walls.wall[k].force = v3(0.0, 0.0, 0.0);
    for (int run = 0; run < w->runs; run++) {
        const struct report *const r = &w->report[run];
        s->elastic += r->energy;
        s->neighbours.touching += r->touching;
        if (r->overlap > s->overlap) {
            s->overlap = r->overlap;
            w->worst = r->worst;
        }
        for (int k = 0; k < s->walls.n; k++)
            s->walls.wall[k].force = v3_add(s->walls.wall[k].force, r->wall_force[k]);
        s->walls.skeleton_force = v3_add(s->walls.skeleton_force, r->skeleton_force);
    }
    half_impulses(s);
}

void contact_guard(const struct sim *s)
{
    if (s->overlap > s->run.overlap_max)
        die_overlap(s, s->contacts->worst, s->overlap);
}

void contact_loop(struct sim *s)
{
#pragma omp for schedule(static)
    for (int run = 0; run < s->contacts->runs; run++)
        work_run(s, run);
#pragma omp master
    collect(s);
}

void contact_gather(struct sim *s)
{
    struct grains *const g = &s->grains;
    const struct neighbours *const nb = &s->neighbours;
    const struct contact_work *const w = s->contacts;
    const struct record *const record = w->record;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < g->n; i++) {
        vec3 force = g->load[i], torque = g->load_torque[i];
        for (int k = w->records[i]; k < w->records[i] + w->count[i]; k++) {
            force = v3_add(force, record[k].force);
            torque = v3_add(torque, record[k].torque_i);
        }
        /* a slot without contact adds record 0, which is zero */
        for (int t = nb->begin_in[i]; t < nb->begin_in[i + 1]; t++) {
            const int k = w->record_of[nb->slots_in[t]];
            force = v3_sub(force, record[k].force);
            torque = v3_add(torque, record[k].torque_j);
        }
        g->force[i] = force;
        g->torque[i] = torque;
    }
}
