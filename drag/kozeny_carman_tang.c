/* drag/kozeny_carman_tang.c - Kozeny and Carman's permeability by surface, shape and
 * tortuosity [TangetAl17; the review's Table 3, row 4].
 *
 *   k    = [1/(C_S S_S^2 T^2)] e^3/(1+e),   e = eps/(1-eps) the void ratio
 *        = eps^3/(C_S T^2 S_S^2 (1-eps)^2)
 *   Fhat = 2 C_S T^2 (y/Phi)^2 (1-eps)/eps^2
 *
 * S_S is the surface of the grains over their volume, 6/(Phi d_32): sphericity Phi, Sauter
 * mean diameter d_32 of the grains around, y = d/d_32. C_S T^2 = 2.5 x 2 with the standard
 * values: Carman's 180 for equal spheres. Above eps = 0.99 the solid fraction counts as 0.01.
 *
 * The review prints eps^3/(1+eps) and calls eps the porosity, and multiplies by gamma_w/mu: it
 * is the void ratio (with the porosity it would be eps^3/(1-eps)^2), and the conductivity. */
#include "drag.h"

#include "formulas.h"

enum { INVERSE };
static double constant = 180.0; /* 36 C_S T^2 */

const struct about drag_about = {
    .name = "kozeny_carman_tang",
    .summary = "Kozeny and Carman's permeability by surface, shape and tortuosity",
    .equation = "Fhat = 2 shape_factor tortuosity^2 (y/sphericity)^2 (1-eps)/eps^2",
    .source = "[TangetAl17]; [Carman37]",
    .range = "packed beds, eps 0.2 to 0.7, Re/(1-eps) < 1",
    .cost = "two divisions and a limit"};
const struct drag_limits drag_limits = {.eps_min = 0.2,
                                        .eps_max = 0.7,
                                        .re_max = 1.0,
                                        .per_solid = true,
                                        .shape = DRAG_SPHERICITY,
                                        .sauter = true};
const struct key drag_keys[] = {
    {"drag", "shape_factor", KEY_REAL, "1", "(0, inf)", "2.5", "C_S of the pores, 2 to 3"},
    {"drag", "tortuosity", KEY_REAL, "1", "[1, inf)", "1.4142135623730951",
     "T: way of the flow over the straight way"},
    {0}};

void drag_init(struct scene *s)
{
    const double t = scene_real(s, "drag", NULL, "tortuosity");
    constant = 36.0 * scene_real(s, "drag", NULL, "shape_factor") * t * t;
}

void drag_prepare(struct drag_grain *grain)
{
    grain->own[INVERSE] = 1.0 / grain->sphericity;
}

double drag_factor(const struct drag_point *p)
{
    const double ratio = p->y * p->grain->own[INVERSE];
    return packed_kozeny_carman(p->eps, constant) * ratio * ratio;
}
