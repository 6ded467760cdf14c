/* porosity/none.c - grains take no volume from the fluid: eps = 1 everywhere. What they
 * exchange with the fluid they exchange with the cell of their centre. Right for grains that
 * are few and small, and for one-way scenes of a single sphere. Also the template for new
 * answers. */
#include "porosity.h"

#include "../solver/locate.h"

const struct about porosity_about = {.name = "none",
                                     .summary = "grains take no volume from the fluid",
                                     .equation =
                                         "eps = 1; all of a grain in the cell of its centre",
                                     .source = "",
                                     .range = "dilute: solid fraction below 0.001"};
const struct key porosity_keys[] = {{0}};
const int porosity_displaces = 0;

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
