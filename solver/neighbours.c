/* neighbours.c - the lists of slots: made from the search grid, with the memory of live contacts
 * carried from the old list to the new.
 *
 * The skin adapts to the motion: thick while grains fall, thin in a bed at rest. It follows
 * from the state alone, so it is the same on any number of threads and after a restart. */
#include "neighbours.h"

#include <string.h>
#include "../contact/contact.h"
#include "contact_loop.h"
#include "contact_path.h"
#include "search.h"
#include "sim.h"

#define SKIN_LEAST  0.06 /* of the mean diameter */
#define SKIN_MOST   0.30
#define SKIN_STEPS  60.0  /* steps that a skin should last */
#define INNER_STEPS 16.0  /* steps that the thin skin should last */
#define INNER_LEAST 0.002 /* of the mean diameter: a bed at rest may wake up */
#define INNER_MOST  0.01  /* of the mean diameter: thicker, it costs more than it saves */

void neighbours_check(const struct sim *s, struct scene *scene)
{
    const struct grains *const g = &s->grains;
    const double widest = 2.0 * grains_widest(g);
    if (g->n == g->n_frozen || !isfinite(contact_duration(0, 0, 1.0, 1.0, 1.0)))
        return; /* nothing touches */
    const double least = g->n > 1 ? 2.0 * (widest + contact_reach()) : widest;
    for (int a = 0; a < 3; a++)
        if (s->domain.periodic[a] && s->domain.size[a] < least)
            scene_error(
                scene, "domain", NULL, "size",
                "must be %g m at least in periodic %c, two of the widest grains: narrower, "
                "a grain would touch another's image on both sides",
                least, 'x' + a);
}

static void slots_create(struct slots *l, int grains)
{
    l->begin = xalloc((size_t)grains + 1, sizeof *l->begin);
}

static void slots_free(struct slots *l)
{
    void *const all[] = {l->begin,  l->owner,  l->other,   l->live,
                         l->memory, l->active, l->n_active};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    *l = (struct slots){0};
}

void neighbours_create(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    const int n = s->grains.n;
    nb->reach = contact_reach();
    nb->rows = shape.path->rows(s);
    slots_create(&nb->pairs, n);
    slots_create(&nb->walls, n);
    nb->moved = nb->moved_inner = (double)INFINITY; /* stale from the start */
    frame_of(&s->frame, &s->domain);
    grains_follow(&s->grains, (void **)&nb->begin_in, sizeof *nb->begin_in);
    grains_follow(&s->grains, (void **)&s->bodies, sizeof *s->bodies);
}

void neighbours_free(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    slots_free(&nb->pairs);
    slots_free(&nb->walls);
    for (int k = 0; k < 2; k++)
        slots_free(&nb->spare[k]);
    xfree(nb->to);
    xfree(nb->halo_begin);
    xfree(nb->in);
    xfree(nb->begin_in);
    xfree(s->bodies);
}

/* The skins: thick enough for a number of steps at the largest speed. */
static void choose_skins(struct sim *s)
{
    const struct grains *const g = &s->grains;
    const double mean = g->n > 0 ? 2.0 * sum_blocks(g->radius, (size_t)g->n) / g->n : 0.0;
    const double way = 2.0 * fmax(s->neighbours.way, s->walls.speed * s->run.dt);
    s->neighbours.skin = fmin(fmax(SKIN_STEPS * way, SKIN_LEAST * mean), SKIN_MOST * mean);
    const double both = way + 2.0 * s->neighbours.tip;
    const double inner = fmin(fmax(INNER_STEPS * both, INNER_LEAST * mean), INNER_MOST * mean);
    s->neighbours.inner = inner > 2.0 * both ? inner : 0.0;
}

/* Room for n slots of `grains` grains; what was there is lost. */
static void slots_reserve(struct slots *l, size_t n, int grains, int rows)
{
    xfree(l->begin);
    xfree(l->n_active);
    slots_create(l, grains);
    l->n_active = xalloc((size_t)(grains / RUN + 1), sizeof *l->n_active);
    l->n = n;
    if (n > l->capacity || !l->owner) {
        const size_t room = n + n / 16 + 64;
        xfree(l->owner);
        xfree(l->other);
        xfree(l->live);
        xfree(l->memory);
        xfree(l->active);
        l->owner = xalloc(room, sizeof *l->owner);
        l->other = xalloc(room, sizeof *l->other);
        l->active = xalloc(room, sizeof *l->active);
        l->live = xalloc(room, 1);
        l->memory = xalloc(room * (size_t)rows + 1, sizeof *l->memory);
        l->capacity = room;
    }
}

/* Finds the slots of each run of grains by `find`, which appends those of a grain. */
typedef int finder(const struct search *c, const struct sim *s, double margin, int i, int **out,
                   int *room, int n);

static int find_walls(const struct search *c, const struct sim *s, double margin, int i,
                      int **out, int *room, int n)
{
    (void)c;
    return walls_near(s, i, margin, out, room, n);
}

