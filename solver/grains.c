/* grains.c - species and materials of a scene, and the arrays of the grains. */
#include "grains.h"

#include <string.h>
#include "../shapes/shape.h"
#include "contact_path.h"
#include "fill.h"
#include "sim.h"
#include "turning.h"

#define FILLS "lattice | random | settle | grow | unit_cell | point | file"

const struct key grains_keys[] = {
    {"grains", "density", KEY_REAL, "kg m-3", "(0, inf)", NULL, "density of the solid"},
    {"grains", "count", KEY_INT, "", "[0, 100000000]", "1",
     "how many (unit_cell and file: as many as there are)"},
    {"grains", "mass", KEY_REAL, "kg", "auto | (0, inf)", "auto",
     "mass of all of them, in place of count: met to half a grain"},
    {"grains", "porosity", KEY_REAL, "1", "auto | (0, 1)", "auto",
     "porosity of their region, in place of count"},
    {"grains", "fill", KEY_CHOICE, "", FILLS, "lattice", "how the grains are placed"},
    {"grains", "overlap", KEY_REAL, "1", "(0, 0.1]", "1e-3",
     "of the smaller diameter, that fill = grow may leave: more of it, a denser packing"},
    {"grains", "frozen", KEY_CHOICE, "", "no | yes", "no", "a fixed skeleton that never moves"},
    {"grains", "material", KEY_TEXT, "", "", "",
     "its material; default: the species' own name"},
    {"grains", "from", KEY_VECTOR, "m", "box | (-inf, inf)", "box",
     "lowest corner of its region"},
    {"grains", "to", KEY_VECTOR, "m", "box | (-inf, inf)", "box",
     "highest corner of its region"},
    {"grains", "position", KEY_VECTOR, "m", "centre | (-inf, inf)", "centre",
     "centre of the grain for fill = point; centre: that of the region"},
    {"grains", "spacing", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "edge of the lattice (auto: 1.05 d) or of the unit cell (auto: neighbours touch)"},
    {"grains", "cell", KEY_CHOICE, "", "simple_cubic | bcc | fcc", "simple_cubic",
     "unit cell for fill = unit_cell"},
    {"grains", "file", KEY_TEXT, "", "", "",
     "for fill = file: a bed.nc or run.nc of silt (its last grains), or text with x y z "
     "diameter "
     "in m a line"},
    {"grains", "file_species", KEY_TEXT, "", "", "",
     "the species to take from the file; default: the one of the same name"},
    {"grains", "velocity", KEY_VECTOR, "m s-1", "(-inf, inf)", "0 0 0 m/s", "at the start"},
    {"grains", "spin", KEY_VECTOR, "rad s-1", "(-inf, inf)", "0 0 0 rad/s", "at the start"},
    {0},
};

static int find_material(struct grains *g, const char *name)
{
    for (int m = 0; m < g->n_materials; m++)
        if (strcmp(g->materials[m].name, name) == 0)
            return m;
    return -1;
}

static int add_material(struct grains *g, const char *name)
{
    g->materials = xrealloc(g->materials, (size_t)g->n_materials, (size_t)g->n_materials + 1,
                            sizeof *g->materials);
    snprintf(g->materials[g->n_materials].name, NAME_LENGTH, "%s", name);
    return g->n_materials++;
}

