/* reference/pressure_drop.c - the pressure drop of a bed against Ergun and Kozeny-Carman.
 *
 * Flow enters by one side and leaves by the opposite one. Over the last part of each level of
 * flow the pressure drop between the two sides and the porosity of every cell are averaged. The
 * layers of cells give the height L of the bed, its bulk porosity eps_b = 1 - (volume of
 * grains)/(area L) (solver/bed.h), and so, at the velocity of each level,
 *   - Ergun and Kozeny-Carman (constants 150 and 180) at (eps_b, L);
 *   - Ergun, and the drag law of the run, summed over the layers at the mean porosity of each
 *     ("profile"): what the verdict on the fixed bed is by;
 *   - the plateau, mean drop of the levels beyond fluidisation, with the grains' weight less
 *     buoyancy per area;
 *   - the velocity at which the curve through the levels of the fixed bed, a u + b u^2 by least
 *     squares of relative errors, meets the plateau, with that at which the law at (eps_b, L)
 *     carries the weight; for Ergun that is a root in closed form.
 * A level is one of the fixed bed if it comes before the first whose drop reaches 0.9 of the
 * weight per area; one beyond if its velocity is at least 1.1 times that at which the curve
 * meets the weight. Of levels that are not fixed the laws are those of the bed at the start of
 * the flow. Where the porosity of a layer is uneven the drop exceeds the profile's a little, as
 * the laws are convex in eps. Without grains that move, or without levels beyond, what concerns
 * fluidisation is left out. [Ergun52], [Kozeny27], [Carman37] */
#include "reference.h"

#include "../drag/drag.h"
#include "../solver/bed.h"
#include "../solver/sim.h"

const struct about reference_about = {
    .name = "pressure_drop",
    .summary = "pressure drop of a bed, and its fluidisation, against Ergun and Kozeny-Carman",
    .equation = "-dp = L [150 mu (1-eps)^2 u/(eps^3 d^2) + 1.75 rho (1-eps) u^2/(eps^3 d)]",
    .source = "[Ergun52]; [Kozeny27]; [Carman37]",
    .range = "flow through a bed, between an inflow and the outflow opposite"};
const struct key reference_keys[] = {
    {"reference", "average", KEY_REAL, "1", "(0, 1]", "0.5",
     "last part of each level of flow, over which the drop is averaged"},
    {"reference", "tolerance_drop", KEY_REAL, "1", "(0, inf)", "1 %",
     "of the drop of the fixed bed, against the drag law summed over the bed's own porosity"},
    {"reference", "tolerance_plateau", KEY_REAL, "1", "(0, inf)", "1 %",
     "of the plateau, against the buoyant weight per area"},
    {"reference", "tolerance_velocity", KEY_REAL, "1", "(0, inf)", "5 %",
     "of the fluidisation velocity, against that of the drag law"},
    {0},
};

static const double fixed_below = 0.9, beyond_above = 1.1;

/* Sums over the samples of a level, once closed their means. */
struct level {
    long samples;
    double velocity, drop; /* m/s, Pa */
    double *eps;           /* per layer */
    struct bed_size size;
    bool fixed;
};

struct pressure_drop {
    int in, out, axis, layers, n;
    double h, area; /* m, m2 */
    double solid;   /* m, volume of grains per area */
    double weight;  /* Pa */
    double average, tolerance_drop, tolerance_plateau, tolerance_velocity;
    struct bed_fluid fluid;
    bool begun;
    int current; /* level whose cells are summed */
    double *sum; /* a field: sum of eps over the samples of that level */
    struct level start, *level;
    struct table *table;
};

