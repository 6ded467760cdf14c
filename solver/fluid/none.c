/* solver/fluid/none.c - no fluid: a dry scene. Refers to nothing, so that its binary holds
 * neither the coupling nor FFTW. Also the template for new solvers. */
#include "fluid.h"

#include "../feasibility.h"
#include "../sim.h"

const struct about fluid_about = {
    .name = "none", .summary = "no fluid", .equation = "", .source = "", .range = "dry grains"};
const struct key fluid_keys[] = {{0}};

void fluid_create(struct sim *s, struct scene *scene)
{
    (void)scene;
    s->fluid.exists = false;
}

void fluid_free(struct sim *s)
{
    (void)s;
}

void fluid_sense(struct sim *s)
{
    (void)s;
}

void fluid_step(struct sim *s)
{
    (void)s;
}

void fluid_load(struct sim *s)
{
    (void)s;
}

double fluid_side_pressure(const struct sim *s, int side)
{
    (void)s;
    (void)side;
    return 0.0;
}

void fluid_feasibility(const struct sim *s, struct feasibility *f)
{
    (void)s;
    (void)f;
}
