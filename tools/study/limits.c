/* limits.c - the binary of a variant, and the limits that its `check` names. */
#include <stdlib.h>
#include <string.h>
#include "study.h"

/* Binaries built so far, by what they hold. */
struct built {
    struct built *next;
    char *slots, *binary;
    uint64_t hash;
};

/* stderr without progress and warnings, in one line; xfree. */
char *reason_of(const char *err_path)
{
    char *const text = file_text(err_path), *rest = NULL, *reason = xstrdup("");
    for (char *l = strtok_r(text, "\n", &rest); l; l = strtok_r(NULL, "\n", &rest)) {
        if (strncmp(l, "running", 7) == 0 || strncmp(l, "settling", 8) == 0 ||
            strncmp(l, "filling", 7) == 0 || strncmp(l, "silt: warning", 13) == 0)
            continue;
        char *const longer = xprintf("%s%s%s", reason, *reason ? "; " : "", l);
        xfree(reason);
        reason = longer;
        if (strlen(reason) > 400)
            break;
    }
    xfree(text);
    return reason;
}

static char *first_line(const char *path)
{
    char *const text = file_text(path);
    text[strcspn(text, "\n")] = '\0';
    return text;
}

/* argv: {head..., scene, overrides..., tail...}, NULL at its end; xfree the array. */
static char **with_overrides(const char *const *head, const char *scene, char *const *overrides,
                             int n, const char *const *tail)
{
    char **const argv = xalloc((size_t)n + 16, sizeof *argv);
    int k = 0;
    for (; *head; head++)
        argv[k++] = (char *)(uintptr_t)*head;
    argv[k++] = (char *)(uintptr_t)scene;
    for (int i = 0; i < n; i++)
        argv[k++] = overrides[i];
    for (; *tail; tail++)
        argv[k++] = (char *)(uintptr_t)*tail;
    return argv;
}

static const char *const none[] = {NULL};

const struct built *study_built(struct study *s, char *const *overrides, int n,
                                const char *real, enum ending *ending, char **why)
{
    char *const front = xprintf("%s/front", s->tools);
    char *const out = study_path(s, "build.txt"), *const err = study_path(s, "build-err.txt");
    const char *const ask[] = {front, "slots", NULL}, *const make[] = {"./run.sh", "build",
                                                                       NULL};
    char **argv = with_overrides(ask, s->scene, overrides, n, none);
    struct process p = process_run(argv, out, err, 0.0, GRACE);
    struct built *found = NULL;
    xfree(argv);
    *why = NULL;
    if (p.code == 0) {
        char *const line = first_line(out), *const slots = xprintf("%s REAL=%s", line, real);
        for (found = s->built; found && strcmp(found->slots, slots) != 0;)
            found = found->next;
        if (!found) {
            setenv("REAL", real, 1);
            argv = with_overrides(make, s->scene, overrides, n, none);
            p = process_run(argv, out, err, 0.0, GRACE);
            xfree(argv);
            if (p.code == 0) {
                found = xalloc(1, sizeof *found);
                *found = (struct built){s->built, xstrdup(slots), first_line(out), 0};
                found->hash = hash_file(HASH_START, found->binary);
                s->built = found;
            } else {
                *ending = RUN_BROKEN;
            }
        }
        xfree(line);
        xfree(slots);
    } else {
        *ending = p.code == EXIT_SCENE ? RUN_REFUSED : RUN_BROKEN;
    }
    if (!found)
        *why = reason_of(err);
    void *const all[] = {front, out, err};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    return found;
}

const char *built_binary(const struct built *b)
{
    return b->binary;
}

uint64_t built_hash(const struct built *b)
{
    return b->hash;
}

void built_free(struct built *b)
{
    while (b) {
        struct built *const next = b->next;
        xfree(b->slots);
        xfree(b->binary);
        xfree(b);
        b = next;
    }
}

/* "Courant   0.0005 s   0.01833 s   0.0273  note": false where there is no such limit. */
static bool read_limit(const char *line, struct limit *l)
{
    enum { NAME = 40 };
    if (strlen(line) <= NAME)
        return false;
    for (const char *at = line + NAME; *at; at++) {
        char unit[2][32];
        double used, limit, ratio;
        if (at[-1] == ' ' &&
            sscanf(at, "%lf %31s %lf %31s %lf", &used, unit[0], &limit, unit[1], &ratio) == 5 &&
            strcmp(unit[0], unit[1]) == 0 &&
            (strcmp(unit[0], "s") == 0 || strncmp(line, "lightness", 9) == 0 ||
             strncmp(line, "overlap", 7) == 0)) {
            int n = (int)(at - line);
            while (n > 0 && line[n - 1] == ' ')
                n--;
            *l = (struct limit){
                .used = used, .limit = limit, .binding = !strstr(at, "accuracy only")};
            snprintf(l->name, sizeof l->name, "%.*s", n, line);
            return true;
        }
    }
    return false;
}

int limits_read(const struct study *s, const char *binary, char *const *overrides, int n,
                struct limit out[MOST_LIMITS])
{
    char *const path = study_path(s, "check.txt"), *const err = study_path(s, "check-err.txt");
    const char *const head[] = {binary, NULL}, *const tail[] = {"run.force=on", "--check",
                                                                NULL};
    char **const argv = with_overrides(head, s->scene, overrides, n, tail);
    const struct process p =
        process_run(argv, path, err, s->timeout > 0.0 ? s->timeout : 600.0, GRACE);
    int limits = p.code == 0 ? 0 : -1;
    char *const text = file_text(path), *rest = NULL;
    for (char *l = strtok_r(text, "\n", &rest); l && p.code == 0;
         l = strtok_r(NULL, "\n", &rest))
        if (limits < MOST_LIMITS && read_limit(l, &out[limits]))
            limits++;
    void *const all[] = {argv, text, path, err};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    return limits;
}
