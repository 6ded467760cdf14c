/* ball_sets.c - unions of balls by name, from a list, or from a file. */
#include "ball_sets.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "base.h"

enum { BALLS_MOST = 2000, NAMED_MOST = 9 };

static const struct named {
    const char *name;
    int n;
    struct ball ball[NAMED_MOST];
} named[] = {
    {"pair", 2, {{{-0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}}},
    {"rod", 3, {{{-1, 0, 0}, 1}, {{0, 0, 0}, 1}, {{1, 0, 0}, 1}}},
    {"triangle",
     3,
     {{{0, 0.8, 0}, 1},
      {{-0.69282032302755092, -0.4, 0}, 1},
      {{0.69282032302755092, -0.4, 0}, 1}}},
    {"tetrahedron",
     4,
     {{{0.5, 0.5, 0.5}, 1},
      {{0.5, -0.5, -0.5}, 1},
      {{-0.5, 0.5, -0.5}, 1},
      {{-0.5, -0.5, 0.5}, 1}}},
    {"cross",
     7,
     {{{0, 0, 0}, 1},
      {{1.2, 0, 0}, 1},
      {{-1.2, 0, 0}, 1},
      {{0, 1.2, 0}, 1},
      {{0, -1.2, 0}, 1},
      {{0, 0, 1.2}, 1},
      {{0, 0, -1.2}, 1}}},
    {"cube",
     8,
     {{{-0.4, -0.4, -0.4}, 0.6},
      {{0.4, -0.4, -0.4}, 0.6},
      {{-0.4, 0.4, -0.4}, 0.6},
      {{0.4, 0.4, -0.4}, 0.6},
      {{-0.4, -0.4, 0.4}, 0.6},
      {{0.4, -0.4, 0.4}, 0.6},
      {{-0.4, 0.4, 0.4}, 0.6},
      {{0.4, 0.4, 0.4}, 0.6}}},
    {"tetrapod",
     9,
     {{{0, 0, 0}, 1},
      {{0.7, 0.7, 0.7}, 0.8},
      {{0.7, -0.7, -0.7}, 0.8},
      {{-0.7, 0.7, -0.7}, 0.8},
      {{-0.7, -0.7, 0.7}, 0.8},
      {{1.3, 1.3, 1.3}, 0.6},
      {{1.3, -1.3, -1.3}, 0.6},
      {{-1.3, 1.3, -1.3}, 0.6},
      {{-1.3, -1.3, 1.3}, 0.6}}},
};

const char *const ball_set_names =
    "pair | rod | triangle | tetrahedron | cross | cube | tetrapod";

/* One ball from text; returns what follows, or NULL. */
static const char *read_ball(const char *text, struct ball *b)
{
    int used = 0;
    if (sscanf(text, " %lf %lf %lf %lf %n", &b->centre.x, &b->centre.y, &b->centre.z, &b->r,
               &used) != 4 ||
        !isfinite(b->centre.x + b->centre.y + b->centre.z) || !isfinite(b->r) || !(b->r > 0.0))
        return NULL;
    return text + used;
}

struct ball *ball_set_listed(const char *list, int *n, char **why)
{
    struct ball *const b = xalloc(BALLS_MOST, sizeof *b);
    *n = 0;
    for (const char *at = list; at && *at && *n < BALLS_MOST;) {
        at = read_ball(at, &b[*n]);
        if (!at || (*at != ',' && *at != '\0')) {
            *why = xprintf("ball %d is not x y z r with r > 0; balls are parted by commas",
                           *n + 1);
            xfree(b);
            return NULL;
        }
        (*n)++;
        at += *at == ',';
    }
    return b;
}

static struct ball *read_file(const char *path, int *n, char **why)
{
    FILE *const file = fopen(path, "r");
    char line[512];
    if (!file) {
        *why = xprintf("%s: %s; or one of %s", path, strerror(errno), ball_set_names);
        return NULL;
    }
    struct ball *const b = xalloc(BALLS_MOST, sizeof *b);
    *n = 0;
    for (int number = 1; fgets(line, sizeof line, file) && !*why; number++) {
        line[strcspn(line, "#\r\n")] = '\0';
        if (line[strspn(line, " \t")] == '\0')
            continue;
        const char *const rest = read_ball(line, &b[*n]);
        if (!rest || *rest != '\0')
            *why = xprintf("%s:%d: not x y z r with r > 0", path, number);
        else if (++*n == BALLS_MOST)
            *why = xprintf("%s: more than %d balls", path, BALLS_MOST - 1);
    }
    fclose(file);
    if (!*why && *n == 0)
        *why = xprintf("%s: no ball in it", path);
    if (!*why)
        return b;
    xfree(b);
    return NULL;
}

struct ball *ball_set_named(const char *name, const char *path, int *n, char **why)
{
    for (size_t k = 0; k < sizeof named / sizeof named[0]; k++) {
        if (strcmp(name, named[k].name) != 0)
            continue;
        struct ball *const b = xalloc((size_t)named[k].n, sizeof *b);
        memcpy(b, named[k].ball, (size_t)named[k].n * sizeof *b);
        *n = named[k].n;
        return b;
    }
    return read_file(path, n, why);
}

bool ball_set_whole(const struct ball *b, int n)
{
    bool *const found = xalloc((size_t)n + 1, sizeof *found);
    int count = n > 0;
    found[0] = true;
    for (bool more = true; more;) {
        more = false;
        for (int i = 0; i < n; i++)
            for (int k = 0; k < n && found[i]; k++)
                if (!found[k] && v3_norm(v3_sub(b[i].centre, b[k].centre)) < b[i].r + b[k].r) {
                    found[k] = more = true;
                    count++;
                }
    }
    xfree(found);
    return count == n;
}
