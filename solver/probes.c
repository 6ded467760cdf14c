/* probes.c - measures the fluid, see probes.h. */
#include "probes.h"

#include <math.h>
#include <string.h>
#include "sample.h"

#define KINDS "point | line | plane | drop | permeability"

const struct key probe_keys[] = {
    {"probe", "kind", KEY_CHOICE, "", KINDS, "point", "what is measured"},
    {"probe", "at", KEY_VECTOR, "m", "[0, inf)", "0 0 0 m", "the point; where a line begins"},
    {"probe", "to", KEY_VECTOR, "m", "[0, inf)", "0 0 0 m", "where a line ends"},
    {"probe", "points", KEY_INT, "", "[2, 100000]", "101", "of a line"},
    {"probe", "axis", KEY_CHOICE, "", "x | y | z", "z", "across which the planes lie"},
    {"probe", "position", KEY_REAL, "m", "[0, inf)", "0 m", "of a plane along its axis"},
    {"probe", "low", KEY_REAL, "m", "[0, inf)", "0 m", "the first of two planes"},
    {"probe", "high", KEY_REAL, "m", "side | [0, inf)", "side",
     "the second; side: the far end"},
    {"probe", "tolerance", KEY_REAL, "1", "(0, 1)", "1e-4",
     "relative change at which a permeability has converged"},
    {"probe", "over", KEY_REAL, "s", "auto | (0, inf)", "auto",
     "the time over which it may change so much; auto: a hundredth of the run"},
    {"probe", "stop", KEY_CHOICE, "", "no | yes", "no",
     "yes: the run ends when it has converged"},
    {0},
};

enum probe_kind { POINT, LINE, PLANE, DROP, PERMEABILITY };

enum { VALUES = 6 };

/* A value that is followed. */
struct value {
    char *name, *unit;
    double now, sum, least, most;
};

struct probe {
    char *name;
    enum probe_kind kind;
    vec3 at, to;
    int points, axis, values;
    double position, low, high, tolerance, over;
    bool stop, converged;
    double k_before, t_before, t_converged;
    struct value value[VALUES];
    char *figure, *title, *table;
};

struct probes {
    int n;
    long samples;
    struct probe *probe;
};

static const char *const component_name[3] = {"velocity_x", "velocity_y", "velocity_z"};

static void check_inside(const struct sim *s, struct scene *scene, const char *name,
                         const char *key, vec3 x)
{
    const double at[3] = {x.x, x.y, x.z};
    for (int a = 0; a < 3; a++)
        if (at[a] > s->domain.size[a])
            scene_error(scene, "probe", name, key, "lies outside the box in %c", 'x' + a);
}

static void read_planes(const struct sim *s, struct scene *scene, struct probe *p)
{
    const char *const name = p->name;
    const double size = s->domain.size[p->axis];
    p->position = scene_real(scene, "probe", name, "position");
    p->low = scene_real(scene, "probe", name, "low");
    p->high = scene_word(scene, "probe", name, "high", "side")
                  ? size
                  : scene_real(scene, "probe", name, "high");
    if (p->position > size)
        scene_error(scene, "probe", name, "position", "lies outside the box, %g m", size);
    if (p->high > size)
        scene_error(scene, "probe", name, "high", "lies outside the box, %g m", size);
    if (p->kind >= DROP && p->high <= p->low)
        scene_error(scene, "probe", name, "high", "must lie beyond probe.low");
}

static void read_probe(const struct sim *s, struct scene *scene, struct probe *p,
                       const char *name)
{
    p->name = xstrdup(name);
    if (strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") !=
        strlen(name))
        scene_error(scene, "probe", name, NULL, "its name is of letters, digits and _");
    p->kind = (enum probe_kind)scene_choice(scene, "probe", name, "kind");
    p->at = scene_vector(scene, "probe", name, "at");
    p->to = scene_vector(scene, "probe", name, "to");
    p->points = scene_int(scene, "probe", name, "points");
    p->axis = scene_choice(scene, "probe", name, "axis");
    p->tolerance = scene_real(scene, "probe", name, "tolerance");
    p->over = scene_word(scene, "probe", name, "over", "auto")
                  ? s->run.end / 100.0
                  : scene_real(scene, "probe", name, "over");
    p->stop = scene_choice(scene, "probe", name, "stop") == 1;
    check_inside(s, scene, name, "at", p->at);
    check_inside(s, scene, name, "to", p->to);
    read_planes(s, scene, p);
    if (!s->fluid.exists)
        scene_error(scene, "probe", name, NULL, "probes measure a fluid, and there is none");
    if (p->kind == LINE && v3_norm(v3_sub(p->to, p->at)) == 0.0)
        scene_error(scene, "probe", name, "to", "must differ from probe.at");
    if (p->stop && p->kind != PERMEABILITY)
        scene_error(scene, "probe", name, "stop", "only a permeability ends a run");
}

