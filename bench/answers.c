/* bench/answers.c - what each answer of a slot costs, in the same minute and on the same input: the
 * table from which the trade study takes its prices, with the reason that an answer gives for costing over
 * 1.5 times the cheapest. One thread, its processor time.
 *
 *   answers [FOLDER]     every folder of the list at the end, or one
 *
 * To add a slot: write a function that times one answer, like drag_cost, and add it to the list. */
#include <math.h>
#include <time.h>
#include "../forces/force.h"
#include "../solver/diffuse.h"
#include "../solver/grains.h"
#include "../solver/spread.h"
#include "../verify/drag_laws.h"

enum { ANSWERS = 64, ROUNDS = 15, POINTS = 4096, PASSES = 8 };

/* One line of a folder's table. */
struct cost {
    char name[64], why[128];
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

/* s of this thread, whatever else the machine does */
static double thread_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Calls `work` in rounds; it does `calls` of the answer each time. Adds the answer's line. */
static void time_answer(const struct about *about, double (*work)(void *of), void *of,
                        int calls)
{
    static volatile double sink; /* so that the work is done */
    double ns[ROUNDS];
    for (int r = 0; r < ROUNDS; r++) {
        const double start = thread_clock();
        sink = work(of);
        ns[r] = 1e9 * (thread_clock() - start) / calls;
    }
    qsort(ns, ROUNDS, sizeof ns[0], by_value);
    if (n_costs < ANSWERS) {
        snprintf(costs[n_costs].name, sizeof costs[0].name, "%s", about->name);
        snprintf(costs[n_costs].why, sizeof costs[0].why, "%s", about->cost ? about->cost : "");
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
    const struct about *about;
    if (!law_load(&law, name, answer) ||
        !answers_symbol(answer, "drag_about", &about, sizeof about))
        return;
    law_init(&law, 0, NULL);
    time_answer(about, drag_work, &law, POINTS * PASSES);
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
    (void)name;
    const struct about *about;
    void (*init)(struct scene *);
    int (*reach)(const struct grid *, double);
    struct diffuse *(*diffusion)(const struct grid *, const struct domain *, double);
    const struct key *keys;
    struct spreading s = {.domain = {.size = {1.0, 1.0, 1.0}, .cells = {CELLS, CELLS, CELLS}}};
    if (!answers_symbol(answer, "porosity_shares", &s.shares, sizeof s.shares) ||
        !answers_symbol(answer, "porosity_init", &init, sizeof init) ||
        !answers_symbol(answer, "porosity_reach", &reach, sizeof reach) ||
        !answers_symbol(answer, "porosity_diffusion", &diffusion, sizeof diffusion) ||
        !answers_symbol(answer, "porosity_keys", &keys, sizeof keys) ||
        !answers_symbol(answer, "porosity_about", &about, sizeof about))
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
    s.diffuse = diffusion(&s.grid, &s.domain, s.grains.radius[0]);
    time_answer(about, porosity_work, &s, GRAINS);
    void *const all[] = {s.grains.pos, s.grains.radius, s.grains.volume,
                         s.n_shares,   s.share,         s.field};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    spread_free(&s.spread);
    diffuse_free(s.diffuse);
}

/* What a force costs per grain and step of the fluid: its own formula; what a standard force takes of the
 * stress is part of a sum that the coupling makes anyway, and added mass is a number. */
static double force_work(void *of)
{
    const struct force *const f = of;
    struct force_view v = {
        .d = 1e-3, .mass = 1e-6, .rho = 1000.0, .mu = 1e-3, .eps = 0.8, .dt = 1e-4};
    double sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        v.slip = v3(1e-3 * (1 + i % 97), 0.02, -1e-2);
        v.curl = v3(3.0, 1.0 + i % 13, -2.0);
        v.spin = v3(0.5 * (i % 7), 2.0, 1.0);
        v.id = i;
        sum += f->spin_rate ? f->spin_rate(&v) : 0.0;
        sum += f->act ? f->act(&v).x : 0.0;
        sum += f->added_mass ? f->added_mass() : 0.0;
    }
    return sum;
}

static void force_cost(const char *name, void *answer)
{
    struct force *force; /* written by nobody: time_answer hands on what is not const */
    char *const symbol = xprintf("force_%s", name);
    if (answers_symbol(answer, symbol, &force, sizeof force)) {
        struct scene *const scene = scene_load(NULL, 0, NULL);
        scene_declare(scene, force->keys);
        if (force->read)
            force->read(scene);
        scene_free(scene);
        time_answer(&force->about, force_work, force, POINTS);
    }
    xfree(symbol);
}

static const struct {
    const char *folder, *what;
    void (*cost)(const char *name, void *answer);
} slots[] = {
    {"drag", "ns per grain and cell it has a share of", drag_cost},
    {"porosity", "ns per grain: shares, sum and diffusion; cells of 2 d, 4 grains each",
     porosity_cost},
    {"forces", "ns per grain and step of the fluid: the force's own formula", force_cost}};

/* Cheapest first; `none` is no measure for the others. */
static void print_costs(const char *folder, const char *what)
{
    double least = (double)NAN;
    qsort(costs, (size_t)n_costs, sizeof costs[0], by_cost);
    printf("%s: %s; the least of %d rounds, its ratio, the median\n  %-24s %8s %8s %8s  %s\n",
           folder, what, ROUNDS, "answer", "ns", "ratio", "median", "why over 1.5");
    for (int i = 0; i < n_costs; i++) {
        const bool none = strcmp(costs[i].name, "none") == 0;
        if (!none && isnan(least))
            least = costs[i].ns;
        printf("  %-24s %8.1f", costs[i].name, costs[i].ns);
        if (none)
            printf(" %8s", "-");
        else
            printf(" %8.2f", costs[i].ns / least);
        const bool dear = !none && costs[i].ns > 1.5 * least;
        printf(" %8.1f  %s\n", costs[i].median,
               !dear             ? ""
               : costs[i].why[0] ? costs[i].why
                                 : "no reason given");
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
