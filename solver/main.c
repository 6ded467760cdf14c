/* main.c - silt SCENE [section.key=value ...] [-o DIR] [-j THREADS] [--check]
 *
 * Reads the scene as a whole, refuses it with every reason at once (exit 2), or runs it. The
 * scene must ask for the answers that this binary holds; ./run.sh builds the binary for the
 * scene. */
#include <omp.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "../reference/reference.h"
#include "bed_file.h"
#include "feasibility.h"
#include "fill.h"
#include "log.h"
#include "output.h"
#include "probes.h"
#include "progress.h"
#include "provenance_info.h"
#include "run.h"
#include "settle.h"
#include "sim.h"
#include "step.h"

static volatile sig_atomic_t caught; /* signal that asks the run to stop */

struct options {
    const char *scene, *directory;
    int threads;
    bool check;
    int n_overrides;
    char **overrides;
};

static void on_signal(int which)
{
    caught = which;
}

static _Noreturn void usage(const char *why, const char *what)
{
    fprintf(stderr,
            "silt: %s%s\nusage: silt SCENE [section.key=value ...] [-o DIR] [-j THREADS] "
            "[--check]\n",
            why, what);
    exit(EXIT_SCENE);
}

static struct options parse(int argc, char **argv)
{
    struct options o = {.overrides = xalloc((size_t)argc, sizeof(char *))};
    for (int i = 1; i < argc; i++) {
        const bool last = i + 1 == argc;
        if (strcmp(argv[i], "-o") == 0 && !last) {
            o.directory = argv[++i];
        } else if (strcmp(argv[i], "-j") == 0 && !last) {
            char *end;
            const long n = strtol(argv[++i], &end, 10);
            if (*end != '\0' || n < 1 || n > 1024)
                usage("-j takes a number of threads, 1 to 1024, not ", argv[i]);
            o.threads = (int)n;
        } else if (strcmp(argv[i], "--check") == 0) {
            o.check = true;
        } else if (argv[i][0] == '-') {
            usage("no such option, or one without its value: ", argv[i]);
        } else if (strchr(argv[i], '=')) {
            o.overrides[o.n_overrides++] = argv[i];
        } else if (!o.scene) {
            o.scene = argv[i];
        } else {
            usage("one scene only, not also ", argv[i]);
        }
    }
    if (!o.scene)
        usage("which scene?", "");
    return o;
}

/* "out/bed" for scenes/bed.ini */
static char *default_directory(const char *scene)
{
    const char *const slash = strrchr(scene, '/'), *const name = slash ? slash + 1 : scene;
    const char *const dot = strrchr(name, '.');
    return xprintf("out/%.*s", (int)(dot ? dot - name : (long)strlen(name)), name);
}

static struct sim *running; /* for the last words of a run that dies */

static void last_words(int code, const char *message)
{
    if (code == EXIT_UNSTABLE && running)
        output_crash(running, message);
}

static void summarise(struct sim *s, double begin)
{
    const double wall = wall_clock() - begin;
    double busy = 0.0;
    for (int t = 0; t < TIMERS; t++)
        busy += s->timers.seconds[t];
    for (int t = 0; t < TIMERS; t++) {
        char key[64];
        snprintf(key, sizeof key, "time_%s", timer_name[t]);
        summary_number(&s->summary, key, s->timers.seconds[t], "s");
    }
    summary_number(&s->summary, "simulated_time", s->t, "s");
    summary_number(&s->summary, "steps", (double)s->step, "1");
    summary_number(&s->summary, "grain_steps", s->grain_steps, "1");
    const double loop = s->timers.seconds[TIME_MOTION] + s->timers.seconds[TIME_NEIGHBOURS] +
                        s->timers.seconds[TIME_SORT] + s->timers.seconds[TIME_SEARCH] +
                        s->timers.seconds[TIME_CONTACTS] + s->timers.seconds[TIME_GATHER];
    if (s->substep > 0 && loop > 0.0)
        summary_number(&s->summary, "grain_steps_per_second", s->grain_steps / loop, "s-1");
    drag_grains_report(s);
    summary_number(&s->summary, "active_choices", (double)s->neighbours.choices, "1");
    summary_number(&s->summary, "list_builds", (double)s->neighbours.builds, "1");
    summary_number(&s->summary, "contacts_per_grain",
                   s->grains.n > 0 ? (double)s->neighbours.touching / s->grains.n : 0.0, "1");
    summary_number(&s->summary, "wall_time", wall, "s");
    summary_number(&s->summary, "threads", omp_get_max_threads(), "1");
    struct provenance line[PROVENANCE_LINES];
    const int lines = provenance(line);
    for (int i = 0; i < lines; i++)
        if (strcmp(line[i].key, "threads") != 0)
            summary_text(&s->summary, line[i].key, "%s", line[i].value);
    printf("where the time went:");
    for (int t = 0; t < TIMERS; t++)
        if (s->timers.seconds[t] > 0.005 * busy)
            printf(" %s %.0f %%,", timer_name[t], 100.0 * s->timers.seconds[t] / busy);
    printf(" wall %.2f s\n", wall);
}