/* Materials: those of the species in order, then the other [material] sections (walls). */
static void read_species(struct sim *s, struct scene *scene)
{
    struct grains *const g = &s->grains;
    const char *const *names;
    g->n_species = scene_names(scene, "grains", &names);
    g->species = xalloc((size_t)g->n_species + 1, sizeof *g->species);
    for (int i = 0; i < g->n_species; i++) {
        struct species *const sp = &g->species[i];
        if (strlen(names[i]) >= NAME_LENGTH)
            scene_error(scene, "grains", names[i], NULL,
                        "the name must be shorter than %d letters", NAME_LENGTH);
        snprintf(sp->name, NAME_LENGTH, "%.*s", NAME_LENGTH - 1, names[i]);
        sizes_read(&sp->sizes, scene, names[i]);
        sp->diameter = sizes_by_mass(&sp->sizes, 0.5);
        sp->largest = sp->sizes.largest;
        sp->density = scene_real(scene, "grains", names[i], "density");
        sp->count = scene_int(scene, "grains", names[i], "count");
        sp->frozen = scene_choice(scene, "grains", names[i], "frozen") == 1;
        const char *material = scene_text(scene, "grains", names[i], "material");
        if (material[0] == '\0')
            material = sp->name;
        sp->material = find_material(g, material);
        if (sp->material < 0)
            sp->material = add_material(g, material);
    }
    const char *const *others;
    const int n = scene_names(scene, "material", &others);
    for (int i = 0; i < n; i++)
        if (find_material(g, others[i]) < 0)
            add_material(g, others[i]);
}

static void read_forms(struct grains *g, struct scene *scene)
{
    struct shape_form *const form = xalloc((size_t)g->n_species + 1, sizeof *form);
    for (int k = 0; k < g->n_species; k++)
        form[k] = (struct shape_form){.bounding = 1.0,
                                      .inertia = {0.4, 0.4, 0.4},
                                      .axes = quat_one(),
                                      /* a shape with nothing to read is a sphere */
                                      .sphericity = shape.init ? (double)NAN : 1.0,
                                      .points_most = 1};
    if (shape.init)
        shape.init(scene, g, form);
    if (shape.path->turning) {
        scene_declare(scene, shape.path->turning->keys);
        shape.path->turning->read(g, scene);
    }
    for (int k = 0; k < g->n_species; k++)
        g->species[k].form = form[k];
    xfree(form);
}

static void register_fields(struct sim *s)
{
    struct grains *const g = &s->grains;
    const int state = FIELD_STATE, both = FIELD_STATE | FIELD_OUTPUT;
    const struct field list[] = {
        {"grain_id", "1", "identity of the grain", PLACE_GRAIN, KIND_INT, (void **)&g->id,
         state},
        {"species", "1", "index of the species", PLACE_GRAIN, KIND_INT, (void **)&g->kind,
         state},
        {"position", "m", "centre of the grain", PLACE_GRAIN, KIND_VEC3, (void **)&g->pos,
         both},
        {"velocity", "m s-1", "velocity of the grain", PLACE_GRAIN, KIND_VEC3, (void **)&g->vel,
         both},
        {"spin", "rad s-1", "angular velocity of the grain", PLACE_GRAIN, KIND_VEC3,
         (void **)&g->spin, both},
        {"force", "N", "force on the grain without its weight", PLACE_GRAIN, KIND_VEC3,
         (void **)&g->force, both},
        {"torque", "N m", "torque on the grain", PLACE_GRAIN, KIND_VEC3, (void **)&g->torque,
         state},
        {"fluid_load", "N", "force of the fluid on the grain", PLACE_GRAIN, KIND_VEC3,
         (void **)&g->load, state},
        {"fluid_torque", "N m", "torque of the fluid on the grain", PLACE_GRAIN, KIND_VEC3,
         (void **)&g->load_torque, state},
        {"radius", "m", "bounding radius", PLACE_GRAIN, KIND_REAL, (void **)&g->radius, state},
        {"mass", "kg", "mass", PLACE_GRAIN, KIND_REAL, (void **)&g->mass, state},
        {"inverse_mass", "kg-1", "0 for a frozen grain", PLACE_GRAIN, KIND_REAL,
         (void **)&g->inv_mass, state},
        {"inverse_inertia", "kg-1 m-2", "0 for a frozen grain", PLACE_GRAIN, KIND_REAL,
         (void **)&g->inv_inertia, state},
        {"grain_volume", "m3", "volume", PLACE_GRAIN, KIND_REAL, (void **)&g->volume, state},
    };
    const struct field turn[] = {
        {"orientation", "1", "w x y z, the quaternion that turns the body's axes to the box's",
         PLACE_GRAIN, KIND_QUAT, (void **)&g->orientation, both},
        {"principal_inertia", "kg m2", "principal moments of inertia", PLACE_GRAIN, KIND_VEC3,
         (void **)&g->inertia, state},
        {"angular_momentum", "kg m2 s-1", "angular momentum within a step", PLACE_GRAIN,
         KIND_VEC3, (void **)&g->momentum, 0},
        {"full_spin", "rad s-1", "predicted angular velocity", PLACE_GRAIN, KIND_VEC3,
         (void **)&g->full_spin, state}};
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        fields_add(&s->fields, list[i]);
    for (size_t i = 0; g->orientation && i < sizeof turn / sizeof turn[0]; i++)
        fields_add(&s->fields, turn[i]);
}

