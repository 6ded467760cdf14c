/* neighbours.h - which bodies may touch: lists of pairs with a skin, from a cell grid.
 *
 * A slot of a list is a pair owned by one grain: of two grains the smaller one (of like ones in
 * single precision that with the smaller id), or the grain of a grain-wall pair. Slots of an owner
 * are consecutive: begin[i]..begin[i+1]-1. The memory of a contact lives in its slot and moves with
 * it when the list is rebuilt; that of a slot without contact is zero.
 *
 * Each grain has a skin of its own: so far it may move until the list is made anew, beside the
 * drift that all share. A pair is listed where the gap is less than both skins; walls drift the
 * other way, and have a skin too. At each step the list grows older by the largest part of its skin
 * that any of them moves, so no position needs to be kept: a fast grain has a thick skin, and makes
 * nobody else's search wider or the list shorter-lived. Of the slots, those within a thin part of
 * the skins are active: only these are looked at in a step, and they are chosen anew when that part
 * is used up. */
#ifndef NEIGHBOURS_H
#define NEIGHBOURS_H

#include "body.h"
#include "real.h"

struct sim;
struct scene;

enum { LIVE_REACH = 1, LIVE_OVERLAP = 2 }; /* within the range of a law; overlapping */
enum { IN_AHEAD = 16 };                    /* how far `in` may be read beyond its end */
/* Grains per run, the unit of work of the contact loop: many where there are many, since fewer of them then
 * stand in halos; by their number alone. */
enum { RUN_LEAST = 256, RUN_MOST = 1024, RUNS_LEAST = 16 };

struct slots {
    size_t n, capacity;
    int *begin;          /* n grains + 1 */
    int *owner, *other;  /* per slot: grains; of a wall slot, `other` is an element of a wall */
    unsigned char *live; /* per slot: LIVE_... at the last step; 0: no contact */
    real *memory;        /* n x rows, of the laws */
    int *active;         /* per run, from begin[first grain] on: slots to look at */
    int *n_active;       /* per run */
};

/* A grain of a run that stands in the halo of another. */
struct incoming {
    int entry; /* there (neighbours_entry) */
    int local; /* here, from 0 */
};

struct neighbours {
    double reach;       /* m, gap up to which laws act */
    float *skin;        /* m, per grain; 0 of frozen ones, as their pace */
    float *pace;        /* 1/m2, per grain, 1/skin^2 */
    double wall_skin;   /* m */
    double thin;        /* the thin part of the skins */
    double4 drift;      /* m/s, that skins do not count */
    double drift_speed; /* m/s */
    int rows;           /* reals of memory per slot */
    int run, runs;      /* grains per run; runs of the grains at hand */
    struct slots pairs, walls;
    int *to;         /* per pair slot: the other grain as its run counts it: own ones from 0,
                           then its halo from `run` on */
    int *halo_begin; /* runs + 1: a run's halo are the grains of other runs in its slots */
    int *begin_in;   /* runs + 1 */
    struct incoming *in; /* of each run, in the order of the others */
    int listed;          /* grains in the lists; newcomers stand behind them */
    double moved; /* the part of its skin that a grain may have moved since the list was made */
    double moved_inner; /* since the active slots were chosen */
    double fastest
        [2]; /* 1/s2, squares of the largest speeds over skins, of the step at hand and the next */
    double tips[2];       /* the same of parts of a grain by its spin, where they matter */
    long builds, choices; /* lists made, active slots chosen */
    long touching;        /* contacts, when last counted */
};

/* A periodic direction must have room for a pair and its images: else an error of the scene. */
void neighbours_check(const struct sim *s, struct scene *scene);
void neighbours_create(struct sim *s);
void neighbours_free(struct sim *s);

/* Square of speed over skin: how fast a grain uses up its skin, 1/s2. v: m/s, and anything behind. */
static inline double neighbours_pace(double4 drift, float pace, double4 v)
{
    const double4 beside = v - drift, square = beside * beside;
    return (square[0] + square[1] + square[2]) * (double)pace;
}

/* m, gap up to which a pair is active. */
static inline double neighbours_inner(const struct neighbours *nb, int i, int j)
{
    return nb->reach + nb->thin * ((double)nb->skin[i] + (double)nb->skin[j]);
}

static inline double neighbours_inner_wall(const struct neighbours *nb, int i)
{
    return nb->reach + nb->thin * ((double)nb->skin[i] + nb->wall_skin);
}

/* A thread reports the largest pace among its grains, and that of their parts by spins, for a step
 * whose parity is that of `step`. */
void neighbours_speed(struct sim *s, int step, double square, double tip);
/* Likewise for walls, m/s. */
void neighbours_wall_speed(struct sim *s, int step, double speed);

/* How old the lists are, as every thread of a team counts it for itself. */
struct ageing {
    double moved, moved_inner; /* parts of the skins */
    bool choose;               /* the active slots are to be chosen anew at this step */
    long choices;
};

/* `new`: the lists were made after the last drift. */
struct ageing neighbours_ageing(const struct sim *s, bool new);
/* Index of entry `local` of a run, when those of all runs stand one behind the other. */
static inline size_t neighbours_entry(const struct neighbours *nb, int run, int local)
{
    return (size_t)run * nb->run + (size_t)(nb->halo_begin[run] + local);
}

/* After the drift of a step of this parity: adds its largest way; false if the list is stale. */
bool neighbours_fresh(struct sim *s, struct ageing *age, int step);
void neighbours_aged(struct sim *s, const struct ageing *age); /* keeps it, by one thread */

/* Sorts the grains, makes the lists anew. Grains that came since the last list stand behind the
 * others; one that is to go is marked by id = -1 and leaves here. */
void neighbours_rebuild(struct sim *s);

#endif
