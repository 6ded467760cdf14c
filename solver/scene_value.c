/* scene_value.c - the values of a scene: words, numbers with units, intervals. */
#include "scene_state.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include "units.h"

/* A key under the eye: where it stands, what it should be. */
struct asked {
    const struct key *key;
    char *section;             /* "grains beads" */
    const struct entry *entry; /* NULL: absent */
    const char *text;          /* as given, or the standard; NULL if neither */
};

void scene_declare(struct scene *s, const struct key *table)
{
    for (int i = 0; i < s->n_tables; i++)
        if (s->table[i] == table)
            return;
    s->table =
        xrealloc(s->table, (size_t)s->n_tables, (size_t)s->n_tables + 1, sizeof *s->table);
    s->table[s->n_tables++] = table;
}

static const struct key *find_key(const struct scene *s, const char *section, const char *name)
{
    for (int t = 0; t < s->n_tables; t++)
        for (const struct key *k = s->table[t]; k->section; k++)
            if (strcmp(k->section, section) == 0 && strcmp(k->name, name) == 0)
                return k;
    die(EXIT_SCENE, "the program reads %s.%s, which no table declares", section, name);
}

static void note_named(struct scene *s, const char *section)
{
    for (int i = 0; i < s->n_named; i++)
        if (strcmp(s->named[i], section) == 0)
            return;
    s->named = xrealloc(s->named, (size_t)s->n_named, (size_t)s->n_named + 1, sizeof *s->named);
    s->named[s->n_named++] = xstrdup(section);
}

static struct asked ask(struct scene *s, const char *section, const char *name, const char *key)
{
    struct asked a = {.key = find_key(s, section, key), .section = section_text(section, name)};
    if (name)
        note_named(s, section);
    a.entry = scene_entry(s, a.section, key);
    if (a.entry)
        for (int i = 0; i < s->n_entries; i++) /* an override reads what it hides too */
            if (strcmp(s->entry[i].section, a.section) == 0 &&
                strcmp(s->entry[i].key, key) == 0)
                s->entry[i].read = true;
    a.text = a.entry ? a.entry->value : a.key->standard;
    return a;
}

static int section_line(const struct scene *s, const char *section)
{
    for (int i = 0; i < s->n_sections; i++)
        if (strcmp(s->section[i].name, section) == 0)
            return s->section[i].line;
    return LINE_NONE;
}

static void put_error(struct scene *s, const char *section, const char *key, const char *what)
{
    const struct entry *const e = key ? scene_entry(s, section, key) : NULL;
    const int line = e ? e->line : section_line(s, section);
    char *const where = scene_where(s, line);
    char *text;
    if (e)
        text = xprintf("%s%s.%s = %s: %s", where, section, key, e->value, what);
    else if (key)
        text = xprintf("%s%s.%s: %s", where, section, key, what);
    else
        text = xprintf("%s[%s]: %s", where, section, what);
    scene_add_error(s, line, text);
    xfree(where);
}

