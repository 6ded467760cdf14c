/* bench/answers.c - what each answer of a slot costs, in the same minute and on the same input: the
 * table from which the trade study takes its prices. One thread.
 *
 *   answers [FOLDER]     every folder of the list at the end, or one
 *
 * To add a slot: write a function that times one answer, like drag_cost, and add it to the list. */
#include <math.h>
#include "../solver/diffuse.h"
#include "../solver/grains.h"
#include "../solver/spread.h"
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

/* An answer of porosity/ and a box of CELLS^3 cells of two diameters, four grains to a cell. */
enum { CELLS = 16, GRAINS = 4 * CELLS * CELLS * CELLS };

struct spreading {
    int (*shares)(const struct grid *g, const struct domain *d, const struct grains *grains,
                  int i, struct share *out);
    struct domain domain;
    struct grid grid;
    struct grains grains;
    struct spread spread;
    struct diffuse *diffuse;
    int reach, *n_shares;
    struct share *share;
    double *field;
};

/* Shares of all grains, their volume on the grid, diffused. */
static double porosity_work(void *of)
{
    struct spreading *const s = of;
    for (int i = 0; i < GRAINS; i++)
        s->n_shares[i] =
            s->shares(&s->grid, &s->domain, &s->grains, i, &s->share[(size_t)i * s->reach]);
    spread_prepare(&s->spread, GRAINS, s->reach, s->n_shares, s->share);
    spread_one(&s->spread, s->grains.volume, s->field);
    if (s->diffuse)
        diffuse_apply(s->diffuse, s->field);
    return s->field[cell(&s->grid, 1, 1, 1)];
}

/* Grains in the order of their cells, as a run keeps them. */
static void place_grains(struct spreading *s)
{
    s->grains.pos = xalloc(GRAINS, sizeof *s->grains.pos);
    s->grains.radius = xalloc(GRAINS, sizeof *s->grains.radius);
    s->grains.volume = xalloc(GRAINS, sizeof *s->grains.volume);
    for (int i = 0; i < GRAINS; i++) {
        const int c = i / 4;
        const double h = s->grid.h[0];
        s->grains.pos[i] = v3((c % CELLS + fmod(0.6180339887 * (i + 1), 1.0)) * h,
                              (c / CELLS % CELLS + fmod(0.7548776662 * (i + 1), 1.0)) * h,
                              (c / (CELLS * CELLS) + fmod(0.5698402910 * (i + 1), 1.0)) * h);
        s->grains.radius[i] = 0.25 * h;
        s->grains.volume[i] = 1.0;
    }
}

static void porosity_cost(const char *name, void *answer)
{
    void (*init)(struct scene *);
    int (*reach)(const struct grid *, double);
    double (*width)(double);
    const struct key *keys;
    struct spreading s = {.domain = {.size = {1.0, 1.0, 1.0}, .cells = {CELLS, CELLS, CELLS}}};
    if (!answers_symbol(answer, "porosity_shares", &s.shares, sizeof s.shares) ||
        !answers_symbol(answer, "porosity_init", &init, sizeof init) ||
        !answers_symbol(answer, "porosity_reach", &reach, sizeof reach) ||
        !answers_symbol(answer, "porosity_width", &width, sizeof width) ||
        !answers_symbol(answer, "porosity_keys", &keys, sizeof keys))
        return;
    struct scene *const scene = scene_load(NULL, 0, NULL);
    scene_declare(scene, keys);
    init(scene);
    scene_free(scene);
    grid_create(&s.grid, &s.domain);
    place_grains(&s);
    s.reach = reach(&s.grid, s.grains.radius[0]);
    s.n_shares = xalloc(GRAINS, sizeof *s.n_shares);
    s.share = xalloc((size_t)GRAINS * s.reach, sizeof *s.share);
    s.field = grid_field(&s.grid);
    spread_create(&s.spread, &s.grid);
    if (width(s.grains.radius[0]) > 0.0)
        s.diffuse = diffuse_create(&s.grid, &s.domain, width(s.grains.radius[0]));
    time_answer(name, porosity_work, &s, GRAINS);
    void *const all[] = {s.grains.pos, s.grains.radius, s.grains.volume,
                         s.n_shares,   s.share,         s.field};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    spread_free(&s.spread);
    diffuse_free(s.diffuse);
}

static const struct {
    const char *folder, *what;
    void (*cost)(const char *name, void *answer);
} slots[] = {{"drag", "ns per grain and cell it has a share of", drag_cost},
             {"porosity",
              "ns per grain: shares, sum and diffusion; cells of 2 d, 4 grains each",
              porosity_cost}};

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
