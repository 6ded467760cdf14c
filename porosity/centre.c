/* porosity/centre.c - a grain's whole volume in the cell that holds its centre.
 *
 *   eps_c = 1 - (volume of the grains with their centre in c)/V
 *
 * The cheapest answer and the roughest: eps jumps when a centre passes from cell to cell, and
 * falls below the packing's where a cell is not much larger than a grain. */
#include "porosity.h"

#include "../solver/locate.h"

const struct about porosity_about = {.name = "centre",
                                     .summary = "all of a grain in the cell of its centre",
                                     .equation = "w = 1 in the cell of the centre",
                                     .source = "[HockneyEastwood88, sect. 5-3], nearest point",
                                     .range = "cells of 4 diameters or more"};
const struct key porosity_keys[] = {{0}};
const int porosity_displaces = 1;

void porosity_init(struct scene *s)
{
    (void)s;
}

int porosity_reach(const struct grid *g, double radius)
{
    (void)g;
    (void)radius;
    return 1;
}

int porosity_shares(const struct grid *g, const struct domain *d, const struct grains *grains,
                    int i, struct share *out)
{
    out[0] = (struct share){.cell = locate_cell(g, d, grains->pos[i]), .weight = 1.0};
    return 1;
}

struct diffuse *porosity_diffusion(const struct grid *g, const struct domain *d, double radius)
{
    (void)g;
    (void)d;
    (void)radius;
    return NULL;
}
