/* shares_grain.h - in which cells does a grain of any shape lie? For the answers of porosity/.
 *
 * A sphere is shared exactly (shares.h). The volume of any other shape is cut once per species into
 * parts (shape.parts), porosity.parts of them across its diameter; each part is then a small cube,
 * so a cell's volume is right to some 1e-3 of the grain's with 12 parts across, 3e-4 with 24. */
#ifndef SHARES_GRAIN_H
#define SHARES_GRAIN_H

#include "grains.h"
#include "shares.h"

struct scene;

extern const struct key shares_grain_keys[];

/* Reads the key, where the shape has parts, and cuts every species; grains->parts belongs to this. */
void shares_grain_create(struct grains *g, struct scene *scene);
void shares_grain_free(struct grains *g);

/* Shares of grain i made larger by `scale`, its volume thinner; at most shares_grain_most for bounding
 * radii (times scale) up to `radius`. */
int shares_grain_most(const struct grid *grid, double radius);
int shares_grain(const struct grid *grid, const struct domain *d, const struct grains *g, int i,
                 double scale, struct share *out);

#endif
