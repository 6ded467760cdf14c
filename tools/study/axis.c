/* axis.c - "drag=ergun,di_felice", "run.dt=1:100:5 us", "grain@grains.sets=all": the values along an
 * axis. */
#include <stdlib.h>
#include <string.h>
#include "study.h"

enum { MOST_VALUES = 10000 };
#define LOG_FROM 5.0 /* ratio of the ends above which a range is logarithmic */

static const char *const slots[] = {"shape",     "contact",     "rolling",  "bond",
                                    "cohesion",  "drag",        "porosity", "fluid",
                                    "reference", "lubrication", "forces"};

int axis_add(struct axis *a, const char *value, double number)
{
    a->value = xrealloc(a->value, (size_t)a->n, (size_t)a->n + 1, sizeof *a->value);
    a->number = xrealloc(a->number, (size_t)a->n, (size_t)a->n + 1, sizeof *a->number);
    a->value[a->n] = xstrdup(value);
    a->number[a->n] = number;
    return a->n++;
}

void axis_free(struct axis *a)
{
    for (int i = 0; i < a->n; i++)
        xfree(a->value[i]);
    xfree(a->value);
    xfree(a->number);
    xfree(a->name);
    xfree(a->key);
}

/* What the name stands for; false if nothing. */
static bool find_key(struct axis *a)
{
    char *const at = strchr(a->name, '@');
    a->kind = AXIS_KEY;
    if (at && at > a->name) {
        a->kind = AXIS_SETS;
        a->key = xstrdup(at + 1);
        *at = '\0';
        return true;
    }
    if (strchr(a->name, '.')) {
        a->key = xstrdup(a->name);
        return true;
    }
    for (size_t i = 0; i < sizeof slots / sizeof slots[0]; i++)
        if (strcmp(slots[i], a->name) == 0) {
            a->key = xprintf("modules.%s", a->name);
            return true;
        }
    a->key = xstrdup(a->name);
    if (strcmp(a->name, "real") == 0 || strcmp(a->name, "REAL") == 0)
        a->kind = AXIS_REAL;
    else if (strcmp(a->name, "threads") == 0)
        a->kind = AXIS_THREADS;
    else if (named_is(a->name))
        a->kind = AXIS_NAMED;
    else
        return false;
    return true;
}

static char *trimmed(const char *from, const char *to)
{
    while (from < to && *from == ' ')
        from++;
    while (to > from && to[-1] == ' ')
        to--;
    return xprintf("%.*s", (int)(to - from), from);
}

/* " mm" behind the last number of a list, if the others have none. */
static const char *common_unit(const char *text)
{
    const char *last = strrchr(text, ',');
    const char *const colon = strrchr(text, ':');
    last = last ? last : colon;
    if (!last)
        return "";
    char *end;
    last++;
    strtod(last, &end);
    if (end == last || *end != ' ')
        return "";
    while (*end == ' ')
        end++;
    /* "8 8 16" has numbers, not a unit; and where an earlier value has letters, each has its own */
    if (strchr("0123456789.-+", *end))
        return "";
    for (const char *c = text; c < last; c++)
        if ((*c >= 'a' && *c <= 'z' && *c != 'e' && *c != 'l' && *c != 'i' && *c != 'n') ||
            *c == '%')
            return "";
    return end;
}

static void add_value(struct axis *a, const char *value, const char *unit)
{
    char *end;
    const double number = strtod(value, &end);
    const bool is_number = end != value && (*end == '\0' || *end == ' ' || *end == '%');
    char *const whole =
        is_number && *unit && *end == '\0' ? xprintf("%s %s", value, unit) : xstrdup(value);
    axis_add(a, whole, is_number ? number : (double)NAN);
    a->words = a->words || !is_number;
    xfree(whole);
}

