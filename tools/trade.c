/* tools/trade.c - error against cost: trade SCENE axis=values ... (./run.sh trade; study.h).
 *
 * Runs the scene through the variants, `repeats` times each in rounds, and tells the error of each
 * with its cost: wall time of the whole process over the simulated time (--cost: or core time, or
 * memory), medians of the repeats.
 * Writes trade.csv, trade.nc, trade.png and a table; names the cheapest variant within the error
 * asked for (--within, or else the reference's own tolerance), at each value of a condition (--per
 * AXIS), for means over an axis of repetitions (--mean AXIS). Exit code 1: --within, and none qualifies. */
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "study/trade.h"

enum { EXIT_NONE = 1, MOST_GRID = 48 };

static void parse_quantities(struct trade *t, const char *text)
{
    char *const copy = xstrdup(text), *rest = NULL;
    for (char *w = strtok_r(copy, ",", &rest); w; w = strtok_r(NULL, ",", &rest)) {
        if (t->n_quantities == MOST_QUANTITIES)
            die(EXIT_SCENE, "at most %d quantities", MOST_QUANTITIES);
        t->quantity[t->n_quantities++] = xstrdup(w);
    }
    xfree(copy);
}

static void parse_against(struct trade *t, const char *text)
{
    char *end;
    t->against_text = text;
    strtod(text, &end);
    t->against = strcmp(text, "finest") == 0   ? AGAINST_FINEST
                 : end != text && *end == '\0' ? AGAINST_VALUE
                                               : AGAINST_FILE;
}

static double parse_within(const char *text)
{
    char *end;
    const double x = strtod(text, &end);
    const bool percent = *end == '%' || strcmp(end, " %") == 0;
    if (end == text || !(x >= 0.0) || (*end && !percent))
        die(EXIT_SCENE, "--within takes an error, such as 5%% or 0.05, not %s", text);
    return percent ? 0.01 * x : x;
}

/* Index of the axis; -1 where none is named. */
static int parse_axis(const struct trade *t, const char *option, const char *name)
{
    if (!name)
        return -1;
    for (int a = 0; a < t->study.n_axes; a++)
        if (strcmp(t->study.axis[a].name, name) == 0)
            return a;
    die(EXIT_SCENE, "%s takes one of the axes, not %s", option, name);
}

static const char *const plan_names[] = {"grid", "one", "front", NULL};
static const char *const cost_names[] = {"wall", "core", "memory", NULL};

/* Index of the word. */
static int parse_word(const char *option, const char *text, const char *const *names)
{
    for (int i = 0; names[i]; i++)
        if (strcmp(text, names[i]) == 0)
            return i;
    die(EXIT_SCENE, "%s is %s, %s or %s, not %s", option, names[0], names[1], names[2], text);
}

static void parse(struct trade *t, int argc, char **argv)
{
    const char *per = NULL, *mean = NULL;
    bool plan = false;
    t->within = (double)NAN;
    study_arguments(&t->study, "trade", &argc, argv);
    for (int i = 1; i < argc; i++) {
        const char *const name = argv[i], *const value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(name, "--confirm") == 0) {
            t->confirm = true;
            continue;
        }
        i++;
        if (strcmp(name, "--within") == 0)
            t->within = parse_within(value);
        else if (strcmp(name, "--error") == 0 && *value)
            t->error_key = value;
        else if (strcmp(name, "--quantity") == 0 && *value)
            parse_quantities(t, value);
        else if (strcmp(name, "--against") == 0 && *value)
            parse_against(t, value);
        else if (strcmp(name, "--per") == 0 && *value)
            per = value;
        else if (strcmp(name, "--mean") == 0 && *value)
            mean = value;
        else if (strcmp(name, "--cost") == 0)
            t->by = (enum cost_by)parse_word(name, value, cost_names);
        else if (strcmp(name, "--plan") == 0) {
            t->plan = (enum plan)parse_word(name, value, plan_names);
            plan = true;
        } else
            die(EXIT_SCENE, "no such option of trade, or one without its value: %s", name);
    }
    if (t->n_quantities > 0 && t->against == AGAINST_REFERENCE)
        t->against = AGAINST_FINEST;
    if (t->n_quantities == 0 && t->against != AGAINST_REFERENCE)
        die(EXIT_SCENE, "--against needs --quantity: a line of summary.txt");
    if (t->study.n_axes == 0)
        die(EXIT_SCENE,
            "trade needs an axis: drag=ergun,di_felice or domain.cells='8 8 16,16 16 32'");
    t->per = parse_axis(t, "--per", per);
    t->mean = parse_axis(t, "--mean", mean);
    if (t->per >= 0 && t->per == t->mean)
        die(EXIT_SCENE, "--per and --mean take two different axes");
    double total = 1.0;
    for (int a = 0; a < t->study.n_axes; a++)
        total *= t->study.axis[a].n;
    if (!plan)
        t->plan = total > MOST_GRID ? PLAN_FRONT : PLAN_GRID;
}

