/* bench/designs.c - what identical bits cost, and what other designs of the contact loop would do: from
 * slots to the force on each grain, on one bed whose grains are held, in ns per grain.
 *   designs SCENE [section.key=value ...]; OMP_NUM_THREADS threads
 *   halo sums      silt's own: sums of a run for its grains and its halo, gathered in order
 *   own arrays     each thread adds into an array of all grains, which are added up at the end; runs go
 *                  to whoever is free: other bits each time
 *   atomics        sums of a run for its grains and its halo, added to one array of all grains by
 *                  atomic additions; runs go to whoever is free: other bits each time
 *   colours        runs that share no grain side by side, one colour after the other: same bits
 *   slabs          slabs across the longest side of the box, thicker than a pair is long: those of even
 *                  number side by side, then the odd ones, straight into one array: same bits
 *   both sides     each contact worked for either grain, with a memory of its own: same bits
 * All use the same blocks, laws and gathering of bodies. Medians of rounds in turns: of the processor's
 * time on one thread, of the clock on more. Walls are left out. */
/* slots: contact/hertz_mindlin */
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "../solver/contact_loop.h"
#include "../solver/contact_path.h"
#include "../solver/feasibility.h"
#include "../solver/modules.h"
#include "../solver/motion.h"
#include "../solver/sim.h"
#include "../solver/step.h"

enum design { HALO_SUMS, OWN_ARRAYS, ATOMICS, COLOURS, SLABS, BOTH_SIDES, DESIGNS };
enum { ROUNDS = 15 };
static int grains_per_run; /* of the bed at hand (neighbours.h) */

static const struct {
    const char *name;
    bool same_bits; /* on any number of threads */
} designs[DESIGNS] = {[HALO_SUMS] = {"halo sums (silt)", true},
                      [OWN_ARRAYS] = {"own arrays", false},
                      [ATOMICS] = {"atomics", false},
                      [COLOURS] = {"colours", true},
                      [SLABS] = {"slabs", true},
                      [BOTH_SIDES] = {"both sides", true}};

struct bench {
    struct sim *s;
    int threads;
    struct pack *packs[DESIGNS]; /* of each run, as the design wants it */
    struct sums **array;         /* per thread, of all grains */
    struct sums **own;           /* per thread, of a run and its halo */
    struct report *report;       /* per thread */
    int colours, *colour;        /* of each run */
    int slabs;
    int *halo_begin, *halo; /* grains of each run's halo */
};

