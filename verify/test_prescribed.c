/* verify/test_prescribed.c - a fixed flow: formulas, files, grains carried in it, one-way. */
/* slots: drag/stokes porosity/divided solver/fluid/prescribed contact/linear */
#include <netcdf.h>
#include <string.h>
#include "../solver/fluid_state.h"
#include "check.h"
#include "harness.h"

#define BOX   "[domain]\nsize = 12 10 8 mm\ncells = 6 5 4\nx = periodic\ngravity = 0 0 0 m/s2\n"
#define WATER "[fluid]\ndensity = 1000 kg/m3\nviscosity = 3 mPa s\ndt = 1 ms\n"
#define GRAIN                                                                                  \
    "[grains a]\ndiameter = 0.2 mm\ndensity = 2650 kg/m3\nfill = point\nposition = 3 4 5 mm\n" \
    "material = m\n[material m]\nstiffness = 100 N/m\nrestitution = 0.6\nfriction = 0.4\n"
#define RUN "[run]\nend = 1 s\ndt = 5 us\n"

static double field_at(const char *keys, int a, int i, int j, int k, double t)
{
    char *const text = xprintf(BOX WATER "%s" RUN, keys);
    struct sim *const s = sim_from(text);
    s->t = t;
    fluid_sense(s);
    const double u = s->fluid.u[a][cell(&s->grid, i, j, k)];
    sim_free(s);
    xfree(text);
    return u;
}

static void check_formulas(void)
{
    check_rel(field_at("velocity = 1 -3 2 mm/s\n", 1, 2, 3, 1, 0.0), -3e-3, 1e-15, "uniform");
    check_rel(field_at("field = shear\nacross = y\nvelocity = 5 0 0 mm/s\n", 0, 2, 4, 1, 0.0),
              5e-3 * 0.7, 1e-14, "shear");
    check_rel(
        field_at("field = parabolic\nacross = z\nvelocity = 5 0 0 mm/s\n", 0, 2, 4, 2, 0.0),
        20e-3 * 0.375 * 0.625, 1e-14, "parabolic");
    check_rel(field_at("field = vortex\nspin = 0 0 3 1/s\n", 0, 2, 4, 2, 0.0), -3.0 * 2e-3,
              1e-13, "vortex: x");
    check_rel(field_at("field = vortex\nspin = 0 0 3 1/s\n", 1, 2, 4, 2, 0.0), -3.0 * 3e-3,
              1e-13, "vortex: y");
    check_rel(field_at("velocity = 1 0 0 mm/s\nperiod = 0.6 s\n", 0, 1, 1, 1, 0.1), 0.5e-3,
              1e-13, "it swings");
}

/* A grain is carried: v -> u of a uniform flow, by the drag's relaxation. */
static void check_carried(void)
{
    struct sim *const s = sim_from(BOX WATER "velocity = 7 0 0 mm/s\n" GRAIN RUN);
    const double d = 0.2e-3, mass = 2650.0 * PI / 6.0 * d * d * d;
    const double rate = 3.0 * PI * 3e-3 * d / mass;
    check(s->coupling.ways == 1, "it is one-way by itself");
    for (int n = 0; n < 20; n++)
        step(s);
    const double got = s->grains.vel[0].x / 7e-3, want = 1.0 - exp(-rate * s->t);
    check(fabs(got - want) < 0.02, "relaxes with the drag: %.4f, exact %.4f", got, want);
    for (int n = 0; n < 200; n++)
        step(s);
    check_rel(s->grains.vel[0].x, 7e-3, 5e-4,
              "goes with the flow (superficial: over the fluid fraction), m/s");
    check(s->fluid.u[0][cell(&s->grid, 2, 2, 2)] == 7e-3, "which does not feel it");
    sim_free(s);
}

/* A grain that fills a ninth of its cell is held in a flow that comes in by a side as [flow] has it: the
 * velocity is superficial, so the grain sees U eps_f/eps with eps_f that of the faces, see coupling.h. */
