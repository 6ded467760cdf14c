/* scene_finish.c - the scene as a whole: sections, unknown keys, the list of errors, the
 * tables. */
#include "scene_state.h"

#include <stdlib.h>
#include <string.h>
#include "keys_elsewhere.h"

enum { ERRORS_SHOWN = 50 };

/* Levenshtein's distance, for words of up to 63 letters. */
static int distance(const char *a, const char *b)
{
    int row[64];
    const size_t n = strlen(b) < 63 ? strlen(b) : 63;
    for (size_t j = 0; j <= n; j++)
        row[j] = (int)j;
    for (size_t i = 0; a[i] && i < 63; i++) {
        int diagonal = row[0];
        row[0] = (int)i + 1;
        for (size_t j = 0; j < n; j++) {
            const int swap = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            int least = row[j] + 1 < diagonal + 1 ? row[j] + 1 : diagonal + 1;
            row[j + 1] = swap < least ? swap : least;
        }
    }
    return row[n];
}

struct nearest nearest_start(const char *word)
{
    const int length = (int)strlen(word);
    return (struct nearest){.word = word, .distance = 2 + length / 4};
}

void nearest_offer(struct nearest *n, const char *candidate)
{
    const int d = distance(n->word, candidate);
    if (d >= n->distance)
        return;
    n->distance = d;
    snprintf(n->best, sizeof n->best, "%s", candidate);
}

const char *nearest_hint(const struct nearest *n, char *buffer, size_t size)
{
    snprintf(buffer, size, n->best[0] ? " (did you mean %s?)" : "%s", n->best);
    return buffer;
}

/* Length of the first word of "grains beads". */
static size_t first_word(const char *section)
{
    return strcspn(section, " ");
}

static bool is_named(const struct scene *s, const char *section)
{
    for (int i = 0; i < s->n_named; i++)
        if (strncmp(s->named[i], section, first_word(section)) == 0 &&
            strlen(s->named[i]) == first_word(section))
            return true;
    return false;
}

static bool section_known(const struct scene *s, const char *section, struct nearest *n)
{
    const size_t length = first_word(section);
    for (int t = 0; t < s->n_tables; t++)
        for (const struct key *k = s->table[t]; k->section; k++) {
            if (strlen(k->section) == length && strncmp(k->section, section, length) == 0)
                return true;
            nearest_offer(n, k->section);
        }
    return false;
}

/* The answers that have the key (NULL: any key of the section), "contact = hertz, linear; rolling =
 * jiang"; empty if none has it. Free with xfree. */
static char *others_with(const char *section, const char *key)
{
    const size_t length = first_word(section);
    const struct elsewhere *last = NULL;
    char *text = xstrdup("");
    for (const struct elsewhere *e = keys_elsewhere; e->section; e++) {
        if (strlen(e->section) != length || strncmp(e->section, section, length) != 0 ||
            (key && strcmp(e->key, key) != 0))
            continue;
        const bool same_slot = last && strcmp(last->slot, e->slot) == 0;
        if (same_slot && strcmp(last->answer, e->answer) == 0)
            continue;
        char *const longer =
            same_slot ? xprintf("%s, %s", text, e->answer)
                      : xprintf("%s%s%s = %s", text, last ? "; " : "", e->slot, e->answer);
        xfree(text);
        text = longer;
        last = e;
    }
    return text;
}

static void check_section(struct scene *s, const char *section, int line)
{
    char *const where = scene_where(s, line);
    char *const word = xprintf("%.*s", (int)first_word(section), section);
    char hint[128];
    struct nearest n = nearest_start(word);
    char *text = NULL;
    char *const others = others_with(section, NULL);
    const bool known = section_known(s, section, &n);
    if (!known && others[0])
        text =
            xprintf("%s[%s]: no such section here; it belongs to %s", where, section, others);
    else if (!known)
        text = xprintf("%s[%s]: no such section%s", where, section,
                       nearest_hint(&n, hint, sizeof hint));
    else if (is_named(s, section) && !strchr(section, ' '))
        text = xprintf("%s[%s]: needs a name, as in [%s NAME]", where, section, section);
    else if (!is_named(s, section) && strchr(section, ' '))
        text =
            xprintf("%s[%s]: takes no name, or nothing in this scene uses it", where, section);
    if (text)
        scene_add_error(s, line, text);
    xfree(where);
    xfree(word);
    xfree(others);
}

/* A key that no table of its section knows. */
static void check_key(struct scene *s, const struct entry *e)
{
    const size_t length = first_word(e->section);
    struct nearest n = nearest_start(e->key);
    char hint[128];
    bool any = false;
    for (int t = 0; t < s->n_tables; t++)
        for (const struct key *k = s->table[t]; k->section; k++) {
            if (strlen(k->section) != length || strncmp(k->section, e->section, length) != 0)
                continue;
            any = true;
            if (strcmp(k->name, e->key) == 0)
                return;
            nearest_offer(&n, k->name);
        }
    char *const others = others_with(e->section, e->key);
    if (any || others[0]) { /* else the section itself is unknown, and said so */
        if (n.best[0]) {
            char full[96];
            snprintf(full, sizeof full, "%.40s.%.48s", e->section, n.best);
            snprintf(n.best, sizeof n.best, "%s", full);
        }
        char *const where = scene_where(s, e->line);
        scene_add_error(s, e->line,
                        xprintf("%s%s.%s = %s: no such key%s%s", where, e->section, e->key,
                                e->value, others[0] ? " here; it belongs to " : "",
                                others[0] ? others : nearest_hint(&n, hint, sizeof hint)));
        xfree(where);
    }
    xfree(others);
}

