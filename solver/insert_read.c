/* insert_read.c - the reading of [insert NAME] and [delete NAME]; what they did, to the summary. */
#include "insert.h"

#include <string.h>
#include "sim.h"

#define PI      3.14159265358979323846
#define SHAPES  "box | sphere | cylinder | disc"
#define CROWDED 0.2 /* of the region, solid of a batch: more seldom finds room */

const struct key insert_keys[] = {
    {"insert", "species", KEY_TEXT, "", "", "", "species of the grains; default: the first"},
    {"insert", "shape", KEY_CHOICE, "", SHAPES, "box", "of the region where grains appear"},
    {"insert", "from", KEY_VECTOR, "m", "box | (-inf, inf)", "box", "lowest corner of a box"},
    {"insert", "to", KEY_VECTOR, "m", "box | (-inf, inf)", "box", "highest corner of a box"},
    {"insert", "centre", KEY_VECTOR, "m", "middle | (-inf, inf)", "middle",
     "centre of a sphere, cylinder or disc"},
    {"insert", "axis", KEY_VECTOR, "1", "(-inf, inf)", "0 0 1", "of a cylinder or disc"},
    {"insert", "radius", KEY_REAL, "m", "none | (0, inf)", "none",
     "of a sphere, cylinder or disc; grains are wholly inside"},
    {"insert", "length", KEY_REAL, "m", "none | (0, inf)", "none", "of a cylinder"},
    {"insert", "rate", KEY_REAL, "s-1", "none | (0, inf)", "none", "grains per time"},
    {"insert", "mass_flow", KEY_REAL, "kg s-1", "none | (0, inf)", "none", "or mass per time"},
    {"insert", "count", KEY_REAL, "1", "unlimited | [1, 1e9]", "unlimited", "grains, at most"},
    {"insert", "mass", KEY_REAL, "kg", "unlimited | (0, inf)", "unlimited", "mass, at most"},
    {"insert", "start", KEY_REAL, "s", "[0, inf)", "0 s", "time of the beginning"},
    {"insert", "end", KEY_REAL, "s", "never | (0, inf)", "never", "time of the end"},
    {"insert", "velocity", KEY_VECTOR, "m s-1", "(-inf, inf)", "0 0 0 m/s", "of the grains"},
    {"insert", "scatter", KEY_REAL, "m s-1", "[0, inf)", "0 m/s",
     "each component of the velocity varies by up to this, evenly"},
    {"insert", "every", KEY_REAL, "s", "auto | (0, inf)", "auto",
     "time between batches; auto: 100 steps of the grains"},
    {"insert", "patience", KEY_REAL, "s", "(0, inf)", "0.1 s",
     "a grain that is late by so much for want of room stops the run"},
    {"delete", "species", KEY_TEXT, "", "", "", "species to remove; default: any"},
    {"delete", "shape", KEY_CHOICE, "", SHAPES " | plane", "box",
     "of the region where grains vanish; plane: all that is behind it"},
    {"delete", "from", KEY_VECTOR, "m", "box | (-inf, inf)", "box", "lowest corner of a box"},
    {"delete", "to", KEY_VECTOR, "m", "box | (-inf, inf)", "box", "highest corner of a box"},
    {"delete", "centre", KEY_VECTOR, "m", "middle | (-inf, inf)", "middle",
     "centre of a sphere or cylinder, or a point of a plane"},
    {"delete", "axis", KEY_VECTOR, "1", "(-inf, inf)", "0 0 1",
     "of a cylinder; normal of a plane, towards what stays"},
    {"delete", "radius", KEY_REAL, "m", "none | (0, inf)", "none", "of a sphere or cylinder"},
    {"delete", "length", KEY_REAL, "m", "none | (0, inf)", "none", "of a cylinder"},
    {"delete", "outside", KEY_CHOICE, "", "no | yes", "no",
     "yes: what is not in the region vanishes"},
    {0},
};

static int read_species(struct sim *s, struct scene *scene, const char *section,
                        const char *name, int standard)
{
    const char *const asked = scene_text(scene, section, name, "species");
    if (asked[0] == '\0')
        return standard;
    for (int k = 0; k < s->grains.n_species; k++)
        if (strcmp(s->grains.species[k].name, asked) == 0)
            return k;
    scene_error(scene, section, name, "species", "there is no [grains %s]", asked);
    return standard;
}

static double limit(struct scene *scene, const char *name, const char *key, const char *word)
{
    return scene_word(scene, "insert", name, key, word)
               ? (double)INFINITY
               : scene_real(scene, "insert", name, key);
}

/* The region lies in the box (beyond a periodic side it goes on at the other) and is wide enough. */
static void check_region(struct sim *s, struct scene *scene, const struct source *o)
{
    vec3 lo, hi;
    insert_region_bounds(&o->region, &lo, &hi);
    const double low[3] = {lo.x, lo.y, lo.z}, high[3] = {hi.x, hi.y, hi.z};
    for (int a = 0; a < 3; a++)
        if (!s->domain.periodic[a] &&
            (low[a] < -1e-12 || high[a] > s->domain.size[a] * (1.0 + 1e-12)))
            scene_error(scene, "insert", o->name, NULL,
                        "the region leaves the box in %c: it reaches from %g to %g m", 'x' + a,
                        low[a], high[a]);
    const struct species *const k = &s->grains.species[o->species];
    const double largest = k->largest * k->form.bounding;
    if (insert_region_room(&o->region) < 0.5 * largest)
        scene_error(scene, "insert", o->name, NULL,
                    "the region is narrower than the largest grain, %g m", largest);
}

