/* porosity/porous_sphere.c - the virtual porous sphere: a grain's volume spread evenly over a larger
 * sphere about it, and that divided among cells exactly.
 *
 *   w_pc = |ball of radius R in cell c|/|ball of radius R|,   R = ratio r
 *
 * so the larger sphere has the solid fraction 1/ratio^3, and the grains' volume is exact. The paper
 * takes ratios of 3 to 5, with which cells may be as small as grains. It says nothing of walls: here
 * the part of the larger sphere beyond a wall is mirrored into the box, so that grains which fill a
 * space evenly give an even fluid fraction up to its walls.
 *
 * A grain that is no sphere is made larger by the same ratio, its volume thinner.
 *
 * Volumes are exact and cost a formula per cell and grain; `gaussian` is as smooth at a fraction of
 * the price. */
#include "porosity.h"

#include "../solver/scene.h"
#include "../solver/shares_grain.h"

const struct about porosity_about = {
    .name = "porous_sphere",
    .summary = "a grain's volume spread over a sphere of a few times its size",
    .equation =
        "w = volume of the sphere of radius ratio r in the cell / volume of that sphere",
    .source = "[HaoXiao24]",
    .range = "ratio 3 to 5; cells of a radius or more",
    .cost = "27 cells per grain of exact volumes, 22 ns each"};
const struct key porosity_keys[] = {
    {"porosity", "ratio", KEY_REAL, "1", "[1, 10]", "4",
     "radius of the virtual porous sphere over the grain's"},
    {0},
};
const int porosity_displaces = 1;

static double ratio;

void porosity_init(struct scene *s)
{
    ratio = scene_real(s, "porosity", NULL, "ratio");
}

int porosity_reach(const struct grid *g, double radius)
{
    return shares_grain_most(g, ratio * radius);
}

int porosity_shares(const struct grid *g, const struct domain *d, const struct grains *grains,
                    int i, struct share *out)
{
    return shares_grain(g, d, grains, i, ratio, out);
}

struct diffuse *porosity_diffusion(const struct grid *g, const struct domain *d, double radius)
{
    (void)g;
    (void)d;
    (void)radius;
    return NULL;
}
