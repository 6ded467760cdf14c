/* forces/pressure_gradient.c - the force of the fluid's pressure on the volume of a grain [AndersonJackson67],
 * [Zhou10]. In every scene with a fluid, unless taken away (forces/force.h).
 *
 *   F = V (f - grad p)     f: what drives periodic directions; p without its hydrostatic part
 *
 * p of the end of the step, with the weights by which the grain is spread. Forms 27a and 27b of the
 * momentum equation give the fluid eps of it: the grains' share is the rest, so the mixture loses nothing.
 * Form 27c leaves all of it to the fluid and has drag/eps instead: there this force is nought.
 *
 * The review (eqs 30-33) adds it to a buoyancy from the same p and hands both to the fluid again. */
#include "force.h"

static const struct key keys[] = {{0}};

const struct force force_pressure_gradient = {
    .about = {.name = "pressure_gradient",
              .summary = "the fluid's pressure on the volume of a grain; standard",
              .equation = "F = V (f - grad p), p without its hydrostatic part",
              .source = "[AndersonJackson67]; [Zhou10]",
              .range = "any; forms a and b (form c has it in the drag)"},
    .keys = keys,
    .of_pressure = 1.0,
};
