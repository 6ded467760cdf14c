/* The driver of studies: axes, front, Richardson, processes that crash, hang or refuse, journal. */
/* slots: contact/none */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "../tools/study/study.h"
#include "check.h"

static char folder[] = "/tmp/silt-test-study-XXXXXX";

static char *in_folder(const char *name)
{
    return xprintf("%s/%s", folder, name);
}

static void axes(void)
{
    struct axis a;
    check(!axis_parse(&a, "drag=ergun,di_felice"), "a list of words");
    check(a.n == 2 && a.words && strcmp(a.key, "modules.drag") == 0, "of a slot");
    axis_free(&a);
    check(!axis_parse(&a, "run.dt=1.7,3.4,27.2 us"), "a list with one unit");
    check(a.n == 3 && strcmp(a.value[0], "1.7 us") == 0 && a.log && a.number[2] == 27.2,
          "each value has the unit: %s", a.value[0]);
    axis_free(&a);
    check(!axis_parse(&a, "grains beads.diameter=0.3:37.3:4 mm"), "a range");
    check_rel(a.number[1], 0.3 * pow(37.3 / 0.3, 1.0 / 3.0), 1e-5, "evenly in the logarithm");
    check(strstr(a.value[3], " mm") != NULL, "with its unit: %s", a.value[3]);
    axis_free(&a);
    check(!axis_parse(&a, "material b.friction=0.1:0.7:4:lin"), "a linear range");
    check_rel(a.number[1], 0.3, 1e-5, "evenly");
    axis_free(&a);
    check(!axis_parse(&a, "domain.cells=8 8 16,16 16 32"), "triples");
    check(a.n == 2 && strcmp(a.value[0], "8 8 16") == 0, "are left as they are: %s",
          a.value[0]);
    axis_free(&a);
    char *const sets = in_folder("grains.sets");
    FILE *const f = fopen(sets, "w");
    fputs(
        "; two\n[round]\nmodules.shape = sphere\n[block 8]\nmodules.shape = superquadric ; c\n"
        "grains a.half_axes = 1 1 1.7\n",
        f);
    fclose(f);
    char *const all = xprintf("grain@%s=all", sets), *const none =
                                                         xprintf("grain@%s=oval", sets);
    check(!axis_parse(&a, all), "sets of keys from a file");
    check(a.n == 2 && a.words && strcmp(a.name, "grain") == 0 &&
              strcmp(a.value[1], "block 8") == 0,
          "all of them, in order");
    char *lines;
    check(!sets_read(&a, "block 8", &lines), "a set is read");
    check(strcmp(lines, "modules.shape=superquadric\ngrains a.half_axes=1 1 1.7") == 0,
          "as overrides: %s", lines);
    xfree(lines);
    axis_free(&a);
    char *const no_set = axis_parse(&a, none);
    check(no_set && strstr(no_set, "no [oval]"), "a set that is not there: %s", no_set);
    axis_free(&a);
    char *const why_file = axis_parse(&a, "grain@/nowhere.sets=all");
    check(why_file && strstr(why_file, "no such file"), "a file that is not: %s", why_file);
    axis_free(&a);
    char *const mine[] = {sets, all, none, no_set, why_file};
    for (size_t i = 0; i < sizeof mine / sizeof mine[0]; i++)
        xfree(mine[i]);
    static const char *const wrong[] = {"nonsense=1,2",      "drag=",      "run.dt=1:2",
                                        "real=half",         "threads=0",  "drag=a,,b",
                                        "run.dt=1:-1:3:log", "run.dt=3,3", "run.dt"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char *const why = axis_parse(&a, wrong[i]);
        check(why != NULL, "%s is refused: %s", wrong[i], why ? why : "");
        xfree(why);
        axis_free(&a);
    }
}

static void fronts(void)
{
    const double nan = (double)NAN;
    const double cost[] = {3.1, 1.7, 2.9, 7.3, 1.7, nan, 9.9, 3.1};
    const double error[] = {0.2, 0.9, 0.4, 0.013, 0.7, 0.001, 0.013, 0.2};
    const bool want[] = {true, false, true, true, true, false, false, false};
    bool front[8];
    pareto_front(8, NULL, cost, error, front);
    for (int i = 0; i < 8; i++)
        check(front[i] == want[i], "Pareto front, point %d", i);
    const int group[] = {5, 5, 5, 5, 9, 9, 9, 9};
    const bool in_group[] = {true, true, true, true, true, false, true, true};
    pareto_front(8, group, cost, error, front);
    for (int i = 0; i < 8; i++)
        check(front[i] == in_group[i], "Pareto front of its group, point %d", i);
    check_rel(median((const double[]){7.1, 1.3, 2.9}, 3), 2.9, 0.0, "median of three");
    check_rel(median((const double[]){7.1, 1.3, 2.9, 3.3}, 4), 3.1, 1e-15, "of four");
    check(isnan(median(NULL, 0)), "of none");
}