static void add_value(struct sim *s, struct probe *p, const char *what, const char *unit,
                      const char *long_name)
{
    struct value *const v = &p->value[p->values++];
    v->name = xprintf("%s_%s", p->name, what);
    v->unit = xstrdup(unit);
    v->now = (double)NAN;
    v->least = (double)INFINITY;
    v->most = -(double)INFINITY;
    series_add(&s->series, v->name, v->unit, long_name, &v->now);
}

static void register_values(struct sim *s, struct probe *p)
{
    switch (p->kind) {
    case POINT:
        add_value(s, p, "pressure", "Pa", "pressure at the point");
        for (int a = 0; a < 3; a++)
            add_value(s, p, component_name[a], "m s-1", "velocity at the point");
        add_value(s, p, "porosity", "1", "fluid fraction at the point");
        break;
    case PLANE:
        add_value(s, p, "pressure", "Pa", "mean pressure of the plane");
        add_value(s, p, "flux", "m s-1", "mean superficial velocity through the plane");
        add_value(s, p, "porosity", "1", "mean fluid fraction of the plane");
        break;
    case DROP:
        add_value(s, p, "drop", "Pa", "pressure drop between the planes");
        break;
    case PERMEABILITY:
        add_value(s, p, "drop", "Pa", "pressure drop between the planes");
        add_value(s, p, "flux", "m s-1", "superficial velocity between the planes");
        add_value(s, p, "permeability", "m2", "permeability between the planes");
        add_value(s, p, "change", "1", "its relative change over the last span");
        break;
    case LINE:
        break;
    }
}

void probes_create(struct sim *s, struct scene *scene)
{
    const char *const *names;
    scene_declare(scene, probe_keys);
    const int n = scene_names(scene, "probe", &names);
    s->probes = xalloc(1, sizeof *s->probes);
    s->probes->n = n;
    s->probes->probe = xalloc((size_t)n + 1, sizeof *s->probes->probe);
    for (int i = 0; i < n; i++)
        read_probe(s, scene, &s->probes->probe[i], names[i]);
    for (int i = 0; i < n && scene_errors(scene) == 0; i++)
        register_values(s, &s->probes->probe[i]);
}

void probes_free(struct sim *s)
{
    for (int i = 0; s->probes && i < s->probes->n; i++) {
        struct probe *const p = &s->probes->probe[i];
        for (int k = 0; k < p->values; k++) {
            xfree(p->value[k].name);
            xfree(p->value[k].unit);
        }
        void *const all[] = {p->name, p->figure, p->title, p->table};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            xfree(all[k]);
    }
    if (s->probes)
        xfree(s->probes->probe);
    xfree(s->probes);
}

static double drop_between(const struct sim *s, const struct probe *p)
{
    const vec3 g = s->flow.gradient;
    const double drive = p->axis == 0 ? g.x : p->axis == 1 ? g.y : g.z;
    return plane_pressure(s, p->axis, p->low) - plane_pressure(s, p->axis, p->high) +
           drive * (p->high - p->low);
}

/* Permeability now, and whether it still changes. */
static void measure_permeability(struct sim *s, struct probe *p)
{
    const double drop = drop_between(s, p), length = p->high - p->low;
    const double flux = plane_flux(s, p->axis, 0.5 * (p->low + p->high));
    const double k = s->fluid.mu * flux * length / drop;
    p->value[0].now = drop;
    p->value[1].now = flux;
    p->value[2].now = k;
    if (s->t < p->t_before + p->over * (1.0 - 1e-9))
        return;
    if (p->t_before > 0.0 || p->k_before != 0.0) {
        const double change = fabs(k / p->k_before - 1.0);
        p->value[3].now = change;
        if (change <= p->tolerance && !p->converged) {
            p->converged = true;
            p->t_converged = s->t;
            s->run.done = s->run.done || p->stop;
        }
    }
    p->k_before = k;
    p->t_before = s->t;
}

