/* sets.c - an axis whose values are sets of keys: "grain@scenes/studies/grains.sets=sphere,clump".
 *
 * The file holds a [value] for each, and under it the keys that it stands for, as on the command
 * line: section.key = value. So one axis can take a scene through answers that need keys of their
 * own. */
#include <ini.h>
#include <string.h>
#include "study.h"

struct reading {
    const char *wanted; /* NULL: only the names */
    char **name;
    int n;
    char *lines;
    char *wrong;
};

/* inih: 1 where all is well */
static int on_line(void *user, const char *section, const char *key, const char *value)
{
    struct reading *const r = user;
    if (section[0] == '\0' || !strchr(key, '.')) {
        xfree(r->wrong);
        r->wrong =
            xprintf("%s = %s: it takes [value], and under it section.key = value", key, value);
        return 0;
    }
    if (r->n == 0 || strcmp(r->name[r->n - 1], section) != 0) {
        r->name = xrealloc(r->name, (size_t)r->n, (size_t)r->n + 1, sizeof *r->name);
        r->name[r->n++] = xstrdup(section);
    }
    if (r->wanted && strcmp(r->wanted, section) == 0) {
        char *const longer =
            xprintf("%s%s%s=%s", r->lines ? r->lines : "", r->lines ? "\n" : "", key, value);
        xfree(r->lines);
        r->lines = longer;
    }
    return 1;
}

static void reading_free(struct reading *r)
{
    for (int i = 0; i < r->n; i++)
        xfree(r->name[i]);
    xfree(r->name);
    xfree(r->lines);
    xfree(r->wrong);
}

/* NULL, or what is wrong with the file. */
static char *read_sets(const char *path, struct reading *r)
{
    const int at = ini_parse(path, on_line, r);
    if (at < 0)
        return xprintf("%s: no such file of sets", path);
    if (at > 0)
        return xprintf("%s:%d: %s", path, at,
                       r->wrong ? r->wrong : "neither [value] nor section.key = value");
    if (r->n == 0)
        return xprintf("%s: it holds no [value]", path);
    return NULL;
}

char *sets_all(struct axis *a)
{
    struct reading r = {0};
    char *const wrong = read_sets(a->key, &r);
    for (int i = 0; !wrong && i < r.n; i++)
        axis_add(a, r.name[i], (double)NAN);
    a->words = true;
    reading_free(&r);
    return wrong;
}

char *sets_read(const struct axis *a, const char *value, char **lines)
{
    struct reading r = {.wanted = value};
    char *wrong = read_sets(a->key, &r);
    if (!wrong && !r.lines)
        wrong = xprintf("%s: there is no [%s]", a->key, value);
    *lines = wrong ? NULL : xstrdup(r.lines);
    reading_free(&r);
    return wrong;
}
