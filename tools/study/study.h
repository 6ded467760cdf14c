/* study.h - many runs of one scene: axes, variants, their runs, what is kept of them.
 *
 * A study takes one scene through variants. An axis is a key of the scene, a slot, a named axis
 * (named.c: "cell_d", "density_ratio"), sets of keys from a file (sets.c), `real` or `threads`; a
 * variant chooses one value of each.
 * Each variant is an ordinary run: the scene with overrides, in the binary built for just that
 * (./run.sh build), as a process of its own. What a run gave is written to a journal at once, so
 * that a study which was interrupted goes on where it was; a run counts again only for the same
 * binary, scene and overrides.
 *
 * Runs are made one after the other, never side by side: they are timed. */
#ifndef STUDY_H
#define STUDY_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include "../../solver/base.h"

enum { MOST_AXES = 16, MOST_REPEATS = 64 };

enum axis_kind { AXIS_KEY, AXIS_NAMED, AXIS_SETS, AXIS_REAL, AXIS_THREADS };

struct axis {
    char *name; /* as asked for: "drag", "domain.cells", "cell_d" */
    char *key;  /* "modules.drag"; of a named axis its name; of sets their file */
    enum axis_kind kind;
    bool words; /* its values are no numbers */
    bool log;   /* its numbers lie evenly on a logarithmic scale */
    int n;
    char **value;   /* as the scene takes them, with their unit */
    double *number; /* NaN for a word; of "8 8 16" the first */
};

/* How a run ended. */
enum ending {
    RUN_NONE,    /* not run yet */
    RUN_GOOD,    /* exit 0 */
    RUN_REFUSED, /* exit 2: a message before it started */
    RUN_STOPPED, /* exit 3: a guard named what was wrong */
    RUN_SLOW,    /* longer than the time it had, but ended properly when asked to */
    RUN_BROKEN   /* a crash, a hang, a silent refusal, an exit code of none of these */
};
extern const char *const ending_name[];

struct cost {
    double wall, core; /* s: of the process as a whole; both user and system */
    double memory;     /* bytes: the most that was resident */
};

struct summary_entry {
    char *key, *text;
    double number; /* NaN for text */
    bool is_number;
};

/* A summary.txt. */
struct result {
    int n;
    struct summary_entry *entry;
};

struct variant {
    int number;            /* from 1 */
    int choice[MOST_AXES]; /* of each axis; -1: as in the scene */
    char *label;           /* "drag = ergun, cell_d = 2" */
    char **overrides;      /* "section.key=value" */
    int n_overrides;
    char *real; /* "double" | "float" */
    int threads;
    char *command; /* that runs it by hand */
    const char *binary;
    uint64_t id; /* of binary, scene, overrides; names its folder */
    enum ending ending;
    char *reason; /* of what did not end well; "" otherwise */
    int n_runs;
    struct cost run[MOST_REPEATS];
    double simulated; /* s */
    struct result result;
};

struct study {
    const char *verb, *scene; /* "trade", "scenes/settling.ini" */
    const char *tools;        /* folder of the built tools, "build/release" */
    char *directory;          /* of the study */
    int n_axes;
    struct axis axis[MOST_AXES];
    char **base; /* overrides of all variants */
    int n_base;
    int n, capacity;
    struct variant **variant;
    int repeats, threads; /* threads: -j; 0: as the run finds fit */
    bool
        more; /* --repeats not given: short runs are repeated until they make a second of core time */
    double timeout;                       /* s, for one run; 0: none */
    char *(*inspect)(const char *folder); /* of a run that ended well: what is wrong with its
                                             output (xfree), or NULL */
    bool force;                           /* run in spite of limits of the time step */
    bool keep;                            /* keep run.nc and the like */
    bool fresh;                           /* forget earlier runs */
    struct journal *journal;
    struct built *built; /* binaries so far */
    int made, found;     /* runs made now, runs found in the journal */
    int expected;        /* runs in all, for the progress line; 0: not known */
};

/* ---- study.c ---- */
/* Reads the options and axes that every study has; the verb's own options are left in argv, which
 * is shortened. Ends the program (2) with a message where one is wrong. An axis of one value that
 * is a key holds for all variants. */
void study_arguments(struct study *s, const char *verb, int *argc, char **argv);
void study_open(struct study *s); /* its folder, made and locked; its journal */
void study_close(struct study *s);
/* The variant with these choices, made if there is none yet. NULL: a named axis does not apply,
 * and *why (xfree it) says why. */
struct variant *study_variant(struct study *s, const int *choice, char **why);
/* Makes run number v->n_runs of a variant, or finds it in the journal. The first run settles how
 * the variant ends; of one that did not end well no more are made. Ends the program (130, 143)
 * where a signal stops the study. */
void study_run(struct study *s, struct variant *v);
/* Runs all variants `repeats` times, in rounds, so that whatever else the machine does falls on
 * all of them; those longer than LONG_RUN s once less often, and where --repeats is not given those
 * that are short until their runs make ENOUGH s of core time (or are MOST_REPEATS). */