static void estimates(void)
{
    const double h[3] = {0.37, 0.19, 0.08};
    double f[3], order, doubt;
    for (int k = 0; k < 3; k++)
        f[k] = 2.385 + 0.71 * pow(h[k], 1.83);
    check_rel(richardson(h, f, &order, &doubt), 2.385, 1e-12, "Richardson's estimate");
    check_rel(order, 1.83, 1e-9, "its order");
    f[1] = f[0] + 0.1;
    f[2] = f[0] - 0.1;
    check_rel(richardson(h, f, &order, &doubt), f[2], 0.0, "without an order: the finest");
    check(isnan(order), "and none is told");
}

static void judged(const char *what, const char *script, double timeout, enum ending want,
                   const char *says)
{
    char *const err = in_folder("err.txt"), *reason, *const shell = xstrdup(script);
    char sh[] = "sh", c[] = "-c";
    char *const argv[] = {sh, c, shell, NULL};
    const struct process p = process_run(argv, NULL, err, timeout, 0.4);
    const enum ending got = process_judge(&p, err, folder, &reason);
    check(got == want, "%s counts as %s (%s)", what, ending_name[got], reason);
    check(strstr(reason, says) != NULL, "%s: the reason names %s", what, says);
    xfree(err);
    xfree(reason);
    xfree(shell);
}

static void endings(void)
{
    char *const summary = in_folder("summary.txt");
    judged("no summary", "exit 0", 0.0, RUN_BROKEN, "summary");
    FILE *const f = fopen(summary, "w");
    fprintf(f, "flux = 2.385e-3 m s-1\nmode = pass\nreference_error = nan\n");
    fclose(f);
    judged("a good end", "exit 0", 0.0, RUN_GOOD, "");
    judged("a crash", "kill -SEGV $$", 0.0, RUN_BROKEN, "crash");
    judged("an abort", "kill -ABRT $$", 0.0, RUN_BROKEN, "signal 6");
    judged("a refusal", "echo 'a.ini:3: run.dt = 1: too long' >&2; exit 2", 0.0, RUN_REFUSED,
           "a.ini:3");
    judged("a silent refusal", "exit 2", 0.0, RUN_BROKEN, "exit code 2");
    judged("a guard", "echo 'running 10 %' >&2; echo 'silt: overlap at t = 1 s' >&2; exit 3",
           0.0, RUN_STOPPED, "silt: overlap");
    judged("an unknown code", "exit 17", 0.0, RUN_BROKEN, "17");
    judged("a hang", "trap '' TERM; while :; do sleep 0.05; done", 0.3, RUN_BROKEN, "hangs");
    judged("what leaves nothing when its time is over", "sleep 20", 0.3, RUN_BROKEN,
           "without its outputs");
    judged("what is slow and ends when asked",
           "trap 'exit 143' TERM; while :; do sleep 0.05; done", 0.3, RUN_SLOW, "longer");
    const struct result r = result_read(summary);
    check_rel(result_number(&r, "flux"), 2.385e-3, 0.0, "a line of the summary");
    check(isnan(result_number(&r, "mode")), "a text is no number");
    const struct summary_entry *const e = result_find(&r, "reference_error");
    check(e && e->is_number && isnan(e->number), "nan is");
    xfree(summary);
}

static void journals(void)
{
    char *const path = in_folder("journal.txt");
    struct journal *j = journal_open(folder, true);
    struct journal_entry e = {.id = 0xfedcba9876543210u,
                              .ending = RUN_STOPPED,
                              .cost = {1.37, 2.5, 3e6},
                              .simulated = 0.02385};
    char reason[] = "silt: overlap\tof 3", none[] = "";
    e.reason = reason;
    journal_add(j, &e, "dt = 3");
    e.ending = RUN_GOOD;
    e.reason = none;
    e.id = 7;
    journal_add(j, &e, "");
    e.cost.wall = 1.73;
    journal_add(j, &e, "");
    journal_close(j);
    FILE *const f = fopen(path, "a");
    fprintf(f, "0000000000000007\tgood\t1.9"); /* cut short */
    fclose(f);
    j = journal_open(folder, false);
    const struct journal_entry *const first = journal_find(j, 0xfedcba9876543210u, 0);
    check(first && first->ending == RUN_STOPPED &&
              strcmp(first->reason, "silt: overlap of 3") == 0,
          "an entry is read again");
    check_rel(first ? first->simulated : 0.0, 0.02385, 1e-12, "with its numbers");
    const struct journal_entry *const second = journal_find(j, 7, 1);
    check_rel(second ? second->cost.wall : 0.0, 1.73, 1e-6, "repeats in their order");
    check(!journal_find(j, 7, 2), "a line that was cut short does not count");
    journal_add(j, &e, "");
    journal_close(j);
    j = journal_open(folder, false);
    check(journal_find(j, 7, 2) != NULL, "and does not spoil the next");
    journal_close(j);
    xfree(path);
}

int main(void)
{
    if (!mkdtemp(folder))
        return 1;
    process_signals();
    axes();
    fronts();
    estimates();
    endings();
    journals();
    char *const argv[] = {(char[]){"rm"}, (char[]){"-r"}, folder, NULL};
    process_run(argv, NULL, NULL, 0.0, 1.0);
    return check_end();
}