/* Cost of the quickest and the slowest run around the median. */
static void print_spread(const struct trade *t, int i)
{
    if (t->study.variant[i]->n_runs > 1)
        printf(" %+5.0f%+4.0f %%", 100.0 * (t->low[i] / t->cost[i] - 1.0),
               100.0 * (t->high[i] / t->cost[i] - 1.0));
    else
        printf(" %11s", "one run");
}

/* "reynolds = 10: ", where there is a condition. */
static void print_condition(const struct trade *t, int group)
{
    if (t->per >= 0)
        printf("%s = %s: ", t->study.axis[t->per].name, t->study.axis[t->per].value[group]);
}

static void print_table(const struct trade *t)
{
    const struct study *const s = &t->study;
    size_t width = 8;
    for (int i = 0; i < s->n; i++)
        width = width > strlen(s->variant[i]->label) ? width : strlen(s->variant[i]->label);
    printf("%4s %-*s %11s", "", (int)width, "variant", "error");
    if (t->mean >= 0)
        printf(" %11s", "scatter");
    printf(" %11s %11s %11s %8s", "cost", "spread", "core", "memory");
    for (int q = 0; q < t->n_quantities; q++)
        printf(" %13s", t->quantity[q]);
    printf("\n%4s %-*s %11s", "", (int)width, "", "1");
    if (t->mean >= 0)
        printf(" %11s", "1");
    printf(" %11s %11s %11s %8s\n", "s/s", "", "s/s", "MiB");
    for (int i = 0; i < s->n; i++) {
        const struct variant *const v = s->variant[i];
        printf("%3d%c %-*s", v->number, t->front[i] ? '*' : ' ', (int)width, v->label);
        if (v->ending != RUN_GOOD) {
            printf(" %s: %.120s\n", ending_name[v->ending], v->reason);
            continue;
        }
        if (isnan(t->error[i]) && v->reason[0]) {
            printf(" %s\n", v->reason);
            continue;
        }
        printf(" %11.4g", t->error[i]);
        if (t->mean >= 0)
            printf(" %11.2g", t->scatter[i]);
        printf(" %11.4g", t->cost[i]);
        print_spread(t, i);
        printf(" %11.4g %8.3g", t->core[i], t->memory[i] / 1048576.0);
        for (int q = 0; q < t->n_quantities; q++)
            printf(" %*.4g", (int)fmax(13.0, (double)strlen(t->quantity[q])),
                   t->value[i * t->n_quantities + q]);
        printf("\n");
    }
    printf("* on the Pareto front; cost: %s, median of %d runs%s in rounds; spread: the least, "
           "the most\n",
           trade_cost_unit(t), s->repeats, s->more ? " and more of short ones" : "");
    for (int k = 0; t->against == AGAINST_FINEST && k < trade_groups(t) * t->n_quantities;
         k++) {
        const struct truth *const truth = &t->truth[k];
        print_condition(t, k / t->n_quantities);
        printf("compared with %s = %.8g", t->quantity[k % t->n_quantities], truth->value);
        if (t->mean >= 0)
            printf(", whose scatter is %.2g %%", 100.0 * fabs(truth->scatter / truth->value));
        if (isfinite(truth->order))
            printf(" (Richardson's estimate, order %.2f, %.2g %% from the finest)",
                   truth->order, 100.0 * fabs(truth->doubt / truth->value));
        printf("\n");
    }
}

