/* shapes/sphere.c - a grain is a sphere. The contact point lies in the middle of the overlap.
 * Also the template for other shapes of one contact a pair. */
#include "shape.h"

const struct about shape_about = {.name = "sphere",
                                  .summary = "a sphere of the given diameter",
                                  .equation = "overlap = r_i + r_j - |x_i - x_j|",
                                  .source = "exact",
                                  .range = "always"};
const struct key shape_keys[] = {{0}};

const struct shape shape = {.path = &contact_spheres, .overlaps = shape_spheres_overlap};
