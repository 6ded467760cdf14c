/* reference/beverloo.c - the rate at which grains leave through an orifice.
 *
 *   W = C rho_b sqrt(g) (D - k d)^(5/2)            a circular orifice of diameter D [Beverloo61]
 *   W = 1.03 rho_b sqrt(g) (L - k d) (B - k d)^(3/2)   a slot B x L; L endless: L   [MyersSellers71]
 *
 * with C = 0.58, k = 1.4 unless the scene says otherwise (published 0.55 to 0.65, 1.3 to 1.6 for
 * spheres). rho_b is the bulk density of what flows: the solid fraction of a region over the
 * orifice, averaged over the same time, times the density of the grains. The rate is the slope of
 * the mass through a meter against time. */
#include "reference.h"

#include "../solver/meter.h"
#include "../solver/region.h"
#include "../solver/sim.h"

const struct about reference_about = {
    .name = "beverloo",
    .summary = "discharge through an orifice against Beverloo's law",
    .equation = "W = C rho_b sqrt(g) (D - k d)^2.5; slot: 1.03 rho_b sqrt(g) L (B - k d)^1.5",
    .source = "[Beverloo61]",
    .range = "D/d above 5, a bed higher than 2.5 D, dry grains of one size"};
const struct key reference_keys[] = {
    {"reference", "orifice", KEY_REAL, "m", "(0, inf)", NULL,
     "diameter of a circular orifice, or width of a slot"},
    {"reference", "length", KEY_REAL, "m", "none | (0, inf)", "none",
     "length of a slot; none: the orifice is circular"},
    {"reference", "endless", KEY_CHOICE, "", "no | yes", "no",
     "the slot goes on through a periodic side: its ends take no part of it"},
    {"reference", "meter", KEY_TEXT, "", "", "outlet", "the meter under the orifice"},
    {"reference", "region", KEY_TEXT, "", "", "above",
     "the region that tells the bulk density"},
    {"reference", "constant", KEY_REAL, "1", "auto | (0, inf)", "auto",
     "C; auto: 0.58, for a slot 1.03"},
    {"reference", "k", KEY_REAL, "1", "[0, inf)", "1.4",
     "diameters that the orifice is narrower by"},
    {"reference", "after", KEY_REAL, "s", "[0, inf)", "0 s", "the rate is fitted from here"},
    {"reference", "until", KEY_REAL, "s", "end | (0, inf)", "end", "to here"},
    {"reference", "tolerance", KEY_REAL, "1", "(0, inf)", "15 %", "of the rate"},
    {0},
};

enum { ROWS = 400 };

struct beverloo {
    double orifice, length, constant, k, after, until, tolerance;
    bool slot, endless;
    const struct meter *meter;
    const struct region *region;
    double solid; /* sum over the looks */
    double looks;
    double next; /* s, of the next row */
    struct table *table;
};

static const struct table pattern = {
    .name = "discharge",
    .title = "mass that has left",
    .n_columns = 3,
    .column = {{"time", "s", "time", true},
               {"simulated", "kg", "mass that has left, simulated", true},
               {"beverloo", "kg", "mass at Beverloo's rate from the beginning of the fit",
                true}},
    .figure = {.file = "discharge.png",
               .title = "mass that has left",
               .x = "time",
               .x_label = "time / s",
               .y_label = "mass / kg",
               .n_curves = 2,
               .curve = {{"simulated", "points", "simulated"},
                         {"beverloo", "line", "at Beverloo's rate"}}}};

