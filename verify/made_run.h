/* verify/made_run.h - a small run made by hand, for tests of what is written: five grains whose
 * order in memory is not that of their ids, a grid of 3 x 4 x 5 cells, values that tell where
 * they come from. */
#ifndef MADE_RUN_H
#define MADE_RUN_H

#include <netcdf.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "../solver/output.h"
#include "../solver/sim.h"
#include "check.h"

enum { GRAINS = 5, NX = 3, NY = 4, NZ = 5 };

static const int order[GRAINS] = {3, 0, 4, 1, 2}; /* ids in order of memory */
static char folder[] = "/tmp/silt-output-XXXXXX";
static double energy; /* a time series */

static inline double grain_value(int id, int component, double t)
{
    return 0.731 * id + 0.0173 * component + 2.385 * t;
}

static inline double cell_value(int i, int j, int k, double t)
{
    return 1.37 * i + 10.9 * j + 100.3 * k + 1000.7 * t;
}

static inline struct scene *made_scene(void)
{
    static const struct key keys[] = {
        {"fluid", "density", KEY_REAL, "kg m-3", "(0, inf)", "998.2 kg/m3", "density"}, {0}};
    char *const path = xprintf("%s/scene.ini", folder);
    FILE *const file = fopen(path, "w");
    if (!file)
        abort();
    fprintf(file, "[fluid]\ndensity = 871.3 kg/m3\n");
    fclose(file);
    struct scene *const scene = scene_load(path, 0, NULL);
    scene_declare(scene, keys);
    check_rel(scene_real(scene, "fluid", NULL, "density"), 871.3, 1e-15, "the scene is read");
    scene_finish(scene);
    xfree(path);
    return scene;
}

static inline void make_grains(struct sim *s)
{
    static struct species species[2] = {{.name = "glass"}, {.name = "steel"}};
    struct grains *const g = &s->grains;
    g->n = g->capacity = g->next_id = GRAINS;
    g->n_species = 2;
    g->species = species;
    g->id = xalloc(GRAINS, sizeof *g->id);
    g->kind = xalloc(GRAINS, sizeof *g->kind);
    g->pos = xalloc(GRAINS, sizeof *g->pos);
    g->radius = xalloc(GRAINS, sizeof *g->radius);
    g->mass = xalloc(GRAINS, sizeof *g->mass);
    for (int i = 0; i < GRAINS; i++) {
        g->id[i] = order[i];
        g->kind[i] = order[i] % 2;
        g->radius[i] = 1e-3 * (1.0 + order[i]);
        g->mass[i] = 1e-6 * (7.0 + order[i]);
    }
    fields_add(&s->fields,
               (struct field){"position", "m", "centre of the grain", PLACE_GRAIN, KIND_VEC3,
                              (void **)&g->pos, FIELD_OUTPUT | FIELD_STATE});
    fields_add(&s->fields, (struct field){"species_now", "1", "a whole number", PLACE_GRAIN,
                                          KIND_INT, (void **)&g->kind, FIELD_OUTPUT});
    fields_add(&s->fields, (struct field){"hidden", "kg", "for a restart only", PLACE_GRAIN,
                                          KIND_REAL, (void **)&g->mass, FIELD_STATE});
}

static inline void make_fluid(struct sim *s)
{
    static const char *const name[] = {"fluid_velocity_x", "fluid_velocity_y",
                                       "fluid_velocity_z"};
    s->fluid.exists = true;
    s->domain.cells[0] = NX, s->domain.cells[1] = NY, s->domain.cells[2] = NZ;
    grid_create(&s->grid, &s->domain);
    s->fluid.eps = grid_field(&s->grid);
    fields_add(&s->fields, (struct field){"fluid_fraction", "1", "fluid fraction", PLACE_CELL,
                                          KIND_REAL, (void **)&s->fluid.eps, FIELD_OUTPUT});
    for (int a = 0; a < 3; a++) {
        s->fluid.u[a] = grid_field(&s->grid);
        fields_add(&s->fields,
                   (struct field){name[a], "m s-1", "velocity", PLACE_FACE_X + a, KIND_REAL,
                                  (void **)&s->fluid.u[a], FIELD_OUTPUT});
    }
}

