/* view.c - reads of a scene what named axes need; its faults are for the binary to tell. */
#include "view.h"

#include <string.h>
#include "../../solver/scene.h"

/* The scene's own tables are the answers'; here with defaults, so that nothing is missed. */
static const struct key wanted[] = {
    {"modules", "fluid", KEY_TEXT, "", "", "none", ""},
    {"modules", "contact", KEY_TEXT, "", "", "none", ""},
    {"domain", "x", KEY_TEXT, "", "", "", ""},
    {"domain", "y", KEY_TEXT, "", "", "", ""},
    {"domain", "z", KEY_TEXT, "", "", "", ""},
    {"domain", "size", KEY_VECTOR, "m", "(0, inf)", "1 1 1 m", ""},
    {"domain", "cells", KEY_CELLS, "", "[0, 1000000]", "0 0 0", ""},
    {"domain", "gravity", KEY_VECTOR, "m s-2", "(-inf, inf)", "0 0 -9.81 m/s2", ""},
    {"grains", "diameter", KEY_REAL, "m", "auto | (0, inf)", "auto", ""},
    {"grains", "density", KEY_REAL, "kg m-3", "(0, inf)", "1 kg/m3", ""},
    {"grains", "frozen", KEY_CHOICE, "", "no | yes", "no", ""},
    {"grains", "fill", KEY_TEXT, "", "", "lattice", ""},
    {"material", "poisson", KEY_REAL, "1", "(-1, 0.5]", "0.3", ""},
    {"reference", "restitution", KEY_REAL, "1", "(0, 1]", "1", ""},
    {"material", "young", KEY_REAL, "Pa", "(0, inf)", "1 Pa", ""},
    {"fluid", "density", KEY_REAL, "kg m-3", "(0, inf)", "1 kg/m3", ""},
    {"fluid", "viscosity", KEY_REAL, "Pa s", "[0, inf)", "1 Pa s", ""},
    {"fluid", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto", ""},
    {"flow", "velocity", KEY_REAL, "m s-1", "[0, inf)", "0 m/s", ""},
    {"run", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto", ""},
    {"run", "end", KEY_REAL, "s", "(0, inf)", "1 s", ""},
    {0},
};

static double real_or_0(struct scene *s, const char *section, const char *name, const char *key)
{
    return scene_word(s, section, name, key, "auto") ? 0.0 : scene_real(s, section, name, key);
}

static void read_species(struct view *v)
{
    const char *const *names;
    const int n = scene_names(v->scene, "grains", &names);
    for (int i = 0; i < n && i < MOST_SPECIES; i++) {
        struct species_view *const sp = &v->species[v->n++];
        sp->name = names[i];
        sp->d = real_or_0(v->scene, "grains", names[i], "diameter");
        sp->rho = scene_real(v->scene, "grains", names[i], "density");
        sp->frozen = scene_choice(v->scene, "grains", names[i], "frozen") == 1;
        sp->unit_cell =
            strcmp(scene_text(v->scene, "grains", names[i], "fill"), "unit_cell") == 0;
    }
}

struct view view_read(const char *path, char *const *overrides, int n)
{
    struct view v = {0};
    char **const copy = xalloc((size_t)n + 1, sizeof *copy);
    for (int i = 0; i < n; i++)
        copy[i] = overrides[i];
    struct scene *const s = v.scene = scene_load(path, n, copy);
    xfree(copy);
    scene_declare(s, wanted);
    const char *const fluid = scene_text(s, "modules", NULL, "fluid");
    v.fluid = strcmp(fluid, "none") != 0;
    v.darcy = strcmp(fluid, "darcy") == 0;
    v.navier_stokes = strcmp(fluid, "navier_stokes") == 0;
    v.linear = strcmp(scene_text(s, "modules", NULL, "contact"), "linear") == 0;
    const vec3 size = scene_vector(s, "domain", NULL, "size");
    v.size[0] = size.x;
    v.size[1] = size.y;
    v.size[2] = size.z;
    static const char *const sides[] = {"x", "y", "z"};
    for (int a = 0; a < 3; a++)
        v.periodic[a] = scene_word(s, "domain", NULL, sides[a], "periodic");
    v.gravity = v3_norm(scene_vector(s, "domain", NULL, "gravity"));
    scene_cells(s, "domain", NULL, "cells", v.cells);
    read_species(&v);
    v.n_materials = scene_names(s, "material", &v.material);
    v.rho = scene_real(s, "fluid", NULL, "density");
    v.mu = scene_real(s, "fluid", NULL, "viscosity");
    v.fluid_dt = real_or_0(s, "fluid", NULL, "dt");
    v.grain_dt = real_or_0(s, "run", NULL, "dt");
    v.inflow = scene_real(s, "flow", NULL, "velocity");
    v.end = scene_real(s, "run", NULL, "end");
    return v;
}

void view_free(struct view *v)
{
    scene_free(v->scene);
}