void study_rounds(struct study *s, struct variant *const *list, int n);
char *run_folder(const struct study *s, const struct variant *v); /* xfree */
char *study_path(const struct study *s, const char *name);        /* in the folder; xfree */

/* ---- axis.c ---- */
/* "name=a,b,c" or "name=a:b:n" (n values from a to b, evenly on a logarithmic scale if both are
 * positive and b/a > 5, or evenly: a:b:n:lin); a unit after the last holds for all: "1,2,4 mm".
 * Returns NULL, or what is wrong (xfree). */
char *axis_parse(struct axis *a, const char *text);
int axis_add(struct axis *a, const char *value, double number); /* returns its index */
void axis_free(struct axis *a);

/* ---- sets.c ---- */
/* Both return NULL, or what is wrong (xfree). */
char *sets_all(struct axis *a); /* adds every value of the file */
/* *lines: the overrides of a value, one a line (xfree); NULL where something is wrong. */
char *sets_read(const struct axis *a, const char *value, char **lines);

/* ---- named.c ---- */
struct named_axis {
    const char *name, *standard, *meaning; /* standard: values where none are given */
};
extern const struct named_axis named_axes[]; /* ends with name NULL */
bool named_is(const char *name);
/* Overrides that put the scene (with the overrides given) at this value of the axis. Returns how
 * many were written to out (xfree each), or -1 and *why. */
enum { MOST_EXPANSION = 48 };
int named_expand(struct study *s, const char *name, const char *value, double number,
                 char *const *overrides, int n_overrides, char *out[MOST_EXPANSION],
                 char **why);

/* ---- process.c ---- */
struct process {
    int code;     /* exit code, or 128 + signal */
    bool late;    /* longer than its time */
    bool hung;    /* it had to be killed */
    bool crashed; /* ended by a signal of its own */
    struct cost cost;
};
void process_signals(void); /* once, before the first */
/* Runs argv with stdout and stderr to files (NULL: to this program's). After `timeout` s (0: never) it
 * is asked to end (SIGTERM); `grace` s later it is killed. */
struct process process_run(char *const argv[], const char *out, const char *err, double timeout,
                           double grace);
int process_caught(void);          /* a signal that asks this program to end, or 0 */
char *file_text(const char *path); /* the whole of it, "" if there is none; xfree */
uint64_t hash_text(uint64_t h, const char *text); /* start with HASH_START */
uint64_t hash_file(uint64_t h, const char *path);
#define HASH_START 14695981039346656037ull

#define GRACE 15.0 /* s that a run has to complete its outputs */
/* What the end of a process with that stderr and folder means; *reason to xfree. */
enum ending process_judge(const struct process *p, const char *err, const char *folder,
                          char **reason);

/* ---- limits.c ---- */
struct limit {
    char name[64];
    double used, limit;
    bool binding;
};
enum { MOST_LIMITS = 24 };
/* The finite limits that `check` names for the scene with these overrides; returns how many, or
 * -1 where it is refused for another reason than a limit. */
int limits_read(const struct study *s, const char *binary, char *const *overrides, int n,
                struct limit out[MOST_LIMITS]);
/* The binary for a scene with overrides, built if need be. NULL where there is none: how that
 * counts, and *why (xfree it). */
const struct built *study_built(struct study *s, char *const *overrides, int n,
                                const char *real, enum ending *ending, char **why);
const char *built_binary(const struct built *b);
uint64_t built_hash(const struct built *b); /* of its bytes */
void built_free(struct built *b);
/* What a program said on stderr, without progress and warnings, in one line; xfree. */
char *reason_of(const char *err_path);

/* ---- journal.c ---- */
struct journal_entry {
    uint64_t id;
    enum ending ending;
    struct cost cost;
    double simulated;
    char *reason;
};
struct journal *journal_open(const char *directory, bool fresh); /* locks the folder */
void journal_close(struct journal *j);
/* Entry number k of a variant, or NULL. */
const struct journal_entry *journal_find(const struct journal *j, uint64_t id, int k);
void journal_add(struct journal *j, const struct journal_entry *e, const char *label);

/* ---- result.c ---- */
struct result result_read(const char *path);
const struct summary_entry *result_find(const struct result *r, const char *key);
double result_number(const struct result *r, const char *key); /* NaN if there is none */
void result_free(struct result *r);

/* ---- pareto.c ---- */
/* Marks what no other of its group (NULL: all are one) beats in both: less cost and no more error, or
 * less error at no more cost. What is not finite is never on the front. */
void pareto_front(int n, const int *group, const double *cost, const double *error,
                  bool *front);
double median(const double *x, int n); /* NaN of none */
/* What three values f on steps h (coarse to fine) tend to as h goes to 0 [Richardson11]: the
 * order is fitted, and must lie within 0.3 and 6, else the finest is taken as it is. *doubt:
 * distance to the finest. */
double richardson(const double h[3], const double f[3], double *order, double *doubt);

/* ---- text.c ---- */
char *shell_quoted(const char *word); /* as it must be typed; xfree */
char *number_text(double x);          /* shortest that tells it to 6 digits; xfree */
void csv_field(FILE *to, const char *text);

#endif
