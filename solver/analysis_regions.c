/* analysis_regions.c - [region NAME]: averages over boxes as time series, and at the end as lines of
 * the summary. What is averaged, and how, is in region.c. */
#include <stdio.h>
#include <string.h>
#include "analysis.h"
#include "region.h"
#include "sim.h"

static const struct key keys[] = {
    {"region", "from", KEY_VECTOR, "m", "box | (-inf, inf)", "box", "lowest corner"},
    {"region", "to", KEY_VECTOR, "m", "box | (-inf, inf)", "box", "highest corner"},
    {0},
};

enum { SERIES = 19 };

/* What goes into the series and the summary. */
static const struct {
    const char *name, *unit, *text;
    size_t offset;
} list[SERIES] = {
    {"pressure", "Pa", "mean stress", offsetof(struct region, pressure)},
    {"deviator", "Pa", "deviator of the stress, von Mises", offsetof(struct region, deviator)},
    {"stress_ratio", "1", "deviator over mean stress", offsetof(struct region, ratio)},
    {"friction_angle", "degree", "angle of friction mobilised",
     offsetof(struct region, friction_angle)},
    {"stress_xx", "Pa", "stress, compression > 0", offsetof(struct region, stress[0][0])},
    {"stress_yy", "Pa", "stress, compression > 0", offsetof(struct region, stress[1][1])},
    {"stress_zz", "Pa", "stress, compression > 0", offsetof(struct region, stress[2][2])},
    {"stress_xy", "Pa", "stress on grains along x across y",
     offsetof(struct region, stress[0][1])},
    {"stress_xz", "Pa", "stress on grains along x across z",
     offsetof(struct region, stress[0][2])},
    {"stress_yz", "Pa", "stress on grains along y across z",
     offsetof(struct region, stress[1][2])},
    {"fabric_xx", "1", "fabric, mean of n n", offsetof(struct region, fabric[0][0])},
    {"fabric_yy", "1", "fabric, mean of n n", offsetof(struct region, fabric[1][1])},
    {"fabric_zz", "1", "fabric, mean of n n", offsetof(struct region, fabric[2][2])},
    {"fabric_xy", "1", "fabric, mean of n n", offsetof(struct region, fabric[0][1])},
    {"fabric_xz", "1", "fabric, mean of n n", offsetof(struct region, fabric[0][2])},
    {"fabric_yz", "1", "fabric, mean of n n", offsetof(struct region, fabric[1][2])},
    {"anisotropy", "1", "deviator of the fabric: 0 isotropic, 1 all contacts parallel",
     offsetof(struct region, anisotropy)},
    {"solid_fraction", "1", "solid fraction", offsetof(struct region, solid)},
    {"coordination", "1", "contacts per grain", offsetof(struct region, coordination)},
};

struct state {
    struct regions regions;
    char **name; /* SERIES per region */
};

static void read_corners(struct sim *s, struct scene *scene, struct region *r)
{
    const double *const size = s->domain.size;
    const bool from = scene_word(scene, "region", r->name, "from", "box");
    const bool to = scene_word(scene, "region", r->name, "to", "box");
    r->from = from ? v3(0.0, 0.0, 0.0) : scene_vector(scene, "region", r->name, "from");
    r->to = to ? v3(size[0], size[1], size[2]) : scene_vector(scene, "region", r->name, "to");
    const vec3 edge = v3_sub(r->to, r->from);
    r->volume = edge.x * edge.y * edge.z;
    if (!(edge.x > 0.0 && edge.y > 0.0 && edge.z > 0.0))
        scene_error(scene, "region", r->name, "to", "must lie above region.from in x, y and z");
    for (int a = 0; a < 3; a++) {
        const double e = a == 0 ? edge.x : a == 1 ? edge.y : edge.z;
        if (s->domain.periodic[a] && e > size[a] * (1.0 + 1e-12))
            scene_error(scene, "region", r->name, "to",
                        "is wider than the box along its periodic %c", 'x' + a);
    }
}

static void *create(struct sim *s, struct scene *scene)
{
    const char *const *names;
    const int n = scene_names(scene, "region", &names);
    if (n == 0)
        return NULL;
    contact_view_wanted(s);
    struct state *const p = xalloc(1, sizeof *p);
    p->regions.n = n;
    p->regions.region = xalloc((size_t)n, sizeof *p->regions.region);
    p->name = xalloc((size_t)n * SERIES, sizeof *p->name);
    for (int k = 0; k < n; k++) {
        struct region *const r = &p->regions.region[k];
        if (strlen(names[k]) >= sizeof r->name)
            scene_error(scene, "region", names[k], NULL, "the name must be shorter than 32");
        snprintf(r->name, sizeof r->name, "%.31s", names[k]);
        if (strlen(names[k]) < sizeof r->name)
            read_corners(s, scene, r);
        for (int c = 0; c < SERIES; c++) {
            char **const name = &p->name[k * SERIES + c];
            *name = xprintf("%s_%s", r->name, list[c].name);
            series_add(&s->series, *name, list[c].unit, list[c].text,
                       (const double *)((const char *)r + list[c].offset));
        }
    }
    return p;
}

static void sample(struct sim *s, void *state)
{
    struct state *const p = state;
    const struct contact_view *const v = contact_view(s);
    for (int k = 0; k < p->regions.n; k++)
        region_measure(s, v, &p->regions.region[k]);
}

static void report(struct sim *s, void *state)
{
    struct state *const p = state;
    sample(s, state);
    for (int k = 0; k < p->regions.n; k++)
        for (int c = 0; c < SERIES; c++) {
            const char *const r = (const char *)&p->regions.region[k];
            summary_number(&s->summary, p->name[k * SERIES + c],
                           *(const double *)(r + list[c].offset), list[c].unit);
        }
}

static void release(void *state)
{
    struct state *const p = state;
    for (int k = 0; k < p->regions.n * SERIES; k++)
        xfree(p->name[k]);
    xfree(p->name);
    xfree(p->regions.region);
    xfree(p);
}

const struct analysis_part analysis_regions = {.name = "regions",
                                               .keys = keys,
                                               .create = create,
                                               .sample = sample,
                                               .report = report,
                                               .free = release};

const struct region *region_find(const struct sim *s, const char *name)
{
    for (int k = 0; analysis_parts[k]; k++) {
        const struct state *const p = s->analysis.state[k];
        if (analysis_parts[k] != &analysis_regions || !p)
            continue;
        for (int r = 0; r < p->regions.n; r++)
            if (strcmp(p->regions.region[r].name, name) == 0)
                return &p->regions.region[r];
    }
    return NULL;
}
