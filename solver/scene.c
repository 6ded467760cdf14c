/* scene.c - reads a scene: inih splits the lines, this file watches what it is given. */
#include "scene_state.h"

#include <ctype.h>
#include <errno.h>
#include <ini.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { LONGEST = 180, LONGEST_NAME = 48 }; /* what inih holds: 200 and 50 */

/* What the reader of lines and the handler of keys share. */
struct reading {
    struct scene *scene;
    FILE *file;
    int line;
    bool stop;
};

char *section_text(const char *section, const char *name)
{
    return name ? xprintf("%s %s", section, name) : xstrdup(section);
}

char *scene_where(const struct scene *s, int line)
{
    if (line == LINE_OVERRIDE || !s->path)
        return xstrdup("command line: ");
    return line > 0 ? xprintf("%s:%d: ", s->path, line) : xprintf("%s: ", s->path);
}

void scene_add_error(struct scene *s, int line, char *text)
{
    for (int i = 0; i < s->n_errors; i++)
        if (strcmp(s->error[i].text, text) == 0) {
            xfree(text);
            return;
        }
    s->error =
        xrealloc(s->error, (size_t)s->n_errors, (size_t)s->n_errors + 1, sizeof *s->error);
    s->error[s->n_errors] = (struct problem){.line = line, .order = s->n_errors, .text = text};
    s->n_errors++;
}

/* An error of a line as a whole. */
static void line_error(struct scene *s, int line, const char *what)
{
    char *const where = scene_where(s, line);
    scene_add_error(s, line, xprintf("%s%s", where, what));
    xfree(where);
}

const struct entry *scene_entry(const struct scene *s, const char *section, const char *key)
{
    const struct entry *found = NULL;
    for (int i = 0; i < s->n_entries; i++) /* overrides come last, the last of them wins */
        if (strcmp(s->entry[i].section, section) == 0 && strcmp(s->entry[i].key, key) == 0)
            if (!found || s->entry[i].line == LINE_OVERRIDE)
                found = &s->entry[i];
    return found;
}

static void add_entry(struct scene *s, const char *section, const char *key, const char *value,
                      int line)
{
    s->entry =
        xrealloc(s->entry, (size_t)s->n_entries, (size_t)s->n_entries + 1, sizeof *s->entry);
    s->entry[s->n_entries++] = (struct entry){.section = xstrdup(section),
                                              .key = xstrdup(key),
                                              .value = xstrdup(value),
                                              .line = line};
}

static int on_key(void *user, const char *section, const char *name, const char *value)
{
    struct reading *const r = user;
    struct scene *const s = r->scene;
    if (section[0] == '\0') {
        char *const text = xprintf("%s = %s: stands before the first [section]", name, value);
        line_error(s, r->line, text);
        xfree(text);
        return 1;
    }
    const struct entry *const old = scene_entry(s, section, name);
    if (old) {
        char *const text = xprintf("%s.%s = %s: given twice, first in line %d", section, name,
                                   value, old->line);
        line_error(s, r->line, text);
        xfree(text);
        return 1;
    }
    add_entry(s, section, name, value, r->line);
    return 1;
}

/* "[ grains   beads ]" to "[grains beads]" in place; NULL, or what is wrong. */
static const char *tidy_header(char *line)
{
    char *const end = strchr(line, ']');
    if (!end)
        return "a [section] without its closing bracket";
    const char *const rest = end + 1 + strspn(end + 1, " \t");
    if (*rest != '\0' && *rest != ';' && *rest != '#')
        return "something follows the [section]";
    char *to = line + 1;
    for (const char *from = line + 1; from < end; from++) {
        const bool space = isspace((unsigned char)*from);
        if (!space)
            *to++ = *from;
        else if (to > line + 1 && to[-1] != ' ')
            *to++ = ' ';
    }
    if (to > line + 1 && to[-1] == ' ')
        to--;
    if (to == line + 1)
        return "a [section] without a name";
    to[0] = ']';
    to[1] = '\0';
    return to - line > LONGEST_NAME ? "the name of the section is too long" : NULL;
}

static void note_section(struct scene *s, const char *header, int line)
{
    char *const name = xprintf("%.*s", (int)strlen(header) - 2, header + 1);
    for (int i = 0; i < s->n_sections; i++)
        if (strcmp(s->section[i].name, name) == 0) {
            char *const text =
                xprintf("[%s]: given twice, first in line %d", name, s->section[i].line);
            line_error(s, line, text);
            xfree(text);
            xfree(name);
            return;
        }
    s->section = xrealloc(s->section, (size_t)s->n_sections, (size_t)s->n_sections + 1,
                          sizeof *s->section);
    s->section[s->n_sections++] = (struct section){.name = name, .line = line};
}

static bool is_text(const char *line, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)line[i];
        if ((c < 32 && c != '\t') || c == 127)
            return false;
    }
    return true;
}

/* Cuts a comment off, which may be longer than what inih holds: a whole line, or ; after a
 * space. */
static void cut_comment(char *line)
{
    if (line[0] == ';' || line[0] == '#')
        line[0] = '\0';
    for (char *c = line; *c; c++)
        if (*c == ';' && isspace((unsigned char)c[-1])) {
            *c = '\0';
            return;
        }
}

