/* verify/test_probes.c - probes: interpolation is exact for linear fields, planes and drops,
 * permeability of a uniform bed and its end of a run, tables of lines, refusals. */
/* slots: drag/kozeny_carman porosity/divided solver/fluid/navier_stokes contact/linear */
#include <string.h>
#include "../solver/fluid_state.h"
#include "../solver/probes.h"
#include "../solver/sample.h"
#include "check.h"
#include "harness.h"

static double linear(double x, double y, double z)
{
    return 1.3 + 17.0 * x - 29.0 * y + 8.1 * z;
}

static void check_linear(void)
{
    struct sim *const s = sim_from(
        "[domain]\nsize = 0.5 0.7 0.9 m\ncells = 5 4 6\nz+ = outflow\n"
        "[fluid]\ndensity = 1 kg/m3\nviscosity = 1 Pa s\ndt = 1 ms\n[run]\nend = 1 s\n");
    const struct grid *const g = &s->grid;
    for (int k = 0; k <= g->n[2] + 1; k++)
        for (int j = 0; j <= g->n[1] + 1; j++)
            for (int i = 0; i <= g->n[0] + 1; i++) {
                const int c = cell(g, i, j, k);
                for (int a = 0; a < 3; a++)
                    s->fluid.u[a][c] = (a + 1) * linear((i - (a == 0 ? 1.0 : 0.5)) * g->h[0],
                                                        (j - (a == 1 ? 1.0 : 0.5)) * g->h[1],
                                                        (k - (a == 2 ? 1.0 : 0.5)) * g->h[2]);
                s->fluid.p[c] =
                    linear((i - 0.5) * g->h[0], (j - 0.5) * g->h[1], (k - 0.5) * g->h[2]);
            }
    static const double at[3][3] = {{0.237, 0.411, 0.763}, {0.05, 0.6, 0.08}, {0.5, 0.35, 0.9}};
    for (int q = 0; q < 3; q++) {
        const double want = linear(at[q][0], at[q][1], at[q][2]);
        const vec3 x = v3(at[q][0], at[q][1], at[q][2]);
        check_rel(sample_pressure(s, x), want, 1e-13, "pressure at a point");
        for (int a = 0; a < 3; a++)
            check_rel(sample_velocity(s, a, x), (a + 1) * want, 1e-13, "velocity at a point");
    }
    check_rel(plane_pressure(s, 1, 0.2), linear(0.25, 0.2, 0.45), 1e-13, "mean over a plane");
    check_rel(plane_flux(s, 2, 0.33), 3.0 * linear(0.25, 0.35, 0.33), 1e-13, "flux through it");
    check_rel(plane_flux(s, 2, 0.9), 3.0 * linear(0.25, 0.35, 0.9), 1e-13, "through a side");
    sim_free(s);
}

static double value_of(const struct sim *s, const char *name)
{
    for (int i = 0; i < s->series.n; i++)
        if (strcmp(s->series.entry[i].name, name) == 0)
            return *s->series.entry[i].value;
    return (double)NAN;
}

/* A uniform bed driven by a gradient, or from an inflow: k = mu eps^2/beta of the drag law. */
static void check_permeability(const char *sides)
{
    const double eps = 1.0 - PI / 6.0;
    char *const text = xprintf(
        "[grains bed]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = unit_cell\n"
        "spacing = 1 mm\nfrozen = yes\nmaterial = m\n[material m]\nstiffness = 100 N/m\n"
        "restitution = 0.6\nfriction = 0.4\n"
        "[domain]\nsize = 3 2 7 mm\ncells = 3 2 7\nx = periodic\ny = periodic\n%s"
        "[fluid]\ndensity = 913 kg/m3\nviscosity = 1.37 mPa s\ndt = 0.1 ms\n"
        "[probe k]\nkind = permeability\nlow = 1.2 mm\nhigh = 5.9 mm\ntolerance = 1e-9\n"
        "over = 2 ms\nstop = yes\n[probe line]\nkind = line\nat = 1 1 0 mm\nto = 1 1 7 mm\n"
        "points = 8\n[probe p]\nkind = plane\nposition = 3.5 mm\n[run]\nend = 1 s\n",
        sides);
    struct sim *const s = sim_from(text);
    int n = 0;
    while (!s->run.done && n < 2000) {
        step(s);
        probes_watch(s);
        n++;
    }
    const double k = 1e-6 * eps * eps * eps / (180.0 * (1.0 - eps) * (1.0 - eps));
    check_rel(value_of(s, "k_permeability"), k, 1e-6, "Kozeny and Carman's permeability, m2");
    check(s->run.done && n < 1000, "it ends the run, after %d steps", n);
    check_rel(value_of(s, "p_porosity"), eps, 1e-12, "porosity of a plane");
    check_rel(value_of(s, "p_flux"), value_of(s, "k_flux"), 1e-9, "flux of a plane");
    probes_report(s);
    const struct table *const t = s->tables.n > 0 ? s->tables.table[0] : NULL;
    check(t && t->n_rows == 8, "the line is a table of 8 rows");
    if (t && t->n_rows == 8)
        check_rel(t->row[7 * t->n_columns + 3], 7e-3, 1e-14, "its last point");
    const struct summary_line *const l = summary_find(&s->summary, "k_converged");
    check(l && strcmp(l->value, "yes") == 0, "the summary says that it has converged");
    check(summary_find(&s->summary, "p_pressure_mean") != NULL, "means are in the summary");
    sim_free(s);
    xfree(text);
}

int main(void)
{
    check_linear();
    check_permeability("z = periodic\n[flow]\npressure_gradient = 0 0 3 Pa/m\n");
    check_permeability("z- = inflow\nz+ = outflow\n[flow]\nvelocity = 0.02 mm/s\n");
    return check_end();
}
