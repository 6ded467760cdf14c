/* porosity/gaussian.c - a grain's volume spread as a Gaussian: its trilinear shares, diffused on the
 * grid [SunXiao15].
 *
 *   eps = 1 - exp(w^2/2 L) (sum of trilinear shares V_p)/V,   L the Laplacian of the grid, no flux
 *                                                             through walls
 * The diffusion is done in the basis of the transforms of the pressure solve, exactly, not by time steps
 * (solver/diffuse.c); it keeps the volume next to walls. Whatever the size of the cells, the fluid
 * fraction is as smooth as the width: 35 ns or so per grain and 4 per cell and field, at any width.
 * One width serves all grains. [SunXiao15] recommend a bandwidth of 6 diameters, which is a width of
 * 3 sqrt(2) = 4.2 diameters in a bed; 2 already remove the noise. */
#include "porosity.h"

#include "../solver/scene.h"

const struct about porosity_about = {
    .name = "gaussian",
    .summary =
        "a grain's volume spread as a Gaussian of given width, conservative next to walls",
    .equation = "w = exp(width^2/2 L) applied to the trilinear shares",
    .source = "[SunXiao15]; [AbramowitzStegun64, 9.6.34]",
    .range = "any cell/d; structure finer than the width is not seen",
    .cost = "8 cells per grain, and three transforms of the field there and back"};
const struct key porosity_keys[] = {
    {"porosity", "width", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "standard deviation of the Gaussian; auto: 2 diameters of the largest grain"},
    {0},
};
const int porosity_displaces = 1;

static double width; /* 0: auto */

void porosity_init(struct scene *s)
{
    width = scene_word(s, "porosity", NULL, "width", "auto")
                ? 0.0
                : scene_real(s, "porosity", NULL, "width");
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
    return diffuse_create(g, d, width > 0.0 ? width : 4.0 * radius);
}