/* The error that a set-up must have: --within, or the reference's tolerance; NaN if neither. */
static double asked(const struct trade *t)
{
    if (isfinite(t->within) || t->n_quantities > 0 || t->error_key)
        return t->within;
    for (int i = 0; i < t->study.n; i++) {
        const double tolerance =
            result_number(&t->study.variant[i]->result, "reference_tolerance");
        if (isfinite(tolerance))
            return tolerance;
    }
    return (double)NAN;
}

/* Runs it alone once more, as often as the study did, and tells how it compares. */
static void confirm(struct trade *t, int best)
{
    struct variant *const v = t->study.variant[best];
    struct variant again = *v;
    double x[MOST_REPEATS];
    again.n_runs = 0;
    again.reason = xstrdup("");
    again.result = (struct result){0};
    again.id = hash_text(v->id, "confirm") + (uint64_t)time(NULL); /* never from the journal */
    for (int k = 0; k < v->n_runs; k++)
        study_run(&t->study, &again);
    for (int k = 0; k < again.n_runs; k++)
        x[k] = t->by == BY_MEMORY ? again.run[k].memory / 1048576.0
               : t->by == BY_CORE ? again.run[k].core / again.simulated
                                  : again.run[k].wall / again.simulated;
    const double got = median(x, again.n_runs);
    const char *const key = t->n_quantities > 0 ? t->quantity[0]
                            : t->error_key      ? t->error_key
                                                : "reference_error";
    const bool same = result_number(&again.result, key) == result_number(&v->result, key);
    printf("run again alone, %d times: %s, its cost %.4g %s (%+.0f %%)\n", again.n_runs,
           same ? "its error the same to the last digit" : "ANOTHER error", got,
           trade_cost_unit(t), 100.0 * (got / t->cost[best] - 1.0));
    xfree(again.reason);
    result_free(&again.result);
}

static void print_choice(const struct trade *t, int group, int i, const char *what)
{
    print_condition(t, group);
    printf("%s %s: error %.3g %%, %.4g %s\n  %s\n", what, t->study.variant[i]->label,
           100.0 * t->error[i], t->cost[i], trade_cost_unit(t), t->study.variant[i]->command);
}

/* The cheapest of the group within the error asked for. Returns the exit code. */
static int recommend_in(struct trade *t, int group)
{
    const double limit = asked(t);
    char what[64];
    int best = -1, least = -1;
    for (int i = 0; i < t->study.n; i++) {
        if (!t->front[i] || trade_group(t, t->study.variant[i]->choice) != group)
            continue;
        if (t->error[i] <= limit && (best < 0 || t->cost[i] < t->cost[best]))
            best = i;
        if (least < 0 || t->error[i] < t->error[least])
            least = i;
    }
    t->best[group] = best;
    if (least < 0) {
        print_condition(t, group);
        printf("no variant has an error and a cost\n");
        return EXIT_NONE;
    }
    if (isnan(limit)) {
        t->best[group] = least;
        print_choice(
            t, group, least,
            "the least error (--within names the cheapest within an error) is that of");
        return EXIT_GOOD;
    }
    if (best < 0) {
        snprintf(what, sizeof what, "no variant is within %.4g %%; the nearest is",
                 100.0 * limit);
        print_choice(t, group, least, what);
        return isfinite(t->within) ? EXIT_NONE : EXIT_GOOD;
    }
    snprintf(what, sizeof what, "the cheapest within %.4g %% is", 100.0 * limit);
    print_choice(t, group, best, what);
    return EXIT_GOOD;
}

/* In every group; EXIT_NONE where one has none. */
static int recommend(struct trade *t)
{
    int code = EXIT_GOOD;
    t->best = xalloc((size_t)trade_groups(t), sizeof *t->best);
    for (int group = 0; group < trade_groups(t); group++)
        if (recommend_in(t, group) != EXIT_GOOD)
            code = EXIT_NONE;
    return code;
}

int main(int argc, char **argv)
{
    struct trade t = {.per = -1, .mean = -1};
    parse(&t, argc, argv);
    study_open(&t.study);
    trade_run_plan(&t);
    trade_costs(&t);
    trade_errors(&t);
    print_table(&t);
    const int code = recommend(&t);
    trade_write(&t);
    trade_draw(&t);
    for (int group = 0; t.confirm && group < trade_groups(&t); group++)
        if (t.best[group] >= 0)
            confirm(&t, t.best[group]);
    trade_free(&t);
    return code;
}
