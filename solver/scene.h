/* scene.h - the scene: what a user asks for, read once, checked as a whole.
 *
 * A scene is an INI file. Sections are plain ("[fluid]") or named ("[grains beads]": section
 * "grains", name "beads"). A key belongs to a `struct key` table; each part of the program (and
 * each answer of a slot) declares its own table with scene_declare, and reads the values with
 * scene_real and its kin. The same table checks the value, prints the message and makes
 * `./run.sh keys`, so it cannot disagree with itself.
 *
 * Errors are collected, never fatal at once: a value that is missing or wrong reads as its
 * default (or 0, or "") and is on the list. scene_finish reports the keys and sections that no
 * table knows, with the answers that have it or the nearest known key; if anything is on the list
 * it prints all of it on stderr, one line each as
 *     scenes/a.ini:12: grains.restitution = 1.3: must lie in (0, 1]
 *     command line: fluid.densty = 1000: no such key (did you mean fluid.density?)
 *     command line: drag.mobility = on: no such key here; it belongs to drag = tang
 * and exits with EXIT_SCENE. Nothing may be written before scene_finish has returned.
 *
 * Not thread safe; used only before the run. */
#ifndef SCENE_H
#define SCENE_H

#include <stdbool.h>
#include <stdio.h>
#include "base.h"

struct scene; /* opaque */

enum key_type {
    KEY_REAL,   /* one number with its unit */
    KEY_VECTOR, /* three numbers and one unit: "20 20 60 mm" */
    KEY_INT,    /* one whole number, no unit */
    KEY_CELLS,  /* three whole numbers */
    KEY_CHOICE, /* one of the words in `allowed`: "on | off" */
    KEY_TEXT    /* free text: a file name, a species name */
};

/* One key. Tables end with a key whose `section` is NULL.
 *  section   "fluid", "material": for a named section, its first word
 *  name      "density"
 *  unit      SI unit as udunits2 reads it ("kg m-3"); "1" for a pure number (then a unit is
 *            refused, but % is taken); "" for text, choices and whole numbers
 *  allowed   numbers: an interval, "(0, 1]", "[0, inf)", "(-inf, inf)"; before it, words that
 * may stand instead of a number: "auto | (0, inf)". Choices: "a | b | c". Text: "". standard
 * the value when the key is absent, in the scene's own notation ("1 mm", "auto"); NULL: the key
 * must be given (in every instance of a named section) meaning   one sentence for `./run.sh
 * keys` */
struct key {
    const char *section, *name;
    enum key_type type;
    const char *unit, *allowed, *standard, *meaning;
};

/* What an answer says of itself: `./run.sh modules` prints it, every output stores it. */
struct about {
    const char *name;     /* the file's name without .c */
    const char *summary;  /* one line */
    const char *equation; /* as plain text */
    const char *source;   /* key in NOTATION.md, with equation number */
    const char *range;    /* where it holds */
    const char *cost;     /* why it costs over 1.5 times the cheapest of its slot; or NULL */
};

/* Reads the file (NULL: only overrides) and the overrides ("section.key=value",
 * "section name.key=value"; a later one wins over an earlier one and over the file).
 * Syntax errors are put on the list. An unreadable file is fatal (EXIT_SCENE). */
struct scene *scene_load(const char *path, int n_overrides, char **overrides);
void scene_free(struct scene *s);

void scene_declare(struct scene *s, const struct key *table);

/* Values in SI. `name` is the instance of a named section, or NULL. The key must be declared.
 */
double scene_real(struct scene *s, const char *section, const char *name, const char *key);
vec3 scene_vector(struct scene *s, const char *section, const char *name, const char *key);
int scene_int(struct scene *s, const char *section, const char *name, const char *key);
void scene_cells(struct scene *s, const char *section, const char *name, const char *key,
                 int out[3]);
/* Index of the chosen word in `allowed`, counted from 0. */
int scene_choice(struct scene *s, const char *section, const char *name, const char *key);
const char *scene_text(struct scene *s, const char *section, const char *name, const char *key);

bool scene_given(struct scene *s, const char *section, const char *name, const char *key);
/* The value is this word (for keys that take a word or a number, such as "auto"). */
bool scene_word(struct scene *s, const char *section, const char *name, const char *key,
                const char *word);

/* Instances of a named section in the order of the file; the array belongs to the scene. */
int scene_names(struct scene *s, const char *section, const char *const **names);
bool scene_has(struct scene *s, const char *section); /* any key of the section is given */

/* Puts an error on the list, at the line of the key (or of the section, if key is NULL or not
 * given, or of the file). The text says what is allowed. */
void scene_error(struct scene *s, const char *section, const char *name, const char *key,
                 const char *format, ...) __attribute__((format(printf, 5, 6)));
int scene_errors(const struct scene *s); /* how many so far */
void scene_finish(struct scene *s);
/* The same, where only one section is to be judged. */
void scene_finish_section(struct scene *s, const char *section);

const char *scene_path(const struct scene *s);
/* The scene as resolved: every declared key with the value used, one "section.key = value" a
 * line, in the order of declaration. Free with xfree. */
char *scene_resolved(struct scene *s);
/* Prints the table for `./run.sh keys`. */
void keys_print(FILE *out, const char *title, const struct key *table);

#endif
