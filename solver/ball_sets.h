/* ball_sets.h - unions of balls by name, from a list, or from a file. */
#ifndef BALL_SETS_H
#define BALL_SETS_H

#include <stdbool.h>
#include "disc_union.h"

extern const char *const ball_set_names; /* "pair | rod | ..." */

/* The balls of a name, or of a file (x y z r a line, # for remarks); xfree them. NULL with *why (xfree
 * it) where there are none. */
struct ball *ball_set_named(const char *name, const char *path, int *n, char **why);
/* Of a list "x y z r, x y z r, ...". */
struct ball *ball_set_listed(const char *list, int *n, char **why);
/* Whether they hang together. */
bool ball_set_whole(const struct ball *b, int n);

#endif
