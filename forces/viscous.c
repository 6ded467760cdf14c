/* forces/viscous.c - the force of the fluid's mean viscous stress on the volume of a grain
 * [AndersonJackson67], [Zhou10]. In every scene with a fluid, unless taken away (forces/force.h).
 *
 *   F = V div tau,   tau = mu (grad u + grad u^T - 2/3 div u I)
 *
 * the divergence that the momentum equation took over the step, with the weights by which the grain is
 * spread. Form 27a gives the fluid eps of it and the grains the rest; form 27b has div(eps tau), the same
 * where the porosity is uniform; form 27c has it in drag/eps: there this force is nought. Darcy's flow
 * knows no div tau. */
#include "force.h"

static const struct key keys[] = {{0}};

const struct force force_viscous = {
    .about = {.name = "viscous",
              .summary = "the fluid's mean viscous stress on the volume of a grain; standard",
              .equation = "F = V div tau",
              .source = "[AndersonJackson67]; [Zhou10]",
              .range = "any; forms a and b of navier_stokes (form c has it in the drag)"},
    .keys = keys,
    .of_viscous = 1.0,
};
