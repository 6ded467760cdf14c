/* porosity/trilinear.c - a grain's volume shared by the eight cells whose centres surround it, with the
 * weights of the trilinear interpolation (particle-mesh codes say: cloud in cell [HockneyEastwood88]).
 *
 *   w_pc = (1 - |x - x_c|/h_x)(1 - |y - y_c|/h_y)(1 - |z - z_c|/h_z)
 *
 * A grain is seen as a box of the size of a cell, whatever its own size: eps changes continuously as
 * it moves, and a fluid velocity that is linear in space is felt exactly. In the half cell next to a
 * wall the weight beyond it goes to the cell inside. */
#include "porosity.h"

const struct about porosity_about = {
    .name = "trilinear",
    .summary = "a grain's volume shared by the eight cell centres around it",
    .equation = "w = product over x, y, z of (1 - |x - x_c|/h)",
    .source = "[HockneyEastwood88, sect. 5-3]",
    .range = "cells of two diameters or more; smooth, but not by the grain's size",
    .cost = "8 cells per grain, 10 ns each"};
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
    return 8;
}

int porosity_shares(const struct grid *g, const struct domain *d, const struct grains *grains,
                    int i, struct share *out)
{
    return shares_trilinear(g, d, grains->pos[i], out);
}

struct diffuse *porosity_diffusion(const struct grid *g, const struct domain *d, double radius)
{
    (void)g;
    (void)d;
    (void)radius;
    return NULL;
}
