/* search.h - the grids in which pairs are sought: one for each class of grains.
 *
 * Classes go by halves of the largest radius and, within, by how far grains may move until the next
 * list, so that a few fast ones widen no other's search. A grain looks into the cells around it of the classes of its
 * own size and of larger ones: no search sees many cells or many grains in one, whatever the mixture
 * of sizes [Ogarko12]. Distances are taken in single precision, their error is part of what counts as
 * near. */
#ifndef SEARCH_H
#define SEARCH_H

#include "domain.h"

struct sim;

enum { SEARCH_SIZES = 12, SEARCH_SPEEDS = 3, SEARCH_CLASSES = SEARCH_SIZES * SEARCH_SPEEDS };
enum { SEARCH_LANES = 16 }; /* grains that are looked at together */

struct search_class {
    int size;      /* halvings of the largest radius */
    double widest; /* m, the largest reach */
    int n_grains;
    int n[3];            /* cells */
    double per_metre[3]; /* 1/m, of them */
    int first;           /* its first cell among those of all classes */
};

/* Grains by class and cell; those of a cell in the order of their places in memory. */
struct search {
    int classes;
    struct search_class class[SEARCH_CLASSES]; /* largest grains first; empty ones left out */
    int class_of[SEARCH_CLASSES];              /* by size and speed */
    double largest;                            /* m, radius */
    int cells;                                 /* of all classes */
    int *begin;                                /* cells + 1 */
    float *x, *y, *z;                          /* m */
    float *reach;  /* m: two grains are near within the sum of theirs */
    float *radius; /* m */
    int *id, *grain;
    const float *skin; /* m, per grain, of the caller */
    double gap;        /* m */
};

/* Makes the grids of the grains at hand: two are near where the gap between them is less than `gap`
 * and the sum of their skins (m, per grain; kept by the caller). */
void search_open(struct search *c, const struct sim *s, const float *skin, double gap);
void search_free(struct search *c);

/* Pairs that grain i owns (see neighbours.h), appended to *out, an array of *room ints that grows
 * (xalloc), from entry `n` on; returns the new count. */
int search_pairs(const struct search *c, const struct sim *s, int i, int **out, int *room,
                 int n);

#endif
