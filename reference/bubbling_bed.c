/* reference/bubbling_bed.c - a fluidised bed carries its grains: over a long time its pressure drop is
 * their buoyant weight per area.
 *
 *   <p_in - p_out> A = sum of (rho_p - rho_f) V_p g
 *
 * p is free of its hydrostatic part. What the walls hold by friction is not in it, nor is momentum that
 * the bed gains or loses between start and end; both average out over many bubbles, if the walls are
 * smooth. The drop is averaged from `reference.from` on. The curves show it, and how the bed breathes: the
 * mean height of the grains. */
#include "reference.h"

#include "../solver/bed.h"
#include "../solver/sim.h"

const struct about reference_about = {
    .name = "bubbling_bed",
    .summary = "mean pressure drop of a fluidised bed against its buoyant weight",
    .equation = "<p_in - p_out> A = sum of (rho_p - rho_f) V g",
    .source = "",
    .range = "all grains carried by the fluid; walls with little friction"};
const struct key reference_keys[] = {
    {"reference", "from", KEY_REAL, "s", "auto | [0, inf)", "auto",
     "start of the average; auto: a quarter of run.end"},
    {"reference", "tolerance", KEY_REAL, "1", "(0, inf)", "3 %", "of the weight"},
    {0},
};

enum { ROWS = 400 };

struct bubbling_bed {
    int in, out;
    double from, tolerance, area, weight; /* s, 1, m2, Pa */
    double sum, square, time;             /* of the drop since `from` */
    double row_sum, row_time, next;       /* of the row at hand; s, its end */
    double least, most;                   /* Pa, of the rows since `from` */
    struct table *table;
};

static const struct table pattern = {
    .name = "bubbling_bed",
    .title = "pressure drop of a fluidised bed",
    .n_columns = 4,
    .column = {{"time", "s", "end of the interval", true},
               {"drop", "Pa", "pressure drop, mean over the interval", true},
               {"weight", "Pa", "buoyant weight per area", true},
               {"height", "m", "mean height of the grains", true}},
    .figure = {.file = "bubbling_bed.png",
               .title = "Pressure drop of a fluidised bed",
               .x = "time",
               .x_label = "time / s",
               .y_label = "pressure drop / Pa",
               .n_curves = 2,
               .curve = {{"drop", "line", "simulated"}, {"weight", "line", "buoyant weight"}}}};

void reference_create(struct sim *s, struct scene *scene)
{
    struct bubbling_bed *const p = xalloc(1, sizeof *p);
    s->reference = p;
    p->in = -1;
    for (int side = 0; side < 6; side++)
        if (s->domain.side[side].kind == SIDE_INFLOW)
            p->in = side;
    p->out = p->in < 0 ? -1 : p->in ^ 1;
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    p->from = scene_word(scene, "reference", NULL, "from", "auto")
                  ? 0.25 * s->run.end
                  : scene_real(scene, "reference", NULL, "from");
    if (!s->fluid.exists || p->in < 0 || s->domain.side[p->out].kind != SIDE_OUTFLOW ||
        (scene_errors(scene) == 0 && s->grains.n == 0))
        scene_error(
            scene, "modules", NULL, "reference",
            "bubbling_bed needs a fluid, grains, and an inflow side with an outflow side "
            "opposite");
    if (p->from >= s->run.end)
        scene_error(scene, "reference", NULL, "from", "must be before run.end, %g s",
                    s->run.end);
    if (scene_errors(scene) > 0)
        return;
    const int axis = p->in / 2;
    p->area = s->domain.size[(axis + 1) % 3] * s->domain.size[(axis + 2) % 3];
    p->weight = bed_weight(s) / p->area;
    p->next = s->run.end / ROWS;
    p->least = (double)INFINITY;
    p->table = tables_add(&s->tables, &pattern);
}

static double mean_height(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    double sum = 0.0, volume = 0.0;
    for (int i = 0; i < g->n; i++) {
        sum += g->volume[i] * g->pos[i].z;
        volume += g->volume[i];
    }
    return volume > 0.0 ? sum / volume : 0.0;
}

static void close_row(struct bubbling_bed *p, const struct sim *s)
{
    const double drop = p->row_sum / p->row_time;
    table_row(p->table, (const double[]){s->t, drop, p->weight, mean_height(s)});
    if (s->t > p->from) {
        p->least = fmin(p->least, drop);
        p->most = fmax(p->most, drop);
    }
    p->row_sum = p->row_time = 0.0;
    while (p->next <= s->t * (1.0 + 1e-9))
        p->next += s->run.end / ROWS;
}

void reference_watch(struct sim *s)
{
    struct bubbling_bed *const p = s->reference;
    if (!s->fluid.on)
        return;
    const double dt = s->fluid.dt;
    const double drop = fluid_side_pressure(s, p->in) - fluid_side_pressure(s, p->out);
    p->row_sum += dt * drop;
    p->row_time += dt;
    if (s->t > p->from) {
        p->sum += dt * drop;
        p->square += dt * drop * drop;
        p->time += dt;
    }
    if (s->t >= p->next * (1.0 - 1e-9))
        close_row(p, s);
}

void reference_report(struct sim *s)
{
    struct bubbling_bed *const p = s->reference;
    if (!(p->time > 0.0)) {
        printf("reference: nothing to average: the run ended before %g s\n", p->from);
        summary_text(&s->summary, "verdict", "none");
        return;
    }
    const double mean = p->sum / p->time, error = mean / p->weight - 1.0;
    const double spread = sqrt(fmax(0.0, p->square / p->time - mean * mean));
    const bool good = fabs(error) <= p->tolerance;
    summary_number(&s->summary, "bed_weight", p->weight, "Pa");
    summary_number(&s->summary, "drop_mean", mean, "Pa");
    summary_number(&s->summary, "drop_deviation", spread, "Pa");
    summary_number(&s->summary, "drop_error", error, "1");
    summary_number(&s->summary, "bed_mean_height", mean_height(s), "m");
    summary_reference(&s->summary, (struct comparison){.quantity = "mean pressure drop",
                                                       .source = reference_about.source,
                                                       .unit = "Pa",
                                                       .got = mean,
                                                       .want = p->weight,
                                                       .error = error,
                                                       .tolerance = p->tolerance});
    summary_text(&s->summary, "verdict", good ? "pass" : "FAIL");
    printf("reference: %s pressure drop %.1f Pa from %g s on (deviation %.1f, %.1f to %.1f), "
           "buoyant "
           "weight %.1f Pa, error %+.2f %%, tolerance %g %%\n",
           good ? "pass" : "FAIL", mean, p->from, spread, p->least, p->most, p->weight,
           100.0 * error, 100.0 * p->tolerance);
}

void reference_free(struct sim *s)
{
    xfree(s->reference);
}
