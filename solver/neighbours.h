/* neighbours.h - which bodies may touch: lists of pairs with a skin, from a cell grid.
 *
 * A slot of a list is a pair owned by one grain: of two grains the smaller one (of like ones
 * that with the smaller id), or the grain of a grain-wall pair. Slots of an owner are
 * consecutive: begin[i]..begin[i+1]-1. The memory of a contact lives in its slot and moves with
 * it when the list is rebuilt; that of a slot without contact is zero.
 *
 * The list is rebuilt when the fastest grains of the steps since may have brought two bodies
 * nearer by the skin (the sum of the largest speeds times the step, so no position needs to be
 * kept). Of the slots, those within a much thinner skin are active: only these are looked at in
 * a step, and they are chosen anew when that skin is used up. */
#ifndef NEIGHBOURS_H
#define NEIGHBOURS_H

#include "domain.h"
#include "real.h"

struct sim;
struct scene;

enum { LIVE_REACH = 1, LIVE_OVERLAP = 2 }; /* within the range of a law; overlapping */
enum { IN_AHEAD = 16 };                    /* how far `in` may be read beyond its end */
enum { RUN = 256 }; /* grains per run, the unit of work of the contact loop */

struct slots {
    size_t n, capacity;
    int *begin;          /* n grains + 1 */
    int *owner, *other;  /* per slot: grains; of a wall slot, `other` is an element of a wall */
    unsigned char *live; /* per slot: LIVE_... at the last step; 0: no contact */
    real *memory;        /* n x rows, of the laws */
    int *active;         /* per run, from begin[first grain] on: slots to look at */
    int *n_active;       /* per run */
};

struct neighbours {
    double skin;  /* m */
    double inner; /* m, the thin skin */
    double reach; /* m, gap up to which laws act */
    int rows;     /* reals of memory per slot */
    int runs;     /* of the grains at hand */
    struct slots pairs, walls;
    struct slots spare[2]; /* the lists before, room for the next */
    int *to;         /* per pair slot: the other grain as its run counts it: own ones from 0,
                           then its halo from RUN on */
    int *halo_begin; /* runs + 1: a run's halo are the grains of other runs in its slots */
    int *begin_in,
        *in;      /* n + 1, halos: entries (neighbours_entry) of a grain in others' halos */
    int listed;   /* grains in the lists; newcomers stand behind them */
    double moved; /* m, that a grain may have moved since the list was made */
    double way;   /* m, the largest of the last step */
    double
        tip; /* m, the largest of the last step of a part of a grain by its spin, where parts matter */
    double moved_inner; /* m, since the active slots were chosen */
    double fastest[2];  /* m2/s2, squares of largest speeds, of the step at hand and the next */
    double tips[2];     /* the same by spins, see tip */
    long builds, choices; /* lists made, active slots chosen */
    long touching;        /* contacts, when last counted */
};

/* A periodic direction must have room for a pair and its images: else an error of the scene. */
void neighbours_check(const struct sim *s, struct scene *scene);
void neighbours_create(struct sim *s);
void neighbours_free(struct sim *s);

/* A thread reports the square of the largest speed among its grains, and of those of their parts by
 * spins, for a step whose parity is that of `step`. */
void neighbours_speed(struct sim *s, int step, double square, double tip);

/* How old the lists are, as every thread of a team counts it for itself. */
struct ageing {
    double way, tip, moved, moved_inner; /* m */
    bool choose; /* the active slots are to be chosen anew at this step */
    long choices;
};

/* `new`: the lists were made after the last drift. */
struct ageing neighbours_ageing(const struct sim *s, bool new);
/* Index of entry `local` of a run, when those of all runs stand one behind the other. */
static inline size_t neighbours_entry(const struct neighbours *nb, int run, int local)
{
    return (size_t)run * RUN + (size_t)(nb->halo_begin[run] + local);
}

/* After the drift of a step of this parity: adds its largest way; false if the list is stale. */
bool neighbours_fresh(struct sim *s, struct ageing *age, int step);
void neighbours_aged(struct sim *s, const struct ageing *age); /* keeps it, by one thread */

/* Sorts the grains, makes the lists anew. Grains that came since the last list stand behind the
 * others; one that is to go is marked by id = -1 and leaves here. */
void neighbours_rebuild(struct sim *s);

#endif