static void die_full(const struct sim *s)
{
    die(EXIT_UNSTABLE,
        "more than 2e9 pairs of grains are near each other at t = %g s: the grains overlap all "
        "over",
        s->t);
}

static void fill_slots(struct sim *s, const struct search *c, finder *find, struct slots *l)
{
    struct neighbours *const nb = &s->neighbours;
    const int n = s->grains.n, runs = nb->runs;
    const double margin = nb->reach + nb->skin;
    int **const found = xalloc((size_t)runs + 1, sizeof *found);
    int *const begin = xalloc((size_t)n + 1, sizeof *begin);
    int *const first = xalloc((size_t)runs + 1, sizeof *first);
#pragma omp parallel for schedule(dynamic, 4)
    for (int run = 0; run < runs; run++) {
        int room = 0, count = 0;
        for (int i = run * RUN; i < n && i < (run + 1) * RUN; i++) {
            count = find(c, s, margin, i, &found[run], &room, count);
            begin[i + 1] = count;
        }
        first[run + 1] = count;
    }
    size_t total = 0;
    for (int run = 0; run < runs; run++) {
        total += (size_t)first[run + 1];
        if (total > 2000000000u)
            die_full(s);
        first[run + 1] = (int)total;
    }
    slots_reserve(l, total, n, nb->rows);
#pragma omp parallel for schedule(dynamic, 4)
    for (int run = 0; run < runs; run++) {
        int slot = first[run];
        for (int i = run * RUN; i < n && i < (run + 1) * RUN; i++) {
            l->begin[i + 1] = first[run] + begin[i + 1];
            for (; slot < l->begin[i + 1]; slot++) {
                l->owner[slot] = i;
                l->other[slot] = found[run][slot - first[run]];
            }
        }
        xfree(found[run]);
    }
    xfree(found);
    xfree(begin);
    xfree(first);
}

/* Copies the memory of the live contacts of grain i from the old list; the rest is zero. */
static void carry_memory(struct slots *l, const struct slots *old, const int *order, bool pairs,
                         int i, int listed, int rows)
{
    const int was = order[i];
    const size_t size = (size_t)rows * sizeof *l->memory;
    for (int t = l->begin[i]; t < l->begin[i + 1]; t++) {
        const int other = pairs ? order[l->other[t]] : l->other[t];
        l->live[t] = 0;
        memset(&l->memory[(size_t)t * rows], 0, size);
        if (was >= listed)
            continue;
        for (int o = old->begin[was]; o < old->begin[was + 1]; o++) {
            if (!old->live[o] || old->other[o] != other)
                continue;
            l->live[t] = old->live[o];
            memcpy(&l->memory[(size_t)t * rows], &old->memory[(size_t)o * rows], size);
            break;
        }
    }
}

/* A new list in the room of the spare one, which then holds the old. */
static void make_slots(struct sim *s, const struct search *c, const int *order, bool pairs)
{
    struct neighbours *const nb = &s->neighbours;
    struct slots *const l = pairs ? &nb->pairs : &nb->walls;
    struct slots *const spare = &nb->spare[pairs ? 0 : 1];
    const struct slots old = *l;
    *l = *spare;
    fill_slots(s, c, pairs ? search_pairs : find_walls, l);
#pragma omp parallel for schedule(dynamic, 256)
    for (int i = 0; i < s->grains.n; i++)
        carry_memory(l, &old, order, pairs, i, nb->listed, nb->rows);
    *spare = old;
}

static void sort_slots(int *slot, int n)
{
    for (int a = 1; a < n; a++) {
        const int v = slot[a];
        int b = a;
        for (; b > 0 && slot[b - 1] > v; b--)
            slot[b] = slot[b - 1];
        slot[b] = v;
    }
}

/* Counts the grains of other runs that a run's slots name, in the order of the slots; writes the
 * `to` of the slots and, from `halo` on, the grains. The marks of the thread tell what it has
 * seen in this run. */
static int count_halo(struct neighbours *nb, int run, int n, int (*mark)[2], int *halo)
{
    const struct slots *const l = &nb->pairs;
    const int first = run * RUN, last = first + RUN < n ? first + RUN : n;
    int count = 0;
    for (int t = l->begin[first]; t < l->begin[last]; t++) {
        const int j = l->other[t];
        if (j >= first && j < last) {
            nb->to[t] = j - first;
            continue;
        }
        if (mark[j][0] != run + 1) {
            mark[j][0] = run + 1;
            mark[j][1] = count;
            halo[count++] = j;
        }
        nb->to[t] = RUN + mark[j][1];
    }
    return count;
}

