/* runs.c - the runs of a study: made, or found in its journal. */
#include <dirent.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "study.h"

#define LONG_RUN 20.0 /* s; longer ones are repeated once less: they average over the noise */
#define ENOUGH                                                                                 \
    1.0 /* s of core time of all runs of a variant: a median of few short runs is noise */

/* Ends the program where a signal asked for it. */
static void obey_signal(struct study *s)
{
    const int which = process_caught();
    if (!which)
        return;
    fprintf(stderr,
            "\nsilt: the study was stopped by a signal after %d runs; the same command goes on "
            "from here\n",
            s->made + s->found);
    journal_close(s->journal);
    exit(128 + which);
}

static void say(const struct study *s, const struct variant *v)
{
    const bool terminal = isatty(STDERR_FILENO) == 1;
    const int at = s->made + s->found + 1;
    char *const of = s->expected >= at ? xprintf(" of %d", s->expected) : xstrdup("");
    fprintf(stderr, "%s%s: run %d%s: %s%s", terminal ? "\r\033[K" : "", s->verb, at, of,
            v->label, terminal ? "" : "\n");
    fflush(stderr);
    xfree(of);
}

char *run_folder(const struct study *s, const struct variant *v)
{
    return xprintf("%s/runs/%016" PRIx64, s->directory, v->id);
}

/* What is large goes; summary and messages stay. */
static void clear_folder(const char *folder)
{
    DIR *const d = opendir(folder);
    for (struct dirent *e = d ? readdir(d) : NULL; e; e = readdir(d)) {
        const char *const dot = strrchr(e->d_name, '.');
        if (!dot || strcmp(dot, ".txt") == 0 || dot == e->d_name)
            continue;
        char *const path = xprintf("%s/%s", folder, e->d_name);
        remove(path);
        xfree(path);
    }
    if (d)
        closedir(d);
}

static void settle(struct variant *v, enum ending ending, const char *reason)
{
    char *const copy = xstrdup(reason);
    xfree(v->reason);
    v->ending = ending;
    v->reason = copy;
}

static void ended(struct variant *v, const struct journal_entry *e, const char *folder)
{
    char *const path = xprintf("%s/summary.txt", folder);
    if (v->n_runs == 0 || e->ending != RUN_GOOD) {
        settle(v, e->ending, e->reason);
        result_free(&v->result);
        if (e->ending == RUN_GOOD)
            v->result = result_read(path);
    }
    v->simulated = e->simulated;
    v->run[v->n_runs++] = e->cost;
    xfree(path);
}

static void make_run(struct study *s, struct variant *v, const char *folder)
{
    char threads[16], *reason;
    char *const out = xprintf("%s/out.txt", folder), *const err = xprintf("%s/err.txt", folder);
    char *const summary = xprintf("%s/summary.txt", folder);
    char **const argv = xalloc((size_t)v->n_overrides + 8, sizeof *argv);
    int k = 0;
    argv[k++] = (char *)(uintptr_t)v->binary;
    argv[k++] = (char *)(uintptr_t)s->scene;
    for (int i = 0; i < v->n_overrides; i++)
        argv[k++] = v->overrides[i];
    argv[k++] = (char *)(uintptr_t) "-o";
    argv[k++] = (char *)(uintptr_t)folder;
    if (v->threads > 0) {
        snprintf(threads, sizeof threads, "%d", v->threads);
        argv[k++] = (char *)(uintptr_t) "-j";
        argv[k++] = threads;
    }
    mkdir(folder, 0777);
    remove(summary);
    const struct process p = process_run(argv, out, err, s->timeout, GRACE);
    obey_signal(s);
    struct journal_entry e = {.id = v->id, .cost = p.cost};
    e.ending = process_judge(&p, err, folder, &reason);
    e.reason = reason;
    if (e.ending == RUN_GOOD) {
        struct result r = result_read(summary);
        e.simulated = result_number(&r, "simulated_time");
        result_free(&r);
        if (s->inspect && v->n_runs == 0) {
            char *const wrong = s->inspect(folder);
            if (wrong) {
                e.ending = RUN_BROKEN;
                xfree(reason);
                e.reason = reason = wrong;
            }
        }
    }
    if (!s->keep)
        clear_folder(folder);
    journal_add(s->journal, &e, v->label);
    ended(v, &e, folder);
    s->made++;
    void *const all[] = {out, err, summary, argv, reason};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

/* The variant's binary and with it its id; false if there is none. */
static bool build(struct study *s, struct variant *v)
{
    char *why;
    enum ending ending = RUN_BROKEN;
    if (v->binary)
        return true;
    const struct built *const b =
        study_built(s, v->overrides, v->n_overrides, v->real, &ending, &why);
    obey_signal(s);
    if (!b) {
        settle(v, ending, why);
        xfree(why);
        return false;
    }
    v->binary = built_binary(b);
    v->id = hash_text(hash_file(built_hash(b), s->scene), v->real);
    for (int i = 0; i < v->n_overrides; i++)
        v->id = hash_text(v->id, v->overrides[i]);
    char threads[16];
    snprintf(threads, sizeof threads, "%d", v->threads);
    v->id = hash_text(v->id, threads);
    return true;
}

void study_run(struct study *s, struct variant *v)
{
    if (v->n_runs == MOST_REPEATS || (v->ending != RUN_NONE && v->ending != RUN_GOOD))
        return;
    if (!build(s, v))
        return;
    char *const folder = run_folder(s, v), *const summary = xprintf("%s/summary.txt", folder);
    const struct journal_entry *const e = journal_find(s->journal, v->id, v->n_runs);
    const bool outdated =
        e && e->ending == RUN_SLOW && (s->timeout == 0.0 || e->cost.wall < 0.9 * s->timeout);
    if (e && !outdated && (e->ending != RUN_GOOD || access(summary, R_OK) == 0)) {
        ended(v, e, folder);
        s->found++;
    } else {
        say(s, v);
        make_run(s, v, folder);
        if (v->ending != RUN_GOOD) {
            fprintf(stderr, "%s%s: %s: %s: %.100s\n", isatty(STDERR_FILENO) ? "\r\033[K" : "",
                    s->verb, v->label, ending_name[v->ending], v->reason);
        }
    }
    xfree(folder);
    xfree(summary);
}

static bool short_of_time(const struct study *s, const struct variant *v)
{
    double all = 0.0;
    for (int k = 0; k < v->n_runs; k++)
        all += v->run[k].core;
    return s->more && v->ending == RUN_GOOD && all < ENOUGH && v->n_runs < MOST_REPEATS;
}

void study_rounds(struct study *s, struct variant *const *list, int n)
{
    s->expected = n * s->repeats;
    for (int round = 0; round < s->repeats; round++)
        for (int k = 0; k < n; k++) {
            struct variant *const v = list[(k + round) % n];
            const int most = v->n_runs > 0 && v->run[0].wall > LONG_RUN && s->repeats > 1
                                 ? s->repeats - 1
                                 : s->repeats;
            if (v->n_runs < most)
                study_run(s, v);
        }
    for (bool any = true; any;) {
        any = false;
        for (int k = 0; k < n; k++)
            if (short_of_time(s, list[k])) {
                study_run(s, list[k]);
                any = true;
            }
    }
    if (s->made + s->found > 0 && isatty(STDERR_FILENO) == 1)
        fputs("\r\033[K", stderr);
}