static double now(int threads)
{
    struct timespec t;
    if (threads > 1)
        return wall_clock();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void set_lane(struct pack_block *to, int c, const struct pack_block *from, int m,
                     int rows)
{
    to->i[c] = from->i[m];
    to->j[c] = from->j[m];
    to->to[c] = from->to[m];
    to->depth[c] = from->depth[m];
    for (int row = 0; row < rows; row++)
        to->memory[row][c] = from->memory[row][m];
}

static struct pack room_for(int n, int rows)
{
    const int blocks = (n + TOUCH - 1) / TOUCH;
    return (struct pack){
        .n = n, .room = blocks, .data = xalloc((size_t)blocks + 1, pack_size(rows))};
}

static void pad(struct pack *p, int rows)
{
    for (int k = p->n; p->n > 0 && k % TOUCH != 0; k++)
        set_lane(pack_block(p, k / TOUCH, rows), k % TOUCH,
                 pack_block(p, (p->n - 1) / TOUCH, rows), (p->n - 1) % TOUCH, rows);
}

/* Forces on j straight to its place in an array of all grains. */
static struct pack direct(const struct pack *own, int first, int rows)
{
    struct pack p = room_for(own->n, rows);
    for (int k = 0; k < own->n; k++) {
        struct pack_block *const b = pack_block(&p, k / TOUCH, rows);
        set_lane(b, k % TOUCH, pack_block(own, k / TOUCH, rows), k % TOUCH, rows);
        b->to[k % TOUCH] = b->j[k % TOUCH] - first;
    }
    pad(&p, rows);
    return p;
}

/* Every contact of the grains of a run; what falls to j is nobody's. */
static void both_sides(const struct sim *s, struct pack *packs)
{
    const struct neighbours *const nb = &s->neighbours;
    const int rows = nb->rows, n = s->grains.n;
    int *const count = xalloc((size_t)n + 1, sizeof *count), *const place = xalloc(
                                                                 (size_t)n + 1, sizeof *place);
    for (int pass = 0; pass < 2; pass++) {
        for (int run = 0; run < nb->runs; run++)
            for (int k = 0; k < s->contacts->pack[run].n; k++) {
                const struct pack_block *const from =
                    pack_block(&s->contacts->pack[run], k / TOUCH, rows);
                const int m = k % TOUCH, grain[2] = {from->i[m], from->j[m]};
                for (int side = 0; side < 2; side++) {
                    if (pass == 0) {
                        count[grain[side]]++;
                        continue;
                    }
                    const int at = place[grain[side]]++;
                    struct pack_block *const to =
                        pack_block(&packs[grain[side] / grains_per_run], at / TOUCH, rows);
                    set_lane(to, at % TOUCH, from, m, rows);
                    to->i[at % TOUCH] = grain[side];
                    to->j[at % TOUCH] = grain[1 - side];
                    to->to[at % TOUCH] = grains_per_run + at % TOUCH;
                }
            }
        for (int run = 0; run < nb->runs && pass == 0; run++) {
            int total = 0;
            for (int i = run * grains_per_run; i < n && i < (run + 1) * grains_per_run; i++) {
                place[i] = total;
                total += count[i];
            }
            packs[run] = room_for(total, rows);
        }
    }
    for (int run = 0; run < nb->runs; run++)
        pad(&packs[run], rows);
    xfree(count);
    xfree(place);
}

/* Which slab of `slabs` across axis a. */
static int slab_of(const struct sim *s, int i, int a, int slabs)
{
    const vec3 x = domain_wrap(&s->domain, s->grains.pos[i]);
    const double at = (a == 0 ? x.x : a == 1 ? x.y : x.z) / s->domain.size[a];
    const int slab = (int)(at * slabs);
    return slab < 0 ? 0 : slab >= slabs ? slabs - 1 : slab;
}

/* The contacts of each slab in the order of the runs: those of its grains with each other and with
 * those of the slab behind, so that a slab touches the grains of two. Their number is even: the
 * last may touch those of the first. */
static void cut_slabs(struct bench *b, struct pack *packs)
{
    const struct sim *const s = b->s;
    const int rows = s->neighbours.rows;
    int axis = 0;
    double largest = 0.0, inner = 0.0;
    for (int a = 1; a < 3; a++)
        axis = s->domain.size[a] > s->domain.size[axis] && s->domain.periodic[a] ? a : axis;
    for (int i = 0; i < s->grains.n; i++) {
        largest = fmax(largest, 2.0 * s->grains.radius[i]);
        inner = fmax(inner, 2.0 * s->neighbours.thin * (double)s->neighbours.skin[i]);
    }
    b->slabs = (int)(s->domain.size[axis] / (largest + inner + s->neighbours.reach)) / 2 * 2;
    if (b->slabs < 2 || b->slabs > s->neighbours.runs)
        b->slabs = s->neighbours.runs < 2 ? 1 : s->neighbours.runs / 2 * 2;
    int *const count = xalloc((size_t)b->slabs, sizeof *count);
    for (int pass = 0; pass < 2; pass++) {
        for (int run = 0; run < s->neighbours.runs; run++) {
            const struct pack *const own = &s->contacts->pack[run];
            for (int k = 0; k < own->n; k++) {
                const struct pack_block *const from = pack_block(own, k / TOUCH, rows);
                const int m = k % TOUCH;
                const int si = slab_of(s, from->i[m], axis, b->slabs);
                const int sj = slab_of(s, from->j[m], axis, b->slabs);
                const int slab = sj == si || sj == (si + 1) % b->slabs ? si : sj;
                const int at = count[slab]++;
                if (pass == 0)
                    continue;
                struct pack_block *const to = pack_block(&packs[slab], at / TOUCH, rows);
                set_lane(to, at % TOUCH, from, m, rows);
                to->to[at % TOUCH] = from->j[m] - slab * grains_per_run;
            }
        }
        for (int slab = 0; slab < b->slabs; slab++) {
            if (pass == 0)
                packs[slab] = room_for(count[slab], rows);
            else
                pad(&packs[slab], rows);
            count[slab] = 0;
        }
    }
    xfree(count);
}

/* Packs as silt has them, with the grains of the halos by name. */
static void list_halos(struct bench *b, struct pack *packs)
{
    const struct neighbours *const nb = &b->s->neighbours;
    b->halo_begin = nb->halo_begin;
    b->halo = xalloc((size_t)nb->halo_begin[nb->runs] + 1, sizeof *b->halo);
    for (int run = 0; run < nb->runs; run++) {
        const struct pack *const own = &b->s->contacts->pack[run];
        packs[run] = room_for(own->n, nb->rows);
        for (int k = 0; k < own->n; k++) {
            const struct pack_block *const from = pack_block(own, k / TOUCH, nb->rows);
            const int m = k % TOUCH;
            set_lane(pack_block(&packs[run], k / TOUCH, nb->rows), m, from, m, nb->rows);
            if (from->to[m] >= grains_per_run)
                b->halo[nb->halo_begin[run] + from->to[m] - grains_per_run] = from->j[m];
        }
        pad(&packs[run], nb->rows);
    }
}

/* Greedy: the first colour that no run with a grain in common has. */
static void colour_runs(struct bench *b)
{
    const struct sim *const s = b->s;
    const int rows = s->neighbours.rows;
    unsigned long *const used = xalloc((size_t)s->grains.n, sizeof *used);
    for (int run = 0; run < s->neighbours.runs; run++) {
        const struct pack *const p = &s->contacts->pack[run];
        unsigned long taken = 0;
        for (int mark = 0; mark < 2; mark++) {
            if (mark)
                b->colour[run] = __builtin_ctzl(~taken);
            for (int k = 0; k < p->n; k++) {
                const struct pack_block *const block = pack_block(p, k / TOUCH, rows);
                const int pair[2] = {block->i[k % TOUCH], block->j[k % TOUCH]};
                for (int side = 0; side < 2; side++) {
                    taken |= mark ? 0 : used[pair[side]];
                    used[pair[side]] |= mark ? 1ul << b->colour[run] : 0;
                }
            }
        }
        b->colours = b->colour[run] + 1 > b->colours ? b->colour[run] + 1 : b->colours;
    }
    xfree(used);
}

/* Works a pack; `sums` are those of grain `run` * grains_per_run and on. */
static void work(struct bench *b, int run, struct sums *sums)
{
    struct sim *const s = b->s;
    const struct target to = {.first = run * grains_per_run,
                              .sums = sums,
                              .report = &b->report[omp_get_thread_num()],
                              .time = s->t};
    struct block block;
    block.kept = NULL;
    shape.path->pairs(s, &block, s->neighbours.pairs.active, s->contacts->pack[run].n, &to);
}

/* By atomic additions, from the sums of a run and its halo. */
static void scatter(const struct bench *b, int run, const struct sums *own)
{
    const int n = b->s->grains.n, first = run * grains_per_run;
    const int halo = b->halo_begin[run + 1] - b->halo_begin[run];
    for (int k = 0; k < grains_per_run + halo; k++) {
        if (k < grains_per_run && first + k >= n)
            continue;
        const int i =
            k < grains_per_run ? first + k : b->halo[b->halo_begin[run] + k - grains_per_run];
        double *const to = (double *)&b->array[0][i].both;
        for (int c = 0; c < 8; c++)
            if (c % 4 != 3)
#pragma omp atomic
                to[c] += own[k].both[c];
    }
}

static void set_force(struct grains *g, int i, struct sums sum)
{
    sums_part(sum.both, &g->force[i], &g->torque[i]);
}

/* Forces out of the first array, which is cleared. */
static void gather(struct bench *b)
{
    struct grains *const g = &b->s->grains;
#pragma omp for schedule(static)
    for (int i = 0; i < g->n; i++) {
        set_force(g, i, b->array[0][i]);
        b->array[0][i] = (struct sums){0};
    }
}

static void gather_all(struct bench *b)
{
    struct grains *const g = &b->s->grains;
#pragma omp for schedule(static)
    for (int i = 0; i < g->n; i++) {
        struct sums sum = {0};
        for (int t = 0; t < b->threads; t++) {
            sum.both += b->array[t][i].both;
            b->array[t][i] = (struct sums){0};
        }
        set_force(g, i, sum);
    }
}

static void own_arrays(struct bench *b)
{
    struct sums *const mine = b->array[omp_get_thread_num()];
#pragma omp for schedule(dynamic)
    for (int run = 0; run < b->s->neighbours.runs; run++)
        work(b, run, mine + (size_t)run * grains_per_run);
    gather_all(b);
}

static void atomics(struct bench *b)
{
    const int *const halo = b->halo_begin;
    struct sums *const own = b->own[omp_get_thread_num()];
#pragma omp for schedule(dynamic)
    for (int run = 0; run < b->s->neighbours.runs; run++) {
        memset(own, 0, (size_t)(grains_per_run + halo[run + 1] - halo[run]) * sizeof *own);
        work(b, run, own);
        scatter(b, run, own);
    }
    gather(b);
}

static void colours(struct bench *b)
{
    for (int colour = 0; colour < b->colours; colour++) {
#pragma omp for schedule(static)
        for (int run = 0; run < b->s->neighbours.runs; run++)
            if (b->colour[run] == colour)
                work(b, run, b->array[0] + (size_t)run * grains_per_run);
    }
    gather(b);
}

static void slabs(struct bench *b)
{
    for (int odd = 0; odd < 2; odd++) {
#pragma omp for schedule(static)
        for (int slab = odd; slab < b->slabs; slab += 2)
            work(b, slab, b->array[0] + (size_t)slab * grains_per_run);
    }
    gather(b);
}

static void both_at_once(struct bench *b)
{
    struct grains *const g = &b->s->grains;
    struct sums own[RUN_MOST + TOUCH];
#pragma omp for schedule(static)
    for (int run = 0; run < b->s->neighbours.runs; run++) {
        memset(own, 0, sizeof own);
        work(b, run, own);
        for (int i = run * grains_per_run; i < g->n && i < (run + 1) * grains_per_run; i++)
            set_force(g, i, own[i - run * grains_per_run]);
    }
}

static void once(struct bench *b, enum design design)
{
#pragma omp parallel
    switch (design) {
    case HALO_SUMS:
        contact_loop(b->s, b->s->t, false, false);
        motion_forces(b->s);
        break;
    case OWN_ARRAYS:
        own_arrays(b);
        break;
    case ATOMICS:
        atomics(b);
        break;
    case COLOURS:
        colours(b);
        break;
    case SLABS:
        slabs(b);
        break;
    default:
        both_at_once(b);
    }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: designs SCENE [section.key=value ...]\n");
        return EXIT_FAILURE;
    }
    struct scene *const scene = scene_load(argv[1], argc - 2, argv + 2);
    struct sim *const s = sim_alloc();
    struct feasibility f = {0};
    sim_create(s, scene, &f);
    scene_finish(scene);
    sim_start(s);
    step_grains(s, 20);
    struct bench b = {.s = s, .threads = omp_get_max_threads()};
    const int runs = s->neighbours.runs, rows = s->neighbours.rows, n = s->grains.n;
    grains_per_run = s->neighbours.run;
    int halo = 0;
    for (int run = 0; run < runs; run++)
        halo = s->neighbours.halo_begin[run + 1] - s->neighbours.halo_begin[run] > halo
                   ? s->neighbours.halo_begin[run + 1] - s->neighbours.halo_begin[run]
                   : halo;
    b.colour = xalloc((size_t)runs, sizeof *b.colour);
    b.array = xalloc((size_t)b.threads, sizeof *b.array);
    b.own = xalloc((size_t)b.threads, sizeof *b.own);
    b.report = xalloc((size_t)b.threads, 2 * sizeof *b.report);
    for (int t = 0; t < b.threads; t++) {
        b.array[t] = xalloc((size_t)n + grains_per_run, sizeof **b.array);
        b.own[t] = xalloc((size_t)grains_per_run + (size_t)halo, sizeof **b.own);
    }
    for (int d = 0; d < DESIGNS; d++)
        b.packs[d] =
            d == HALO_SUMS ? s->contacts->pack : xalloc((size_t)runs, sizeof **b.packs);
    for (int run = 0; run < runs; run++) {
        b.packs[OWN_ARRAYS][run] = direct(&s->contacts->pack[run], run * grains_per_run, rows);
        b.packs[COLOURS][run] = direct(&s->contacts->pack[run], run * grains_per_run, rows);
    }
    list_halos(&b, b.packs[ATOMICS]);
    both_sides(s, b.packs[BOTH_SIDES]);
    cut_slabs(&b, b.packs[SLABS]);
    colour_runs(&b);

    double time[DESIGNS][ROUNDS];
    vec3 force[DESIGNS];
    const int repeats = 2000000 / n + 1;
    for (int r = 0; r < ROUNDS; r++)
        for (int d = 0; d < DESIGNS; d++) {
            s->contacts->pack = b.packs[d];
            once(&b, (enum design)d); /* warms up */
            const double start = now(b.threads);
            for (int k = 0; k < repeats; k++)
                once(&b, (enum design)d);
            time[d][r] = 1e9 * (now(b.threads) - start) / ((double)repeats * n);
            force[d] = s->grains.force[n / 2];
        }
    printf("%-20s %10s %8s %12s %10s\n", "forces, from slots", "bits", "threads", "ns a grain",
           "over silt");
    int fastest = OWN_ARRAYS;
    for (int d = 0; d < DESIGNS; d++) {
        qsort(time[d], ROUNDS, sizeof **time, by_value);
        if (!designs[d].same_bits && time[d][ROUNDS / 2] < time[fastest][ROUNDS / 2])
            fastest = d;
    }
    const double silt = time[HALO_SUMS][ROUNDS / 2];
    for (int d = 0; d < DESIGNS; d++) {
        printf("%-20s %10s %8d %12.1f %10.2f\n", designs[d].name,
               designs[d].same_bits ? "the same" : "other", b.threads, time[d][ROUNDS / 2],
               time[d][ROUNDS / 2] / silt);
        if (!(v3_norm(v3_sub(force[d], force[0])) <= 1e-9 * v3_norm(force[0]) + 1e-300))
            printf("  (other forces: %g of %g N)\n", v3_norm(v3_sub(force[d], force[0])),
                   v3_norm(force[0]));
    }
    printf("identical bits cost %.0f %% over the fastest without (%s); %d colours, %d slabs\n",
           100.0 * (silt / time[fastest][ROUNDS / 2] - 1.0), designs[fastest].name, b.colours,
           b.slabs);
    return EXIT_SUCCESS;
}