static void cut_space(char *text)
{
    size_t n = strlen(text);
    while (n > 0 && isspace((unsigned char)text[n - 1]))
        n--;
    text[n] = '\0';
}

/* Looks a line over before inih sees it; an empty line stands for a bad one. */
static void check_line(struct reading *r, char *line)
{
    struct scene *const s = r->scene;
    const char *wrong = NULL;
    if (line[0] == '\0')
        return;
    if (strlen(line) > LONGEST) {
        wrong = "the line is longer than 180 letters";
    } else if (line[0] == '[') {
        wrong = tidy_header(line);
        if (!wrong)
            note_section(s, line, r->line);
    } else {
        const char *const equals = strchr(line, '=');
        if (!equals)
            wrong = "neither a [section], nor key = value, nor a ; comment";
        else if (equals == line)
            wrong = "a value without a key";
        else if (equals - line > LONGEST_NAME)
            wrong = "the key is too long";
    }
    if (!wrong)
        return;
    char *const text = xprintf("\"%.60s\": %s", line, wrong);
    line_error(s, r->line, text);
    xfree(text);
    line[0] = '\0';
}

/* fgets for inih: one line, without the space before it (which would continue the line above).
 */
static char *next_line(char *out, int size, void *stream)
{
    struct reading *const r = stream;
    char *line = NULL;
    size_t room = 0;
    if (r->stop)
        return NULL;
    ssize_t length = getline(&line, &room, r->file);
    if (length < 0) {
        free(line);
        return NULL;
    }
    r->line++;
    if (length > 0 && line[length - 1] == '\n')
        line[--length] = '\0';
    if (length > 0 && line[length - 1] == '\r')
        line[--length] = '\0';
    if (!is_text(line, (size_t)length)) {
        line_error(r->scene, r->line, "the file is not text (it holds control bytes)");
        r->stop = true;
        free(line);
        return NULL;
    }
    char *from = line + strspn(line, " \t");
    if (r->line == 1 && strncmp(from, "\xEF\xBB\xBF", 3) == 0)
        from += 3; /* the mark that some editors put before UTF-8 */
    cut_comment(from);
    cut_space(from);
    check_line(r, from);
    snprintf(out, (size_t)size, "%s\n", from);
    free(line);
    return out;
}

static void read_file(struct scene *s)
{
    struct stat info;
    struct reading r = {.scene = s, .file = fopen(s->path, "r")};
    if (!r.file)
        die(EXIT_SCENE, "%s: %s", s->path, strerror(errno));
    if (stat(s->path, &info) != 0 || S_ISDIR(info.st_mode))
        die(EXIT_SCENE, "%s: is a directory, not a scene", s->path);
    if (ini_parse_stream(next_line, &r, on_key, &r) < 0)
        die(EXIT_SCENE, "%s: cannot be parsed: out of memory", s->path);
    fclose(r.file);
    if (s->n_errors == 0 && s->n_sections == 0) {
        line_error(s, LINE_NONE, "the file holds no [section]");
        r.stop = true;
    }
    if (r.stop) /* not a scene at all: what it lacks is beside the point */
        scene_refuse(s);
}

static void read_override(struct scene *s, const char *text)
{
    const char *const equals = strchr(text, '=');
    const char *dot = NULL;
    for (const char *c = text; equals && c < equals; c++)
        if (*c == '.')
            dot = c;
    if (!equals || !dot || dot == text || dot + 1 == equals) {
        char *const what = xprintf("%s: must read section.key=value", text);
        line_error(s, LINE_OVERRIDE, what);
        xfree(what);
        return;
    }
    char *const section = xprintf("%.*s", (int)(dot - text), text);
    char *const key = xprintf("%.*s", (int)(equals - dot - 1), dot + 1);
    char *const value = xstrdup(equals + 1 + strspn(equals + 1, " \t"));
    cut_space(key);
    cut_space(value);
    add_entry(s, section, key, value, LINE_OVERRIDE);
    xfree(section);
    xfree(key);
    xfree(value);
}

struct scene *scene_load(const char *path, int n_overrides, char **overrides)
{
    struct scene *const s = xalloc(1, sizeof *s);
    if (path) {
        s->path = xstrdup(path);
        read_file(s);
    }
    for (int i = 0; i < n_overrides; i++)
        read_override(s, overrides[i]);
    return s;
}

void scene_free(struct scene *s)
{
    for (int i = 0; i < s->n_entries; i++) {
        xfree(s->entry[i].section);
        xfree(s->entry[i].key);
        xfree(s->entry[i].value);
    }
    for (int i = 0; i < s->n_sections; i++)
        xfree(s->section[i].name);
    for (int i = 0; i < s->n_errors; i++)
        xfree(s->error[i].text);
    for (int i = 0; i < s->n_named; i++)
        xfree(s->named[i]);
    for (int i = 0; i < s->n_name_lists; i++)
        xfree(s->name_lists[i]);
    void *const all[] = {s->path,  s->entry, s->section,   s->error,
                         s->table, s->named, s->name_lists};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    xfree(s);
}

const char *scene_path(const struct scene *s)
{
    return s->path ? s->path : "";
}
