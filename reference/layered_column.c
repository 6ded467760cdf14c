/* reference/layered_column.c - steady seepage along z through layers: the head at each height.
 *
 * Layers of cells in series, with flux U and resistance R_k(U), the head lost per flux and
 * length: -dH/dz = R_k U,   rho g R_k U = 18 mu (1-eps_k) Fhat(eps_k, rho U d_k/mu) U/(eps_k
 * d_k^2) H(z_k) = H(0) - U [R_1 h + ... + R_{k-1} h + R_k h/2] exact for layers that are each
 * uniform [Darcy1856]. The law is the drag law of the run, eps_k the mean fluid fraction of the
 * layer as the grid has it, d_k the volume-to-surface mean diameter of the grains in it,
 * weighted with their shares. Sides: a head or an outflow (head 0), or a given flux or inflow.
 * Where both sides hold a head, U is the root of the total loss, so that a law that is not
 * linear in U is solved as such. Compared at the end of the run, which must be steady. */
#include "reference.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include "../solver/bed.h"
#include "../solver/fluid_state.h"
#include "../solver/sim.h"

const struct about reference_about = {
    .name = "layered_column",
    .summary = "head in a steady column of layers along z against the resistances in series",
    .equation = "H_1 - H_2 = U sum R_k h, R_k from the drag law",
    .source = "[Darcy1856]",
    .range = "steady flow along z, layers uniform in x and y"};
const struct key reference_keys[] = {
    {"reference", "tolerance", KEY_REAL, "1", "(0, inf)", "1e-6",
     "of the heads, in parts of the difference of head, and of the flux"},
    {0},
};

struct layered_column {
    double tolerance, gravity, rho, mu, h; /* 1, m/s2, kg/m3, Pa s, m */
    int n;
    double *eps, *d; /* per layer: fluid fraction; m, diameter */
    double lost;     /* m, the loss of head asked for; of the root */
    struct table *table;
    const struct drag_grain *grain; /* of the first species, for all */
};

enum { COLUMNS = 6 };
static const struct table pattern = {
    .name = "head",
    .title = "head in the column",
    .n_columns = COLUMNS,
    .column = {{"height", "m", "height of the cell's centre"},
               {"porosity", "1", "mean fluid fraction of the layer"},
               {"conductivity", "m s-1", "hydraulic conductivity of the layer, exact"},
               {"simulated", "m", "total head, simulated"},
               {"exact", "m", "total head, exact"},
               {"error", "1", "(simulated - exact) / difference of head"}},
    .figure = {.file = "head.png",
               .title = "head in the column",
               .x = "height",
               .x_label = "height / m",
               .y_label = "total head / m",
               .n_curves = 2,
               .curve = {{"simulated", "points", "simulated"},
                         {"exact", "line", "layers in series, exact"}}}};

static bool gives_head(enum side_kind kind)
{
    return kind == SIDE_HEAD || kind == SIDE_OUTFLOW;
}

void reference_create(struct sim *s, struct scene *scene)
{
    struct layered_column *const p = xalloc(1, sizeof *p);
    const struct side *const side = s->domain.side;
    const double g = v3_norm(s->domain.gravity);
    s->reference = p;
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    if (!s->fluid.exists || (scene_errors(scene) == 0 && s->grains.n == 0))
        scene_error(scene, "modules", NULL, "reference",
                    "layered_column needs a fluid and grains");
    for (int z = Z_LO; z <= Z_HI; z++)
        if (!gives_head(side[z].kind) && side[z].kind != SIDE_FLUX &&
            side[z].kind != SIDE_INFLOW)
            scene_error(scene, "domain", NULL, side_name[z],
                        "layered_column needs head, outflow, flux or inflow here");
    if (!gives_head(side[Z_LO].kind) && !gives_head(side[Z_HI].kind))
        scene_error(scene, "domain", NULL, side_name[Z_HI],
                    "layered_column needs head or outflow at z- or z+");
    if (scene_errors(scene) > 0)
        return;
    p->gravity = g > 0.0 ? g : 9.81;
    p->rho = s->fluid.rho;
    p->mu = s->fluid.mu;
    p->grain = s->coupling.drag_of.kind;
    p->n = s->grid.n[2];
    p->h = s->grid.h[2];
    p->eps = xalloc((size_t)p->n, sizeof *p->eps);
    p->d = xalloc((size_t)p->n, sizeof *p->d);
    p->table = tables_add(&s->tables, &pattern);
}

void reference_watch(struct sim *s)
{
    (void)s; /* the end of the run is compared */
}

/* Sauter mean diameter in each layer. */
static void diameters(const struct sim *s, double *d)
{
    const struct coupling *const c = &s->coupling;
    const size_t n = (size_t)s->grid.n[2];
    double *const cubes = xalloc(n, sizeof *cubes), *const squares = xalloc(n, sizeof *squares);
    for (int i = 0; i < s->grains.n; i++) {
        const double size = s->grains.species[s->grains.kind[i]].diameter;
        const struct share *const share = &c->shares[(size_t)i * (size_t)c->reach];
        for (int k = 0; k < c->n_shares[i]; k++) {
            const int layer = share[k].cell / s->grid.sk - 1;
            cubes[layer] += share[k].weight * size * size * size;
            squares[layer] += share[k].weight * size * size;
        }
    }
    for (size_t k = 0; k < n; k++)
        d[k] = squares[k] > 0.0 ? cubes[k] / squares[k] : 0.0;
    xfree(cubes);
    xfree(squares);
}

/* Loss of head per length of layer k at flux u, with the sign of u. */
static double slope(const struct layered_column *p, int k, double u)
{
    const struct bed_fluid f = {p->d[k], p->rho, p->mu, p->grain};
    const double loss = p->d[k] > 0.0 ? bed_law(&f, p->eps[k], fabs(u)) : 0.0;
    return copysign(loss, u) / (p->rho * p->gravity);
}

