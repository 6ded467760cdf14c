/* forces/buoyancy.c - the force of the hydrostatic pressure on the volume of a grain, Archimedes' [Zhou10].
 * In every scene with a fluid, unless taken away (forces/force.h).
 *
 *   F = -rho V g
 *
 * The program's p is without its hydrostatic part, so this is what forces/pressure_gradient.c leaves out,
 * in all three forms of the momentum equation; nothing is counted twice. The hydrostatic pressure that
 * bears the grain stands on the box, so the fluid's equation gets no reaction.
 *
 * The review (eq. 33) prints + pi rho d^3 g/6, which with its g that points down has the wrong sign, and
 * adds it to a pressure force that may hold it already. */
#include "force.h"

static const struct key keys[] = {{0}};

const struct force force_buoyancy = {
    .about = {.name = "buoyancy",
              .summary = "Archimedes' force; standard",
              .equation = "F = -rho V g",
              .source = "[Zhou10]",
              .range = "any"},
    .keys = keys,
    .of_weight = -1.0,
};