static void allocate(struct grains *g, int n)
{
    g->n = g->capacity = n;
    g->id = xalloc((size_t)n, sizeof *g->id);
    g->kind = xalloc((size_t)n, sizeof *g->kind);
    vec3 **const vectors[] = {&g->pos,    &g->vel,  &g->spin,       &g->force,
                              &g->torque, &g->load, &g->load_torque};
    double **const numbers[] = {&g->radius, &g->mass, &g->inv_mass, &g->inv_inertia,
                                &g->volume};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        *vectors[i] = xalloc((size_t)n, sizeof(vec3));
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        *numbers[i] = xalloc((size_t)n, sizeof(double));
    if (!shape.path->turning)
        return;
    g->orientation = xalloc((size_t)n, sizeof *g->orientation);
    g->inertia = xalloc((size_t)n, sizeof *g->inertia);
    g->momentum = xalloc((size_t)n, sizeof *g->momentum);
    g->full_spin = xalloc((size_t)n, sizeof *g->full_spin);
}

void grains_follow(struct grains *g, void **data, size_t size)
{
    g->follower = xrealloc(g->follower, (size_t)g->n_followers, (size_t)g->n_followers + 1,
                           sizeof *g->follower);
    g->follower[g->n_followers++] = (struct follower){data, size};
    *data = xalloc((size_t)g->capacity + 1, size);
}

void grains_reserve(struct sim *s, int n)
{
    struct grains *const g = &s->grains;
    if (n <= g->capacity)
        return;
    const size_t old = (size_t)g->capacity, more = (size_t)n + (size_t)n / 2 + 64;
    for (int f = 0; f < s->fields.n; f++) {
        const struct field *const field = &s->fields.field[f];
        if (field->place == PLACE_GRAIN)
            *field->data = xrealloc(*field->data, old, more, kind_size(field->kind));
    }
    for (int f = 0; f < g->n_followers; f++)
        *g->follower[f].data =
            xrealloc(*g->follower[f].data, old + 1, more + 1, g->follower[f].size);
    g->capacity = (int)more;
}

int *grains_order(const struct grains *g)
{
    int *const at = xalloc((size_t)g->next_id + 1, sizeof *at); /* index + 1 of an id */
    int *const order = xalloc((size_t)g->n + 1, sizeof *order);
    int n = 0;
    for (int i = 0; i < g->n; i++)
        at[g->id[i]] = i + 1;
    for (int id = 0; id < g->next_id; id++)
        if (at[id] > 0)
            order[n++] = at[id] - 1;
    xfree(at);
    return order;
}

void species_count(struct species *k, double diameter)
{
    if (k->n_made == k->room) {
        const int more = 2 * k->room + 64;
        k->made = xrealloc(k->made, (size_t)k->room, (size_t)more, sizeof *k->made);
        k->room = more;
    }
    k->made[k->n_made++] = diameter;
    k->count++;
}

double grains_widest(const struct grains *g)
{
    double widest = 0.0;
    for (int i = 0; i < g->n; i++)
        widest = fmax(widest, g->radius[i]);
    for (int k = 0; k < g->n_species; k++)
        widest = fmax(widest, 0.5 * g->species[k].largest * g->species[k].form.bounding);
    return widest;
}

#define PI 3.14159265358979323846

