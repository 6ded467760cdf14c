/* bench/contact_answers.c - ns per contact of each answer of each slot of contacts, blocks of 64
 * contacts in the first-level cache; one material, and four of them. Medians of rounds in which
 * the answers take turns, processor time of one thread; with the reason that an answer gives for costing
 * over 1.5 times the cheapest of its slot. */
#include <time.h>
#include "../verify/laws.h"

enum { ROUNDS = 15, MOST = 64, REPEATS = 3000 };

struct entry {
    struct law law;
    double ns[2][ROUNDS];
};

static struct entry entries[MOST];

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *x)
{
    qsort(x, ROUNDS, sizeof *x, by_value);
    return x[ROUNDS / 2];
}

static void block(struct touch *t, int materials)
{
    t->n = TOUCH;
    t->dt = 1e-7;
    t->time = 0.0;
    for (int c = 0; c < TOUCH; c++) {
        const struct law_pair p = {.r_i = 1e-3 * (1.0 + 0.01 * (c % 7)),
                                   .r_j = c % 9 == 4 ? 0.0 : 1.1e-3,
                                   .m_i = 1e-5,
                                   .m_j = 1.3e-5,
                                   .depth = 1e-6 * (1 + c % 5),
                                   .n = v3(0.6, 0.0, 0.8),
                                   .v = v3(1e-3 * (c % 3 - 1), 2e-3, 1e-3 * (c % 5 - 2)),
                                   .spin_i = v3(0.1, 0.2 * (c % 4), -0.3),
                                   .spin_j = v3(-0.2, 0.1, 0.05 * c),
                                   .pair = (c * 7) % (materials * materials)};
        law_put(t, c, &p);
        t->fn[c] = 0.1;
        t->kn[c] = 3e4;
    }
}

static double thread_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double time_of(struct entry *e, int materials)
{
    static struct touch t;
    static _Alignas(64) real history[HISTORY_MAX][TOUCH];
    memset(history, 0, sizeof history);
    block(&t, materials);
    const double start = thread_clock();
    for (int k = 0; k < REPEATS; k++) {
        t.time = k * t.dt;
        e->law.forces(&t, history);
    }
    return 1e9 * (thread_clock() - start) / ((double)REPEATS * TOUCH);
}

/* One slot at a time, its answers open together. */
static void bench_slot(const char *program, const struct law_slot *slot)
{
    static struct law laws[MOST];
    const int n = laws_open(program, slot, laws, MOST);
    for (int i = 0; i < n; i++)
        entries[i].law = laws[i];
    for (int r = 0; r < ROUNDS; r++)
        for (int i = 0; i < n; i++)
            for (int many = 0; many < 2; many++) {
                law_start(&entries[i].law, many ? 4 : 1, NULL);
                entries[i].ns[many][r] = time_of(&entries[i], many ? 4 : 1);
            }
    double least = (double)INFINITY;
    for (int i = 0; i < n; i++)
        if (strcmp(laws[i].about->name, "none") != 0)
            least = fmin(least, median(entries[i].ns[0]));
    for (int i = 0; i < n; i++) {
        const double one = median(entries[i].ns[0]), many = median(entries[i].ns[1]);
        const char *const why = laws[i].about->cost;
        printf("%-12s %-20s %12.2f %12.2f %12.2f  %s\n", slot->name, laws[i].about->name, one,
               many, one / least,
               one <= 1.5 * least ? ""
               : why              ? why
                                  : "no reason given");
    }
}

int main(int argc, char **argv)
{
    (void)argc;
    printf("ns per contact, median of %d\n%-12s %-20s %12s %12s %12s  %s\n", ROUNDS, "slot",
           "answer", "1 material", "4 materials", "of the least", "why over 1.5");
    for (int k = 0; k < LAW_SLOTS; k++)
        bench_slot(argv[0], &law_slots[k]);
    return 0;
}
