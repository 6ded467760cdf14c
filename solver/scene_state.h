/* scene_state.h - the inside of struct scene, shared by the files scene*.c only. */
#ifndef SCENE_STATE_H
#define SCENE_STATE_H

#include "scene.h"

enum { LINE_OVERRIDE = -1, LINE_NONE = 0 };

struct entry {     /* a key as given */
    char *section; /* "grains beads" */
    char *key, *value;
    int line; /* or LINE_OVERRIDE */
    bool read;
};

struct section { /* a header in the file */
    char *name;
    int line;
};

struct scene {
    char *path;
    int n_entries, n_sections, n_errors, n_tables, n_named;
    struct entry *entry;
    struct section *section;
    struct problem {
        int line, order;
        char *text;
    } * error;
    const struct key **table;
    char **named; /* first words of named sections */
    const char ***name_lists;
    int n_name_lists;
};

/* "grains beads", or "fluid" where name is NULL; xfree it. */
char *section_text(const char *section, const char *name);

void scene_add_error(struct scene *s, int line, char *text); /* takes the text */

/* Prints the list and ends the program, unless the list is empty. */
void scene_refuse(struct scene *s);

/* Line numbers and prefixes: "a.ini:12: ", "command line: ", "a.ini: ". xfree it. */
char *scene_where(const struct scene *s, int line);

const struct entry *scene_entry(const struct scene *s, const char *section, const char *key);

/* The word nearest to `word` offered so far; NULL-terminated use: nearest_offer for each
 * candidate. */
struct nearest {
    const char *word;
    int distance;
    char best[96];
};
struct nearest nearest_start(const char *word);
void nearest_offer(struct nearest *n, const char *candidate);
/* " (did you mean X?)" or "". */
const char *nearest_hint(const struct nearest *n, char *buffer, size_t size);

#endif
