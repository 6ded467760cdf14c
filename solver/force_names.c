/* force_names.c - the names of the answers of forces/ in one canonical text. */
#include "force_names.h"

#include <stdlib.h>
#include <string.h>
#include "../forces/force.h"
#include "base.h"

static const char between[] = " ,+\t";

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

bool force_names_given(const char *text, const char *name)
{
    const size_t n = strlen(name);
    for (text += strspn(text, between); *text; text += strspn(text, between)) {
        const size_t word = strcspn(text, between);
        if (word == n && strncmp(text, name, n) == 0)
            return true;
        text += word;
    }
    return false;
}

/* Is it taken away? */
static bool removed(const char *text, const char *name)
{
    char *const minus = xprintf("-%s", name);
    const bool yes = force_names_given(text, minus);
    xfree(minus);
    return yes;
}

/* The names in `out`, which points into `words`; how many. "standard" is what there is anyway. */
static int collect(char *words, const char *text, char **out)
{
    char *rest = NULL;
    int n = 0;
    for (char *word = strtok_r(words, between, &rest); word;
         word = strtok_r(NULL, between, &rest))
        if (word[0] != '-' && strcmp(word, "none") != 0 && strcmp(word, "standard") != 0 &&
            !removed(text, word))
            out[n++] = word;
    return n;
}

char *force_names(const char *text, bool fluid)
{
    const bool standard = fluid && !force_names_given(text, "none");
    char *const words = xprintf("%s %s", text, standard ? FORCES_STANDARD : "");
    char **const name = xalloc(strlen(words) + 1, sizeof *name), *out = xstrdup("");
    const int n = collect(words, text, name);
    qsort(name, (size_t)n, sizeof *name, by_name);
    for (int i = 0; i < n; i++) {
        if (i > 0 && strcmp(name[i], name[i - 1]) == 0)
            continue;
        char *const longer = xprintf("%s%s%s", out, out[0] ? "+" : "", name[i]);
        xfree(out);
        out = longer;
    }
    if (!out[0]) {
        xfree(out);
        out = xstrdup("none");
    }
    xfree(name);
    xfree(words);
    return out;
}

/* Whether the words "a | b | c" hold this one. */
static bool is_listed(const char *allowed, const char *word)
{
    const size_t n = strlen(word);
    for (const char *at = strstr(allowed, word); at; at = strstr(at + 1, word))
        if ((at == allowed || at[-1] == ' ') && (at[n] == ' ' || at[n] == '\0'))
            return true;
    return false;
}

char *force_names_wrong(const char *text, const char *allowed)
{
    char *const words = xstrdup(text), *rest = NULL, *wrong = NULL;
    for (char *word = strtok_r(words, between, &rest); word && !wrong;
         word = strtok_r(NULL, between, &rest)) {
        const char *const name = word[0] == '-' ? word + 1 : word;
        if (strcmp(word, "none") != 0 && strcmp(word, "standard") != 0 &&
            (name[0] == '\0' || strchr(name, '|') || !is_listed(allowed, name)))
            wrong = xstrdup(name);
    }
    xfree(words);
    return wrong;
}
