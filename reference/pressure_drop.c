/* reference/pressure_drop.c - the pressure drop of a bed against Ergun and Kozeny-Carman.
 *
 * Flow enters by one side and leaves by the opposite one. Over the last part of each level of flow
 * the pressure drop between the two sides and the porosity of each layer of cells are averaged.
 * From the layers come the bed's porosity eps_b (its middle) and its height, that of a bed of eps_b
 * with the same volume of grains: L = (volume of grains / area)/(1 - eps_b). Compared are
 *   - Ergun and Kozeny-Carman (constants 150 and 180) at (eps_b, L);
 *   - Ergun, and the drag law of the run, summed over the bed's layers at the porosity of each;
 *   - the plateau, mean drop of the levels beyond fluidisation, with the grains' weight less
 *     buoyancy per area;
 *   - the velocity at which the curve through the levels of the fixed bed, a u + b u^2 by least
 *     squares of relative errors, meets the plateau, with that at which the law at (eps_b, L)
 *     carries the weight; for Ergun that is a root in closed form.
 * A level is one of the fixed bed if it comes before the first whose drop reaches 0.9 of the weight
 * per area; one beyond if its velocity is at least 1.1 times that at which the curve meets the
 * weight. Of levels that are not fixed the laws are those of the bed at the start of the flow.
 * Nothing is assumed about the bed. Without grains that move, or without levels beyond, what
 * concerns fluidisation is left out. [Ergun52], [Kozeny27], [Carman37] */
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
     "of the drop of the fixed bed, against the drag law summed over the porosity profile"},
    {"reference", "tolerance_plateau", KEY_REAL, "1", "(0, inf)", "1 %",
     "of the plateau, against the buoyant weight per area"},
    {"reference", "tolerance_velocity", KEY_REAL, "1", "(0, inf)", "5 %",
     "of the fluidisation velocity, against that of the drag law"},
    {0},
};

static const double fixed_below = 0.9, beyond_above = 1.1;

/* Sums over the samples of a level, later their means. */
struct level {
    long samples;
    double velocity, drop; /* m/s, Pa */
    double *eps;           /* per layer */
    double porosity, height;
    bool fixed;
};

struct pressure_drop {
    int in, out, axis, layers, n;
    double h, area;          /* m, m2 */
    double solid;            /* m, volume of grains per area */
    double weight;           /* Pa */
    double average, tolerance_drop, tolerance_plateau, tolerance_velocity;
    struct bed_fluid fluid;
    bool begun;
    struct level start, *level;
    struct table *table;
};