enum { COLUMNS = 15, DROP = 2, LAW_PROFILE = 7, ERROR_PROFILE = 11 };
static const struct table pattern = {
    .name = "pressure_drop",
    .title = "pressure drop of the bed (levels not fixed: laws at the bed of the start)",
    .n_columns = COLUMNS,
    .column = {{"velocity", "m s-1", "superficial velocity", false},
               {"reynolds", "1", "rho u d/mu", false},
               {"simulated", "Pa", "pressure drop, simulated", false},
               {"ergun", "Pa", "Ergun at the bed's porosity and height", false},
               {"kc_150", "Pa", "Kozeny-Carman, constant 150", false},
               {"kc_180", "Pa", "Kozeny-Carman, constant 180", false},
               {"ergun_profile", "Pa", "Ergun summed over the porosity profile", true},
               {"profile", "Pa", "drag law of the run summed over the porosity profile", false},
               {"err_ergun", "1", "simulated / Ergun - 1", false},
               {"err_kc_150", "1", "simulated / Kozeny-Carman (150) - 1", false},
               {"err_kc_180", "1", "simulated / Kozeny-Carman (180) - 1", false},
               {"err_profile", "1", "simulated / drag law over the profile - 1", false},
               {"plateau", "Pa", "weight less buoyancy of the grains, per area", false},
               {"porosity", "1", "porosity of the whole bed", true},
               {"height", "m", "height of the bed", true}},
    .figure = {.file = "pressure_drop.png",
               .title = "pressure drop of the bed",
               .x = "velocity",
               .x_label = "superficial velocity / m s^{-1}",
               .y_label = "pressure drop / Pa",
               .n_curves = 5,
               .curve = {{"simulated", "points", "simulated"},
                         {"ergun", "line", "Ergun, porosity and height measured"},
                         {"kc_150", "line", "Kozeny-Carman, 150"},
                         {"kc_180", "line", "Kozeny-Carman, 180"},
                         {"plateau", "line", "buoyant weight per area"}}}};

void reference_create(struct sim *s, struct scene *scene)
{
    struct pressure_drop *const p = xalloc(1, sizeof *p);
    s->reference = p;
    p->in = p->out = -1;
    for (int side = 0; side < 6; side++)
        if (s->domain.side[side].kind == SIDE_INFLOW)
            p->in = side;
    p->average = scene_real(scene, "reference", NULL, "average");
    p->tolerance_drop = scene_real(scene, "reference", NULL, "tolerance_drop");
    p->tolerance_plateau = scene_real(scene, "reference", NULL, "tolerance_plateau");
    p->tolerance_velocity = scene_real(scene, "reference", NULL, "tolerance_velocity");
    if (p->in >= 0)
        p->out = p->in ^ 1;
    if (!s->fluid.exists || p->in < 0 || s->domain.side[p->out].kind != SIDE_OUTFLOW ||
        (scene_errors(scene) == 0 && s->grains.n == 0))
        scene_error(
            scene, "modules", NULL, "reference",
            "pressure_drop needs a fluid, grains, and a side that is inflow with outflow "
            "opposite");
    if (scene_errors(scene) > 0)
        return;
    p->axis = p->in / 2;
    p->layers = s->grid.n[p->axis];
    p->h = s->grid.h[p->axis];
    p->area = s->domain.size[(p->axis + 1) % 3] * s->domain.size[(p->axis + 2) % 3];
    p->fluid = (struct bed_fluid){bed_diameter(s), s->fluid.rho, s->fluid.mu,
                                  s->coupling.drag_of.kind};
    p->solid = bed_solid(s) / p->area;
    p->weight = bed_weight(s) / p->area;
    p->n = s->flow.steps;
    p->level = xalloc((size_t)p->n, sizeof *p->level);
    for (int k = 0; k < p->n; k++)
        p->level[k].eps = xalloc((size_t)p->layers, sizeof(double));
    p->start.eps = xalloc((size_t)p->layers, sizeof(double));
    p->sum = grid_field(&s->grid);
    p->current = -1;
    p->table = tables_add(&s->tables, &pattern);
}

/* Pa, from side to side. A flow that does not feel the grains has no pressure for them: then what it
 * would take to drive it, the drag on the grains over their porosity, per area [Zhou10, form a]. */
static double drop_now(const struct pressure_drop *p, const struct sim *s)
{
    const struct coupling *const c = &s->coupling;
    if (c->ways == 2)
        return fluid_side_pressure(s, p->in) - fluid_side_pressure(s, p->out);
    double sum = 0.0;
    for (int i = 0; i < s->grains.n; i++) {
        const struct share *const w = &c->shares[(size_t)i * c->reach];
        const double drag[3] = {c->drag[i].x, c->drag[i].y, c->drag[i].z};
        double eps = 0.0;
        for (int k = 0; k < c->n_shares[i]; k++)
            eps += w[k].weight * c->eps[w[k].cell];
        sum += drag[p->axis] / eps;
    }
    return (p->in % 2 ? -sum : sum) / p->area;
}

/* Sums of the level at hand to means. */
static void close_level(struct pressure_drop *p, const struct sim *s)
{
    if (p->current < 0)
        return;
    struct level *const l = &p->level[p->current];
    const double n = (double)l->samples;
    for (size_t c = 0; c < s->grid.total; c++)
        p->sum[c] /= n;
    l->velocity /= n;
    l->drop /= n;
    bed_planes(s, p->axis, p->sum, l->eps);
    l->size = bed_measure(l->eps, p->layers, p->h, p->fluid.d, p->solid);
    for (size_t c = 0; c < s->grid.total; c++)
        p->sum[c] = 0.0;
    p->current = -1;
}

