/* analysis.h - what a run measures beside the state itself: each part is a file of its own, asked
 * for by keys of its own, and costs nothing where a scene does not ask for it.
 *
 * To add a part: one file with a `struct analysis_part`, and its name in the list of analysis.c. */
#ifndef ANALYSIS_H
#define ANALYSIS_H

#include "contact_view.h"
#include "scene.h"

struct sim;
struct output_file;

struct analysis_part {
    const char *name;
    const struct key *keys;
    /* Reads its keys, registers series, fields and tables. Returns its state, or NULL where the
     * scene does not ask for it. */
    void *(*create)(struct sim *s, struct scene *scene);
    void (*start)(struct sim *s, void *state);  /* t = 0, after settling; these may be NULL */
    void (*watch)(struct sim *s, void *state);  /* after every step */
    void (*sample)(struct sim *s, void *state); /* sets the values of its series */
    void (*define)(struct sim *s, void *state, struct output_file *f); /* variables of run.nc */
    void (*record)(struct sim *s, void *state, struct output_file *f); /* at an output time */
    void (*report)(struct sim *s, void *state); /* at the end: tables, summary */
    void (*free)(void *state);
};

extern const struct analysis_part *const analysis_parts[]; /* ends with NULL */
enum { ANALYSIS_PARTS = 16 };                              /* at most */

struct analysis {
    void *state[ANALYSIS_PARTS];
    struct contact_view view;
};

void analysis_create(struct sim *s, struct scene *scene);
void analysis_start(struct sim *s);
void analysis_watch(struct sim *s);
void analysis_sample(struct sim *s);
void analysis_define(struct sim *s, struct output_file *f);
void analysis_record(struct sim *s, struct output_file *f);
void analysis_report(struct sim *s);
void analysis_free(struct sim *s);

#endif
