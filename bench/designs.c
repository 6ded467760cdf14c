/* bench/designs.c - what identical bits cost, and what other designs of the contact loop would do: from
 * slots to the force on each grain, on one bed whose grains are held, in ns per grain.
 *   designs SCENE [section.key=value ...]; OMP_NUM_THREADS threads
 *   halo sums      silt's own: sums of a run for its grains and its halo, gathered in order
 *   own arrays     each thread adds into an array of all grains, which are added up at the end; runs go
 *                  to whoever is free: other bits each time, the fastest of those that we know
 *   colours        runs that share no grain side by side, one colour after the other: same bits
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

enum { DESIGNS = 4, ROUNDS = 15, COLOURS = 64 };

struct bench {
    struct sim *s;
    int threads;
    struct pack *packs[DESIGNS]; /* of each run, as the design wants it */
    struct sums **array;         /* per thread, of all grains */
    struct report *report;       /* per thread */
    int colours, *colour;        /* of each run */
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
                        pack_block(&packs[grain[side] / RUN], at / TOUCH, rows);
                    set_lane(to, at % TOUCH, from, m, rows);
                    to->i[at % TOUCH] = grain[side];
                    to->j[at % TOUCH] = grain[1 - side];
                    to->to[at % TOUCH] = RUN + at % TOUCH;
                }
            }
        for (int run = 0; run < nb->runs && pass == 0; run++) {
            int total = 0;
            for (int i = run * RUN; i < n && i < (run + 1) * RUN; i++) {
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

static void work(struct bench *b, int run, struct sums *sums)
{
    struct sim *const s = b->s;
    const int first = run * RUN;
    const struct target to = {
        .first = first, .sums = sums, .report = &b->report[omp_get_thread_num()], .time = s->t};
    struct block block;
    block.kept = NULL;
    shape.path->pairs(s, &block, &s->neighbours.pairs.active[s->neighbours.pairs.begin[first]],
                      s->contacts->pack[run].n, &to);
}

static void set_force(struct grains *g, int i, struct sums sum)
{
    sums_part(sum.both, &g->force[i], &g->torque[i]);
}

static void once(struct bench *b, int design)
{
    struct sim *const s = b->s;
    struct grains *const g = &s->grains;
    const int runs = s->neighbours.runs;
#pragma omp parallel
    {
        struct sums *const mine = b->array[omp_get_thread_num()];
        switch (design) {
        case 0:
            contact_loop(s, s->t, false, false);
            motion_forces(s);
            break;
        case 1:
#pragma omp for schedule(dynamic)
            for (int run = 0; run < runs; run++)
                work(b, run, mine + (size_t)run * RUN);
#pragma omp for schedule(static)
            for (int i = 0; i < g->n; i++) {
                struct sums sum = {0};
                for (int t = 0; t < b->threads; t++) {
                    sum.both += b->array[t][i].both;
                    b->array[t][i] = (struct sums){0};
                }
                set_force(g, i, sum);
            }
            break;
        case 2:
            for (int colour = 0; colour < b->colours; colour++) {
#pragma omp for schedule(static)
                for (int run = 0; run < runs; run++)
                    if (b->colour[run] == colour)
                        work(b, run, b->array[0] + (size_t)run * RUN);
            }
#pragma omp for schedule(static)
            for (int i = 0; i < g->n; i++) {
                set_force(g, i, b->array[0][i]);
                b->array[0][i] = (struct sums){0};
            }
            break;
        default: {
            struct sums own[RUN + TOUCH];
#pragma omp for schedule(static)
            for (int run = 0; run < runs; run++) {
                memset(own, 0, sizeof own);
                work(b, run, own);
                for (int i = run * RUN; i < g->n && i < (run + 1) * RUN; i++)
                    set_force(g, i, own[i - run * RUN]);
            }
        }
        }
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
    b.colour = xalloc((size_t)runs, sizeof *b.colour);
    b.array = xalloc((size_t)b.threads, sizeof *b.array);
    b.report = xalloc((size_t)b.threads, 2 * sizeof *b.report);
    for (int t = 0; t < b.threads; t++)
        b.array[t] = xalloc((size_t)n + RUN, sizeof **b.array);
    for (int d = 0; d < DESIGNS; d++)
        b.packs[d] = d == 0 ? s->contacts->pack : xalloc((size_t)runs, sizeof **b.packs);
    for (int run = 0; run < runs; run++)
        for (int d = 1; d < 3; d++)
            b.packs[d][run] = direct(&b.packs[0][run], run * RUN, rows);
    both_sides(s, b.packs[3]);
    colour_runs(&b);

    double time[DESIGNS][ROUNDS];
    vec3 force[DESIGNS];
    const int repeats = 2000000 / n + 1;
    for (int r = 0; r < ROUNDS; r++)
        for (int d = 0; d < DESIGNS; d++) {
            s->contacts->pack = b.packs[d];
            once(&b, d); /* warms up */
            const double start = now(b.threads);
            for (int k = 0; k < repeats; k++)
                once(&b, d);
            time[d][r] = 1e9 * (now(b.threads) - start) / ((double)repeats * n);
            force[d] = s->grains.force[n / 2];
        }
    static const char *const names[DESIGNS] = {"halo sums (silt)", "own arrays, other bits",
                                               "colours", "both sides"};
    printf("%-26s %8s %14s %10s\n", "forces, from slots", "threads", "ns a grain", "over silt");
    for (int d = 0; d < DESIGNS; d++)
        qsort(time[d], ROUNDS, sizeof **time, by_value);
    for (int d = 0; d < DESIGNS; d++) {
        printf("%-26s %8d %14.1f %10.2f\n", names[d], b.threads, time[d][ROUNDS / 2],
               time[d][ROUNDS / 2] / time[0][ROUNDS / 2]);
        if (!(v3_norm(v3_sub(force[d], force[0])) <= 1e-9 * v3_norm(force[0]) + 1e-300))
            printf("  (other forces: %g of %g N)\n", v3_norm(v3_sub(force[d], force[0])),
                   v3_norm(force[0]));
    }
    printf("identical bits cost %.0f %% over the fastest without; %d colours\n",
           100.0 * (time[0][ROUNDS / 2] / time[1][ROUNDS / 2] - 1.0), b.colours);
    return EXIT_SUCCESS;
}