static inline void make_results(struct sim *s)
{
    const struct table pattern = {
        .name = "drop",
        .title = "pressure drop",
        .n_columns = 2,
        .column = {{"velocity", "m s-1", "superficial velocity"}, {"simulated", "Pa", "drop"}},
        .figure = {.file = "drop.png",
                   .title = "pressure drop",
                   .x = "velocity",
                   .x_label = "velocity / m s^{-1}",
                   .y_label = "drop / Pa",
                   .log_y = true,
                   .n_curves = 1,
                   .curve = {{"simulated", "points", "simulated"}}}};
    struct table *const t = tables_add(&s->tables, &pattern);
    table_row(t, (const double[]){0.00237, 31.9});
    table_row(t, (const double[]){0.00471, (double)NAN});
    table_row(t, (const double[]){0.00893, 127.3});
    series_add(&s->series, "kinetic_energy", "J", "kinetic energy", &energy);
    summary_number(&s->summary, "bed_porosity", 0.41237, "1");
    summary_number(&s->summary, "bed_height", 0.014875, "m");
    summary_text(&s->summary, "verdict", "%s", "within 1 % of the law");
}

/* The fields as they are at time t. Ghosts hold nonsense, which must not be written. */
static inline void set_state(struct sim *s, double t)
{
    const struct grid *const g = &s->grid;
    s->t = t;
    energy = 5.19 * t;
    for (int i = 0; i < s->grains.n; i++)
        s->grains.pos[i] = v3(grain_value(order[i], 0, t), grain_value(order[i], 1, t),
                              grain_value(order[i], 2, t));
    for (int k = 0; s->fluid.exists && k <= NZ + 1; k++)
        for (int j = 0; j <= NY + 1; j++)
            for (int i = 0; i <= NX + 1; i++) {
                const int c = cell(g, i, j, k);
                const bool ghost = i == 0 || j == 0 || k == 0 || i > NX || j > NY || k > NZ;
                s->fluid.eps[c] = ghost ? -1e30 : cell_value(i, j, k, t);
                for (int a = 0; a < 3; a++)
                    s->fluid.u[a][c] = cell_value(i, j, k, t) + 0.1 * (a + 1);
            }
}

static inline struct sim *made_sim(bool with_grains, bool with_fluid, const char *directory)
{
    struct sim *const s = sim_alloc();
    for (int a = 0; a < 3; a++)
        s->domain.size[a] = 0.012 * (a + 1);
    s->run.directory = xprintf("%s/%s", folder, directory);
    if (with_grains)
        make_grains(s);
    if (with_fluid)
        make_fluid(s);
    make_results(s);
    set_state(s, 0.0);
    return s;
}

static inline void free_made(struct sim *s)
{
    struct grains *const g = &s->grains;
    void *const all[] = {g->id,         g->kind,         g->pos,        g->radius,
                         g->mass,       s->fluid.eps,    s->fluid.u[0], s->fluid.u[1],
                         s->fluid.u[2], s->run.directory};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
    tables_free(&s->tables);
    fields_free(&s->fields);
    series_free(&s->series);
    summary_free(&s->summary);
    xfree(s);
}

static inline int open_nc(const char *directory, const char *name)
{
    char *const path = xprintf("%s/%s/%s", folder, directory, name);
    int nc = -1;
    const int status = nc_open(path, NC_NOWRITE, &nc);
    check(status == NC_NOERR, "%s/%s opens: %s", directory, name, nc_strerror(status));
    xfree(path);
    return nc;
}

/* An attribute as text; var NULL: a global one. */
static inline const char *attribute(int nc, const char *name, const char *key)
{
    static char text[8192];
    int var = NC_GLOBAL;
    size_t n = 0;
    memset(text, 0, sizeof text);
    if ((name && nc_inq_varid(nc, name, &var)) || nc_inq_attlen(nc, var, key, &n) ||
        n >= sizeof text || nc_get_att_text(nc, var, key, text))
        return "no such attribute";
    return text;
}

static inline void check_text(int nc, const char *name, const char *key, const char *want)
{
    const char *const got = attribute(nc, name, key);
    check(strcmp(got, want) == 0, "%s:%s is \"%s\", want \"%s\"", name ? name : "", key, got,
          want);
}

static inline double number(int nc, const char *name, const size_t at[])
{
    double x = (double)NAN;
    int var;
    if (nc_inq_varid(nc, name, &var) == NC_NOERR)
        nc_get_var1_double(nc, var, at, &x);
    return x;
}

static inline void clean_up(void)
{
    char *const clean = xprintf("rm -rf '%s'", folder);
    check(system(clean) == 0, "the files of the test are removed");
    xfree(clean);
}

#endif
