/* walls.c - planes that bound the grains. Every side of the box that is not periodic is one, so
 * is every [wall NAME]: a point and a normal towards the grains. */
#include "walls.h"

#include <stdio.h>
#include <string.h>
#include "sim.h"

const struct key wall_keys[] = {
    {"wall", "point", KEY_VECTOR, "m", "(-inf, inf)", NULL, "a point of the plane"},
    {"wall", "normal", KEY_VECTOR, "1", "(-inf, inf)", NULL, "its normal, towards the grains"},
    {"wall", "velocity", KEY_VECTOR, "m s-1", "(-inf, inf)", "0 0 0 m/s",
     "velocity of the wall in its own plane"},
    {"wall", "material", KEY_TEXT, "", "", "",
     "its material; default: \"wall\" if there is one, or that of the first species"},
    {0},
};

static int material_index(struct sim *s, const char *name)
{
    for (int m = 0; m < s->grains.n_materials; m++)
        if (strcmp(s->grains.materials[m].name, name) == 0)
            return m;
    return -1;
}

static int default_material(struct sim *s)
{
    const int m = material_index(s, "wall");
    return m >= 0 ? m : 0;
}

static void add_sides(struct sim *s)
{
    for (int side = 0; side < 6; side++) {
        const int axis = side / 2;
        if (s->domain.periodic[axis] || s->domain.side[side].open)
            continue;
        struct wall *const w = &s->walls.wall[s->walls.n++];
        *w = (struct wall){.material = default_material(s),
                           .velocity = s->domain.side[side].velocity};
        snprintf(w->name, sizeof w->name, "%s", side_name[side]);
        const double at = side % 2 ? s->domain.size[axis] : 0.0;
        const double to = side % 2 ? -1.0 : 1.0;
        w->point = v3(axis == 0 ? at : 0.0, axis == 1 ? at : 0.0, axis == 2 ? at : 0.0);
        w->normal = v3(axis == 0 ? to : 0.0, axis == 1 ? to : 0.0, axis == 2 ? to : 0.0);
    }
}

static void add_named(struct sim *s, struct scene *scene, const char *name)
{
    struct wall w = {.material = default_material(s)};
    snprintf(w.name, sizeof w.name, "%s", name);
    w.point = scene_vector(scene, "wall", name, "point");
    w.velocity = scene_vector(scene, "wall", name, "velocity");
    const vec3 normal = scene_vector(scene, "wall", name, "normal");
    const double length = v3_norm(normal);
    if (length > 0.0)
        w.normal = v3_scale(1.0 / length, normal);
    else if (scene_given(scene, "wall", name, "normal"))
        scene_error(scene, "wall", name, "normal", "must not be zero");
    if (fabs(v3_dot(w.normal, w.velocity)) > 1e-12 * v3_norm(w.velocity))
        scene_error(scene, "wall", name, "velocity", "must lie in the plane of the wall");
    const char *material = scene_text(scene, "wall", name, "material");
    if (material[0] != '\0') {
        w.material = material_index(s, material);
        if (w.material < 0) {
            scene_error(scene, "wall", name, "material", "there is no [material %s]", material);
            w.material = 0;
        }
    }
    if (s->walls.n == WALLS_MAX)
        scene_error(scene, "wall", name, NULL, "more than %d walls", WALLS_MAX);
    else
        s->walls.wall[s->walls.n++] = w;
}

void walls_create(struct sim *s, struct scene *scene)
{
    scene_declare(scene, wall_keys);
    add_sides(s);
    const char *const *names;
    const int n = scene_names(scene, "wall", &names);
    for (int i = 0; i < n; i++)
        add_named(s, scene, names[i]);
}

vec3 wall_distance(const struct sim *s, int element, vec3 x)
{
    const struct wall *const w = &s->walls.wall[element];
    return v3_scale(v3_dot(v3_sub(x, w->point), w->normal), w->normal);
}

int walls_near(const struct sim *s, int i, double margin, int *out)
{
    const struct grains *const g = &s->grains;
    int n = 0;
    if (g->inv_mass[i] == 0.0)
        return 0;
    for (int k = 0; k < s->walls.n; k++) {
        const struct wall *const w = &s->walls.wall[k];
        if (v3_dot(v3_sub(g->pos[i], w->point), w->normal) < g->radius[i] + margin)
            out[n++] = k;
    }
    return n;
}

void walls_impulse(vec3 *force, vec3 *sum, vec3 *impulse, vec3 now, int steps, double dt)
{
    if (steps > 0)
        *impulse = v3_axpy(*impulse, dt, v3_add(*sum, v3_scale(0.5, v3_sub(*force, now))));
    *force = now;
    *sum = v3(0.0, 0.0, 0.0);
}
