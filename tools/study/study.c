/* study.c - arguments, folder, variants of a study. */
#include "study.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *const ending_name[] = {"none", "good", "refused", "stopped", "slow", "broken"};

enum { STUDY_REPEATS = 3 };

static double option_number(const char *name, const char *value, double least, double most)
{
    char *end = NULL;
    const double x = value ? strtod(value, &end) : (double)NAN;
    if (!value || end == value || *end != '\0' || !(x >= least && x <= most))
        die(EXIT_SCENE, "%s takes a number, %g to %g", name, least, most);
    return x;
}

static char *default_directory(const struct study *s)
{
    const char *const slash = strrchr(s->scene, '/'), *const name =
                                                          slash ? slash + 1 : s->scene;
    const char *const dot = strrchr(name, '.');
    return xprintf("out/%.*s-%s", (int)(dot ? dot - name : (long)strlen(name)), name, s->verb);
}

/* A key with one value holds for all variants; anything else is an axis. */
static void add_axis(struct study *s, const char *text)
{
    struct axis a;
    char *const wrong = axis_parse(&a, text);
    if (wrong)
        die(EXIT_SCENE, "%s", wrong);
    if (a.kind == AXIS_KEY && a.n == 1) {
        s->base = xrealloc(s->base, (size_t)s->n_base, (size_t)s->n_base + 1, sizeof *s->base);
        s->base[s->n_base++] = xprintf("%s=%s", a.key, a.value[0]);
        axis_free(&a);
        return;
    }
    if (s->n_axes == MOST_AXES)
        die(EXIT_SCENE, "a study has at most %d axes", MOST_AXES);
    for (int i = 0; i < s->n_axes; i++)
        if (strcmp(s->axis[i].key, a.key) == 0)
            die(EXIT_SCENE, "%s is an axis twice", a.name);
    s->axis[s->n_axes++] = a;
}

/* True if argv[*i] (with its value) was one of the options of every study. */
static bool common_option(struct study *s, int argc, char **argv, int *i)
{
    const char *const name = argv[*i], *const value = *i + 1 < argc ? argv[*i + 1] : NULL;
    bool takes = true;
    if (strcmp(name, "-o") == 0 && value)
        s->directory = xstrdup(value);
    else if (strcmp(name, "-j") == 0)
        s->threads = (int)option_number(name, value, 1, 1024);
    else if (strcmp(name, "--repeats") == 0) {
        s->repeats = (int)option_number(name, value, 1, MOST_REPEATS);
        s->more = false;
    } else if (strcmp(name, "--timeout") == 0)
        s->timeout = option_number(name, value, 0.01, 1e9);
    else
        takes = false;
    if (takes) {
        ++*i;
        return true;
    }
    if (strcmp(name, "--keep") == 0)
        return s->keep = true;
    if (strcmp(name, "--fresh") == 0)
        return s->fresh = true;
    return false;
}

void study_arguments(struct study *s, const char *verb, int *argc, char **argv)
{
    int left = 1;
    s->verb = verb;
    s->more = s->repeats == 0;
    s->repeats = s->repeats ? s->repeats : STUDY_REPEATS;
    char *const tools = xstrdup(argv[0]), *const slash = strrchr(tools, '/');
    if (slash)
        *slash = '\0';
    s->tools = slash ? tools : ".";
    for (int i = 1; i < *argc; i++) {
        if (argv[i][0] == '-') {
            if (!common_option(s, *argc, argv, &i)) {
                argv[left++] = argv[i];
                if (i + 1 < *argc && argv[i + 1][0] != '-' && strcmp(argv[i], "--force") != 0 &&
                    strcmp(argv[i], "--confirm") != 0 && strcmp(argv[i], "--no-edges") != 0 &&
                    strcmp(argv[i], "--no-force") != 0)
                    argv[left++] = argv[++i];
            }
        } else if (strchr(argv[i], '=')) {
            add_axis(s, argv[i]);
        } else if (!s->scene) {
            s->scene = argv[i];
        } else {
            die(EXIT_SCENE, "one scene only, not also %s", argv[i]);
        }
    }
    *argc = left;
    if (!s->scene)
        die(EXIT_SCENE, "which scene?");
    if (!s->directory)
        s->directory = default_directory(s);
}

static void make_folders(const char *path)
{
    char *const copy = xstrdup(path);
    for (char *c = copy + 1;; c++)
        if (*c == '/' || *c == '\0') {
            const char was = *c;
            *c = '\0';
            if (mkdir(copy, 0777) != 0 && errno != EEXIST)
                die(EXIT_WRITE, "%s: %s", copy, strerror(errno));
            *c = was;
            if (was == '\0')
                break;
        }
    xfree(copy);
}

void study_open(struct study *s)
{
    char *const runs = study_path(s, "runs");
    make_folders(runs);
    xfree(runs);
    process_signals();
    s->journal = journal_open(s->directory, s->fresh);
}

static void variant_free(struct variant *v)
{
    for (int i = 0; i < v->n_overrides; i++)
        xfree(v->overrides[i]);
    void *const all[] = {v->overrides, v->label, v->real, v->command, v->reason};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    result_free(&v->result);
    xfree(v);
}

