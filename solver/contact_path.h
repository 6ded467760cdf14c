/* contact_path.h - the two ways from slots to forces, one of which the shape picks (shapes/shape.h).
 * A path is named by the shape alone, so only that path is linked. */
#ifndef CONTACT_PATH_H
#define CONTACT_PATH_H

#include "contact_block.h"

struct contact_view;
struct neighbours;
struct turning;

struct contact_path {
    /* Room of its own, once the contacts' is there; what it keeps beside the grains, after every rebuild of
     * the lists. NULL: nothing. */
    void (*create)(struct sim *s);
    void (*free)(struct sim *s);
    void (*prepare)(struct sim *s);
    int (*rows)(const struct sim *s); /* reals of memory per slot, in fours */
    /* Works `count` pair slots, and the wall slots of a run, through shape and laws; forces are
     * added to those of the target. */
    void (*pairs)(struct sim *s, struct block *b, const int *slot, int count,
                  const struct target *to);
    void (*walls)(struct sim *s, int run, struct block *b, const struct target *to);
    /* The contacts of the last step, see contact_view.h; room for what is kept for it. */
    void (*view)(const struct sim *s, struct contact_view *v);
    size_t (*seen_size)(const struct sim *s); /* bytes per slot */
    void (*stop)(const struct sim *s); /* a contact is too deep: stops the run and says which */
    /* A path that keeps the contacts of a run's active pair slots in a form of its own takes them
     * when they are chosen, and gives them back before they are chosen anew; NULL: it works on the
     * slots. */
    void (*take)(struct sim *s, int run);
    void (*put_back)(struct sim *s, int run);
    const struct turning *turning; /* NULL: a grain's inertia is a number, and nobody
                                                 asks for its orientation */
    /* Whether it depends on how two bodies are turned which of their parts are within the thin skin. NULL:
     * it does not. */
    bool (*turns)(const struct sim *s);
    bool from_bodies; /* its pairs look at the bodies alone, not at the grains' places */
};

#endif