enum { COLUMNS = 16 };
static const struct table pattern = {
    .name = "pressure_drop",
    .title = "pressure drop of the bed (levels not fixed: laws at the bed of the start)",
    .n_columns = COLUMNS,
    .column = {{"velocity", "m s-1", "superficial velocity"},
               {"reynolds", "1", "rho u d/mu"},
               {"simulated", "Pa", "pressure drop, simulated"},
               {"ergun", "Pa", "Ergun at the bed's porosity and height"},
               {"kozeny_carman_150", "Pa", "Kozeny-Carman, constant 150"},
               {"kozeny_carman_180", "Pa", "Kozeny-Carman, constant 180"},
               {"ergun_profile", "Pa", "Ergun summed over the porosity profile"},
               {"law_profile", "Pa", "drag law of the run summed over the porosity profile"},
               {"error_ergun", "1", "simulated / Ergun - 1"},
               {"error_kc_150", "1", "simulated / Kozeny-Carman (150) - 1"},
               {"error_kc_180", "1", "simulated / Kozeny-Carman (180) - 1"},
               {"error_ergun_profile", "1", "simulated / Ergun over the profile - 1"},
               {"error_law_profile", "1", "simulated / drag law over the profile - 1"},
               {"plateau", "Pa", "weight less buoyancy of the grains, per area"},
               {"porosity", "1", "porosity inside the bed"},
               {"height", "m", "height of a bed of that porosity with all grains"}},
    .figure = {.file = "pressure_drop.png",
               .title = "pressure drop of the bed",
               .x = "velocity",
               .x_label = "superficial velocity / m s^{-1}",
               .y_label = "pressure drop / Pa",
               .n_curves = 5,
               .curve = {{"simulated", "points", "simulated"},
                         {"ergun", "line", "Ergun, porosity and height measured"},
                         {"kozeny_carman_150", "line", "Kozeny-Carman, 150"},
                         {"kozeny_carman_180", "line", "Kozeny-Carman, 180"},
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
        s->grains.n == 0)
        scene_error(scene, "modules", NULL, "reference",
                    "pressure_drop needs a fluid, grains, and a side that is inflow with outflow "
                    "opposite");
    if (scene_errors(scene) > 0)
        return;
    p->axis = p->in / 2;
    p->layers = s->grid.n[p->axis];
    p->h = s->grid.h[p->axis];
    p->area = s->domain.size[(p->axis + 1) % 3] * s->domain.size[(p->axis + 2) % 3];
    p->fluid = (struct bed_fluid){bed_diameter(s), s->fluid.rho, s->fluid.mu};
    p->solid = bed_solid(s) / p->area;
    p->weight = bed_weight(s) / p->area;
    p->n = s->flow.steps;
    p->level = xalloc((size_t)p->n, sizeof *p->level);
    for (int k = 0; k < p->n; k++)
        p->level[k].eps = xalloc((size_t)p->layers, sizeof(double));
    p->start.eps = xalloc((size_t)p->layers, sizeof(double));
    p->table = tables_add(&s->tables, &pattern);
}

static void measure(const struct pressure_drop *p, struct level *l)
{
    l->porosity = bed_porosity(l->eps, p->layers, p->h, p->fluid.d);
    l->height = l->porosity < 1.0 ? p->solid / (1.0 - l->porosity) : 0.0;
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
        bed_planes(s, p->axis, s->fluid.eps, p->start.eps);
        measure(p, &p->start);
    }
    const int k = flow_level(&s->flow, s->t);
    if (!sampled(p, s, k))
        return;
    struct level *const l = &p->level[k];
    double *const planes = xalloc((size_t)p->layers, sizeof *planes);
    bed_planes(s, p->axis, s->fluid.eps, planes);
    for (int i = 0; i < p->layers; i++)
        l->eps[i] += planes[i];
    xfree(planes);
    l->velocity += flow_velocity(&s->flow, s->t);
    l->drop += fluid_side_pressure(s, p->in) - fluid_side_pressure(s, p->out);
    l->samples++;
}

/* Sums to means; drops levels without samples. */
static void close_levels(struct pressure_drop *p)
{
    bool fixed = true;
    int used = 0;
    for (int k = 0; k < p->n; k++) {
        struct level l = p->level[k];
        if (l.samples == 0) {
            xfree(l.eps);
            continue;
        }
        const double n = (double)l.samples;
        for (int i = 0; i < p->layers; i++)
            l.eps[i] /= n;
        l.velocity /= n;
        l.drop /= n;
        measure(p, &l);
        fixed = fixed && (!(p->weight > 0.0) || l.drop < fixed_below * p->weight);
        l.fixed = fixed;
        p->level[used++] = l;
    }
    p->n = used;
}

/* a u + b u^2 through the levels of the fixed bed; returns how many there are. */
static int fit(const struct pressure_drop *p, double *a, double *b)
{
    double s11 = 0.0, s12 = 0.0, s22 = 0.0, s1 = 0.0, s2 = 0.0;
    int n = 0;
    for (int k = 0; k < p->n; k++) {
        const struct level *const l = &p->level[k];
        if (!l->fixed || !(l->drop > 0.0) || !(l->velocity > 0.0))
            continue;
        const double x = l->velocity / l->drop, y = x * l->velocity;
        s11 += x * x;
        s12 += x * y;
        s22 += y * y;
        s1 += x;
        s2 += y;
        n++;
    }
    const double det = s11 * s22 - s12 * s12;
    *a = n > 0 ? s1 / s11 : 0.0;
    *b = 0.0;
    if (n >= 4 && s11 * s2 > s12 * s1) { /* b > 0, from levels enough */
        *a = (s22 * s1 - s12 * s2) / det;
        *b = (s11 * s2 - s12 * s1) / det;
    }
    return n;
}

