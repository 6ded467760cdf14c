/* forces/virtual_mass.c - the fluid that a grain has to set in motion with itself [Auton88].
 *
 *   F = C_m rho V (Du/Dt - dv/dt),   C_m = 1/2 for a sphere in unbounded flow
 *
 * Du/Dt is the fluid's own acceleration along its path, not along the grain's; the difference was
 * settled by [Auton88]. The coupling takes dv/dt implicitly (forces/force.h) and returns the reaction of
 * a step to the fluid in the next. That lag is stable while C_m (1 - eps)/eps < 1, so down to eps = 1/3
 * for C_m = 1/2.
 *
 * [Zuber64] gives C_m = (1 + 2 phi)/(2 (1 - phi)) among other spheres, phi = 1 - eps: set the
 * coefficient accordingly for a bed. */
#include "force.h"

static const struct key keys[] = {
    {"forces", "virtual_mass_coefficient", KEY_REAL, "1", "[0, 10]", "0.5",
     "C_m, fluid that a grain sets in motion over the fluid that it displaces"},
    {0},
};

static double coefficient;

static void read_keys(struct scene *s)
{
    coefficient = scene_real(s, "forces", NULL, "virtual_mass_coefficient");
}

static double added_mass(void)
{
    return coefficient;
}

const struct force force_virtual_mass = {
    .about = {.name = "virtual_mass",
              .summary = "the fluid that a grain sets in motion with itself, implicit",
              .equation = "F = C_m rho V (Du/Dt - dv/dt)",
              .source = "[Auton88]; [Zuber64]",
              .range = "C_m (1 - eps)/eps < 1"},
    .keys = keys,
    .returned = true,
    .read = read_keys,
    .added_mass = added_mass,
};
