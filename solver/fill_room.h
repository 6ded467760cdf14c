/* fill_room.h - the part of a region that walls leave to grains. */
#ifndef FILL_ROOM_H
#define FILL_ROOM_H

#include <gsl/gsl_rng.h>
#include "fill_relax.h"

struct sim;

/* m3 of the region that is not behind a wall of `walls` (NULL: all of it), by `points` points that
 * are spread evenly. A wall that is felt from both sides takes no room. */
double room_volume(const struct sim *walls, const struct fill_region *r, int points);

/* A random place for a sphere inside the region, clear of the walls; false if none was found. */
bool room_somewhere(const struct sim *walls, const struct fill_region *r, double radius,
                    gsl_rng *rng, vec3 *x);

#endif