/* Percent signs stay with their number; "a:b:n" with an optional ":lin" or ":log". */
static char *add_range(struct axis *a, const char *text, const char *unit)
{
    char *end;
    const double from = strtod(text, &end);
    if (end == text || *end != ':')
        return xprintf("%s: a range is from:to:count", text);
    const char *next = end + 1;
    const double to = strtod(next, &end);
    if (end == next || *end != ':')
        return xprintf("%s: a range is from:to:count", text);
    next = end + 1;
    const long n = strtol(next, &end, 10);
    const bool lin = strncmp(end, ":lin", 4) == 0, log = strncmp(end, ":log", 4) == 0;
    if (end == next || n < 1 || n > MOST_VALUES || (*end == ':' && !lin && !log))
        return xprintf("%s: a range is from:to:count, or from:to:count:lin", text);
    if (log && !(from > 0.0 && to > 0.0))
        return xprintf("%s: a logarithmic range is of positive numbers", text);
    a->log = log || (!lin && from > 0.0 && to > 0.0 && fmax(to / from, from / to) > LOG_FROM);
    for (long i = 0; i < n; i++) {
        const double part = n > 1 ? (double)i / (double)(n - 1) : 0.0;
        const double x = a->log ? from * pow(to / from, part) : from + part * (to - from);
        char *const number = number_text(x);
        add_value(a, number, unit);
        xfree(number);
    }
    return NULL;
}

static void add_list(struct axis *a, const char *text, const char *unit)
{
    while (true) {
        const size_t n = strcspn(text, ",");
        char *const value = trimmed(text, text + n);
        add_value(a, value, unit);
        xfree(value);
        if (text[n] == '\0')
            return;
        text += n + 1;
    }
}

/* Numbers in order with ratios above LOG_FROM from end to end are shown on a logarithmic scale. */
static void find_scale(struct axis *a)
{
    double least = HUGE_VAL, most = 0.0;
    for (int i = 0; i < a->n && !a->words; i++) {
        least = fmin(least, a->number[i]);
        most = fmax(most, a->number[i]);
    }
    if (!a->words && least > 0.0 && most / least > LOG_FROM)
        a->log = true;
}

static char *check_set(struct axis *a, int i)
{
    char *lines;
    char *const wrong = sets_read(a, a->value[i], &lines);
    xfree(lines);
    a->number[i] = (double)NAN; /* a name, even where it looks like a number */
    a->words = true;
    return wrong;
}

char *axis_parse(struct axis *a, const char *text)
{
    const char *const equals = strchr(text, '=');
    *a = (struct axis){0};
    if (!equals || equals == text)
        return xprintf("%s: neither a scene nor axis=values", text);
    a->name = trimmed(text, equals);
    if (!find_key(a))
        return xprintf(
            "%s: no such axis: a key (section.key), a slot, real, threads, a named axis "
            "(./run.sh axes), or name@FILE of sets of keys",
            a->name);
    const char *values = equals + 1;
    while (*values == ' ')
        values++;
    if (*values == '\0')
        return xprintf("%s: no values", a->name);
    const char *const unit = common_unit(values);
    char *wrong = NULL;
    if (a->kind == AXIS_SETS && strcmp(values, "all") == 0)
        wrong = sets_all(a);
    else if (strchr(values, ':') && strspn(values, "0123456789.+-eE") > 0 &&
             values[strspn(values, "0123456789.+-eE")] == ':')
        wrong = add_range(a, values, unit);
    else
        add_list(a, values, unit);
    for (int i = 0; !wrong && i < a->n; i++) {
        if (a->value[i][0] == '\0')
            wrong = xprintf("%s: an empty value", text);
        else if (a->kind == AXIS_SETS)
            wrong = check_set(a, i);
        else if (a->kind == AXIS_REAL && strcmp(a->value[i], "double") != 0 &&
                 strcmp(a->value[i], "float") != 0)
            wrong = xprintf("%s: real is double or float", text);
        else if (a->kind == AXIS_THREADS && !(a->number[i] >= 1.0 && a->number[i] <= 1024.0))
            wrong = xprintf("%s: threads are 1 to 1024", text);
        for (int k = 0; !wrong && k < i; k++)
            if (strcmp(a->value[i], a->value[k]) == 0)
                wrong = xprintf("%s: %s is there twice", text, a->value[i]);
    }
    find_scale(a);
    return wrong;
}
