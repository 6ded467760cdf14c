/* porosity/porosity.h - contract: what does the grid see of a grain?
 *
 * To add an answer: copy none.c to porosity/NAME.c. Every answer exports exactly the symbols
 * below. An answer says in which cells a grain lies, and with which shares (sum 1). The
 * coupling uses the same shares for everything: the grain's volume (fluid fraction), what the
 * grain feels of the fluid, and what the fluid feels of the grain; so whatever is spread is
 * given back with the same weights, and volume and momentum are conserved to round-off, next to
 * walls too.
 *
 * Cells are interior cells (periodic directions wrapped; what would lie outside a wall goes to
 * cells inside). Called from parallel loops. */
#ifndef POROSITY_H
#define POROSITY_H

#include "../solver/grid.h"
#include "../solver/grains.h"

struct share {
    int cell;      /* index in a grid field */
    double weight; /* fraction of the grain, >= 0; all of a grain's sum to 1 to round-off */
};

extern const struct about porosity_about;
extern const struct key porosity_keys[]; /* of section "porosity" */
extern const int porosity_displaces;     /* 1: grains take volume from the fluid; 0: eps = 1 */

void porosity_init(struct scene *s);

/* Most cells that a grain of this radius can have a share in. */
int porosity_reach(const struct grid *g, double radius);

/* Fills `out` (room for porosity_reach of the largest grain), returns how many. */
int porosity_shares(const struct grid *g, const struct domain *d, const struct grains *grains,
                    int i, struct share *out);

#endif