/* For each grain its entries in halos, in the order of the runs. */
static void list_incoming(struct neighbours *nb, const int *halo, int n)
{
    const int entries = nb->halo_begin[nb->runs];
    int *const next = xalloc((size_t)n + 1, sizeof *next);
    xfree(nb->in);
    nb->in = xalloc((size_t)entries + IN_AHEAD, sizeof *nb->in);
    memset(nb->begin_in, 0, ((size_t)n + 1) * sizeof *nb->begin_in);
#pragma omp parallel for schedule(static)
    for (int e = 0; e < entries; e++)
#pragma omp atomic
        nb->begin_in[halo[e] + 1]++;
    for (int i = 0; i < n; i++)
        nb->begin_in[i + 1] += nb->begin_in[i];
    memcpy(next, nb->begin_in, (size_t)n * sizeof *next);
#pragma omp parallel for schedule(static)
    for (int run = 0; run < nb->runs; run++)
        for (int e = nb->halo_begin[run]; e < nb->halo_begin[run + 1]; e++) {
            int place;
#pragma omp atomic capture
            place = next[halo[e]]++;
            nb->in[place] = (int)neighbours_entry(nb, run, RUN + e - nb->halo_begin[run]);
        }
#pragma omp parallel for schedule(dynamic, 1024)
    for (int i = 0; i < n; i++)
        sort_slots(nb->in + nb->begin_in[i], nb->begin_in[i + 1] - nb->begin_in[i]);
    xfree(next);
}

static void make_halos(struct neighbours *nb, int n)
{
    const struct slots *const l = &nb->pairs;
    int *const halo = xalloc(l->n + 1, sizeof *halo); /* of a run from its first slot on */
    xfree(nb->to);
    xfree(nb->halo_begin);
    nb->to = xalloc(l->n + 1, sizeof *nb->to);
    nb->halo_begin = xalloc((size_t)nb->runs + 1, sizeof *nb->halo_begin);
#pragma omp parallel
    {
        int(*const mark)[2] = xalloc((size_t)n + 1, sizeof *mark);
#pragma omp for schedule(static)
        for (int run = 0; run < nb->runs; run++)
            nb->halo_begin[run + 1] = count_halo(nb, run, n, mark, halo + l->begin[run * RUN]);
        xfree(mark);
    }
    for (int run = 0; run < nb->runs; run++) {
        const int count = nb->halo_begin[run + 1];
        nb->halo_begin[run + 1] = nb->halo_begin[run] + count;
        memmove(halo + nb->halo_begin[run], halo + l->begin[run * RUN],
                (size_t)count * sizeof *halo);
    }
    list_incoming(nb, halo, n);
    xfree(halo);
}

/* The largest; not a number stays. */
static void raise_to(double *most, double x)
{
    if (!(x <= *most))
        *most = x;
}

void neighbours_speed(struct sim *s, int step, double square, double tip)
{
    struct neighbours *const nb = &s->neighbours;
#pragma omp critical(neighbours_speed)
    {
        raise_to(&nb->fastest[step % 2], square);
        raise_to(&nb->tips[step % 2], tip);
    }
}

struct ageing neighbours_ageing(const struct sim *s, bool new)
{
    const struct neighbours *const nb = &s->neighbours;
    return (struct ageing){.way = nb->way,
                           .tip = nb->tip,
                           .moved = nb->moved,
                           .moved_inner = new ? 0.0 : nb->moved_inner,
                           .choose = true};
}

/* The speeds of two steps are kept apart, so that one can be cleared while the other is read. */
bool neighbours_fresh(struct sim *s, struct ageing *age, int step)
{
    struct neighbours *const nb = &s->neighbours;
    const double way = sqrt(nb->fastest[step % 2]) * s->run.dt;
    age->way = way;
    age->tip =
        shape.path->turns && shape.path->turns(s) ? sqrt(nb->tips[step % 2]) * s->run.dt : 0.0;
    age->moved += way;
    age->moved_inner += way + age->tip;
    if (!(age->moved <= 0.5 * nb->skin))
        return false;
    age->choose = !(age->moved_inner <= 0.5 * nb->inner);
    if (age->choose) {
        age->moved_inner = 0.0;
        age->choices++;
    }
#pragma omp master
    nb->fastest[(step + 1) % 2] = nb->tips[(step + 1) % 2] = 0.0;
    return true;
}

void neighbours_aged(struct sim *s, const struct ageing *age)
{
    struct neighbours *const nb = &s->neighbours;
    nb->way = age->way;
    nb->tip = age->tip;
    nb->moved = age->moved;
    nb->moved_inner = age->moved_inner;
    nb->choices += age->choices;
    nb->fastest[0] = nb->fastest[1] = nb->tips[0] = nb->tips[1] = 0.0;
}

void neighbours_rebuild(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    struct search c;
    double clock = wall_clock();
    contact_put_back(s);
    choose_skins(s);
    int *const order = search_sort(&c, s, nb->reach + nb->skin);
    nb->runs = (s->grains.n + RUN - 1) / RUN;
    bodies_sort(s, order, nb->listed);
    clock = timer_add(&s->timers, TIME_SORT, clock);
    make_slots(s, &c, order, true);
    make_slots(s, &c, order, false);
    clock = timer_add(&s->timers, TIME_SEARCH, clock);
    make_halos(nb, s->grains.n);
    nb->listed = s->grains.n;
    nb->moved = 0.0;
    nb->moved_inner = (double)INFINITY;
    nb->builds++;
    xfree(order);
    search_free(&c);
    timer_add(&s->timers, TIME_NEIGHBOURS, clock);
}
