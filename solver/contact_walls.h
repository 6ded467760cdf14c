/* contact_walls.h - the wall contacts of a run of grains. */
#ifndef CONTACT_WALLS_H
#define CONTACT_WALLS_H

#include "contact_block.h"

/* Chooses the wall slots of a run that are within the thin skin, or touch still. */
void walls_choose(struct sim *s, int run, int first, int last);

/* Works the wall contacts of a run. Forces on the walls, and their torques about the pivots, are
 * added to those of the target. */
void walls_enter(struct sim *s, int run, struct block *b, const struct target *to);

/* Adds up the forces on the walls at the last step, and their impulses since the last time. */
void walls_collect(struct sim *s, int steps);
/* Takes the sums over steps out of the runs, in their order. */
void walls_flush(struct sim *s);

#endif
