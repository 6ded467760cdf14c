/* force_names.h - a list of answers of forces/ as text: "buoyancy+magnus" for "magnus, -viscous
 * -pressure_gradient" (forces/force.h). */
#ifndef FORCE_NAMES_H
#define FORCE_NAMES_H

#include <stdbool.h>

/* Sorted, each once, joined by "+"; "none" where there is none. Starts from the standard forces where
 * there is a fluid and the text has no "none". Free with xfree. */
char *force_names(const char *text, bool fluid);

/* Whether the text itself asks for this force. */
bool force_names_given(const char *text, const char *name);

/* The first word of the text that is no force of `allowed`, "a | b"; NULL: all are. Free with xfree. */
char *force_names_wrong(const char *text, const char *allowed);

#endif