void scene_error(struct scene *s, const char *section, const char *name, const char *key,
                 const char *format, ...)
{
    char what[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    char *const full = section_text(section, name);
    put_error(s, full, key, what);
    xfree(full);
}

static void complain(struct scene *s, const struct asked *a, const char *what)
{
    put_error(s, a->section, a->key->name, what);
}

/* The interval of `allowed`, after its words; false if it has none. */
static bool interval(const char *allowed, double *lo, double *hi, bool *open_lo, bool *open_hi,
                     const char **text)
{
    const char *const begin = strpbrk(allowed, "([");
    if (!begin)
        return false;
    char *end;
    *lo = strtod(begin + 1, &end);
    *hi = strtod(end + strspn(end, ", "), &end);
    *open_lo = *begin == '(';
    *open_hi = *end == ')';
    *text = begin;
    return true;
}

/* Whether `word` is one of the words of `allowed` ("a | b | (0, 1]"); its index. */
static bool word_of(const char *allowed, const char *word, int *index)
{
    int i = 0;
    for (const char *at = allowed; *at;) {
        at += strspn(at, " |");
        const size_t n = strcspn(at, " |");
        if (n == 0 || *at == '(' || *at == '[')
            return false;
        if (strlen(word) == n && strncmp(at, word, n) == 0) {
            *index = i;
            return true;
        }
        at += n;
        i++;
    }
    return false;
}

static void check_range(struct scene *s, const struct asked *a, double value)
{
    double lo, hi;
    bool open_lo, open_hi;
    const char *text;
    if (!interval(a->key->allowed, &lo, &hi, &open_lo, &open_hi, &text))
        return;
    if ((open_lo ? value > lo : value >= lo) && (open_hi ? value < hi : value <= hi))
        return;
    const bool pure = a->key->unit[0] == '\0' || strcmp(a->key->unit, "1") == 0;
    char *const what =
        xprintf("must lie in %s%s%s", text, pure ? "" : " ", pure ? "" : a->key->unit);
    complain(s, a, what);
    xfree(what);
}

static void complain_number(struct scene *s, const struct asked *a, int count)
{
    const char *const begin = strpbrk(a->key->allowed, "([");
    char words[64] = "";
    if (begin && begin > a->key->allowed)
        snprintf(words, sizeof words, "%.*s or ",
                 (int)(begin - a->key->allowed - 3 > 0 ? begin - a->key->allowed - 3 : 0),
                 a->key->allowed);
    const bool whole = a->key->type == KEY_INT || a->key->type == KEY_CELLS;
    const bool pure = whole || strcmp(a->key->unit, "1") == 0;
    const char *const kind = whole ? "whole number" : "number";
    char *const what = xprintf("must be %s%s %s%s%s%s", words, count == 3 ? "three" : "one",
                               kind, count == 3 ? "s" : "", pure ? "" : " with a unit, as in ",
                               pure ? "" : a->key->unit);
    complain(s, a, what);
    xfree(what);
}

/* Reads `count` numbers from the text; the rest, or NULL with an error on the list. */
static const char *numbers(struct scene *s, const struct asked *a, int count, double *out)
{
    const char *at = a->text;
    for (int i = 0; i < count; i++) {
        char *end;
        at += strspn(at, " \t");
        const bool number = *at && (isdigit((unsigned char)*at) || strchr("+-.", *at));
        errno = 0;
        out[i] = number ? strtod(at, &end) : 0.0;
        if (!number || end == at || !isfinite(out[i]) || memchr(at, 'x', (size_t)(end - at)) ||
            memchr(at, 'X', (size_t)(end - at)) ||
            (*end && !isspace((unsigned char)*end) && i + 1 < count)) {
            complain_number(s, a, count);
            return NULL;
        }
        at = end;
    }
    return at + strspn(at, " \t");
}

/* Converts to SI; false with an error on the list. */
static bool convert(struct scene *s, const struct asked *a, const char *unit, int count,
                    double *out)
{
    double factor = 1.0, offset = 0.0;
    char *what = NULL;
    if (strcmp(a->key->unit, "1") == 0) {
        if (strcmp(unit, "%") == 0)
            factor = 0.01;
        else if (unit[0] && units_convert(unit, "1", &factor, &offset) == UNIT_GOOD)
            what = xprintf("is a pure number: it takes no unit (%s)", unit);
        else if (unit[0])
            what = xprintf("\"%.40s\" follows %s; it is a pure number", unit,
                           count == 3 ? "three numbers" : "the number");
    } else if (!unit[0]) {
        what = xprintf("needs a unit, as in %s", a->key->unit);
    } else if ((isdigit((unsigned char)unit[0]) && strncmp(unit, "1/", 2) != 0) ||
               strchr("+-.,", unit[0])) { /* a number too many; but "1/m" is a unit */
        complain_number(s, a, count);
        return false;
    } else {
        const enum unit_result r = units_convert(unit, a->key->unit, &factor, &offset);
        if (r == UNIT_UNKNOWN)
            what =
                xprintf("\"%.40s\" is not a unit; it needs one as in %s", unit, a->key->unit);
        else if (r == UNIT_DIMENSION)
            what = xprintf("\"%.40s\" has the wrong dimension; it needs that of %s", unit,
                           a->key->unit);
    }
    if (what) {
        complain(s, a, what);
        xfree(what);
        return false;
    }
    for (int i = 0; i < count; i++)
        out[i] = factor * out[i] + offset;
    return true;
}

static void complain_missing(struct scene *s, const struct asked *a)
{
    const struct key *const k = a->key;
    const bool pure = k->unit[0] == '\0' || strcmp(k->unit, "1") == 0;
    char *const what =
        xprintf("must be given (%s)%s%s%s%s", k->meaning, pure ? "" : ", in units of ",
                pure ? "" : k->unit, k->allowed[0] ? ", " : "", k->allowed);
    complain(s, a, what);
    xfree(what);
}

/* The value of a key of `count` numbers; words read as zeros. */
static void read_numbers(struct scene *s, const char *section, const char *name,
                         const char *key, int count, double *out)
{
    const struct asked a = ask(s, section, name, key);
    int index;
    for (int i = 0; i < count; i++)
        out[i] = 0.0;
    if (!a.text) {
        complain_missing(s, &a);
    } else if (!word_of(a.key->allowed, a.text, &index)) {
        const bool whole = a.key->type == KEY_INT || a.key->type == KEY_CELLS;
        const char *const rest = numbers(s, &a, count, out);
        bool good = rest != NULL;
        if (good && whole) {
            for (int i = 0; i < count; i++)
                good = good && out[i] == rint(out[i]) && fabs(out[i]) <= INT_MAX;
            if (!good || rest[0]) {
                complain_number(s, &a, count);
                good = false;
            }
        } else if (good) {
            good = convert(s, &a, rest, count, out);
        }
        for (int i = 0; i < count && good; i++)
            check_range(s, &a, out[i]);
        for (int i = 0; i < count && !good; i++)
            out[i] = 0.0;
    }
    xfree(a.section);
}

double scene_real(struct scene *s, const char *section, const char *name, const char *key)
{
    double x;
    read_numbers(s, section, name, key, 1, &x);
    return x;
}

vec3 scene_vector(struct scene *s, const char *section, const char *name, const char *key)
{
    double x[3];
    read_numbers(s, section, name, key, 3, x);
    return v3(x[0], x[1], x[2]);
}

int scene_int(struct scene *s, const char *section, const char *name, const char *key)
{
    double x;
    read_numbers(s, section, name, key, 1, &x);
    return (int)x;
}

void scene_cells(struct scene *s, const char *section, const char *name, const char *key,
                 int out[3])
{
    double x[3];
    read_numbers(s, section, name, key, 3, x);
    for (int i = 0; i < 3; i++)
        out[i] = (int)x[i];
}

int scene_choice(struct scene *s, const char *section, const char *name, const char *key)
{
    const struct asked a = ask(s, section, name, key);
    int index = 0;
    if (!a.text) {
        complain_missing(s, &a);
    } else if (!word_of(a.key->allowed, a.text, &index)) {
        char hint[128];
        struct nearest n = nearest_start(a.text);
        char *const words = xstrdup(a.key->allowed);
        for (char *w = strtok(words, " |"); w; w = strtok(NULL, " |"))
            nearest_offer(&n, w);
        char *const what =
            xprintf("must be one of %s%s", a.key->allowed, nearest_hint(&n, hint, sizeof hint));
        complain(s, &a, what);
        xfree(what);
        xfree(words);
    }
    xfree(a.section);
    return index;
}

const char *scene_text(struct scene *s, const char *section, const char *name, const char *key)
{
    const struct asked a = ask(s, section, name, key);
    if (!a.text)
        complain_missing(s, &a);
    xfree(a.section);
    return a.text ? a.text : "";
}

bool scene_given(struct scene *s, const char *section, const char *name, const char *key)
{
    const struct asked a = ask(s, section, name, key);
    xfree(a.section);
    return a.entry != NULL;
}

bool scene_word(struct scene *s, const char *section, const char *name, const char *key,
                const char *word)
{
    const struct asked a = ask(s, section, name, key);
    xfree(a.section);
    return a.text && strcmp(a.text, word) == 0;
}
