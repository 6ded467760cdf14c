/* verify/test_forces_standard.c - pressure force, viscous force and buoyancy, each by itself and together, in
 * every form of the momentum equation: in developed flow between plates f + mu u'' = 0, so a grain feels V f
 * from the pressure and -V f from the viscous stress; handed over to the last digit. How scenes name them. */
/* slots: porosity/trilinear solver/fluid/navier_stokes drag/stokes */
#include <omp.h>
#include "../solver/force_names.h"
#include "check.h"
#include "harness.h"

static const double f = 3.7, mu = 0.0231, rho = 871.0, height = 7e-3, d = 0.83e-3;

/* Plates at z = 0 and `height`, the developed profile of the grid, one grain held in it. */
static struct sim *channel(char form, const char *ways)
{
    char *const text = xprintf(
        "[domain]\nsize = 6 6 7 mm\ncells = 3 3 7\nx = periodic\ny = periodic\nz = wall\n"
        "[fluid]\ndensity = %g kg/m3\nviscosity = %g Pa s\ndt = 0.1 ms\nform = %c\n"
        "[flow]\npressure_gradient = %g 0 0 Pa/m\n[run]\nend = 1 s\nforce = on\n"
        "[grains ball]\ndiameter = %g m\ndensity = 2650 kg/m3\nfill = point\n"
        "position = 2.9 3.3 4.1 mm\nfrozen = yes\n[coupling]\nways = %s\n",
        rho, mu, form, f, d, ways);
    struct sim *const s = sim_from(text);
    const struct grid *const g = &s->grid;
    for (size_t c = 0; c < g->total; c++) {
        const double z = ((double)((int)c / g->sk) - 0.5) * g->h[2];
        /* the walls' ghosts mirror the velocity: the discrete profile is off the parabola by h^2/4 */
        s->fluid.u[0][c] = f / (2.0 * mu) * (z * (height - z) + 0.25 * g->h[2] * g->h[2]);
    }
    xfree(text);
    return s;
}

/* The load without drag, which is stationary; of form c drag alone. */
static void test_each(char form)
{
    const double V = PI / 6.0 * d * d * d;
    struct sim *const s = channel(form, "one");
    struct fluid_forces *const o = &s->coupling.forces;
    const double g = v3_norm(s->domain.gravity), whole = form == 'c' ? 0.0 : 1.0;
    for (int k = 0; k < 8; k++) {
        o->pressure = k & 1 ? 1.0 : 0.0;
        o->viscous = k & 2 ? 1.0 : 0.0;
        o->weight = k & 4 ? -1.0 : 0.0;
        step(s);
        const vec3 rest = v3_sub(s->grains.load[0], s->coupling.drag[0]);
        char *const what = xprintf("form %c:%s%s%s", form, k & 1 ? " pressure" : "",
                                   k & 2 ? " viscous" : "", k & 4 ? " buoyancy" : "");
        check_abs(rest.x / (V * f), whole * (o->pressure - o->viscous), 1e-9, what);
        check_abs(rest.z / (rho * V * g), -o->weight, 1e-12, "  upwards");
        xfree(what);
    }
    sim_free(s);
}

/* Two-way: what the grain feels of each the fluid does not. */
static void test_handed_over(char form)
{
    struct sim *const s = channel(form, "two");
    struct fluid_forces *const o = &s->coupling.forces;
    for (int k = 0; k < 8; k++) {
        o->pressure = k & 1 ? 1.0 : 0.0;
        o->viscous = k & 2 ? 1.0 : 0.0;
        o->weight = k & 4 ? -1.0 : 0.0;
        for (int n = 0; n < 3; n++)
            step(s);
        const vec3 to = s->coupling.to_grains, from = s->coupling.from_fluid;
        check(v3_norm(v3_sub(to, from)) < 1e-13 * v3_norm(to) && v3_norm(to) > 0.0,
              "form %c, choice %d: handed over but for %.1e of %.2e N", form, k,
              v3_norm(v3_sub(to, from)) / v3_norm(to), v3_norm(to));
    }
    sim_free(s);
}

static void test_name(const char *text, bool fluid, const char *want)
{
    char *const got = force_names(text, fluid);
    check(strcmp(got, want) == 0, "\"%s\"%s: %s", text, fluid ? "" : " without a fluid", got);
    xfree(got);
}

static void test_names(void)
{
    test_name("standard", true, "buoyancy+pressure_gradient+viscous");
    test_name("standard", false, "none");
    test_name("virtual_mass, brownian", true,
              "brownian+buoyancy+pressure_gradient+virtual_mass+viscous");
    test_name("magnus -viscous magnus", true, "buoyancy+magnus+pressure_gradient");
    test_name("none", true, "none");
    test_name("none + buoyancy", true, "buoyancy");
    test_name("-buoyancy -viscous -pressure_gradient", true, "none");
    test_name("saffman", false, "saffman");
    check(force_names_given("a, viscous", "viscous") &&
              !force_names_given("viscous_torque", "viscous"),
          "a name is a whole word");
    char *const wrong = force_names_wrong("none -a b+c", "a | b | cc");
    check(wrong && strcmp(wrong, "c") == 0, "the one that is none of them: %s", wrong);
    xfree(wrong);
}

int main(void)
{
    omp_set_num_threads(1);
    test_names();
    for (int form = 'a'; form <= 'c'; form++) {
        test_each((char)form);
        test_handed_over((char)form);
    }
    return check_end();
}
