/* bench/far_pairs.h - what pairs cost whose balls overlap but which do not touch: of the pairs that the
 * loop looks at in a bed that comes to rest, how many are told apart by their balls, by the distance
 * that is left of what was found before, by the direction that is kept, and by a search; ns of each
 * beside those that touch. Medians of rounds in which the kinds take turns, processor time of one
 * thread, forces and all else that a pair costs included.
 *
 * For a bench that names the shape and gives its bed: BED, text of a scene, and START, seconds after which
 * it is looked at. */
#ifndef FAR_PAIRS_H
#define FAR_PAIRS_H

#include <omp.h>
#include <time.h>
#include "../solver/contact_points.h"
#include "../verify/harness.h"

enum { ROUNDS = 15, REPEATS = 20, LOOKS = 40, BETWEEN = 25, KINDS = 5 };
enum told { BY_BALLS, BY_DISTANCE, BY_DIRECTION, BY_SEARCH, TOUCH_OR_NEAR };

static const char *const told_name[KINDS] = {
    "told apart by their balls", "by the distance that is left", "by the direction kept",
    "by a search", "within reach of the law"};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* As the loop would find it in the next step; nothing is changed. */
static enum told kind_of(const struct sim *s, const struct cut *cut, int slot)
{
    static real memory[4096];
    static struct shape_point p[POINTS_MOST];
    const struct slots *const l = &s->neighbours.pairs;
    const real *const kept = &l->memory[(size_t)slot * s->neighbours.rows];
    const int i = l->owner[slot], j = l->other[slot];
    const vec3 d = domain_minimum_image(&s->domain, v3_sub(s->grains.pos[i], s->grains.pos[j]));
    const double reach = s->neighbours.reach,
                 touch = s->grains.radius[i] + s->grains.radius[j] + reach;
    double far = 0.0;
    if (v3_norm(d) >= touch)
        return BY_BALLS;
    if (kept[cut->head + 1] > (real)0.0)
        return BY_DISTANCE;
    memcpy(memory, kept, (size_t)s->neighbours.rows * sizeof *memory);
    struct shape_pair pair = {.i = points_pose(s, i),
                              .j = points_pose(s, j),
                              .reach = reach,
                              .memory = memory,
                              .apart = &far};
    pair.j.centre = v3_scale(-1.0, d);
    const int n = shape.points(&pair, cut->most, p);
    for (int k = 0; k < n && k < cut->most; k++)
        if (p[k].depth > -reach)
            return TOUCH_OR_NEAR;
    return memcmp(memory, kept, (size_t)cut->head * sizeof *memory) == 0 ? BY_DIRECTION
                                                                         : BY_SEARCH;
}

/* Active slots of each kind, run after run. */
struct sorted {
    int n[KINDS], *slot[KINDS], *begin[KINDS]; /* begin: runs + 1 */
};

static void sort_slots(const struct sim *s, struct sorted *out)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct cut cut = points_cut(s);
    for (int k = 0; k < KINDS; k++) {
        out->n[k] = 0;
        out->slot[k] = xalloc(nb->pairs.n + 1, sizeof(int));
        out->begin[k] = xalloc((size_t)nb->runs + 1, sizeof(int));
    }
    for (int run = 0; run < nb->runs; run++) {
        const int *const active = &nb->pairs.active[nb->pairs.begin[run * s->neighbours.run]];
        for (int a = 0; a < nb->pairs.n_active[run]; a++) {
            const enum told k = kind_of(s, &cut, active[a]);
            out->slot[k][out->n[k]++] = active[a];
        }
        for (int k = 0; k < KINDS; k++)
            out->begin[k][run + 1] = out->n[k];
    }
}

static void sorted_free(struct sorted *l)
{
    for (int k = 0; k < KINDS; k++) {
        xfree(l->slot[k]);
        xfree(l->begin[k]);
    }
}

/* ns a slot of one kind, through the loop's own path; what it has changed is put back. */
static double cost(struct sim *s, const struct sorted *l, int kind, const real *memory)
{
    struct neighbours *const nb = &s->neighbours;
    static struct block b;
    double took = 0.0;
    for (int k = 0; k < REPEATS; k++) {
        memcpy(nb->pairs.memory, memory,
               nb->pairs.n * (size_t)nb->rows * sizeof *nb->pairs.memory);
        const double start = now();
        for (int run = 0; run < nb->runs; run++) {
            const struct target to = {.first = run * s->neighbours.run,
                                      .sums = &s->contacts->sums[neighbours_entry(nb, run, 0)],
                                      .wall =
                                          &s->contacts->wall_force[(size_t)run * s->walls.n],
                                      .report = &s->contacts->report[run],
                                      .time = s->t};
            shape.path->pairs(s, &b, l->slot[kind] + l->begin[kind][run],
                              l->begin[kind][run + 1] - l->begin[kind][run], &to);
        }
        took += now() - start;
    }
    return 1e9 * took / REPEATS / l->n[kind];
}

static double median(double *x)
{
    for (int i = 1; i < ROUNDS; i++)
        for (int j = i; j > 0 && x[j] < x[j - 1]; j--) {
            const double swap = x[j];
            x[j] = x[j - 1];
            x[j - 1] = swap;
        }
    return x[ROUNDS / 2];
}

int main(void)
{
    omp_set_num_threads(1);
    struct sim *const s = sim_from(BED);
    long seen[KINDS] = {0}, all = 0;
    double ns[KINDS][ROUNDS] = {{0.0}};
    struct sorted l;
    while (s->t < START)
        step(s);
    for (int look = 0; look < LOOKS; look++) {
        for (int k = 0; k < BETWEEN; k++)
            step(s);
        sort_slots(s, &l);
        for (int k = 0; k < KINDS; k++) {
            seen[k] += l.n[k];
            all += l.n[k];
        }
        if (look + 1 < LOOKS)
            sorted_free(&l);
    }
    const size_t room = s->neighbours.pairs.n * (size_t)s->neighbours.rows;
    real *const memory = xalloc(room, sizeof *memory);
    memcpy(memory, s->neighbours.pairs.memory, room * sizeof *memory);
    for (int r = 0; r < ROUNDS; r++)
        for (int k = 0; k < KINDS; k++)
            if (l.n[k] > 0)
                ns[k][r] = cost(s, &l, k, memory);
    printf("%s: %.1f pairs a grain are looked at\n", shape_about.name,
           (double)all / LOOKS / s->grains.n);
    const double near = median(ns[TOUCH_OR_NEAR]);
    for (int k = 0; k < KINDS; k++) {
        printf("  %-28s %6.2f %%", told_name[k], 100.0 * (double)seen[k] / (double)all);
        if (l.n[k] > 0)
            printf(" %8.0f ns, %.2f of one within reach", median(ns[k]), median(ns[k]) / near);
        printf("\n");
    }
    xfree(memory);
    sorted_free(&l);
    sim_free(s);
    return 0;
}

#endif
