/* analysis_meters.c - [meter NAME]: grains, mass and momentum that pass through a plane, summed and
 * per time, by species.
 *
 * A grain passes when its centre changes sides between two calls of step(); one that comes back
 * is taken off again. Across a periodic side a distance jumps by the size of the box: that is
 * no passing. */
#include <gsl/gsl_fit.h>
#include <stdio.h>
#include <string.h>
#include "analysis.h"
#include "meter.h"
#include "sim.h"

static const struct key keys[] = {
    {"meter", "point", KEY_VECTOR, "m", "(-inf, inf)", NULL, "a point of the plane"},
    {"meter", "normal", KEY_VECTOR, "1", "(-inf, inf)", NULL,
     "its normal; what passes along it counts as positive"},
    {"meter", "from", KEY_VECTOR, "m", "box | (-inf, inf)", "box",
     "lowest corner of what is looked at; default: all of the plane"},
    {"meter", "to", KEY_VECTOR, "m", "box | (-inf, inf)", "box", "its highest corner"},
    {"meter", "after", KEY_REAL, "s", "(-inf, inf)", "0 s",
     "the mean rate of the summary is fitted from here"},
    {"meter", "until", KEY_REAL, "s", "end | (-inf, inf)", "end", "to here"},
    {0},
};

enum { SERIES = 4, NAMES = SERIES + 2 };

struct state {
    int n;
    struct meter *meter;
    double *after, *until; /* s */
    char **name;           /* NAMES per meter */
    struct table **table;
};

static void read_meter(struct sim *s, struct scene *scene, struct meter *m)
{
    const vec3 normal = scene_vector(scene, "meter", m->name, "normal");
    const double length = v3_norm(normal), far = (double)INFINITY;
    m->point = scene_vector(scene, "meter", m->name, "point");
    m->normal = length > 0.0 ? v3_scale(1.0 / length, normal) : v3(0.0, 0.0, 1.0);
    if (!(length > 0.0) && scene_given(scene, "meter", m->name, "normal"))
        scene_error(scene, "meter", m->name, "normal", "must not be zero");
    m->from = scene_word(scene, "meter", m->name, "from", "box")
                  ? v3(-far, -far, -far)
                  : scene_vector(scene, "meter", m->name, "from");
    m->to = scene_word(scene, "meter", m->name, "to", "box")
                ? v3(far, far, far)
                : scene_vector(scene, "meter", m->name, "to");
    m->width = far;
    const double along[3] = {m->normal.x, m->normal.y, m->normal.z};
    for (int a = 0; a < 3; a++)
        if (s->domain.periodic[a] && along[a] != 0.0)
            m->width = fmin(m->width, s->domain.size[a] * fabs(along[a]));
}

static void register_meter(struct sim *s, struct state *p, int k)
{
    struct meter *const m = &p->meter[k];
    const struct {
        const char *name, *unit, *text;
        const double *value;
    } list[SERIES] = {{"count", "1", "grains that passed", &m->count},
                      {"mass", "kg", "mass that passed", &m->mass},
                      {"rate", "kg s-1", "mass that passes per time", &m->rate},
                      {"momentum", "kg m s-1", "momentum that passed", &m->momentum}};
    const struct table pattern = {.n_columns = 3,
                                  .column = {{"species", "1", "index of the species"},
                                             {"count", "1", "grains of it that passed"},
                                             {"mass", "kg", "their mass"}}};
    char **const name = &p->name[k * NAMES];
    for (int c = 0; c < SERIES; c++) {
        name[c] = xprintf("%s_%s", m->name, list[c].name);
        series_add(&s->series, name[c], list[c].unit, list[c].text, list[c].value);
    }
    name[SERIES] = xprintf("%s_passed", m->name);
    p->table[k] = tables_add(&s->tables, &pattern);
    p->table[k]->name = name[SERIES];
    p->table[k]->title = name[SERIES];
    name[SERIES + 1] = xprintf("%s_distance", m->name);
    m->distance = xalloc((size_t)s->grains.capacity, sizeof *m->distance);
    fields_add(&s->fields,
               (struct field){name[SERIES + 1], "m", "distance from the plane of a meter",
                              PLACE_GRAIN, KIND_REAL, (void **)&m->distance, FIELD_STATE});
    m->n_species = s->grains.n_species;
    m->count_of = xalloc(2 * (size_t)m->n_species + 1, sizeof *m->count_of);
    m->mass_of = m->count_of + m->n_species;
}

static void *create(struct sim *s, struct scene *scene)
{
    const char *const *names;
    const int n = scene_names(scene, "meter", &names);
    if (n == 0)
        return NULL;
    struct state *const p = xalloc(1, sizeof *p);
    const size_t room = (size_t)n;
    p->n = n;
    p->meter = xalloc(room, sizeof *p->meter);
    p->after = xalloc(2 * room, sizeof *p->after);
    p->until = p->after + n;
    p->name = xalloc(room * NAMES, sizeof *p->name);
    p->table = xalloc(room, sizeof(struct table *));
    for (int k = 0; k < n; k++) {
        struct meter *const m = &p->meter[k];
        snprintf(m->name, sizeof m->name, "%.31s", names[k]);
        if (strlen(names[k]) >= sizeof m->name)
            scene_error(scene, "meter", names[k], NULL, "the name must be shorter than 32");
        else
            read_meter(s, scene, m);
        p->after[k] = scene_real(scene, "meter", names[k], "after");
        p->until[k] = scene_word(scene, "meter", names[k], "until", "end")
                          ? (double)INFINITY
                          : scene_real(scene, "meter", names[k], "until");
        register_meter(s, p, k);
    }
    return p;
}