/* True in the last part of the level of flow at hand. */
static bool sampled(const struct pressure_drop *p, const struct sim *s, int level)
{
    const struct flow *const f = &s->flow;
    const double whole = p->n > 1 ? f->hold : s->run.end - f->start;
    const double part = (s->t - f->start) / whole - level;
    return part > 1.0 - p->average + 1e-9;
}

void reference_watch(struct sim *s)
{
    struct pressure_drop *const p = s->reference;
    if (!s->fluid.on)
        return;
    if (!p->begun) {
        p->begun = true;
        bed_planes(s, p->axis, s->coupling.eps, p->start.eps);
        p->start.size = bed_measure(p->start.eps, p->layers, p->h, p->fluid.d, p->solid);
    }
    const int k = flow_level(&s->flow, s->t);
    if (!sampled(p, s, k))
        return;
    if (k != p->current)
        close_level(p, s);
    struct level *const l = &p->level[k];
    p->current = k;
    for (size_t c = 0; c < s->grid.total; c++)
        p->sum[c] += s->coupling.eps[c];
    l->velocity += flow_velocity(&s->flow, s->t);
    l->drop += drop_now(p, s);
    l->samples++;
}

/* Marks the levels of the fixed bed and drops those without samples. */
static void sort_levels(struct pressure_drop *p)
{
    bool fixed = true;
    int used = 0;
    for (int k = 0; k < p->n; k++) {
        struct level l = p->level[k];
        if (l.samples == 0) {
            xfree(l.eps);
            continue;
        }
        fixed = fixed && (!(p->weight > 0.0) || l.drop < fixed_below * p->weight);
        l.fixed = fixed;
        p->level[used++] = l;
    }
    p->n = used;
}

/* The curve through the levels of the fixed bed; returns how many there are. */
static int fit(const struct pressure_drop *p, struct bed_curve *curve)
{
    double *const u = xalloc((size_t)p->n, sizeof *u), *const drop =
                                                           xalloc((size_t)p->n, sizeof *u);
    int n = 0;
    for (int k = 0; k < p->n; k++)
        if (p->level[k].fixed && p->level[k].drop > 0.0 && p->level[k].velocity > 0.0) {
            u[n] = p->level[k].velocity;
            drop[n++] = p->level[k].drop;
        }
    *curve = bed_curve_fit(n, u, drop);
    xfree(u);
    xfree(drop);
    return n;
}

static double relative(double got, double want)
{
    return want > 0.0 ? got / want - 1.0 : (double)NAN;
}

/* Adds the table's row. */
static void add_row(const struct pressure_drop *p, const struct level *l)
{
    const struct bed_fluid *const f = &p->fluid;
    const struct level *const bed = l->fixed ? l : &p->start;
    const double u = l->velocity, eps = bed->size.porosity, height = bed->size.height;
    double ergun = 0.0, law = 0.0;
    for (int i = 0; i < p->layers; i++) {
        ergun += p->h * bed_ergun(f, bed->eps[i], u);
        law += p->h * bed_law(f, bed->eps[i], u);
    }
    const double whole = height * bed_ergun(f, eps, u);
    const double kc150 = height * bed_kozeny_carman(f, eps, u, 150.0);
    const double kc180 = height * bed_kozeny_carman(f, eps, u, 180.0);
    const double row[COLUMNS] = {
        u,
        f->rho * u * f->d / f->mu,
        l->drop,
        whole,
        kc150,
        kc180,
        ergun,
        law,
        relative(l->drop, whole),
        relative(l->drop, kc150),
        relative(l->drop, kc180),
        relative(l->drop, law),
        p->weight > 0.0 ? p->weight : (double)NAN,
        l->size.porosity,
        l->size.height,
    };
    table_row(p->table, row);
}

/* One line of the verdict; `worst` must be finite and within the tolerance. */
static bool judge(const char *what, double worst, double tolerance)
{
    const bool good = fabs(worst) <= tolerance;
    printf("reference: %s %s, %+.3f %%, tolerance %g %%\n", good ? "pass" : "FAIL", what,
           100.0 * worst, 100.0 * tolerance);
    return good;
}

