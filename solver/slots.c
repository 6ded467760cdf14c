/* slots.c - lists of slots, run by run. */
#include "slots.h"

#include <string.h>
#include "search.h"
#include "sim.h"

void slots_create(struct slots *l, int grains)
{
    l->begin = xalloc((size_t)grains + 1, sizeof *l->begin);
}

void slots_free(struct slots *l)
{
    void *const all[] = {l->begin,  l->owner,  l->other,   l->live,
                         l->memory, l->active, l->n_active};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    *l = (struct slots){0};
}

struct kept slots_keep(const struct slots *l, int n, int rows)
{
    struct kept k = {.n = n, .begin = xalloc((size_t)n + 1, sizeof *k.begin)};
    const size_t size = (size_t)rows * sizeof *k.memory;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; i++)
        for (int t = l->begin[i]; t < l->begin[i + 1]; t++)
            k.begin[i + 1] += l->live[t] != 0;
    for (int i = 0; i < n; i++)
        k.begin[i + 1] += k.begin[i];
    const size_t all = (size_t)k.begin[n] + 1;
    k.other = xalloc(all, sizeof *k.other);
    k.live = xalloc(all, 1);
    k.memory = xalloc(all * (size_t)rows + 1, sizeof *k.memory);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; i++) {
        int at = k.begin[i];
        for (int t = l->begin[i]; t < l->begin[i + 1]; t++) {
            if (!l->live[t])
                continue;
            k.other[at] = l->other[t];
            k.live[at] = l->live[t];
            memcpy(&k.memory[(size_t)at++ * rows], &l->memory[(size_t)t * rows], size);
        }
    }
    return k;
}

static void kept_free(struct kept *k)
{
    xfree(k->begin);
    xfree(k->other);
    xfree(k->live);
    xfree(k->memory);
}

/* Room for n slots of `grains` grains, without contacts; what was there is lost. */
static void reserve(struct slots *l, size_t n, int grains, int rows)
{
    xfree(l->begin);
    xfree(l->n_active);
    slots_create(l, grains);
    l->n_active = xalloc((size_t)(grains / RUN_LEAST + 1), sizeof *l->n_active);
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

static void die_full(const struct sim *s)
{
    die(EXIT_UNSTABLE,
        "more than 2e9 pairs of grains are near each other at t = %g s: the grains overlap all "
        "over",
        s->t);
}

/* Slot numbers from counts; returns how many there are. */
static size_t number_runs(const struct sim *s, int *first, int runs)
{
    size_t total = 0;
    for (int run = 0; run < runs; run++) {
        total += (size_t)first[run + 1];
        if (total > 2000000000u)
            die_full(s);
        first[run + 1] = (int)total;
    }
    return total;
}

/* Where the grains of the list before stand now; -1: gone. */
static int *places(const int *order, int old, int n)
{
    int *const place = xalloc((size_t)old + 1, sizeof *place);
    for (int k = 0; k < old; k++)
        place[k] = -1;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; i++)
        if (order[i] < old)
            place[order[i]] = i;
    return place;
}

/* Marks and memory of the slots of grain i, from the contacts of `was`. */
static void carry(struct slots *l, const struct kept *k, const int *place, int was, int i,
                  int rows)
{
    const size_t size = (size_t)rows * sizeof *l->memory;
    for (int o = k->begin[was]; o < k->begin[was + 1]; o++) {
        const int other = place ? place[k->other[o]] : k->other[o];
        int t = l->begin[i];
        while (t < l->begin[i + 1] && l->other[t] != other)
            t++;
        if (t == l->begin[i + 1])
            continue;
        l->live[t] = k->live[o];
        memcpy(&l->memory[(size_t)t * rows], &k->memory[(size_t)o * rows], size);
    }
}

void slots_fill(struct sim *s, struct slots *l, finder *find, const struct search *c,
                struct kept *kept, const int *order, bool pairs)
{
    const int n = s->grains.n, runs = s->neighbours.runs, rows = s->neighbours.rows;
    int **const found = xalloc((size_t)runs + 1, sizeof *found);
    int *const begin = xalloc((size_t)n + 1, sizeof *begin);
    int *const first = xalloc((size_t)runs + 1, sizeof *first);
    int *const place = pairs ? places(order, kept->n, n) : NULL;
#pragma omp parallel for schedule(dynamic, 4)
    for (int run = 0; run < runs; run++) {
        int room = 0, count = 0;
        for (int i = run * s->neighbours.run; i < n && i < (run + 1) * s->neighbours.run; i++) {
            count = find(c, s, i, &found[run], &room, count);
            begin[i + 1] = count;
        }
        first[run + 1] = count;
    }
    reserve(l, number_runs(s, first, runs), n, rows);
    for (int run = 0; run < runs; run++) /* whole, since the next run's grains begin there */
        for (int i = run * s->neighbours.run; i < n && i < (run + 1) * s->neighbours.run; i++)
            l->begin[i + 1] = first[run] + begin[i + 1];
#pragma omp parallel for schedule(dynamic, 4)
    for (int run = 0; run < runs; run++) {
        const int slots = first[run + 1] - first[run];
        if (slots > 0)
            memcpy(&l->other[first[run]], found[run], (size_t)slots * sizeof *l->other);
        memset(&l->live[first[run]], 0, (size_t)slots);
        memset(&l->memory[(size_t)first[run] * rows], 0,
               (size_t)slots * rows * sizeof *l->memory);
        for (int i = run * s->neighbours.run; i < n && i < (run + 1) * s->neighbours.run; i++) {
            for (int t = l->begin[i]; t < l->begin[i + 1]; t++)
                l->owner[t] = i;
            if (order[i] < kept->n)
                carry(l, kept, place, order[i], i, rows);
        }
        xfree(found[run]);
    }
    xfree(found);
    xfree(begin);
    xfree(first);
    xfree(place);
    kept_free(kept);
}
