/* drag/kozeny_carman_d10.c - Kozeny and Carman's permeability with the effective diameter D10
 * [YinetAl21; the review's Table 3, row 2].
 *
 *   k    = D10^2 eps^3/(C (1-eps)^2),   C = 150
 *   Fhat = (C/18) (1-eps)/eps^2 (d/D10)^2
 *
 * 10 % of the grains' volume is of smaller diameter than D10: the fine grains rule the pores.
 * All grains of the scene count as placed at the start (drag.d10 = auto), or D10 is given.
 * Each grain takes its share of the resistance by its volume, hence d^2. Above eps = 0.99,
 * where there is no bed, the solid fraction counts as 0.01.
 *
 * The review prints the conductivity k rho g/mu under the symbol k of the permeability. */
#include "drag.h"

#include "formulas.h"

enum { INVERSE };
static double constant = 150.0, given; /* m; 0: not given */

const struct about drag_about = {.name = "kozeny_carman_d10",
                                 .summary =
                                     "Kozeny and Carman's permeability, effective diameter D10",
                                 .equation = "Fhat = (constant/18) (1-eps)/eps^2 (d/D10)^2",
                                 .source = "[YinetAl21]; [Carman37]",
                                 .range = "packed beds, eps 0.2 to 0.7, Re/(1-eps) < 1",
                                 .cost = "two divisions and a limit"};
const struct drag_limits drag_limits = {
    .eps_min = 0.2, .eps_max = 0.7, .re_max = 1.0, .per_solid = true};
const struct key drag_keys[] = {
    {"drag", "constant", KEY_REAL, "1", "(0, inf)", "150", "constant of Kozeny and Carman"},
    {"drag", "d10", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "10 % of the grains' volume is smaller; auto: of the scene's grains"},
    {0}};

void drag_init(struct scene *s)
{
    constant = scene_real(s, "drag", NULL, "constant");
    given =
        scene_word(s, "drag", NULL, "d10", "auto") ? 0.0 : scene_real(s, "drag", NULL, "d10");
}

void drag_prepare(struct drag_grain *grain)
{
    grain->own[INVERSE] = 1.0 / (given > 0.0 ? given : grain->d10);
}

double drag_factor(const struct drag_point *p)
{
    const double ratio = p->d * p->grain->own[INVERSE];
    return packed_kozeny_carman(p->eps, constant) * ratio * ratio;
}