/* What concerns fluidisation; true if it is as it should be, or does not apply. */
static bool fluidisation(const struct pressure_drop *p, struct summary *sum)
{
    const struct bed_size *const bed = &p->start.size;
    struct bed_curve curve;
    double plateau = 0.0;
    int beyond = 0;
    if (!(p->weight > 0.0))
        return true;
    summary_number(sum, "weight_per_area", p->weight, "Pa");
    const double u_ergun = bed_ergun_velocity(&p->fluid, bed, p->weight);
    const double u_law = bed_law_velocity(&p->fluid, bed, p->weight);
    summary_number(sum, "u_mf_ergun", u_ergun, "m s-1");
    summary_number(sum, "u_mf_analytic", u_law, "m s-1");
    if (fit(p, &curve) == 0)
        return true;
    const double least = beyond_above * bed_curve_meets(&curve, p->weight);
    for (int k = 0; k < p->n; k++)
        if (!p->level[k].fixed && p->level[k].velocity >= least) {
            plateau += p->level[k].drop;
            beyond++;
        }
    if (beyond == 0) {
        printf("the flow stays below fluidisation: Ergun %.5g m/s, drag law %.5g m/s\n",
               u_ergun, u_law);
        return true;
    }
    plateau /= beyond;
    const double u_mf = bed_curve_meets(&curve, plateau);
    printf("fluidisation velocity %.5g m/s; Ergun %.5g m/s, drag law %.5g m/s\n"
           "plateau %.5g Pa (%d levels); weight less buoyancy %.5g Pa\n",
           u_mf, u_ergun, u_law, plateau, beyond, p->weight);
    summary_number(sum, "u_mf", u_mf, "m s-1");
    summary_number(sum, "u_mf_error", relative(u_mf, u_law), "1");
    summary_number(sum, "plateau", plateau, "Pa");
    summary_number(sum, "plateau_error", relative(plateau, p->weight), "1");
    const bool flat = judge("plateau against the buoyant weight per area",
                            relative(plateau, p->weight), p->tolerance_plateau);
    return judge("fluidisation velocity against the drag law", relative(u_mf, u_law),
                 p->tolerance_velocity) &&
           flat;
}

/* Of two errors the worse; NaN is the worst. */
static double worse(double a, double b)
{
    return isnan(a) || fabs(a) >= fabs(b) ? a : b;
}

void reference_report(struct sim *s)
{
    struct pressure_drop *const p = s->reference;
    struct summary *const sum = &s->summary;
    const struct bed_size *const bed = &p->start.size;
    double profile = 0.0, drop[2] = {(double)NAN, (double)NAN};
    int fixed = 0;
    close_level(p, s);
    sort_levels(p);
    for (int k = 0; k < p->n; k++) {
        add_row(p, &p->level[k]);
        if (p->level[k].fixed && p->level[k].velocity > 0.0) {
            const double *const row = &p->table->row[(size_t)k * COLUMNS];
            profile = worse(profile, row[ERROR_PROFILE]);
            if (profile == row[ERROR_PROFILE]) {
                drop[0] = row[DROP];
                drop[1] = row[LAW_PROFILE];
            }
            fixed++;
        }
    }
    table_print(stdout, p->table);
    printf("bed at the start of the flow: porosity %.5f (its middle %.5f), height %.5g m, "
           "diameter "
           "%.5g m\n",
           bed->porosity, bed->middle, bed->height, p->fluid.d);
    summary_number(sum, "bed_porosity", bed->porosity, "1");
    summary_number(sum, "bed_porosity_middle", bed->middle, "1");
    summary_number(sum, "bed_height", bed->height, "m");
    summary_number(sum, "bed_diameter", p->fluid.d, "m");
    summary_number(sum, "levels_fixed", fixed, "1");
    bool good = fluidisation(p, sum);
    if (fixed > 0) {
        summary_number(sum, "error_law_profile", profile, "1");
        good = judge("drop of the fixed bed against the drag law over its porosity profile",
                     profile, p->tolerance_drop) &&
               good;
    } else {
        printf("reference: FAIL no level of flow was measured with the bed fixed\n");
        good = false;
    }
    summary_reference(
        sum, (struct comparison){.quantity = "pressure drop of the fixed bed, worst level",
                                 .source = reference_about.source,
                                 .unit = "Pa",
                                 .got = drop[0],
                                 .want = drop[1],
                                 .error = fixed > 0 ? profile : (double)NAN,
                                 .tolerance = p->tolerance_drop});
    summary_text(sum, "verdict", good ? "pass" : "FAIL");
}

void reference_free(struct sim *s)
{
    struct pressure_drop *const p = s->reference;
    if (!p)
        return;
    for (int k = 0; k < p->n && p->level; k++)
        xfree(p->level[k].eps);
    xfree(p->level);
    xfree(p->start.eps);
    xfree(p->sum);
    xfree(p);
}