double grains_volume(int species, double diameter)
{
    return shape.volume ? shape.volume(species, diameter)
                        : PI / 6.0 * diameter * diameter * diameter;
}

void grains_body(struct grains *g, int i, double diameter)
{
    const struct species *const sp = &g->species[g->kind[i]];
    const double size = 0.5 * diameter;
    g->radius[i] = size * sp->form.bounding;
    g->volume[i] = grains_volume(g->kind[i], diameter);
    g->mass[i] = sp->density * g->volume[i];
    const double scale = g->mass[i] * size * size;
    const vec3 inertia = sp->form.inertia;
    const bool round = inertia.x == inertia.y && inertia.y == inertia.z;
    g->inv_mass[i] = 1.0 / g->mass[i];
    g->inv_inertia[i] =
        1.0 / (scale * (round ? inertia.x : (inertia.x + inertia.y + inertia.z) / 3.0));
    if (g->inertia)
        g->inertia[i] = v3_scale(scale, inertia);
}

static void make_bodies(struct grains *g, struct scene *scene, const struct fill *f,
                        unsigned long seed)
{
    const char *const *names;
    const int species = scene_names(scene, "grains", &names);
    vec3 *const velocity = xalloc(2 * (size_t)species + 1, sizeof *velocity);
    vec3 *const spin = velocity + species;
    for (int k = 0; k < species; k++) {
        velocity[k] = scene_vector(scene, "grains", names[k], "velocity");
        spin[k] = scene_vector(scene, "grains", names[k], "spin");
    }
    for (int i = 0; i < g->n; i++) {
        const struct placed *const p = &f->grain[i];
        const struct species *const sp = &g->species[p->species];
        g->id[i] = i;
        g->kind[i] = p->species;
        g->pos[i] = p->pos;
        grains_body(g, i, p->diameter / sp->form.bounding);
        if (sp->frozen) {
            g->inv_mass[i] = g->inv_inertia[i] = 0.0;
            g->n_frozen++;
        } else if (i < f->n_motion && !isnan(f->vel[i].x)) {
            g->vel[i] = f->vel[i];
            g->spin[i] = f->spin[i];
        } else {
            g->vel[i] = velocity[p->species];
            g->spin[i] = spin[p->species];
        }
        if (!g->orientation)
            continue;
        shape.path->turning->place(g, i, seed);
        if (i < f->n_motion && f->turn && !isnan(f->turn[i].w))
            g->orientation[i] = f->turn[i];
        g->full_spin[i] = g->spin[i];
    }
    xfree(velocity);
}

void grains_create(struct sim *s, struct scene *scene)
{
    struct grains *const g = &s->grains;
    scene_declare(scene, grains_keys);
    scene_declare(scene, sizes_keys);
    read_species(s, scene);
    read_forms(g, scene);
    struct fill f = {0};
    /* Placing grains needs sound numbers: with errors on the list they stay out. */
    if (scene_errors(scene) == 0)
        fill(s, scene, &f);
    const int n = f.n;
    allocate(g, n);
    make_bodies(g, scene, &f, s->run.seed);
    g->next_id = n;
    for (int i = 0; i < g->n_species; i++)
        g->species[i].count = 0;
    for (int i = 0; i < n; i++)
        species_count(&g->species[g->kind[i]],
                      f.grain[i].diameter / g->species[g->kind[i]].form.bounding);
    register_fields(s);
    fill_free(&f);
}

void grains_free(struct sim *s)
{
    struct grains *const g = &s->grains;
    if (shape.free)
        shape.free();
    for (int k = 0; k < g->n_species; k++)
        xfree(g->species[k].made), sizes_free(&g->species[k].sizes);
    void *const all[] = {g->id,        g->kind,     g->pos,         g->vel,         g->spin,
                         g->force,     g->torque,   g->load,        g->load_torque, g->radius,
                         g->mass,      g->inv_mass, g->inv_inertia, g->volume,      g->species,
                         g->materials, g->follower, g->orientation, g->inertia,     g->momentum,
                         g->full_spin};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}
