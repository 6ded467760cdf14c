/* contact_loop.c - the contact loop.
 *
 * The lists of slots are cut into fixed runs of grains that lie close together. A thread takes
 * a run, looks at its active slots and works them through shape and laws in blocks
 * (contact_block.c). The forces go to sums that belong to the run: one for each of its grains and
 * one for each grain of other runs that its slots name, its halo. When a grain moves, it gathers
 * its sum and those in the halos, in the order of the runs. No two threads write to one place,
 * and no sum depends on who computed what: the same bits on any number of threads. */
#include "contact_loop.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/cohesion/cohesion.h"
#include "../contact/contact.h"
#include "../contact/lubrication/lubrication.h"
#include "../contact/rolling/rolling.h"
#include "contact_path.h"
#include "contact_walls.h"
#include "sim.h"

double contact_reach(void)
{
    return fmax(fmax(cohesion_range(), lubrication_range()), bond_range());
}

void contact_create(struct sim *s, struct scene *scene)
{
    struct grains *const g = &s->grains;
    const char **const names = xalloc((size_t)g->n_materials + 1, sizeof *names);
    for (int m = 0; m < g->n_materials; m++)
        names[m] = g->materials[m].name;
    const struct materials materials = {.n = g->n_materials, .name = names};
    contact_init(scene, &materials);
    rolling_init(scene, &materials);
    cohesion_init(scene, &materials);
    lubrication_init(scene, &materials);
    bond_init(scene, &materials);
    xfree(names);
    s->contacts = xalloc(1, sizeof *s->contacts);
    if (shape.path->create)
        shape.path->create(s);
}

void contact_free(struct sim *s)
{
    if (!s->contacts)
        return;
    if (shape.path->free)
        shape.path->free(s);
    xfree(s->contacts->sums);
    for (int run = 0; run < s->contacts->runs; run++) {
        xfree(s->contacts->pack[run].data);
        wall_pack_free(&s->contacts->wall_pack[run]);
    }
    xfree(s->contacts->pack);
    xfree(s->contacts->wall_pack);
    xfree(s->contacts->report);
    xfree(s->contacts->wall_force);
    xfree(s->contacts->wall_sum);
    xfree(s->contacts->broken.bond);
    xfree(s->contacts->seen[0]);
    xfree(s->contacts->seen[1]);
    xfree(s->contacts);
}

static vec3 narrow(double4 a)
{
    return v3(a[0], a[1], a[2]);
}

/* Takes the sums over steps out of the runs, in their order. */
static void flush_sums(struct sim *s)
{
    struct contact_work *const w = s->contacts;
    double4 skeleton = {0.0, 0.0, 0.0, 0.0};
    for (int run = 0; run < w->runs; run++) {
        skeleton += w->report[run].skeleton_sum;
        w->report[run].skeleton_sum = (double4){0.0, 0.0, 0.0, 0.0};
    }
    s->walls.skeleton_sum = v3_add(s->walls.skeleton_sum, narrow(skeleton));
    walls_flush(s);
}

/* Room for the forces of single contacts. */
static void prepare_seen(struct contact_work *w, int list, size_t slots, size_t size)
{
    if (slots <= w->seen_room[list])
        return;
    w->seen_room[list] = slots + slots / 16 + 64;
    xfree(w->seen[list]);
    w->seen[list] = xalloc(w->seen_room[list], size);
}

void contact_prepare(struct sim *s)
{
    struct contact_work *const w = s->contacts;
    const struct neighbours *const nb = &s->neighbours;
    if (w->watched) {
        const size_t size = shape.path->seen_size(s);
        prepare_seen(w, 0, nb->pairs.n, size);
        prepare_seen(w, 1, nb->walls.n, size);
    }
    flush_sums(s);
    if (nb->runs > w->runs) {
        const int runs = w->runs;
        w->runs = nb->runs + nb->runs / 4;
        w->pack = xrealloc(w->pack, (size_t)runs, (size_t)w->runs, sizeof *w->pack);
        w->wall_pack =
            xrealloc(w->wall_pack, (size_t)runs, (size_t)w->runs, sizeof *w->wall_pack);
        const size_t sums = (size_t)w->runs * (size_t)s->walls.n + 1;
        xfree(w->report);
        xfree(w->wall_force);
        xfree(w->wall_sum);
        w->report = xalloc((size_t)w->runs, sizeof *w->report);
        w->wall_force = xalloc(sums, sizeof *w->wall_force);
        w->wall_sum = xalloc(sums, sizeof *w->wall_sum);
    }
    const size_t entries = neighbours_entry(nb, nb->runs, 0);
    if (entries > w->capacity) {
        w->capacity = entries + entries / 16 + 64;
        xfree(w->sums);
        w->sums = xalloc(w->capacity, sizeof *w->sums);
    }
    memset(w->sums, 0, entries * sizeof *w->sums); /* then cleared by who takes them */
    if (shape.path->prepare)
        shape.path->prepare(s);
}

