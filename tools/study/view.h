/* view.h - what named axes need to know of a scene. */
#ifndef VIEW_H
#define VIEW_H

#include <stdbool.h>
#include "../../solver/vec3.h"

enum { MOST_SPECIES = 16 };

struct species_view {
    const char *name;
    double d, rho; /* m, kg/m3; d 0: a distribution */
    bool frozen, unit_cell;
};

struct view {
    struct scene *scene;
    bool fluid, darcy, navier_stokes, linear, gravity_on;
    int n;
    struct species_view species[MOST_SPECIES];
    int n_materials;
    const char *const *material;
    double rho, mu, fluid_dt, grain_dt; /* 0: not given, or auto */
    double end, inflow;
    double size[3];
    bool periodic[3];
    double gravity; /* m/s2 */
    int cells[3];
};

/* Of the scene with overrides; view_free it. */
struct view view_read(const char *scene, char *const *overrides, int n);
void view_free(struct view *v);

#endif
