/* neighbours.h - which grains may touch: a list of pairs with a skin, from a cell grid.
 *
 * A slot of the list is a pair owned by one grain: the one with the smaller id, or the grain of
 * a grain-wall pair. Slots of an owner are consecutive: begin[i]..begin[i+1]-1. The history of
 * a contact lives in its slot and moves with it when the list is rebuilt. The list is rebuilt
 * when a grain has moved half a skin since it was made; grains are then sorted by cell. */
#ifndef NEIGHBOURS_H
#define NEIGHBOURS_H

#include "domain.h"

struct sim;
struct scene;

struct neighbours {
    double skin;  /* m */
    double reach; /* m, gap up to which laws act */
    int n_listed; /* grains in the list */
    size_t n_slots, capacity;
    int *begin;    /* n + 1 */
    int *owner;    /* per slot */
    int *other;    /* per slot: grain index, or -1 - wall */
    int *begin_in; /* n + 1: slots in which a grain is the other one */
    int *slots_in;
    unsigned char *live; /* per slot: it touched at the last step, its history counts */
    int rows;            /* doubles of history per slot */
    double *history;     /* n_slots x rows */
    vec3 *pos_built;     /* m, positions when the list was made */
    double moved;        /* m, largest displacement since */
    long builds;
    long touching; /* contacts at the last step */
};

/* A periodic direction must have room for a pair and its images: else an error of the scene. */
void neighbours_check(const struct sim *s, struct scene *scene);
void neighbours_create(struct sim *s);
void neighbours_free(struct sim *s);

/* A thread reports the largest displacement among its grains, m. */
void neighbours_moved(struct sim *s, double moved);
bool neighbours_stale(const struct sim *s);
/* Sorts the grains, makes the list anew. Grains that came since the last list stand behind the
 * others; one that is to go is marked by id = -1 and leaves here. */
void neighbours_rebuild(struct sim *s);

#endif
