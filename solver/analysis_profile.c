/* analysis_profile.c - solid fraction over a direction, in slabs across the whole box:
 *
 *   phi_k = sum of the volumes of the grains between the planes of slab k / its volume
 *
 * exact for spheres; a grain of another shape counts as a sphere of its volume. */
#include "analysis.h"
#include "sim.h"
#include "sphere_box.h"

static const struct key keys[] = {
    {"output", "profile", KEY_CHOICE, "", "off | x | y | z", "off",
     "solid fraction over this direction, at the start and at the end"},
    {"output", "profile_bins", KEY_INT, "", "[1, 100000]", "50", "slabs of that profile"},
    {0},
};

struct slabs {
    int axis, bins;
    double *start, *end;
    struct table *table;
};

static const struct table pattern = {
    .name = "solid_profile",
    .title = "solid fraction in slabs",
    .n_columns = 3,
    .column = {{"position", "m", "middle of the slab", true},
               {"start", "1", "solid fraction at the start", true},
               {"end", "1", "solid fraction at the end", true}},
    .figure = {.file = "solid_profile.png",
               .title = "solid fraction",
               .x = "position",
               .x_label = "position / m",
               .y_label = "solid fraction",
               .n_curves = 2,
               .curve = {{"start", "line", "at the start"}, {"end", "line", "at the end"}}}};

static void *create(struct sim *s, struct scene *scene)
{
    const int axis = scene_choice(scene, "output", NULL, "profile") - 1;
    const int bins = scene_int(scene, "output", NULL, "profile_bins");
    if (axis < 0 || bins < 1)
        return NULL;
    struct slabs *const p = xalloc(1, sizeof *p);
    p->axis = axis;
    p->bins = bins;
    p->start = xalloc(2 * (size_t)bins, sizeof *p->start);
    p->end = p->start + bins;
    p->table = tables_add(&s->tables, &pattern);
    return p;
}

/* Adds what a ball at x has in the slabs; those beyond a periodic side are at the other. */
static void add_ball(const struct sim *s, const struct slabs *p, double x, double volume,
                     double *sum)
{
    const double radius = cbrt(3.0 * volume / (4.0 * 3.14159265358979323846));
    const double width = s->domain.size[p->axis] / p->bins;
    const int lo = (int)floor((x - radius) / width), hi = (int)floor((x + radius) / width);
    for (int k = lo; k <= hi; k++) {
        const bool wraps = s->domain.periodic[p->axis];
        if (!wraps && (k < 0 || k >= p->bins))
            continue;
        const int bin = wraps ? ((k % p->bins) + p->bins) % p->bins : k;
        sum[bin] += volume * (ball_beyond((k * width - x) / radius) -
                              ball_beyond(((k + 1) * width - x) / radius));
    }
}

static void measure(const struct sim *s, const struct slabs *p, double *phi)
{
    const double *const size = s->domain.size;
    const double slab = size[0] * size[1] * size[2] / p->bins;
    for (int k = 0; k < p->bins; k++)
        phi[k] = 0.0;
    for (int i = 0; i < s->grains.n; i++) {
        const vec3 x = s->grains.pos[i];
        add_ball(s, p, p->axis == 0 ? x.x : p->axis == 1 ? x.y : x.z, s->grains.volume[i], phi);
    }
    for (int k = 0; k < p->bins; k++)
        phi[k] /= slab;
}

static void start(struct sim *s, void *state)
{
    const struct slabs *const p = state;
    measure(s, p, p->start);
}

static void report(struct sim *s, void *state)
{
    const struct slabs *const p = state;
    measure(s, p, p->end);
    for (int k = 0; k < p->bins; k++)
        table_row(p->table, (const double[]){(k + 0.5) * s->domain.size[p->axis] / p->bins,
                                             p->start[k], p->end[k]});
}

static void release(void *state)
{
    struct slabs *const p = state;
    xfree(p->start);
    xfree(p);
}

const struct analysis_part analysis_profile = {.name = "profile",
                                               .keys = keys,
                                               .create = create,
                                               .start = start,
                                               .report = report,
                                               .free = release};