void reference_create(struct sim *s, struct scene *scene)
{
    struct beverloo *const p = xalloc(1, sizeof *p);
    s->reference = p;
    p->orifice = scene_real(scene, "reference", NULL, "orifice");
    p->slot = !scene_word(scene, "reference", NULL, "length", "none");
    p->length = p->slot ? scene_real(scene, "reference", NULL, "length") : 0.0;
    p->endless = scene_choice(scene, "reference", NULL, "endless") == 1;
    p->constant = scene_word(scene, "reference", NULL, "constant", "auto")
                      ? (p->slot ? 1.03 : 0.58)
                      : scene_real(scene, "reference", NULL, "constant");
    p->k = scene_real(scene, "reference", NULL, "k");
    p->after = scene_real(scene, "reference", NULL, "after");
    p->until = scene_word(scene, "reference", NULL, "until", "end")
                   ? s->run.end
                   : scene_real(scene, "reference", NULL, "until");
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    p->meter = meter_find(s, scene_text(scene, "reference", NULL, "meter"));
    p->region = region_find(s, scene_text(scene, "reference", NULL, "region"));
    if (!p->meter)
        scene_error(scene, "reference", NULL, "meter", "there is no [meter %s]",
                    scene_text(scene, "reference", NULL, "meter"));
    if (!p->region)
        scene_error(scene, "reference", NULL, "region", "there is no [region %s]",
                    scene_text(scene, "reference", NULL, "region"));
    p->table = tables_add(&s->tables, &pattern);
}

/* Samples tell of the region: it is measured at those. */
void reference_watch(struct sim *s)
{
    struct beverloo *const p = s->reference;
    if (s->t >= p->after && s->t <= p->until && p->region->solid > 0.0) {
        p->solid += p->region->solid;
        p->looks += 1.0;
    }
    if (s->t >= p->next) {
        table_row(p->table, (const double[]){s->t, p->meter->mass, (double)NAN});
        p->next = s->t + s->run.end / ROWS;
    }
}

/* m and kg/m3 of the grains that move: those of the first such species. */
static void grain_of(const struct sim *s, double *diameter, double *density)
{
    const struct grains *const g = &s->grains;
    *diameter = *density = (double)NAN;
    for (int k = g->n_species - 1; k >= 0; k--)
        if (!g->species[k].frozen) {
            *diameter = g->species[k].diameter;
            *density = g->species[k].density;
        }
}

static double law(const struct beverloo *p, double bulk, double gravity, double d)
{
    const double width = fmax(0.0, p->orifice - p->k * d);
    if (!p->slot)
        return p->constant * bulk * sqrt(gravity) * pow(width, 2.5);
    const double length = p->endless ? p->length : fmax(0.0, p->length - p->k * d);
    return p->constant * bulk * sqrt(gravity) * length * pow(width, 1.5);
}

void reference_report(struct sim *s)
{
    struct beverloo *const p = s->reference;
    double d, density, error, at_start = (double)NAN;
    grain_of(s, &d, &density);
    const double solid = p->looks > 0.0 ? p->solid / p->looks : (double)NAN;
    const double want = law(p, solid * density, v3_norm(s->domain.gravity), d);
    const double got = meter_slope(p->meter, p->after, p->until, &error);
    for (int r = 0; r < p->table->n_rows; r++) {
        double *const row = &p->table->row[3 * (size_t)r];
        if (row[0] < p->after || row[0] > p->until)
            continue;
        if (isnan(at_start))
            at_start = row[1] - want * (row[0] - p->after);
        row[2] = at_start + want * (row[0] - p->after);
    }
    const double off = got / want - 1.0;
    const bool good = fabs(off) <= p->tolerance;
    summary_number(&s->summary, "orifice_over_diameter", p->orifice / d, "1");
    summary_number(&s->summary, "bulk_density", solid * density, "kg m-3");
    summary_number(&s->summary, "discharge_rate", got, "kg s-1");
    summary_number(&s->summary, "discharge_rate_error", error, "kg s-1");
    summary_number(&s->summary, "beverloo_rate", want, "kg s-1");
    summary_number(&s->summary, "beverloo_error", off, "1");
    summary_reference(&s->summary, (struct comparison){.quantity = "discharge rate",
                                                       .source = reference_about.source,
                                                       .unit = "kg s-1",
                                                       .got = got,
                                                       .want = want,
                                                       .error = off,
                                                       .tolerance = p->tolerance});
    summary_text(&s->summary, "verdict", good ? "pass" : "FAIL");
    printf("reference: %s discharge %.4g kg/s, Beverloo %.4g kg/s at a bulk density of %.0f "
           "kg/m3: %+.1f %%, tolerance %g %%\n",
           good ? "pass" : "FAIL", got, want, solid * density, 100.0 * off,
           100.0 * p->tolerance);
}

void reference_free(struct sim *s)
{
    xfree(s->reference);
}
