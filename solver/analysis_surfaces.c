/* analysis_surfaces.c - [surface NAME]: angle and height of a free surface as time series; its points
 * at the end as a table with a figure. How they are found is in surface.h. */
#include <stdio.h>
#include <string.h>
#include "analysis.h"
#include "sim.h"
#include "surface.h"

static const struct key keys[] = {
    {"surface", "kind", KEY_CHOICE, "", "heap | ridge | slope", "heap",
     "a cone about an axis, a roof about a plane, or one slope (a drum, a chute)"},
    {"surface", "axis", KEY_CHOICE, "", "x | y", "x", "along which a ridge or a slope falls"},
    {"surface", "centre", KEY_VECTOR, "m", "box | (-inf, inf)", "box",
     "its middle (z is not looked at); default: that of the box"},
    {"surface", "cell", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "edge of a column, whose highest grain is a point; auto: two mean diameters"},
    {"surface", "base", KEY_REAL, "m", "(-inf, inf)", "0 m", "z on which a heap stands"},
    {"surface", "low", KEY_REAL, "1", "[0, 1)", "20 %",
     "the line is fitted down to this part of the height of a heap"},
    {"surface", "high", KEY_REAL, "1", "(0, 1]", "80 %", "from this part"},
    {"surface", "middle", KEY_REAL, "1", "(0, 1]", "50 %",
     "the line is fitted over this middle part of a slope"},
    {"surface", "from", KEY_VECTOR, "m", "box | (-inf, inf)", "box",
     "lowest corner of what is looked at; default: the box"},
    {"surface", "to", KEY_VECTOR, "m", "box | (-inf, inf)", "box",
     "its highest corner, as below a funnel"},
    {"surface", "flying", KEY_CHOICE, "", "off | on", "off",
     "grains that touch nothing count too"},
    {0},
};

enum { SERIES = 2, NAMES = SERIES + 2 };

struct state {
    int n;
    struct surface *surface;
    char **name; /* NAMES per surface */
    struct table **table;
};

static void read_surface(struct sim *s, struct scene *scene, struct surface *f)
{
    const char *const name = f->name;
    const struct grains *const g = &s->grains;
    f->kind = (enum surface_kind)scene_choice(scene, "surface", name, "kind");
    f->axis = scene_choice(scene, "surface", name, "axis");
    const vec3 centre = scene_word(scene, "surface", name, "centre", "box")
                            ? v3(0.5 * s->domain.size[0], 0.5 * s->domain.size[1], 0.0)
                            : scene_vector(scene, "surface", name, "centre");
    f->centre[0] = centre.x;
    f->centre[1] = centre.y;
    f->base = scene_real(scene, "surface", name, "base");
    f->low = scene_real(scene, "surface", name, "low");
    f->high = scene_real(scene, "surface", name, "high");
    f->middle = scene_real(scene, "surface", name, "middle");
    f->from = v3(-(double)INFINITY, -(double)INFINITY, -(double)INFINITY);
    f->to = v3((double)INFINITY, (double)INFINITY, (double)INFINITY);
    if (!scene_word(scene, "surface", name, "from", "box"))
        f->from = scene_vector(scene, "surface", name, "from");
    if (!scene_word(scene, "surface", name, "to", "box"))
        f->to = scene_vector(scene, "surface", name, "to");
    if (!(f->from.x < f->to.x && f->from.y < f->to.y && f->from.z < f->to.z))
        scene_error(scene, "surface", name, "to", "must lie above surface.from in x, y and z");
    f->flying = scene_choice(scene, "surface", name, "flying") == 1;
    double mean = 0.0;
    for (int k = 0; k < g->n_species; k++)
        mean = fmax(mean, g->species[k].diameter);
    f->cell = scene_word(scene, "surface", name, "cell", "auto")
                  ? 2.0 * mean
                  : scene_real(scene, "surface", name, "cell");
    if (f->low >= f->high)
        scene_error(scene, "surface", name, "low", "must be less than surface.high");
    const vec3 down = s->domain.gravity;
    if (down.x * down.x + down.y * down.y > 1e-24 * v3_dot(down, down) || down.z > 0.0)
        scene_error(scene, "domain", NULL, "gravity", "must point along -z for [surface %s]",
                    name);
}

