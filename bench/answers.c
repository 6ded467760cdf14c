/* bench/answers.c - what each answer of a slot costs, in the same minute and on the same input: the
 * table from which the trade study takes its prices. One thread.
 *
 *   answers [FOLDER]     every folder of the list at the end, or one
 *
 * To add a slot: write a function that times one answer, like drag_cost, and add it to the list. */
#include <math.h>
#include "../verify/drag_laws.h"

enum { ANSWERS = 64, ROUNDS = 15, POINTS = 4096, PASSES = 8 };

/* One line of a folder's table. */
struct cost {
    char name[64];
    double ns, median; /* the least over the rounds, and the median */
};

static struct cost costs[ANSWERS];
static int n_costs;

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int by_cost(const void *a, const void *b)
{
    return by_value(&((const struct cost *)a)->ns, &((const struct cost *)b)->ns);
}

/* Calls `work` in rounds; it does `calls` of the answer each time. Adds the answer's line. */
static void time_answer(const char *name, double (*work)(void *of), void *of, int calls)
{
    static volatile double sink; /* so that the work is done */
    double ns[ROUNDS];
    for (int r = 0; r < ROUNDS; r++) {
        const double start = wall_clock();
        sink = work(of);
        ns[r] = 1e9 * (wall_clock() - start) / calls;
    }
    qsort(ns, ROUNDS, sizeof ns[0], by_value);
    if (n_costs < ANSWERS) {
        snprintf(costs[n_costs].name, sizeof costs[0].name, "%s", name);
        costs[n_costs].median = ns[ROUNDS / 2];
        costs[n_costs++].ns = ns[0];
    }
    (void)sink;
}

/* eps from 0.35 to 1, Re from 1e-3 to 1e3, the same for every law. */
static double drag_work(void *of)
{
    static double eps[POINTS], re[POINTS];
    const struct law *const law = of;
    double sum = 0.0;
    for (int i = 0; i < POINTS && eps[0] == 0.0; i++) {
        eps[POINTS - 1 - i] = 0.35 + 0.65 * fmod(0.6180339887 * (i + 1), 1.0);
        re[POINTS - 1 - i] = pow(10.0, -3.0 + 6.0 * fmod(0.7548776662 * (i + 1), 1.0));
    }
    for (int pass = 0; pass < PASSES; pass++)
        for (int i = 0; i < POINTS; i++)
            sum += law_factor(law, eps[i], re[i]);
    return sum;
}

static void drag_cost(const char *name, void *answer)
{
    struct law law;
    if (!law_load(&law, name, answer))
        return;
    law_init(&law, 0, NULL);
    time_answer(name, drag_work, &law, POINTS * PASSES);
}

static const struct {
    const char *folder, *what;
    void (*cost)(const char *name, void *answer);
} slots[] = {{"drag", "ns per grain and cell it has a share of", drag_cost}};

/* Cheapest first; `none` is no measure for the others. */
static void print_costs(const char *folder, const char *what)
{
    double least = (double)NAN;
    qsort(costs, (size_t)n_costs, sizeof costs[0], by_cost);
    printf("%s: %s; the least of %d rounds, its ratio, the median\n  %-24s %8s %8s %8s\n",
           folder, what, ROUNDS, "answer", "ns", "ratio", "median");
    for (int i = 0; i < n_costs; i++) {
        const bool none = strcmp(costs[i].name, "none") == 0;
        if (!none && isnan(least))
            least = costs[i].ns;
        printf("  %-24s %8.1f", costs[i].name, costs[i].ns);
        if (none)
            printf(" %8s", "-");
        else
            printf(" %8.2f", costs[i].ns / least);
        printf(" %8.1f\n", costs[i].median);
    }
}

int main(int argc, char **argv)
{
    check_quiet = true;
    for (size_t i = 0; i < sizeof slots / sizeof slots[0]; i++) {
        if (argc > 1 && strcmp(argv[1], slots[i].folder) != 0)
            continue;
        n_costs = 0;
        answers_visit(argv[0], slots[i].folder, slots[i].cost);
        print_costs(slots[i].folder, slots[i].what);
    }
    return check_failed != 0;
}