/* Steps to the end, or to a signal; returns the exit code. */
static int advance(struct sim *s)
{
    const double end = s->run.end - 1e-6 * s->run.dt;
    const double cells = (double)s->grid.n[0] * s->grid.n[1] * s->grid.n[2];
    double next_output = s->run.output_every, next_sample = s->run.series_every;
    struct progress progress;
    progress_start(&progress, 0.0, s->run.end, "running");
    while (s->t < end && !s->run.done && !caught) {
        const double before = s->grain_steps;
        run_until(s, s->run.series_asked ? fmin(next_output, next_sample) : next_output);
        step(s);
        const double clock = wall_clock(), slack = 1e-9 * s->run.end;
        probes_watch(s);
        analysis_watch(s);
        reference_watch(s);
        if (s->t >= next_sample - slack) {
            output_sample(s);
            while (next_sample <= s->t + slack)
                next_sample += s->run.series_every;
        }
        if (s->t >= next_output - slack && s->t < end) {
            output_fields(s);
            while (next_output <= s->t + slack)
                next_output += s->run.output_every;
        }
        timer_add(&s->timers, TIME_OUTPUT, clock);
        progress_update(&progress, s->t, s->grain_steps - before + cells);
    }
    progress_end(&progress);
    if (caught)
        fprintf(stderr,
                "silt: stopped by a signal at t = %.9g s; outputs are complete up to here\n",
                s->t);
    return caught ? 128 + caught : EXIT_GOOD;
}

static int run(struct sim *s, struct scene *scene)
{
    const double begin = wall_clock();
    output_create(s, scene);
    log_start(stdout, s);
    running = s;
    die_hook = last_words;
    /* sigaction, not signal: a second Ctrl-C must not end the run in the middle of an output */
    struct sigaction stop = {.sa_handler = on_signal};
    sigemptyset(&stop.sa_mask);
    s->run.stop = &caught;
    sigaction(SIGINT, &stop, NULL);
    sigaction(SIGTERM, &stop, NULL);
    sim_start(s);
    if (fill_settles(s, scene))
        settle(s);
    if (s->run.save_bed == SAVE_START)
        bed_file_write(s);
    ledger_start(s);
    analysis_start(s);
    if (s->fluid.exists)
        fluid_sense(s); /* the porosity at the start, for the output */
    output_fields(s);
    const int code = advance(s);
    if (s->run.save_bed == SAVE_END)
        bed_file_write(s);
    output_fields(s);
    insert_report(s);
    ledger_report(s);
    probes_report(s);
    analysis_report(s);
    reference_report(s);
    summarise(s, begin);
    output_close(s);
    return code;
}

/* Threads that wait for each other spin for a moment only, then sleep. By default libgomp spins for
 * long, which costs nothing alone; but two runs side by side on the same cores then hold each
 * other up a hundredfold. libgomp reads the variable when the program is loaded: so once more. */
static void bound_spinning(char **argv)
{
    if (getenv("GOMP_SPINCOUNT") || getenv("OMP_WAIT_POLICY"))
        return;
    setenv("GOMP_SPINCOUNT", "1000", 1);
    execv("/proc/self/exe", argv); /* if it cannot, the run goes on as it is */
}

/* Without -j: no more threads than there is work for, since waiting for each other takes longer than
 * a few hundred grains or some thousand cells. The results do not depend on it. */
static void fit_threads(const struct sim *s)
{
    enum { GRAINS = 500, CELLS = 5000 }; /* per thread */
    const double work = (double)s->grains.n / GRAINS + (double)s->grid.total / CELLS;
    const int most = omp_get_max_threads(), enough = 1 + (int)fmin(work, 1000.0);
    if (!getenv("OMP_NUM_THREADS") && !insert_changes(s) && enough < most)
        omp_set_num_threads(enough);
}

int main(int argc, char **argv)
{
    bound_spinning(argv);
    memory_open();
    const struct options o = parse(argc, argv);
    if (o.threads > 0)
        omp_set_num_threads(o.threads);
    struct scene *const scene = scene_load(o.scene, o.n_overrides, o.overrides);
    struct sim *const s = sim_alloc();
    struct feasibility f = {0};
    int code = EXIT_GOOD;
    s->run.directory = o.directory ? xstrdup(o.directory) : default_directory(o.scene);
    sim_create(s, scene, &f);
    if (o.threads == 0)
        fit_threads(s);
    if (o.check && (f.n > 0 || scene_errors(scene) == 0))
        feasibility_print(stdout, s, &f);
    scene_finish(scene);
    if (!o.check)
        code = run(s, scene);
    sim_free(s);
    scene_free(scene);
    xfree(o.overrides);
    return code;
}
