/* contact_walls.h - which wall slots are looked at; the sums of the forces on walls. */
#ifndef CONTACT_WALLS_H
#define CONTACT_WALLS_H

#include "contact_block.h"

/* Chooses the wall slots of a run that are within the thin skin, or touch still. */
void walls_choose(struct sim *s, int run, int first, int last);

/* Adds up the forces on the walls at the last step, and their impulses since the last time. */
void walls_collect(struct sim *s, int steps);
/* Takes the sums over steps out of the runs, in their order. */
void walls_flush(struct sim *s);

#endif
