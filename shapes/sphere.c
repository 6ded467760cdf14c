/* shapes/sphere.c - a grain is a sphere. The contact point lies in the middle of the overlap.
 * Also the template for other shapes of one contact a pair. */
#include "shape.h"

const struct about shape_about = {.name = "sphere",
                                  .summary = "a sphere of the given diameter",
                                  .equation = "overlap = r_i + r_j - |x_i - x_j|",
                                  .source = "exact",
                                  .range = "always"};
const struct key shape_keys[] = {{0}};

static void overlaps(const struct grains *g, const struct candidates *c, struct touch *t,
                     struct levers *l)
{
    (void)g;
#pragma omp simd
    for (int k = 0; k < c->n; k++) {
        const real square = c->dx[k] * c->dx[k] + c->dy[k] * c->dy[k] + c->dz[k] * c->dz[k];
        const real inverse = inverse_root(square), distance = square * inverse;
        const real half = 0.5 * (t->r_i[k] + t->r_j[k] - distance);
        const real arm_i = half - t->r_i[k];
        const real arm_j = t->r_j[k] > 0.0 ? t->r_j[k] - half : 0.0;
        t->depth[k] = 2.0 * half;
        t->nx[k] = c->dx[k] * inverse;
        t->ny[k] = c->dy[k] * inverse;
        t->nz[k] = c->dz[k] * inverse;
        l->ix[k] = arm_i * t->nx[k];
        l->iy[k] = arm_i * t->ny[k];
        l->iz[k] = arm_i * t->nz[k];
        l->jx[k] = arm_j * t->nx[k];
        l->jy[k] = arm_j * t->ny[k];
        l->jz[k] = arm_j * t->nz[k];
    }
}

const struct shape shape = {.path = &contact_spheres, .overlaps = overlaps};
