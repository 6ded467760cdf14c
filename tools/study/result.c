/* result.c - reads a summary.txt: "key = value unit", one a line. */
#include <stdlib.h>
#include <string.h>
#include "study.h"

static void add_line(struct result *r, char *line)
{
    char *const equals = strstr(line, " = ");
    if (!equals)
        return;
    *equals = '\0';
    const char *const value = equals + 3;
    char *end;
    const double number = strtod(value, &end);
    const bool is_number = end != value && (*end == '\0' || *end == ' ');
    r->entry = xrealloc(r->entry, (size_t)r->n, (size_t)r->n + 1, sizeof *r->entry);
    r->entry[r->n++] = (struct summary_entry){
        .key = xstrdup(line),
        .number = is_number ? number : (double)NAN,
        .is_number = is_number,
        .text = xstrdup(value),
    };
}

struct result result_read(const char *path)
{
    struct result r = {0};
    char *const text = file_text(path), *rest = NULL;
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
        add_line(&r, line);
    xfree(text);
    return r;
}

const struct summary_entry *result_find(const struct result *r, const char *key)
{
    for (int i = 0; i < r->n; i++)
        if (strcmp(r->entry[i].key, key) == 0)
            return &r->entry[i];
    return NULL;
}

double result_number(const struct result *r, const char *key)
{
    const struct summary_entry *const e = result_find(r, key);
    return e ? e->number : (double)NAN;
}

void result_free(struct result *r)
{
    for (int i = 0; i < r->n; i++) {
        xfree(r->entry[i].key);
        xfree(r->entry[i].text);
    }
    xfree(r->entry);
    *r = (struct result){0};
}
