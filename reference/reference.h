/* reference/reference.h - contract: what should come out?
 *
 * A scene names the theory that it is checked against: `reference = pressure_drop`. The answer
 * watches the run and, at its end, compares: a table (with its figure), lines of the summary, a
 * verdict with tolerance. To add one: copy none.c to reference/NAME.c. */
#ifndef REFERENCE_H
#define REFERENCE_H

#include "../solver/scene.h"

struct sim;

extern const struct about reference_about;
extern const struct key reference_keys[]; /* of section "reference" */

void reference_create(struct sim *s, struct scene *scene); /* after grains and fluid exist */
void reference_watch(struct sim *s);                       /* after every step; cheap */
void reference_report(struct sim *s); /* at the end: tables, summary, printed text */
void reference_free(struct sim *s);

#endif
