/* force_names.c - the names of the answers of forces/ in one canonical text. */
#include "force_names.h"

#include <stdlib.h>
#include <string.h>
#include "base.h"

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

char *force_names(const char *text)
{
    char *const copy = xstrdup(text), *rest = NULL, *out = xstrdup("");
    char **const name = xalloc(strlen(text) + 1, sizeof *name);
    int n = 0;
    for (char *word = strtok_r(copy, " ,+\t", &rest); word;
         word = strtok_r(NULL, " ,+\t", &rest))
        if (strcmp(word, "none") != 0)
            name[n++] = word;
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
    xfree(copy);
    return out;
}
