/* porosity/divided.c - a grain's volume divided among the cells that it overlaps, exactly.
 *
 *   w_pc = |ball p in cell c|/V_p        
 *
 * The exact volumes of spheres are those of solver/shares.c; other shapes are shared by small parts of
 * their own volume (solver/shares_grain.c). */
#include "porosity.h"

#include "../solver/shares_grain.h"

const struct about porosity_about = {
    .name = "divided",
    .summary = "a grain's volume divided among the cells that it overlaps, exactly",
    .equation = "w = volume of the sphere in the cell / volume of the sphere",
    .source = "solver/sphere_box.c; compare [StrobletAl16]",
    .range = "cells of a diameter or more (below, eps falls to 0 inside grains)",
    .cost = "exact volumes of a sphere cut by up to three planes, up to 8 cells per grain"};
const struct key porosity_keys[] = {{0}};
const int porosity_displaces = 1;

void porosity_init(struct scene *s)
{
    (void)s;
}

int porosity_reach(const struct grid *g, double radius)
{
    return shares_grain_most(g, radius);
}

int porosity_shares(const struct grid *g, const struct domain *d, const struct grains *grains,
                    int i, struct share *out)
{
    return shares_grain(g, d, grains, i, 1.0, out);
}

struct diffuse *porosity_diffusion(const struct grid *g, const struct domain *d, double radius)
{
    (void)g;
    (void)d;
    (void)radius;
    return NULL;
}
