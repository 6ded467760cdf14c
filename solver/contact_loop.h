/* contact_loop.h - all contact forces: shapes -> contact -> cohesion -> rolling -> bond. */
#ifndef CONTACT_LOOP_H
#define CONTACT_LOOP_H

#include <stdbool.h>
#include "contact_block.h"
#include "contact_members.h"
#include "contact_pack.h"
#include "contact_wall_pack.h"
#include "neighbours.h"

struct sim;
struct scene;

/* A bond that broke. */
struct broken {
    double time; /* s */
    vec3 point;  /* m */
    int i, j;    /* ids; j = -1 - index of a wall */
    int mode;    /* BROKE_TENSION or BROKE_SHEAR */
};

struct break_list {
    int n, room;
    struct broken *bond;
};

struct contact_work {
    struct sums *sums;           /* per entry of a run: its grains, then its halo */
    size_t capacity;             /* of it */
    struct report *report;       /* per run */
    struct pack *pack;           /* per run */
    struct wall_pack *wall_pack; /* per run */
    struct members members;      /* of contact_members.c */
    struct sums *wall_force; /* per run and wall: on it, with the torque about its pivot, now */
    struct sums *wall_sum;   /* the same, over the steps since it was last collected */
    bool watched;            /* someone looks at single contacts (contact_view.h) */
    void *seen[2]; /* then, per slot of pairs, of walls: what the path keeps of the last
                              step that was asked for */
    size_t seen_room[2];
    struct break_list broken; /* bonds, since the start */
    int runs;                 /* room of the three */
    int too_deep;             /* some contact of the last step is deeper than run.overlap_max */
};

/* Initialises the laws (parameters from the scene) and the scratch of the loop. */
void contact_create(struct sim *s, struct scene *scene);
void contact_free(struct sim *s);

double contact_reach(void); /* m, gap up to which some law acts */

/* Room for the lists at hand: after every rebuild of them. */
void contact_prepare(struct sim *s);
/* The contacts' memory goes to the slots: before every rebuild. */
void contact_put_back(struct sim *s);

/* Forces of every contact at the bodies' places: sums per grain of each run and its halo,
 * which the motion gathers. `time`: s, of the state
 * at hand. `choose`: active slots are chosen anew. `asked`: the last step before the
 * ledger, which wants energies, counts and the largest overlap. Called by every thread of a
 * team (or by one alone); ends with all threads together. */
void contact_loop(struct sim *s, double time, bool choose, bool asked);

/* The sums of a run's grains, to which it adds those that other runs have of them, in the order of
 * these; clears theirs for the next step while they are at hand, and fetches them in time. Who takes
 * the sums of the run clears these. */
static inline struct sums *contact_gather(const struct contact_work *w,
                                          const struct neighbours *nb, int run)
{
    struct sums *const all = w->sums, *const own = &all[neighbours_entry(nb, run, 0)];
    const struct incoming *const in = nb->in;
    const int to = nb->begin_in[run + 1];
    for (int k = nb->begin_in[run]; k < to; k++) {
        struct sums *const other = &all[in[k].entry];
        __builtin_prefetch(&all[in[k + IN_AHEAD - 1].entry], 1);
        own[in[k].local].both += other->both;
        *other = (struct sums){0};
    }
    return own;
}

/* Whether the run asks for the places of the grains' arrays at every step. */
bool contact_asks_places(const struct sim *s, int run);

/* Adds up what the runs report: forces on the walls with their impulses since the last time,
 * and, after a step that was asked for them, energies, counts and overlaps. */
void contact_collect(struct sim *s, int steps);

/* Says which contact is too deep (j = -1 - wall) by how much, and stops. */
void contact_die(const struct sim *s, int i, int j, const char *overlap);
void contact_stop_spheres(const struct sim *s);

/* Stops the run (EXIT_UNSTABLE) where grains overlapped too deeply. */
void contact_guard(const struct sim *s);

#endif
