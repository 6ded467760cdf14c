/* porosity/porosity.h - contract: what does the grid see of a grain?
 *
 * To add an answer: copy none.c to porosity/NAME.c. Every answer exports exactly the symbols
 * below. An answer says in which cells a grain lies, with which shares (sum 1), and by which
 * Gaussian the fields made of them are then diffused (solver/diffuse.h; most: by none). The
 * coupling uses the same weights, shares times diffusion, for everything: the grain's volume
 * (fluid fraction), what the grain feels of the fluid, and what the fluid feels of the grain; so
 * whatever is spread is given back with the same weights, and volume and momentum are conserved
 * to round-off, next to walls too.
 *
 * Cells are interior cells (periodic directions wrapped; what would lie outside a wall goes to
 * cells inside). Called from parallel loops. */
#ifndef POROSITY_H
#define POROSITY_H

#include "../solver/diffuse.h"
#include "../solver/grains.h"
#include "../solver/shares.h"

extern const struct about porosity_about;
extern const struct key porosity_keys[]; /* of section "porosity" */
extern const int porosity_displaces;     /* 1: grains take volume from the fluid; 0: eps = 1 */

void porosity_init(struct scene *s);

/* Most cells that a grain of this radius can have a share in. */
int porosity_reach(const struct grid *g, double radius);

/* Fills `out` (room for porosity_reach of the largest grain), returns how many. */
int porosity_shares(const struct grid *g, const struct domain *d, const struct grains *grains,
                    int i, struct share *out);

/* The Gaussian, where the largest grain has this radius, m; NULL: none. The caller frees it. */
struct diffuse *porosity_diffusion(const struct grid *g, const struct domain *d, double radius);

#endif