/* Positive root of a u + b u^2 = drop. */
static double meets(double a, double b, double drop)
{
    return 2.0 * drop / (a + sqrt(a * a + 4.0 * b * drop));
}

/* m/s; velocity at which the run's drag law carries the weight. NAN if it never does. */
static double law_velocity(const struct pressure_drop *p)
{
    const struct level *const bed = &p->start;
    double lo = 0.0, hi = 1e-9;
    while (bed_law(&p->fluid, bed->porosity, hi) * bed->height < p->weight) {
        hi *= 2.0;
        if (hi > 1e6)
            return NAN;
    }
    for (int i = 0; i < 200; i++) {
        const double mid = 0.5 * (lo + hi);
        if (bed_law(&p->fluid, bed->porosity, mid) * bed->height < p->weight)
            lo = mid;
        else
            hi = mid;
    }
    return hi;
}

static double relative(double got, double want)
{
    return want > 0.0 ? got / want - 1.0 : (double)NAN;
}

/* Adds the table's row; returns the error against the drag law over the profile. */
static double add_row(const struct pressure_drop *p, const struct level *l)
{
    const struct bed_fluid *const f = &p->fluid;
    const struct level *const bed = l->fixed ? l : &p->start;
    const double u = l->velocity, eps = bed->porosity, height = bed->height;
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
        relative(l->drop, ergun),
        relative(l->drop, law),
        p->weight > 0.0 ? p->weight : (double)NAN,
        l->porosity,
        l->height,
    };
    table_row(p->table, row);
    return row[12];
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
    const struct level *const bed = &p->start;
    double a, b, plateau = 0.0;
    int beyond = 0;
    if (!(p->weight > 0.0))
        return true;
    summary_number(sum, "weight_per_area", p->weight, "Pa");
    const double A = bed_ergun(&(struct bed_fluid){p->fluid.d, p->fluid.rho, 0.0}, bed->porosity,
                               1.0) * bed->height;
    const double B = bed_kozeny_carman(&p->fluid, bed->porosity, 1.0, 150.0) * bed->height;
    const double u_ergun = meets(B, A, p->weight), u_law = law_velocity(p);
    summary_number(sum, "u_mf_ergun", u_ergun, "m s-1");
    summary_number(sum, "u_mf_analytic", u_law, "m s-1");
    if (fit(p, &a, &b) == 0)
        return true;
    for (int k = 0; k < p->n; k++)
        if (!p->level[k].fixed && p->level[k].velocity >= beyond_above * meets(a, b, p->weight)) {
            plateau += p->level[k].drop;
            beyond++;
        }
    if (beyond == 0) {
        printf("the flow stays below fluidisation: Ergun %.5g m/s, drag law %.5g m/s\n", u_ergun,
               u_law);
        return true;
    }
    plateau /= beyond;
    const double u_mf = meets(a, b, plateau);
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
                 p->tolerance_velocity) && flat;
}

void reference_report(struct sim *s)
{
    struct pressure_drop *const p = s->reference;
    struct summary *const sum = &s->summary;
    double worst = 0.0;
    int fixed = 0;
    close_levels(p);
    for (int k = 0; k < p->n; k++) {
        const double error = add_row(p, &p->level[k]);
        if (p->level[k].fixed && p->level[k].velocity > 0.0) {
            if (fixed == 0 || (!isnan(worst) && !(fabs(error) <= fabs(worst))))
                worst = error;
            fixed++;
        }
    }
    table_print(stdout, p->table);
    printf("bed at the start of the flow: porosity %.5f, height %.5g m, diameter %.5g m\n",
           p->start.porosity, p->start.height, p->fluid.d);
    summary_number(sum, "bed_porosity", p->start.porosity, "1");
    summary_number(sum, "bed_height", p->start.height, "m");
    summary_number(sum, "bed_diameter", p->fluid.d, "m");
    summary_number(sum, "levels_fixed", fixed, "1");
    bool good = fluidisation(p, sum);
    if (fixed > 0) {
        summary_number(sum, "error_law_profile", worst, "1");
        good = judge("drop of the fixed bed against the drag law over its profile", worst,
                     p->tolerance_drop) && good;
    } else {
        printf("reference: FAIL no level of flow was measured with the bed fixed\n");
        good = false;
    }
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
    xfree(p);
}