static const struct table pattern = {
    .n_columns = 2,
    .column = {{"place", "m", "distance from the middle, or place along the axis", true},
               {"height", "m", "height of the surface over its base", true}},
    .figure = {.x = "place",
               .x_label = "distance from the middle / m",
               .y_label = "height / m",
               .n_curves = 1,
               .curve = {{"height", "points", "tops of columns"}}}};

static void register_surface(struct sim *s, struct state *p, int k)
{
    struct surface *const f = &p->surface[k];
    char **const name = &p->name[k * NAMES];
    name[0] = xprintf("%s_angle", f->name);
    name[1] = xprintf("%s_height", f->name);
    name[2] = xprintf("%s_points", f->name);
    name[3] = xprintf("%s.png", f->name);
    series_add(&s->series, name[0], "degree", "angle of the surface", &f->angle);
    series_add(&s->series, name[1], "m", "highest point of the surface over its base",
               &f->height);
    p->table[k] = tables_add(&s->tables, &pattern);
    p->table[k]->name = name[2];
    p->table[k]->title = "free surface at the end";
    p->table[k]->figure.file = name[3];
    p->table[k]->figure.title = "free surface at the end";
}

static void *create(struct sim *s, struct scene *scene)
{
    const char *const *names;
    const int n = scene_names(scene, "surface", &names);
    if (n == 0)
        return NULL;
    contact_view_wanted(s);
    struct state *const p = xalloc(1, sizeof *p);
    p->n = n;
    p->surface = xalloc((size_t)n, sizeof *p->surface);
    p->name = xalloc((size_t)n * NAMES, sizeof *p->name);
    p->table = xalloc((size_t)n, sizeof(struct table *));
    for (int k = 0; k < n; k++) {
        struct surface *const f = &p->surface[k];
        snprintf(f->name, sizeof f->name, "%.31s", names[k]);
        if (strlen(names[k]) >= sizeof f->name)
            scene_error(scene, "surface", names[k], NULL, "the name must be shorter than 32");
        else
            read_surface(s, scene, f);
        register_surface(s, p, k);
    }
    return p;
}

static void sample(struct sim *s, void *state)
{
    struct state *const p = state;
    const struct contact_view *const v = contact_view(s);
    for (int k = 0; k < p->n; k++) {
        int n;
        xfree(surface_measure(s, v, &p->surface[k], &n));
    }
}

static double place(const struct surface *f, const double *p)
{
    const double x = p[0] - f->centre[0], y = p[1] - f->centre[1];
    if (f->kind == SURFACE_HEAP)
        return sqrt(x * x + y * y);
    return f->axis == 0 ? x : y;
}

static void report(struct sim *s, void *state)
{
    struct state *const p = state;
    const struct contact_view *const v = contact_view(s);
    for (int k = 0; k < p->n; k++) {
        struct surface *const f = &p->surface[k];
        int n;
        double *const point = surface_measure(s, v, f, &n);
        for (int c = 0; c < n; c++)
            table_row(p->table[k],
                      (const double[]){place(f, &point[3 * c]), point[3 * c + 2] - f->base});
        xfree(point);
        summary_number(&s->summary, p->name[k * NAMES], f->angle, "degree");
        summary_number(&s->summary, p->name[k * NAMES + 1], f->height, "m");
    }
}

static void release(void *state)
{
    struct state *const p = state;
    for (int c = 0; c < p->n * NAMES; c++)
        xfree(p->name[c]);
    xfree(p->name);
    xfree(p->table);
    xfree(p->surface);
    xfree(p);
}

const struct analysis_part analysis_surfaces = {.name = "surfaces",
                                                .keys = keys,
                                                .create = create,
                                                .sample = sample,
                                                .report = report,
                                                .free = release};

const struct surface *surface_find(const struct sim *s, const char *name)
{
    for (int k = 0; analysis_parts[k]; k++) {
        const struct state *const p = s->analysis.state[k];
        if (analysis_parts[k] != &analysis_surfaces || !p)
            continue;
        for (int m = 0; m < p->n; m++)
            if (strcmp(p->surface[m].name, name) == 0)
                return &p->surface[m];
    }
    return NULL;
}