void study_close(struct study *s)
{
    for (int i = 0; i < s->n; i++)
        variant_free(s->variant[i]);
    for (int i = 0; i < s->n_axes; i++)
        axis_free(&s->axis[i]);
    for (int i = 0; i < s->n_base; i++)
        xfree(s->base[i]);
    xfree(s->base);
    xfree(s->variant);
    xfree(s->directory);
    journal_close(s->journal);
    built_free(s->built);
}

char *study_path(const struct study *s, const char *name)
{
    return xprintf("%s/%s", s->directory, name);
}

static void append(char **text, const char *more)
{
    char *const longer = xprintf("%s%s", *text, more);
    xfree(*text);
    *text = longer;
}

static void add_override(struct variant *v, char *text)
{
    v->overrides = xrealloc(v->overrides, (size_t)v->n_overrides, (size_t)v->n_overrides + 1,
                            sizeof *v->overrides);
    v->overrides[v->n_overrides++] = text;
}

static char *variant_label(const struct study *s, const int *choice)
{
    char *label = xstrdup("");
    for (int a = 0; a < s->n_axes; a++) {
        if (choice[a] < 0)
            continue;
        char *const part = xprintf("%s%s = %s", label[0] ? ", " : "", s->axis[a].name,
                                   s->axis[a].value[choice[a]]);
        append(&label, part);
        xfree(part);
    }
    if (label[0] == '\0')
        append(&label, "the scene as it is");
    return label;
}

/* Returns NULL, or what is wrong with the file. */
static char *add_set(struct variant *v, const struct axis *x, int c)
{
    char *lines, *rest = NULL;
    char *const wrong = sets_read(x, x->value[c], &lines);
    for (char *l = wrong ? NULL : strtok_r(lines, "\n", &rest); l;
         l = strtok_r(NULL, "\n", &rest))
        add_override(v, xstrdup(l));
    xfree(lines);
    return wrong;
}

/* NULL, or why an axis does not apply. */
static char *fill_overrides(struct study *s, struct variant *v)
{
    char *why = NULL;
    for (int i = 0; i < s->n_base; i++)
        add_override(v, xstrdup(s->base[i]));
    for (int pass = 0; pass < 2;
         pass++) /* keys first: named axes look at the scene with them */
        for (int a = 0; a < s->n_axes; a++) {
            const struct axis *const x = &s->axis[a];
            const int c = v->choice[a];
            if (c < 0)
                continue;
            if (pass == 0 && x->kind == AXIS_KEY)
                add_override(v, xprintf("%s=%s", x->key, x->value[c]));
            if (pass == 0 && x->kind == AXIS_SETS && (why = add_set(v, x, c)))
                return why;
            if (pass == 0 && x->kind == AXIS_THREADS)
                v->threads = (int)x->number[c];
            if (pass == 0 && x->kind == AXIS_REAL) {
                xfree(v->real);
                v->real = xstrdup(x->value[c]);
            }
            if (pass == 1 && x->kind == AXIS_NAMED) {
                char *more[MOST_EXPANSION];
                const int n = named_expand(s, x->name, x->value[c], x->number[c], v->overrides,
                                           v->n_overrides, more, &why);
                if (n < 0)
                    return why;
                for (int i = 0; i < n; i++)
                    add_override(v, more[i]);
            }
        }
    if (s->force)
        add_override(v, xstrdup("run.force=on"));
    return NULL;
}

static void fill_command(const struct study *s, struct variant *v)
{
    char *const scene = shell_quoted(s->scene);
    v->command =
        xprintf("%s./run.sh %s", strcmp(v->real, "float") == 0 ? "REAL=float " : "", scene);
    for (int i = 0; i < v->n_overrides; i++) {
        char *const word = shell_quoted(v->overrides[i]);
        append(&v->command, " ");
        append(&v->command, word);
        xfree(word);
    }
    if (v->threads > 0) {
        char *const word = xprintf(" -j %d", v->threads);
        append(&v->command, word);
        xfree(word);
    }
    xfree(scene);
}

struct variant *study_variant(struct study *s, const int *choice, char **why)
{
    for (int i = 0; i < s->n; i++)
        if (memcmp(s->variant[i]->choice, choice, (size_t)s->n_axes * sizeof *choice) == 0)
            return s->variant[i];
    struct variant *const v = xalloc(1, sizeof *v);
    const char *const real = getenv("REAL");
    memcpy(v->choice, choice, (size_t)s->n_axes * sizeof *choice);
    v->real = xstrdup(real && *real ? real : "double");
    v->threads = s->threads;
    v->reason = xstrdup("");
    v->label = variant_label(s, choice);
    *why = fill_overrides(s, v);
    if (*why) {
        variant_free(v);
        return NULL;
    }
    fill_command(s, v);
    if (s->n == s->capacity) {
        const int more = s->capacity ? 2 * s->capacity : 64;
        s->variant = xrealloc(s->variant, (size_t)s->n, (size_t)more, sizeof(struct variant *));
        s->capacity = more;
    }
    v->number = s->n + 1;
    return s->variant[s->n++] = v;
}
