/* shapes/sphere.c - a grain is a sphere. The contact point lies in the middle of the overlap.
 * Also the template for other shapes. */
#include "shape.h"

#define PI 3.14159265358979323846

const struct about shape_about = {.name = "sphere",
                                  .summary = "a sphere of the given diameter",
                                  .equation = "overlap = r_i + r_j - |x_i - x_j|",
                                  .source = "exact",
                                  .range = "always"};
const struct key shape_keys[] = {{0}};

void shape_body(struct grains *g, int i, double diameter, double density)
{
    const double r = 0.5 * diameter;
    g->radius[i] = r;
    g->volume[i] = PI / 6.0 * diameter * diameter * diameter;
    g->mass[i] = density * g->volume[i];
    g->inv_mass[i] = 1.0 / g->mass[i];
    g->inv_inertia[i] = 2.5 / (g->mass[i] * r * r);
}

void shape_overlaps(const struct grains *g, const struct candidates *c, struct touch *t,
                    struct levers *l)
{
    const double *const restrict radius = g->radius;
    for (int k = 0; k < c->n; k++) { /* a wall has no radius; its j is i */
        const double ri = radius[c->i[k]], rj = radius[c->j[k]];
        t->r_i[k] = ri;
        t->r_j[k] = c->wall[k] ? 0.0 : rj;
        t->r_eff[k] = c->wall[k] ? ri : ri * rj / (ri + rj);
    }
#pragma omp simd
    for (int k = 0; k < c->n; k++) {
        const double distance =
            sqrt(c->dx[k] * c->dx[k] + c->dy[k] * c->dy[k] + c->dz[k] * c->dz[k]);
        const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
        const double depth = t->r_i[k] + t->r_j[k] - distance;
        t->depth[k] = depth;
        t->nx[k] = c->dx[k] * inverse;
        t->ny[k] = c->dy[k] * inverse;
        t->nz[k] = c->dz[k] * inverse;
        const double arm_i = -(t->r_i[k] - 0.5 * depth);
        const double arm_j = t->r_j[k] > 0.0 ? t->r_j[k] - 0.5 * depth : 0.0;
        l->ix[k] = arm_i * t->nx[k];
        l->iy[k] = arm_i * t->ny[k];
        l->iz[k] = arm_i * t->nz[k];
        l->jx[k] = arm_j * t->nx[k];
        l->jy[k] = arm_j * t->ny[k];
        l->jz[k] = arm_j * t->nz[k];
    }
}
