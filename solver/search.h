/* search.h - the grid in which pairs are sought: one for each class of sizes.
 *
 * Class k holds the grains whose radius lies between 2^-(k+1) and 2^-k of the largest; its cells
 * are as wide as its widest pair with the margin. A grain looks into the 27 cells around it in
 * its own class and in every class of larger grains, so no search sees many cells or many grains
 * in one cell, whatever the mixture of sizes [Ogarko12]. */
#ifndef SEARCH_H
#define SEARCH_H

#include "domain.h"

struct sim;

enum { SEARCH_CLASSES = 12 };

struct search_class {
    double widest; /* m, largest radius */
    int n_grains;
    int n[3];       /* cells */
    double edge[3]; /* m */
    int first;      /* its first cell among those of all classes */
};

struct search {
    int classes;
    struct search_class class[SEARCH_CLASSES]; /* largest grains first; empty ones left out */
    int class_of[64];                          /* by halvings of the largest radius */
    double largest;                            /* m */
    int cells;                                 /* of all classes */
    int *begin; /* cells + 1: grains sorted by class and cell, then by their old place */
};

/* Makes the grids for pairs nearer than `margin`; sorts the grains (all fields, wrapped into the
 * box; those with id < 0 leave). Returns order[new] = old; free with xfree. */
int *search_sort(struct search *c, struct sim *s, double margin);
void search_free(struct search *c);

/* Pairs that grain i owns (see neighbours.h) nearer than the margin, appended to *out, an array
 * of *room ints that grows (xalloc), from entry `n` on; returns the new count. */
int search_pairs(const struct search *c, const struct sim *s, double margin, int i, int **out,
                 int *room, int n);

#endif
