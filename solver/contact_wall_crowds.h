/* contact_wall_crowds.h - balls near several elements of a wall: which of these count. */
#ifndef CONTACT_WALL_CROWDS_H
#define CONTACT_WALL_CROWDS_H

#include "contact_wall_pack.h"

struct sim;
struct ball_walls;

/* Of n entries, in the order of their walls, grains and balls, leaves those that may count until slots are
 * chosen anew, and notes of what kind their lanes are; returns how many are left. */
int wall_crowds_thin(const struct sim *s, struct wall_entry *e, int n,
                     const struct ball_walls *balls);
/* Looks at every element of the crowds of a run from its ball, marks those that count, gives lanes to new
 * contacts. balls: as of contact_spheres.h. */
void wall_crowds_decide(const struct sim *s, struct wall_pack *p,
                        const struct ball_walls *balls);

#endif