/* m; total loss at flux u beyond the loss asked for. */
static double loss_beyond(double u, void *params)
{
    const struct layered_column *const p = params;
    double loss = 0.0;
    for (int k = 0; k < p->n; k++)
        loss += slope(p, k, u) * p->h;
    return loss - p->lost;
}

/* m/s; the flux, upwards, that loses the head `lost`; NAN if the column resists nothing. */
static double flux_of(struct layered_column *p, double lost)
{
    double hi = 1e-12, u = 0.0;
    p->lost = fabs(lost);
    if (p->lost == 0.0)
        return 0.0;
    while (loss_beyond(hi, p) < 0.0) {
        hi *= 2.0;
        if (hi > 1e9)
            return (double)NAN;
    }
    gsl_function f = {.function = loss_beyond, .params = p};
    gsl_root_fsolver *const solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    gsl_root_fsolver_set(solver, &f, 0.0, hi);
    for (int i = 0; i < 200; i++) {
        gsl_root_fsolver_iterate(solver);
        u = gsl_root_fsolver_root(solver);
        if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver),
                                   gsl_root_fsolver_x_upper(solver), 0.0, 1e-14) == GSL_SUCCESS)
            break;
    }
    gsl_root_fsolver_free(solver);
    return copysign(u, lost);
}

/* m/s, upwards, where the side gives it. */
static double given_flux(const struct sim *s, int z)
{
    const struct side *const side = &s->domain.side[z];
    const double in =
        side->kind == SIDE_FLUX ? course_at(&side->flux, s->t) : fluid_inflow(s, z, s->t);
    return z == Z_LO ? in : -in;
}

/* m; where the side gives it: an outflow's is 0. */
static double given_head(const struct sim *s, int z)
{
    const struct side *const side = &s->domain.side[z];
    return side->kind == SIDE_HEAD ? course_at(&side->head, s->t) : 0.0;
}

/* m/s; mean flux upwards through the low faces of the layers above the first. */
static double simulated_flux(const struct sim *s)
{
    const struct grid *const g = &s->grid;
    double sum = 0.0;
    for (int k = 2; k <= g->n[2]; k++)
        for (int j = 1; j <= g->n[1]; j++)
            for (int i = 1; i <= g->n[0]; i++)
                sum += grid_face(s->fluid.eps, cell(g, i, j, k), g->sk) *
                       s->fluid.u[2][cell(g, i, j, k)];
    return sum / ((double)g->n[0] * g->n[1] * (g->n[2] - 1));
}

/* Rows of the table; returns the largest error. `bottom` is the exact head at z = 0. */
static double add_rows(const struct sim *s, struct layered_column *p, double u, double bottom,
                       double scale)
{
    double *const pressure = xalloc((size_t)p->n, sizeof *pressure);
    double head = bottom, worst = 0.0;
    bed_planes(s, 2, s->fluid.p, pressure);
    for (int k = 0; k < p->n; k++) {
        const double fall = slope(p, k, u), exact = head - 0.5 * p->h * fall;
        const double simulated = pressure[k] / (p->rho * p->gravity);
        const double error = (simulated - exact) / scale;
        const double row[COLUMNS] = {
            (k + 0.5) * p->h, p->eps[k], fall != 0.0 ? u / fall : (double)NAN,
            simulated,        exact,     error};
        table_row(p->table, row);
        if (!(fabs(error) <= worst) && !isnan(worst))
            worst = fabs(error);
        head -= p->h * fall;
    }
    xfree(pressure);
    return worst;
}

void reference_report(struct sim *s)
{
    struct layered_column *const p = s->reference;
    struct summary *const sum = &s->summary;
    const bool low = gives_head(s->domain.side[Z_LO].kind);
    const bool high = gives_head(s->domain.side[Z_HI].kind);
    bed_planes(s, 2, s->fluid.eps, p->eps);
    diameters(s, p->d);
    const double u = low && high ? flux_of(p, given_head(s, Z_LO) - given_head(s, Z_HI))
                                 : given_flux(s, low ? Z_HI : Z_LO);
    p->lost = 0.0;
    const double lost = loss_beyond(u, p), got = simulated_flux(s);
    const double bottom = low ? given_head(s, Z_LO) : given_head(s, Z_HI) + lost;
    const double worst = add_rows(s, p, u, bottom, fabs(lost));
    const double flux_error = got / u - 1.0;
    const bool good = worst <= p->tolerance && fabs(flux_error) <= p->tolerance;
    table_print(stdout, p->table);
    summary_number(sum, "flux", got, "m s-1");
    summary_number(sum, "flux_exact", u, "m s-1");
    summary_number(sum, "flux_error", flux_error, "1");
    summary_number(sum, "head_error", worst, "1");
    summary_reference(
        sum, (struct comparison){.quantity = "flux; error: the larger of flux and heads",
                                 .source = reference_about.source,
                                 .unit = "m s-1",
                                 .got = got,
                                 .want = u,
                                 .error = isnan(flux_error) ? flux_error
                                                            : fmax(worst, fabs(flux_error)),
                                 .tolerance = p->tolerance});
    summary_text(sum, "verdict", good ? "pass" : "FAIL");
    printf(
        "reference: %s flux %.8g m/s against %.8g m/s, %+.2e, largest error of a head %.2e of "
        "the difference, tolerance %g\n",
        good ? "pass" : "FAIL", got, u, flux_error, worst, p->tolerance);
}

void reference_free(struct sim *s)
{
    struct layered_column *const p = s->reference;
    if (!p)
        return;
    xfree(p->eps);
    xfree(p->d);
    xfree(p);
}