/* With all else sound, a key that nothing has read is a mistake too: the scene does not mean
 * it. */
static void check_unread(struct scene *s)
{
    for (int i = 0; i < s->n_entries && s->n_tables > 0; i++) {
        const struct entry *const e = &s->entry[i];
        if (e->read)
            continue;
        char *const where = scene_where(s, e->line);
        scene_add_error(s, e->line,
                        xprintf("%s%s.%s = %s: nothing in this scene uses it", where,
                                e->section, e->key, e->value));
        xfree(where);
    }
}

static int by_line(const void *a, const void *b)
{
    const struct problem *const x = a, *const y = b;
    const int lx = x->line == LINE_OVERRIDE ? 1 << 30 : x->line;
    const int ly = y->line == LINE_OVERRIDE ? 1 << 30 : y->line;
    return lx != ly ? (lx < ly ? -1 : 1) : x->order - y->order;
}

int scene_errors(const struct scene *s)
{
    return s->n_errors;
}

void scene_refuse(struct scene *s)
{
    if (s->n_errors == 0)
        return;
    qsort(s->error, (size_t)s->n_errors, sizeof *s->error, by_line);
    for (int i = 0; i < s->n_errors && i < ERRORS_SHOWN; i++)
        fprintf(stderr, "%s\n", s->error[i].text);
    if (s->n_errors > ERRORS_SHOWN)
        fprintf(stderr, "... and %d more\n", s->n_errors - ERRORS_SHOWN);
    exit(EXIT_SCENE);
}

void scene_finish(struct scene *s)
{
    for (int i = 0; i < s->n_sections; i++)
        check_section(s, s->section[i].name, s->section[i].line);
    for (int i = 0; i < s->n_entries; i++) {
        if (s->entry[i].line == LINE_OVERRIDE)
            check_section(s, s->entry[i].section, LINE_OVERRIDE);
        check_key(s, &s->entry[i]);
    }
    if (s->n_errors == 0)
        check_unread(s);
    scene_refuse(s);
}

void scene_finish_section(struct scene *s, const char *section)
{
    for (int i = 0; i < s->n_entries; i++)
        if (strcmp(s->entry[i].section, section) == 0)
            check_key(s, &s->entry[i]);
    scene_refuse(s);
}

bool scene_has(struct scene *s, const char *section)
{
    for (int i = 0; i < s->n_entries; i++)
        if (strcmp(s->entry[i].section, section) == 0)
            return true;
    return false;
}

/* Offers the name in "section NAME" to the list, once. */
static void add_name(const char **list, int *n, const char *full, const char *section)
{
    const size_t length = strlen(section);
    if (strncmp(full, section, length) != 0 || full[length] != ' ')
        return;
    for (int i = 0; i < *n; i++)
        if (strcmp(list[i], full + length + 1) == 0)
            return;
    list[(*n)++] = full + length + 1;
}

int scene_names(struct scene *s, const char *section, const char *const **names)
{
    const char **const list = xalloc((size_t)(s->n_sections + s->n_entries) + 1, sizeof *list);
    int n = 0;
    for (int i = 0; i < s->n_sections; i++)
        add_name(list, &n, s->section[i].name, section);
    for (int i = 0; i < s->n_entries; i++)
        add_name(list, &n, s->entry[i].section, section);
    s->name_lists = xrealloc(s->name_lists, (size_t)s->n_name_lists,
                             (size_t)s->n_name_lists + 1, sizeof *s->name_lists);
    s->name_lists[s->n_name_lists++] = list;
    if (!is_named(s, section)) {
        s->named =
            xrealloc(s->named, (size_t)s->n_named, (size_t)s->n_named + 1, sizeof *s->named);
        s->named[s->n_named++] = xstrdup(section);
    }
    *names = list;
    return n;
}

static void resolve(struct scene *s, const struct key *k, const char *section, char **text)
{
    const struct entry *const e = scene_entry(s, section, k->name);
    if (!e && !k->standard)
        return;
    char *const longer =
        xprintf("%s%s.%s = %s\n", *text, section, k->name, e ? e->value : k->standard);
    xfree(*text);
    *text = longer;
}

char *scene_resolved(struct scene *s)
{
    char *text = xstrdup("");
    for (int t = 0; t < s->n_tables; t++)
        for (const struct key *k = s->table[t]; k->section; k++) {
            if (!is_named(s, k->section)) {
                resolve(s, k, k->section, &text);
                continue;
            }
            const char *const *names;
            const int n = scene_names(s, k->section, &names);
            for (int i = 0; i < n; i++) {
                char *const section = section_text(k->section, names[i]);
                resolve(s, k, section, &text);
                xfree(section);
            }
        }
    return text;
}

void keys_print(FILE *out, const char *title, const struct key *table)
{
    if (!table->section)
        return;
    fprintf(out, "%s\n", title);
    for (const struct key *k = table; k->section; k++) {
        char name[80];
        snprintf(name, sizeof name, "%s.%s", k->section, k->name);
        fprintf(out, "  %-28s %-8s %-34s %-14s %s\n", name,
                k->unit[0] && strcmp(k->unit, "1") != 0 ? k->unit : "-",
                k->allowed[0] ? k->allowed : "text", k->standard ? k->standard : "(needed)",
                k->meaning);
    }
}
