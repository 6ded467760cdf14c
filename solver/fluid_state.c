/* fluid_state.c - fields and sides of the fluid, for every solver of solver/fluid/. */
#include "fluid_state.h"

#include <string.h>

static double auto_step(const struct sim *s)
{
    const double viscous =
        s->fluid.implicit_viscosity ? (double)INFINITY : fluid_viscous_limit(s);
    return fmin(0.5 * fmin(fluid_courant_limit(s), viscous), s->run.end / 10.0);
}

static void register_flow(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    const int both = FIELD_STATE | FIELD_OUTPUT;
    const struct field list[] = {
        {"fluid_velocity_x", "m s-1", "interstitial velocity of the fluid, x", PLACE_FACE_X,
         KIND_REAL, (void **)&f->u[0], both},
        {"fluid_velocity_y", "m s-1", "interstitial velocity of the fluid, y", PLACE_FACE_Y,
         KIND_REAL, (void **)&f->u[1], both},
        {"fluid_velocity_z", "m s-1", "interstitial velocity of the fluid, z", PLACE_FACE_Z,
         KIND_REAL, (void **)&f->u[2], both},
        {"pressure", "Pa", "pressure without its hydrostatic part", PLACE_CELL, KIND_REAL,
         (void **)&f->p, both},
    };
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        fields_add(&s->fields, list[i]);
    series_add(&s->series, "courant", "1", "largest u dt / h", &f->courant);
    series_add(&s->series, "divergence", "1", "largest continuity error, times h / u",
               &f->divergence);
}

static void register_porosity(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    fields_add(&s->fields,
               (struct field){"fluid_fraction", "1", "fluid fraction (porosity)", PLACE_CELL,
                              KIND_REAL, (void **)&f->eps, FIELD_STATE | FIELD_OUTPUT});
    fields_add(&s->fields,
               (struct field){"fluid_fraction_old", "1", "fluid fraction a step ago",
                              PLACE_CELL, KIND_REAL, (void **)&f->eps_old, FIELD_STATE});
}

bool fluid_state_create(struct sim *s, struct scene *scene)
{
    struct fluid *const f = &s->fluid;
    f->exists = true;
    f->rho = scene_real(scene, "fluid", NULL, "density");
    f->mu = scene_real(scene, "fluid", NULL, "viscosity");
    for (int a = 0; a < 3; a++)
        if (s->domain.cells[a] < 1) {
            scene_error(scene, "domain", NULL, "cells",
                        "a scene with a fluid needs three numbers "
                        "of cells, each 1 at least");
            break;
        }
    double cells = 1.0;
    for (int a = 0; a < 3; a++)
        cells *= s->domain.cells[a] + 2.0;
    if (cells > 1e9)
        scene_error(scene, "domain", NULL, "cells", "%.3g cells are more than 1e9", cells);
    const bool automatic = scene_word(scene, "fluid", NULL, "dt", "auto");
    if (!automatic)
        f->dt = scene_real(scene, "fluid", NULL, "dt");
    if (scene_errors(scene) > 0) {
        f->dt = 1.0;
        coupling_read(s, scene);
        return false;
    }
    grid_create(&s->grid, &s->domain);
    if (automatic)
        f->dt = auto_step(s);
    f->p = grid_field(&s->grid);
    for (int a = 0; a < 3; a++)
        f->u[a] = grid_field(&s->grid);
    register_flow(s);
    coupling_read(s, scene);
    if (f->bare)
        return true;
    f->eps = grid_field(&s->grid);
    f->eps_old = grid_field(&s->grid);
    for (size_t c = 0; c < s->grid.total; c++)
        f->eps[c] = f->eps_old[c] = 1.0;
    for (int a = 0; a < 3; a++) {
        double **const faces[] = {&f->drag[a], &f->drag_s[a], &f->stress[a]};
        for (size_t i = 0; i < sizeof faces / sizeof faces[0]; i++)
            *faces[i] = grid_field(&s->grid);
    }
    register_porosity(s);
    coupling_create(s);
    return true;
}

void fluid_state_free(struct sim *s)
{
    struct fluid *const f = &s->fluid;
    if (!f->p)
        return;
    coupling_free(s);
    xfree(f->p);
    xfree(f->eps);
    xfree(f->eps_old);
    for (int a = 0; a < 3; a++) {
        void *const faces[] = {f->u[a], f->drag[a], f->drag_s[a], f->stress[a]};
        for (size_t i = 0; i < sizeof faces / sizeof faces[0]; i++)
            xfree(faces[i]);
    }
}
