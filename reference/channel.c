/* reference/channel.c - fully developed flow between two plane walls.
 *
 * The walls are the sides y- and y+, the flow goes along x:
 *   u(y) = U_- + (U_+ - U_-) y/H + G y (H - y)/(2 mu)
 * plane Couette and Poiseuille flow; G is the pressure gradient that drives, or in a channel
 * from an inflow to an outflow (velocity U, walls at rest) 12 mu U/H^2. Compared at the end of
 * the run, which must be steady, on the line across the channel at `reference.at` of its length.
 * On cells of size h the exact solution of the difference equations is this parabola plus
 * G h^2/(8 mu), so the error falls with h^2. */
#include "reference.h"

#include "../solver/fluid_state.h"
#include "../solver/sample.h"
#include "../solver/sim.h"

const struct about reference_about = {
    .name = "channel",
    .summary = "developed flow between two plane walls: the profile",
    .equation = "u = U_- + (U_+ - U_-) y/H + G y (H - y)/(2 mu)",
    .source = "[Bear72]",
    .range = "laminar, steady, without grains; walls y- and y+, flow along x"};
const struct key reference_keys[] = {
    {"reference", "tolerance", KEY_REAL, "1", "(0, inf)", "0.01",
     "of the velocity, in parts of the largest"},
    {"reference", "at", KEY_REAL, "1", "[0, 1]", "0.9",
     "where along x, in parts of the length"},
    {0},
};

struct channel {
    double tolerance, at;
    struct table *table;
};

enum { COLUMNS = 4 };
static const struct table pattern = {
    .name = "profile",
    .title = "profile across the channel",
    .n_columns = COLUMNS,
    .column = {{"y", "m", "height of the cell's centre"},
               {"simulated", "m s-1", "velocity along x, simulated"},
               {"exact", "m s-1", "velocity along x, exact"},
               {"error", "1", "(simulated - exact)/largest"}},
    .figure = {.file = "profile.png",
               .title = "profile across the channel",
               .x = "y",
               .x_label = "y / m",
               .y_label = "velocity along x / (m/s)",
               .n_curves = 2,
               .curve = {{"simulated", "points", "simulated"}, {"exact", "line", "exact"}}}};

void reference_create(struct sim *s, struct scene *scene)
{
    struct channel *const p = xalloc(1, sizeof *p);
    const struct side *const side = s->domain.side;
    s->reference = p;
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    p->at = scene_real(scene, "reference", NULL, "at");
    if (!s->fluid.exists || s->grains.n > 0)
        scene_error(scene, "modules", NULL, "reference", "channel needs a fluid and no grains");
    if (side[Y_LO].kind != SIDE_WALL || side[Y_HI].kind != SIDE_WALL)
        scene_error(scene, "domain", NULL, "y", "channel needs walls at y- and y+");
    if (scene_errors(scene) == 0)
        p->table = tables_add(&s->tables, &pattern);
}

void reference_watch(struct sim *s)
{
    (void)s; /* the end of the run is compared */
}

/* Pa/m; what drives the flow. */
static double gradient(const struct sim *s)
{
    const double H = s->domain.size[1];
    if (s->domain.side[X_LO].kind != SIDE_INFLOW)
        return s->flow.gradient.x;
    return 12.0 * s->fluid.mu * fluid_inflow(s, X_LO, s->t) / (H * H);
}

void reference_report(struct sim *s)
{
    struct channel *const p = s->reference;
    const double H = s->domain.size[1], G = gradient(s), low = s->domain.side[Y_LO].velocity.x;
    const double high = s->domain.side[Y_HI].velocity.x;
    double worst = 0.0, most = 0.0, mean = 0.0;
    for (int pass = 0; pass < 2; pass++)
        for (int j = 1; j <= s->grid.n[1]; j++) {
            const double y = (j - 0.5) * s->grid.h[1];
            const vec3 x = v3(p->at * s->domain.size[0], y, 0.5 * s->domain.size[2]);
            const double exact =
                low + (high - low) * y / H + G * y * (H - y) / (2.0 * s->fluid.mu);
            const double got = sample_velocity(s, 0, x);
            if (pass == 0) {
                most = fmax(most, fabs(exact));
                mean += got / s->grid.n[1];
                continue;
            }
            const double row[COLUMNS] = {y, got, exact, (got - exact) / most};
            table_row(p->table, row);
            worst = fabs(row[3]) <= worst ? worst : fabs(row[3]);
        }
    const bool good = worst <= p->tolerance;
    table_print(stdout, p->table);
    summary_number(&s->summary, "profile_error", worst, "1");
    summary_number(&s->summary, "mean_velocity", mean, "m s-1");
    summary_reference(&s->summary,
                      (struct comparison){.quantity = "velocity profile, largest difference",
                                          .source = reference_about.source,
                                          .unit = "1",
                                          .got = (double)NAN,
                                          .want = (double)NAN,
                                          .error = worst,
                                          .tolerance = p->tolerance});
    summary_text(&s->summary, "verdict", good ? "pass" : "FAIL");
    printf("reference: %s largest error of the profile %.2e of its largest velocity, tolerance "
           "%g\n",
           good ? "pass" : "FAIL", worst, p->tolerance);
}

void reference_free(struct sim *s)
{
    xfree(s->reference);
}