/* A batch must leave room in its region. */
static void check_batch(struct sim *s, struct scene *scene, const struct source *o)
{
    const struct species *const k = &s->grains.species[o->species];
    const double volume = insert_region_volume(&o->region);
    const double solid = o->rate > 0.0 ? o->rate * PI / 6.0 * k->sizes.mean_cube
                                       : o->mass_flow / k->density; /* m3/s */
    const double most =
        fmin(solid * fmax(o->every_time, 0.0), o->count_most * k->sizes.mean_cube);
    if (volume > 0.0 && most > CROWDED * volume)
        scene_error(
            scene, "insert", o->name, o->rate > 0.0 ? "rate" : "mass_flow",
            "a batch (%g s) would fill %.3g %% of the region; at most %.3g %% find room: a "
            "larger region, or a shorter `every`",
            o->every_time, 100.0 * most / volume, 100.0 * CROWDED);
}

static void read_source(struct sim *s, struct scene *scene, const char *name, struct source *o)
{
    *o = (struct source){.waits = -1.0};
    snprintf(o->name, sizeof o->name, "%.31s", name);
    o->species = read_species(s, scene, "insert", name, 0);
    insert_region_read(s, scene, "insert", name, &o->region);
    const bool rate = !scene_word(scene, "insert", name, "rate", "none");
    const bool flow = !scene_word(scene, "insert", name, "mass_flow", "none");
    o->rate = rate ? scene_real(scene, "insert", name, "rate") : 0.0;
    o->mass_flow = flow ? scene_real(scene, "insert", name, "mass_flow") : 0.0;
    if (rate == flow)
        scene_error(scene, "insert", name, rate ? "rate" : NULL,
                    "give one of rate and mass_flow");
    o->count_most = limit(scene, name, "count", "unlimited");
    o->mass_most = limit(scene, name, "mass", "unlimited");
    o->start = scene_real(scene, "insert", name, "start");
    o->end = limit(scene, name, "end", "never");
    if (!(o->end > o->start))
        scene_error(scene, "insert", name, "end", "must be after start, %g s", o->start);
    o->velocity = scene_vector(scene, "insert", name, "velocity");
    o->scatter = scene_real(scene, "insert", name, "scatter");
    o->every_time = scene_word(scene, "insert", name, "every", "auto")
                        ? -1.0
                        : scene_real(scene, "insert", name, "every");
    o->patience = scene_real(scene, "insert", name, "patience");
    o->next_batch = o->start;
    if (s->grains.n_species == 0)
        scene_error(scene, "insert", name, "species", "there is no [grains NAME] to insert");
    else if (s->grains.species[o->species].frozen)
        scene_error(scene, "insert", name, "species", "frozen grains cannot be inserted");
    else if (scene_errors(scene) == 0) {
        check_region(s, scene, o);
        check_batch(s, scene, o);
    }
}

static void read_sinks(struct sim *s, struct scene *scene)
{
    struct traffic *const t = &s->traffic;
    const char *const *names;
    const int n = scene_names(scene, "delete", &names);
    t->sink = xalloc((size_t)n + 6, sizeof *t->sink);
    for (int i = 0; i < n; i++) {
        struct sink *const k = &t->sink[t->n_sinks++];
        *k = (struct sink){.side = -1};
        snprintf(k->name, sizeof k->name, "%.31s", names[i]);
        k->species = read_species(s, scene, "delete", names[i], -1);
        insert_region_read(s, scene, "delete", names[i], &k->region);
        k->outside = scene_choice(scene, "delete", names[i], "outside") == 1;
    }
    for (int side = 0; side < 6; side++)
        if (s->domain.side[side].open) {
            struct sink *const k = &t->sink[t->n_sinks++];
            *k = (struct sink){.side = side, .species = -1};
            snprintf(k->name, sizeof k->name, "%s", side_name[side]);
        }
}

static void add_series(struct sim *s)
{
    struct traffic *const t = &s->traffic;
    series_add(&s->series, "grains_at_hand", "1", "grains at hand", &t->grains);
    series_add(&s->series, "grains_inserted", "1", "grains that came", &t->inserted);
    series_add(&s->series, "grains_removed", "1", "grains that went", &t->removed);
    series_add(&s->series, "mass_inserted", "kg", "mass that came", &t->mass_in);
    series_add(&s->series, "mass_removed", "kg", "mass that went", &t->mass_out);
    for (int k = 0; k < t->n_sources; k++) {
        struct source *const o = &t->source[k];
        static const char *const what[2][2] = {{"asked", "grains due from this source"},
                                               {"done", "grains that came from it"}};
        for (int i = 0; i < 2; i++) {
            o->series[i] = xprintf("insert_%s_%s", o->name, what[i][0]);
            series_add(&s->series, o->series[i], "1", what[i][1], i ? &o->done : &o->asked);
        }
    }
}