void contact_put_back(struct sim *s)
{
    if (!shape.path->put_back)
        return;
#pragma omp parallel for schedule(static)
    for (int run = 0; run < s->contacts->runs; run++)
        shape.path->put_back(s, run);
    for (int run = 0; run < s->contacts->runs; run++)
        if (s->contacts->report[run].points > 0)
            shape.path->stop(s);
}

/* The contact of a slot is over: nothing is remembered, nothing acts. */
static void end_contact(const struct neighbours *nb, struct slots *l, int slot)
{
    l->live[slot] = 0;
    memset(&l->memory[(size_t)slot * nb->rows], 0, (size_t)nb->rows * sizeof *l->memory);
}

/* Chooses the slots of a run whose bodies are within the thin skin. */
static void choose_pairs(struct sim *s, int run, int first, int last)
{
    struct neighbours *const nb = &s->neighbours;
    struct slots *const l = &nb->pairs;
    const struct frame *const f = &s->frame;
    const struct body *const bodies = s->bodies;
    const real reach = (real)nb->reach, thin = (real)nb->thin;
    int *const active = &l->active[l->begin[first]];
    int n = 0;
    enum { PART = 512 };
    real gap[PART];
    for (int from = l->begin[first]; from < l->begin[last]; from += PART) {
        const int count = l->begin[last] - from < PART ? l->begin[last] - from : PART;
#pragma omp simd
        for (int k = 0; k < count; k++) {
            const int a = l->owner[from + k], b = l->other[from + k];
            const struct body *const i = &bodies[a], *const j = &bodies[b];
            real x = body_along(i, j, 0) * f->scale[0];
            real y = body_along(i, j, 1) * f->scale[1];
            real z = body_along(i, j, 2) * f->scale[2];
            x -= f->image[0] * rint(x * f->inv_image[0]);
            y -= f->image[1] * rint(y * f->inv_image[1]);
            z -= f->image[2] * rint(z * f->inv_image[2]);
            const real margin = reach + thin * ((real)nb->skin[a] + (real)nb->skin[b]);
            const real cut = i->spin[3] + j->spin[3] + margin;
            gap[k] = x * x + y * y + z * z - cut * cut;
        }
        for (int k = 0; k < count; k++) {
            const bool near = gap[k] < 0.0;
            active[n] = from + k;
            n += near;
            if (!near && l->live[from + k])
                end_contact(nb, l, from + k);
        }
    }
    l->n_active[run] = n;
}

static int run_end(const struct sim *s, int run)
{
    return (run + 1) * s->neighbours.run < s->grains.n ? (run + 1) * s->neighbours.run
                                                       : s->grains.n;
}

bool contact_asks_places(const struct sim *s, int run)
{
    const int *const walls = s->neighbours.walls.begin;
    return !shape.path->from_bodies || bond_history > 0 ||
           walls[run_end(s, run)] > walls[run * s->neighbours.run];
}

