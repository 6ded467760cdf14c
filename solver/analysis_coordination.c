/* analysis_coordination.c - contacts per grain: the mean with and without rattlers, the histogram,
 * the number of each grain.
 *
 *   Z = (2 N_pairs + N_walls) / N
 *
 * over the N grains that move. A rattler has fewer than output.rattlers contacts; those of
 * rattlers do not count for others, so they are sought again until none is left [OHern03]. A
 * frictionless sphere needs 4, one with friction 2: so by default. */
#include <string.h>
#include "../contact/contact.h"
#include "analysis.h"
#include "sim.h"

static const struct key keys[] = {
    {"output", "coordination", KEY_CHOICE, "", "off | on", "off",
     "contacts per grain: mean, with and without rattlers, histogram, of each grain"},
    {"output", "rattlers", KEY_INT, "", "auto | [0, 12]", "auto",
     "a grain with fewer contacts (those with other rattlers not counted) carries nothing; "
     "auto: 2 where grains have friction, else 4"},
    {0},
};

enum { MOST = 400 }; /* contacts of a grain in the histogram; 50:1 in size gives thousands */

struct coordination {
    int least;
    int *count;          /* per grain; a field */
    int *bearing;        /* per grain, scratch: contacts with grains that are no rattlers */
    double mean;         /* of all grains that move */
    double mean_bearing; /* of those that are no rattlers */
    double rattlers;     /* part of the grains */
    struct table *histogram;
};

static const struct table pattern = {
    .name = "coordination",
    .title = "contacts per grain at the end",
    .n_columns = 3,
    .column = {{"contacts", "1", "contacts of a grain"},
               {"grains", "1", "grains that have so many"},
               {"share", "1", "part of the grains"}},
    .figure = {.file = "coordination.png",
               .title = "contacts per grain at the end",
               .x = "contacts",
               .x_label = "contacts of a grain",
               .y_label = "part of the grains",
               .n_curves = 1,
               .curve = {{"share", "points", "part of the grains"}}}};

static bool has_friction(const struct sim *s, struct scene *scene)
{
    for (int m = 0; m < s->grains.n_materials && contact_history > 0; m++) {
        const char *const name = s->grains.materials[m].name;
        if (strcmp(name, "wall") != 0 && scene_given(scene, "material", name, "friction") &&
            scene_real(scene, "material", name, "friction") > 0.0)
            return true;
    }
    return false;
}

static void *create(struct sim *s, struct scene *scene)
{
    const bool on = scene_choice(scene, "output", NULL, "coordination") == 1;
    const int least = scene_word(scene, "output", NULL, "rattlers", "auto")
                          ? (has_friction(s, scene) ? 2 : 4)
                          : scene_int(scene, "output", NULL, "rattlers");
    if (!on)
        return NULL;
    struct coordination *const c = xalloc(1, sizeof *c);
    contact_view_wanted(s);
    c->least = least;
    c->count = xalloc((size_t)s->grains.capacity + 1, sizeof *c->count);
    grains_follow(&s->grains, (void **)&c->bearing, sizeof *c->bearing);
    fields_add(&s->fields,
               (struct field){"coordination", "1", "contacts of the grain", PLACE_GRAIN,
                              KIND_INT, (void **)&c->count, FIELD_OUTPUT});
    series_add(&s->series, "coordination_mean", "1", "contacts per grain", &c->mean);
    series_add(&s->series, "coordination_bearing", "1", "contacts per grain, without rattlers",
               &c->mean_bearing);
    series_add(&s->series, "rattlers", "1", "part of the grains that are rattlers",
               &c->rattlers);
    c->histogram = tables_add(&s->tables, &pattern);
    return c;
}

/* Contacts that count: those that touch, or across whose gap a law acts. */
static bool counts(const struct seen *v)
{
    return v->depth >= 0.0 || v3_dot(v->force, v->force) > 0.0;
}

/* Contacts of each grain with those that `alive` holds; returns whether one fell under `least`. */
static bool count_bearing(const struct sim *s, const struct contact_view *v, int least,
                          const unsigned char *alive, unsigned char *next, int *count)
{
    bool fell = false;
    memset(count, 0, (size_t)s->grains.n * sizeof *count);
    for (size_t k = 0; k < v->n; k++) {
        const struct seen *const c = &v->seen[k];
        if (!counts(c) || !alive[c->i] || (c->j >= 0 && !alive[c->j]))
            continue;
        count[c->i]++;
        if (c->j >= 0)
            count[c->j]++;
    }
    for (int i = 0; i < s->grains.n; i++) {
        next[i] = alive[i] && (count[i] >= least || s->grains.inv_mass[i] == 0.0);
        fell = fell || next[i] != alive[i];
    }
    return fell;
}

static void sample(struct sim *s, void *state)
{
    struct coordination *const c = state;
    const struct contact_view *const v = contact_view(s);
    const struct grains *const g = &s->grains;
    unsigned char *const alive = xalloc(2 * (size_t)g->n + 1, 1), *const next = alive + g->n;
    double all = 0.0, bearing = 0.0;
    int moving = 0, left = 0;
    memset(alive, 1, (size_t)g->n);
    bool more = count_bearing(s, v, c->least, alive, next, c->count);
    memcpy(c->bearing, c->count, (size_t)g->n * sizeof *c->bearing);
    while (more) {
        memcpy(alive, next, (size_t)g->n);
        more = count_bearing(s, v, c->least, alive, next, c->bearing);
    }
    for (int i = 0; i < g->n; i++) {
        if (g->inv_mass[i] == 0.0)
            continue;
        moving++;
        left += alive[i];
        all += c->count[i];
        bearing += alive[i] ? c->bearing[i] : 0;
    }
    c->mean = moving > 0 ? all / moving : 0.0;
    c->mean_bearing = left > 0 ? bearing / left : 0.0;
    c->rattlers = moving > 0 ? 1.0 - (double)left / moving : 0.0;
    xfree(alive);
}

static void record(struct sim *s, void *state, struct output_file *f)
{
    (void)f;
    sample(s, state);
}

static void report(struct sim *s, void *state)
{
    struct coordination *const c = state;
    const struct grains *const g = &s->grains;
    int grains[MOST + 1] = {0}, most = 0, moving = 0;
    sample(s, state);
    for (int i = 0; i < g->n; i++) {
        if (g->inv_mass[i] == 0.0)
            continue;
        const int k = c->count[i] < MOST ? c->count[i] : MOST;
        most = k > most ? k : most;
        grains[k]++;
        moving++;
    }
    for (int k = 0; moving > 0 && k <= most; k++)
        table_row(c->histogram, (const double[]){k, grains[k], (double)grains[k] / moving});
    summary_number(&s->summary, "coordination_mean", c->mean, "1");
    summary_number(&s->summary, "coordination_bearing", c->mean_bearing, "1");
    summary_number(&s->summary, "rattlers", c->rattlers, "1");
}

static void release(void *state)
{
    struct coordination *const c = state;
    xfree(c->count);
    xfree(c->bearing);
    xfree(c);
}

const struct analysis_part analysis_coordination = {.name = "coordination",
                                                    .keys = keys,
                                                    .create = create,
                                                    .sample = sample,
                                                    .record = record,
                                                    .report = report,
                                                    .free = release};