static void measure(struct sim *s, struct probe *p)
{
    switch (p->kind) {
    case POINT:
        p->value[0].now = sample_pressure(s, p->at);
        for (int a = 0; a < 3; a++)
            p->value[1 + a].now = sample_velocity(s, a, p->at);
        p->value[4].now = sample_porosity(s, p->at);
        break;
    case PLANE:
        p->value[0].now = plane_pressure(s, p->axis, p->position);
        p->value[1].now = plane_flux(s, p->axis, p->position);
        p->value[2].now = plane_porosity(s, p->axis, p->position);
        break;
    case DROP:
        p->value[0].now = drop_between(s, p);
        break;
    case PERMEABILITY:
        measure_permeability(s, p);
        break;
    case LINE:
        break;
    }
}

void probes_watch(struct sim *s)
{
    if (!s->fluid.on || s->probes->n == 0)
        return;
    for (int i = 0; i < s->probes->n; i++) {
        struct probe *const p = &s->probes->probe[i];
        measure(s, p);
        for (int k = 0; k < p->values; k++) {
            struct value *const v = &p->value[k];
            v->sum += v->now;
            v->least = v->now < v->least ? v->now : v->least;
            v->most = v->now > v->most ? v->now : v->most;
        }
    }
    s->probes->samples++;
}

enum { COLUMNS = 9 };

/* The profile along a line: a table with its figure. */
static void report_line(struct sim *s, struct probe *p)
{
    p->figure = xprintf("%s.png", p->name);
    p->title = xprintf("along the line %s", p->name);
    p->table = xprintf("line_%s", p->name);
    const struct table pattern = {
        .name = p->table,
        .title = p->title,
        .n_columns = COLUMNS,
        .column = {{"distance", "m", "from where the line begins"},
                   {"x", "m", "x of the point"},
                   {"y", "m", "y of the point"},
                   {"z", "m", "z of the point"},
                   {"velocity_x", "m s-1", "velocity of the fluid, x"},
                   {"velocity_y", "m s-1", "velocity of the fluid, y"},
                   {"velocity_z", "m s-1", "velocity of the fluid, z"},
                   {"pressure", "Pa", "pressure without its hydrostatic part"},
                   {"porosity", "1", "fluid fraction"}},
        .figure = {.file = p->figure,
                   .title = p->title,
                   .x = "distance",
                   .x_label = "distance / m",
                   .y_label = "velocity / (m/s)",
                   .n_curves = 3,
                   .curve = {{"velocity_x", "line", "x"},
                             {"velocity_y", "line", "y"},
                             {"velocity_z", "line", "z"}}}};
    struct table *const t = tables_add(&s->tables, &pattern);
    const vec3 along = v3_sub(p->to, p->at);
    for (int i = 0; i < p->points; i++) {
        const double part = (double)i / (p->points - 1);
        const vec3 x = v3_axpy(p->at, part, along);
        double row[COLUMNS] = {part * v3_norm(along), x.x, x.y, x.z};
        for (int a = 0; a < 3; a++)
            row[4 + a] = sample_velocity(s, a, x);
        row[7] = sample_pressure(s, x);
        row[8] = sample_porosity(s, x);
        table_row(t, row);
    }
}

static void report_values(struct sim *s, const struct probe *p)
{
    for (int k = 0; k < p->values; k++) {
        const struct value *const v = &p->value[k];
        const struct {
            const char *suffix;
            double x;
        } line[] = {{"", v->now},
                    {"_mean", v->sum / (double)s->probes->samples},
                    {"_least", v->least},
                    {"_most", v->most}};
        const bool many = p->kind != PERMEABILITY;
        for (int l = 0; l < (many ? 4 : 1); l++) {
            char *const key = xprintf("%s%s", v->name, line[l].suffix);
            summary_number(&s->summary, key, line[l].x, v->unit);
            xfree(key);
        }
    }
    if (p->kind != PERMEABILITY)
        return;
    char *const key = xprintf("%s_converged", p->name);
    summary_text(&s->summary, key, "%s", p->converged ? "yes" : "no");
    xfree(key);
    printf("probe %s: permeability %.6g m2, %s\n", p->name, p->value[2].now,
           p->converged ? "converged" : "NOT converged");
}

void probes_report(struct sim *s)
{
    for (int i = 0; i < s->probes->n && s->probes->samples > 0; i++) {
        struct probe *const p = &s->probes->probe[i];
        if (p->kind == LINE)
            report_line(s, p);
        else
            report_values(s, p);
    }
}