static void check_inflow(void)
{
    struct sim *const s = sim_from(
        BOX "z- = inflow\nz+ = outflow\n[flow]\nvelocity = 1.3 mm/s\nvelocity_end = 2.6 "
            "mm/s\nsteps = 2\n"
            "hold = 2 ms\n" WATER
            "[grains a]\ndiameter = 1.2 mm\ndensity = 2650 kg/m3\nfill = point\nfrozen = yes\n"
            "position = 3 5 5 mm\nmaterial = m\n[material m]\nstiffness = 100 N/m\n"
            "restitution = 0.6\nfriction = 0.4\n" RUN);
    const double d = 1.2e-3, eps = 1.0 - PI / 6.0 * d * d * d / 8e-9;
    const double seen = 0.5 * (1.0 + eps) / eps;
    step(s);
    check_rel(s->coupling.drag[0].z, 3.0 * PI * 3e-3 * d * 1.3e-3 * seen, 1e-12,
              "drag in a flow from the inflow side, superficial: first level, N");
    for (int n = 0; n < 3; n++)
        step(s);
    check_rel(s->coupling.drag[0].z, 3.0 * PI * 3e-3 * d * 2.6e-3 * seen, 1e-12,
              "second level");
    sim_free(s);
}

/* The stress of a vortex is its centripetal acceleration, rho Du/Dt = -rho omega^2 r. */
static void check_stress(void)
{
    struct sim *const s = sim_from(BOX WATER "field = vortex\nspin = 0 0 3 1/s\n" GRAIN RUN);
    fluid_sense(s);
    check_rel(s->fluid.stress[1][cell(&s->grid, 3, 4, 2)], -1000.0 * 9.0 * (6e-3 - 5e-3), 1e-12,
              "rho Du/Dt of a vortex, N/m3");
    sim_free(s);
}

/* The field of a run.nc, as output.c writes it. */
static void check_file(void)
{
    char path[] = "/tmp/silt-field-XXXXXX";
    close(mkstemp(path));
    int nc, dim[4], var;
    const int n[3] = {6, 5, 4};
    static const char *const names[3] = {"fluid_velocity_x", "fluid_velocity_y",
                                         "fluid_velocity_z"};
    nc_create(path, NC_NETCDF4 | NC_CLOBBER, &nc);
    nc_def_dim(nc, "time", 2, &dim[0]);
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            char name[4] = {'d', (char)('0' + a), (char)('0' + b), '\0'};
            nc_def_dim(nc, name, (size_t)n[2 - b] + (a == 2 - b), &dim[1 + b]);
        }
        nc_def_var(nc, names[a], NC_DOUBLE, 4, dim, &var);
    }
    nc_enddef(nc);
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < n[2] + (a == 2); k++)
            for (int j = 0; j < n[1] + (a == 1); j++)
                for (int i = 0; i < n[0] + (a == 0); i++) {
                    const size_t at[4] = {1, (size_t)k, (size_t)j, (size_t)i};
                    const double u = 1e-3 * (a + 1) + 1e-4 * i + 1e-5 * j + 1e-6 * k;
                    nc_inq_varid(nc, names[a], &var);
                    nc_put_var1_double(nc, var, at, &u);
                }
    nc_close(nc);
    char *const keys = xprintf("field = file\nfile = %s\n", path);
    check_rel(field_at(keys, 2, 3, 2, 5, 0.0), 3e-3 + 2e-4 + 1e-5 + 4e-6, 1e-14,
              "the last output of a file");
    check_rel(field_at(keys, 1, 4, 6, 1, 0.0), 2e-3 + 3e-4 + 5e-5, 1e-14, "its last face");
    xfree(keys);
    unlink(path);
}

int main(void)
{
    check_formulas();
    check_carried();
    check_inflow();
    check_stress();
    check_file();
    return check_end();
}
