/* slots.h - making the lists of slots (neighbours.h), with the memory of live contacts carried from the
 * list before. */
#ifndef SLOTS_H
#define SLOTS_H

#include "neighbours.h"

struct search;
struct sim;

void slots_create(struct slots *l, int grains);
void slots_free(struct slots *l);

/* The live contacts of a list, by grains as they stood when it was made: what is kept of it while it is
 * made anew. */
struct kept {
    int n;      /* grains */
    int *begin; /* n + 1 */
    int *other;
    unsigned char *live;
    real *memory;
};

/* Of a list of n grains; freed by slots_fill. */
struct kept slots_keep(const struct slots *l, int n, int rows);

/* Finds the slots of grain i, appends them to *out, an array of *room ints that grows (xalloc), from
 * entry n on; returns the new count. `c`: of the call of slots_fill. */
typedef int finder(const struct search *c, const struct sim *s, int i, int **out, int *room,
                   int n);

/* The list anew for the grains at hand. order[new] = old: where grains stood in the list before. `pairs`:
 * the other side of a slot is a grain too. */
void slots_fill(struct sim *s, struct slots *l, finder *find, const struct search *c,
                struct kept *kept, const int *order, bool pairs);

#endif