static void work_run(struct sim *s, int run, double time, bool choose, bool asked)
{
    struct neighbours *const nb = &s->neighbours;
    struct contact_work *const w = s->contacts;
    struct report *const r = &w->report[run];
    const int first = run * s->neighbours.run;
    const int last = run_end(s, run);
    const bool walls = nb->walls.begin[last] > nb->walls.begin[first];
    const struct target to = {.first = first,
                              .sums = &w->sums[neighbours_entry(nb, run, 0)],
                              .wall = &w->wall_force[(size_t)run * s->walls.n],
                              .report = r,
                              .time = time,
                              .asked = asked};
    struct block b;
    r->touching = 0;
    r->energy = r->overlap = 0.0;
    r->too_deep = false;
    r->points = 0;
    r->skeleton = (double4){0.0, 0.0, 0.0, 0.0};
    if (choose) {
        if (shape.path->put_back)
            shape.path->put_back(s, run);
        choose_pairs(s, run, first, last);
        walls_choose(s, run, first, last);
        if (shape.path->take)
            shape.path->take(s, run);
    }
    b.kept = NULL;
    if (walls || choose)
        memset(to.wall, 0, (size_t)s->walls.n * sizeof *to.wall);
    shape.path->pairs(s, &b, &nb->pairs.active[nb->pairs.begin[first]], nb->pairs.n_active[run],
                      &to);
    if (walls)
        shape.path->walls(s, run, &b, &to);
    r->too_deep = r->too_deep || r->points > 0;
    r->skeleton_sum += r->skeleton;
    for (int k = 0; walls && k < s->walls.n; k++)
        w->wall_sum[(size_t)run * s->walls.n + k].both += to.wall[k].both;
    if (r->too_deep)
#pragma omp atomic write
        w->too_deep = 1;
}

void contact_loop(struct sim *s, double time, bool choose, bool asked)
{
#pragma omp for schedule(static)
    for (int run = 0; run < s->neighbours.runs; run++)
        work_run(s, run, time, choose, asked);
}

void contact_collect(struct sim *s, int steps)
{
    const struct contact_work *const w = s->contacts;
    const double dt = s->run.dt;
    s->overlap = s->elastic = 0.0;
    s->neighbours.touching = 0;
    flush_sums(s);
    double4 skeleton = {0.0, 0.0, 0.0, 0.0};
    for (int run = 0; run < s->neighbours.runs; run++) {
        const struct report *const r = &w->report[run];
        s->elastic += r->energy;
        s->neighbours.touching += r->touching;
        s->overlap = fmax(s->overlap, r->overlap);
        skeleton += r->skeleton;
    }
    walls_impulse(&s->walls.skeleton_force, &s->walls.skeleton_sum, &s->walls.skeleton_impulse,
                  narrow(skeleton), steps, dt);
    walls_collect(s, steps);
}

void contact_die(const struct sim *s, int i, int j, const char *overlap)
{
    const struct grains *const g = &s->grains;
    char other[64];
    if (j < 0)
        snprintf(other, sizeof other, "wall %s", s->walls.wall[-1 - j].name);
    else
        snprintf(other, sizeof other, "grain %d", g->id[j]);
    die(EXIT_UNSTABLE,
        "grain %d overlaps %s by %s at t = %.9g s, at %.6g %.6g %.6g m, speed %.3g m/s: more "
        "than "
        "run.overlap_max = %g; take a shorter run.dt or stiffer grains",
        g->id[i], other, overlap, s->t, g->pos[i].x, g->pos[i].y, g->pos[i].z,
        v3_norm(g->vel[i]), s->run.overlap_max);
}

void contact_guard(const struct sim *s)
{
    if (s->contacts->too_deep)
        shape.path->stop(s);
}

/* Finds the largest overlap, to tell. */
void contact_stop_spheres(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    const struct slots *const pairs = &s->neighbours.pairs, *const walls = &s->neighbours.walls;
    double most = 0.0;
    int i = 0, j = -1;
    for (size_t t = 0; t < pairs->n; t++) {
        const int a = pairs->owner[t], b = pairs->other[t];
        const vec3 d = domain_minimum_image(&s->domain, v3_sub(g->pos[a], g->pos[b]));
        const double smaller = fmin(g->radius[a], g->radius[b]);
        const double overlap = (g->radius[a] + g->radius[b] - v3_norm(d)) / smaller;
        if (overlap > most) {
            most = overlap;
            i = a;
            j = b;
        }
    }
    for (size_t t = 0; t < walls->n; t++) {
        const int a = walls->owner[t];
        const vec3 d = wall_see(s, walls->other[t], g->pos[a]).view.away;
        const double overlap = (g->radius[a] - v3_norm(d)) / g->radius[a];
        if (overlap > most) {
            most = overlap;
            i = a;
            j = -1 - s->walls.wall_of[walls->other[t]];
        }
    }
    contact_die(s, i, j, xprintf("%.3g of its radius", most));
}