void insert_create(struct sim *s, struct scene *scene)
{
    struct traffic *const t = &s->traffic;
    const char *const *names;
    scene_declare(scene, insert_keys);
    const int n = scene_names(scene, "insert", &names);
    t->source = xalloc((size_t)n + 1, sizeof *t->source);
    for (int i = 0; i < n; i++)
        read_source(s, scene, names[i], &t->source[t->n_sources++]);
    read_sinks(s, scene);
    t->grains = s->grains.n;
    if (insert_changes(s))
        add_series(s);
}

void insert_free(struct sim *s)
{
    for (int k = 0; k < s->traffic.n_sources; k++)
        for (int i = 0; i < 2; i++)
            xfree(s->traffic.source[k].series[i]);
    xfree(s->traffic.source);
    xfree(s->traffic.sink);
}

/* Grains that a source will have been asked for by the end. */
static double expected_of(const struct sim *s, const struct source *o, double mean)
{
    const double time = fmax(0.0, fmin(s->run.end, o->end) - o->start);
    const double n = o->rate > 0.0 ? o->rate * time : o->mass_flow * time / mean;
    return floor(fmin(n, fmin(o->count_most, o->mass_most / mean)));
}

/* kg, of a grain of a source. */
static double mean_mass(const struct sim *s, const struct source *o)
{
    const struct species *const sp = &s->grains.species[o->species];
    return sp->density * grains_volume(o->species, cbrt(sp->sizes.mean_cube));
}

double insert_expected(const struct sim *s)
{
    double n = 0.0;
    for (int k = 0; k < s->traffic.n_sources; k++) {
        const struct source *const o = &s->traffic.source[k];
        n += expected_of(s, o, mean_mass(s, o));
    }
    return n;
}

void insert_expect(FILE *out, const struct sim *s)
{
    for (int k = 0; k < s->traffic.n_sources; k++) {
        const struct source *const o = &s->traffic.source[k];
        const struct species *const sp = &s->grains.species[o->species];
        const double mean = mean_mass(s, o), n = expected_of(s, o, mean);
        fprintf(
            out,
            "insert %s: about %.0f grains of %s, %.4g kg, by t = %g s; D10 %.4g, D50 %.4g, D90 "
            "%.4g m by mass\n",
            o->name, n, sp->name, n * mean, fmin(s->run.end, o->end),
            sizes_by_mass(&sp->sizes, 0.1), sizes_by_mass(&sp->sizes, 0.5),
            sizes_by_mass(&sp->sizes, 0.9));
    }
}

/* What each species was made of, by mass: asked sizes are judged by these. */
static void report_sizes(struct sim *s)
{
    char key[64];
    for (int k = 0; k < s->grains.n_species; k++) {
        const struct species *const sp = &s->grains.species[k];
        const size_t n = (size_t)sp->n_made;
        double *const d = xalloc(n + 1, sizeof *d), mass = 0.0;
        for (size_t i = 0; i < n; i++) {
            d[i] = sp->made[i];
            mass += sp->density * grains_volume(k, d[i]);
        }
        snprintf(key, sizeof key, "%.31s_made", sp->name);
        summary_number(&s->summary, key, sp->n_made, "1");
        snprintf(key, sizeof key, "%.31s_mass", sp->name);
        summary_number(&s->summary, key, mass, "kg");
        for (int q = 10; q <= 90 && n > 0; q += 40) {
            snprintf(key, sizeof key, "%.31s_d%d", sp->name, q);
            summary_number(&s->summary, key, sizes_measured(d, n, 0.01 * q), "m");
        }
        xfree(d);
    }
}

void insert_report(struct sim *s)
{
    struct traffic *const t = &s->traffic;
    char key[64];
    report_sizes(s);
    for (int k = 0; k < t->n_sources; k++) {
        const struct source *const o = &t->source[k];
        const struct {
            const char *what, *unit;
            double value;
        } line[] = {{"asked", "1", o->asked},
                    {"done", "1", o->done},
                    {"mass_asked", "kg", o->asked_mass},
                    {"mass_done", "kg", o->done_mass}};
        for (size_t i = 0; i < sizeof line / sizeof line[0]; i++) {
            snprintf(key, sizeof key, "insert_%s_%s", o->name, line[i].what);
            summary_number(&s->summary, key, line[i].value, line[i].unit);
        }
        if (o->rate > 0.0 && o->done < o->asked)
            fprintf(stderr, "silt: insert %s: %.0f grains are still owed, of %.0f asked\n",
                    o->name, o->asked - o->done, o->asked);
    }
    for (int k = 0; k < t->n_sinks; k++) {
        snprintf(key, sizeof key, "removed_%s", t->sink[k].name);
        summary_number(&s->summary, key, t->sink[k].removed, "1");
        snprintf(key, sizeof key, "removed_%s_mass", t->sink[k].name);
        summary_number(&s->summary, key, t->sink[k].removed_mass, "kg");
    }
}
