/* course.c - reads and evaluates values in time. */
#include "course.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MOST = 256 };

double course_at(const struct course *c, double t)
{
    const double part = c->ramp > 0.0 ? fmin(1.0, fmax(0.0, t / c->ramp)) : 1.0;
    if (c->n == 0)
        return part * c->value;
    if (t <= c->time[0])
        return part * c->level[0];
    int lo = 0, hi = c->n - 1;
    if (t >= c->time[hi])
        return part * c->level[hi];
    while (hi - lo > 1) {
        const int middle = (lo + hi) / 2;
        *(t < c->time[middle] ? &hi : &lo) = middle;
    }
    const double x = (t - c->time[lo]) / (c->time[hi] - c->time[lo]);
    return part * (c->level[lo] + x * (c->level[hi] - c->level[lo]));
}

double course_most(const struct course *c)
{
    double most = c->n == 0 ? fabs(c->value) : 0.0;
    for (int i = 0; i < c->n; i++)
        most = fmax(most, fabs(c->level[i]));
    return most;
}

static FILE *open_beside(const char *path, const char *scene)
{
    const char *const slash = scene ? strrchr(scene, '/') : NULL;
    char *const beside = slash && path[0] != '/'
                             ? xprintf("%.*s/%s", (int)(slash - scene), scene, path)
                             : xstrdup(path);
    FILE *file = fopen(beside, "r");
    xfree(beside);
    return file ? file : fopen(path, "r");
}

/* "0.5, 1e-3" -> two numbers; false where there are not exactly two. */
static bool two_numbers(const char *line, double out[2])
{
    char *end;
    out[0] = strtod(line, &end);
    if (end == line)
        return false;
    line = end + strspn(end, " \t,;");
    out[1] = strtod(line, &end);
    return end != line && end[strspn(end, " \t\r\n")] == '\0' && isfinite(out[0]) &&
           isfinite(out[1]);
}

/* Why the table cannot be read, or NULL; xfree it. */
static char *read_lines(struct course *c, FILE *file)
{
    char line[LINE_MOST];
    for (int number = 1; fgets(line, sizeof line, file); number++) {
        const char *const text = line + strspn(line, " \t\r\n");
        double at[2];
        if (*text == '\0' || *text == '#')
            continue;
        if (!two_numbers(text, at)) {
            if (c->n == 0 && strchr("+-.0123456789", *text) == NULL)
                continue; /* names of the columns */
            return xprintf("line %d must be two numbers, time in s and value in its SI unit",
                           number);
        }
        if (c->n > 0 && !(at[0] > c->time[c->n - 1]))
            return xprintf("line %d: times must grow", number);
        c->time = xrealloc(c->time, (size_t)c->n, (size_t)c->n + 1, sizeof *c->time);
        c->level = xrealloc(c->level, (size_t)c->n, (size_t)c->n + 1, sizeof *c->level);
        c->time[c->n] = at[0];
        c->level[c->n++] = at[1];
    }
    return c->n == 0 ? xstrdup("holds no line of two numbers") : NULL;
}

void course_read_table(struct course *c, struct scene *s, const char *section, const char *name,
                       const char *key)
{
    const char *const path = scene_text(s, section, name, key);
    if (path[0] == '\0')
        return;
    FILE *const file = open_beside(path, scene_path(s));
    if (!file) {
        scene_error(s, section, name, key, "no such file, neither beside the scene nor here");
        return;
    }
    char *const why = read_lines(c, file);
    fclose(file);
    if (why)
        scene_error(s, section, name, key, "%s", why);
    xfree(why);
}

void course_free(struct course *c)
{
    xfree(c->time);
    xfree(c->level);
    *c = (struct course){0};
}