static double distance(const struct sim *s, const struct meter *m, int i)
{
    const vec3 d = domain_minimum_image(&s->domain, v3_sub(s->grains.pos[i], m->point));
    const double x = v3_dot(d, m->normal);
    return x != 0.0 ? x : 1e-300; /* 0 is kept for grains not seen yet */
}

static bool looked_at(const struct sim *s, const struct meter *m, int i)
{
    const vec3 x = domain_wrap(&s->domain, s->grains.pos[i]);
    return x.x >= m->from.x && x.x <= m->to.x && x.y >= m->from.y && x.y <= m->to.y &&
           x.z >= m->from.z && x.z <= m->to.z;
}

static void pass(const struct sim *s, struct meter *m, int i, double sign)
{
    const struct grains *const g = &s->grains;
    m->count += sign;
    m->mass += sign * g->mass[i];
    m->momentum += sign * g->mass[i] * v3_dot(g->vel[i], m->normal);
    m->count_of[g->kind[i]] += sign;
    m->mass_of[g->kind[i]] += sign * g->mass[i];
}

static void watch_meter(struct sim *s, struct meter *m)
{
    for (int i = 0; i < s->grains.n; i++) {
        const double now = distance(s, m, i), before = m->distance[i];
        m->distance[i] = now;
        if (before == 0.0 || (now > 0.0) == (before > 0.0) ||
            fabs(now - before) > 0.25 * m->width || !looked_at(s, m, i))
            continue;
        pass(s, m, i, now > 0.0 ? 1.0 : -1.0);
    }
}

static void watch(struct sim *s, void *state)
{
    struct state *const p = state;
    for (int k = 0; k < p->n; k++)
        watch_meter(s, &p->meter[k]);
}

static void start(struct sim *s, void *state)
{
    struct state *const p = state;
    for (int k = 0; k < p->n; k++)
        for (int i = 0; i < s->grains.n; i++)
            p->meter[k].distance[i] = distance(s, &p->meter[k], i);
}

static void sample(struct sim *s, void *state)
{
    struct state *const p = state;
    for (int k = 0; k < p->n; k++) {
        struct meter *const m = &p->meter[k];
        const int last = m->samples - 1;
        const double t0 = last >= 0 ? m->time[last] : 0.0;
        const double before = last >= 0 ? m->passed[last] : 0.0;
        m->rate = s->t > t0 ? (m->mass - before) / (s->t - t0) : 0.0;
        if (m->samples == m->room) {
            const int more = 2 * m->room + 64;
            m->time = xrealloc(m->time, (size_t)m->room, (size_t)more, sizeof *m->time);
            m->passed = xrealloc(m->passed, (size_t)m->room, (size_t)more, sizeof *m->passed);
            m->room = more;
        }
        m->time[m->samples] = s->t;
        m->passed[m->samples++] = m->mass;
    }
}

double meter_slope(const struct meter *m, double t0, double t1, double *error)
{
    int first = 0, n = 0;
    while (first < m->samples && m->time[first] < t0)
        first++;
    while (first + n < m->samples && m->time[first + n] <= t1)
        n++;
    *error = (double)NAN;
    if (n < 3)
        return (double)NAN;
    double c0, c1, c00, c01, c11, rest;
    gsl_fit_linear(m->time + first, 1, m->passed + first, 1, (size_t)n, &c0, &c1, &c00, &c01,
                   &c11, &rest);
    *error = sqrt(c11);
    return c1;
}

static void report(struct sim *s, void *state)
{
    struct state *const p = state;
    static const char *const unit[SERIES] = {"1", "kg", "kg s-1", "kg m s-1"};
    for (int k = 0; k < p->n; k++) {
        struct meter *const m = &p->meter[k];
        double error;
        const double slope = meter_slope(m, p->after[k], p->until[k], &error);
        const double value[SERIES] = {m->count, m->mass, slope, m->momentum};
        for (int c = 0; c < SERIES; c++)
            summary_number(&s->summary, p->name[k * NAMES + c], value[c], unit[c]);
        for (int sp = 0; sp < m->n_species; sp++)
            table_row(p->table[k], (const double[]){sp, m->count_of[sp], m->mass_of[sp]});
    }
}

static void release(void *state)
{
    struct state *const p = state;
    for (int k = 0; k < p->n; k++) {
        xfree(p->meter[k].distance);
        xfree(p->meter[k].count_of);
        xfree(p->meter[k].time);
        xfree(p->meter[k].passed);
    }
    for (int c = 0; c < p->n * NAMES; c++)
        xfree(p->name[c]);
    void *const all[] = {p->meter, p->after, p->name, p->table, p};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

const struct analysis_part analysis_meters = {.name = "meters",
                                              .keys = keys,
                                              .create = create,
                                              .start = start,
                                              .watch = watch,
                                              .sample = sample,
                                              .report = report,
                                              .free = release};

const struct meter *meter_find(const struct sim *s, const char *name)
{
    for (int k = 0; analysis_parts[k]; k++) {
        const struct state *const p = s->analysis.state[k];
        if (analysis_parts[k] != &analysis_meters || !p)
            continue;
        for (int m = 0; m < p->n; m++)
            if (strcmp(p->meter[m].name, name) == 0)
                return &p->meter[m];
    }
    return NULL;
}
