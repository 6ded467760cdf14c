/* verify/test_output.c - what a run leaves on disk, read back: every value in run.nc must be
 * the one put in, at its place, with its unit; summary.txt and run.xmf must agree with it. */
#include <sys/stat.h>
#include "made_run.h"

/* A whole run with two outputs and three samples. */
static void whole_run(struct sim *s, struct scene *scene)
{
    output_create(s, scene);
    output_fields(s);
    for (int k = 1; k <= 3; k++) {
        set_state(s, 0.237 * k);
        output_sample(s);
    }
    output_fields(s);
    output_close(s);
}

/* A variable's dimensions as "time grain component". */
static const char *dims_of(int nc, const char *name)
{
    static char text[512];
    int var, n = 0, dim[NC_MAX_VAR_DIMS];
    text[0] = '\0';
    if (nc_inq_varid(nc, name, &var) || nc_inq_var(nc, var, NULL, NULL, &n, dim, NULL))
        return "no such variable";
    for (int i = 0; i < n; i++) {
        char word[NC_MAX_NAME + 1];
        nc_inq_dimname(nc, dim[i], word);
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s", i ? " " : "", word);
    }
    return text;
}

static void check_dims(int nc, const char *name, const char *want)
{
    const char *const got = dims_of(nc, name);
    check(strcmp(got, want) == 0, "%s lies on (%s), want (%s)", name, got, want);
}

static void check_grains(int nc)
{
    double worst = 0.0;
    check_dims(nc, "position", "time grain component");
    for (size_t t = 0; t < 2; t++)
        for (size_t id = 0; id < GRAINS; id++)
            for (size_t c = 0; c < 3; c++) {
                const double got = number(nc, "position", (const size_t[]){t, id, c});
                const double off = got - grain_value((int)id, (int)c, t == 0 ? 0.0 : 0.237 * 3);
                worst = fabs(off) <= worst ? worst : fabs(off);
            }
    check(worst == 0.0, "positions are in order of id and exact: off by %g", worst);
    check_text(nc, "position", "units", "m");
    check_text(nc, "position", "long_name", "centre of the grain");
    for (size_t id = 0; id < GRAINS; id++) {
        check(number(nc, "radius", &id) == 1e-3 * (1.0 + (double)id), "radius of grain %zu",
              id);
        check(number(nc, "grain_mass", &id) == 1e-6 * (7.0 + (double)id), "mass of grain %zu",
              id);
        check(number(nc, "grain_species", &id) == (double)(id % 2), "species of grain %zu", id);
        check(number(nc, "species_now", (const size_t[]){1, id}) == (double)(id % 2),
              "whole numbers of grain %zu", id);
    }
    check_text(nc, "grain_species", "flag_meanings", "glass steel");
    check_dims(nc, "hidden", "no such variable");
}

static void check_fields(int nc)
{
    static const char *const name[] = {"fluid_fraction", "fluid_velocity_x", "fluid_velocity_y",
                                       "fluid_velocity_z"};
    static const char *const dims[] = {"time z y x", "time z y xf", "time z yf x",
                                       "time zf y x"};
    for (int f = 0; f < 4; f++) {
        double worst = 0.0;
        check_dims(nc, name[f], dims[f]);
        for (size_t t = 0; t < 2; t++)
            for (size_t k = 0; k < NZ + (f == 3); k++)
                for (size_t j = 0; j < NY + (f == 2); j++)
                    for (size_t i = 0; i < NX + (f == 1); i++) {
                        const double want = cell_value((int)i + 1, (int)j + 1, (int)k + 1,
                                                       t == 0 ? 0.0 : 0.237 * 3) +
                                            0.1 * f;
                        const double off =
                            number(nc, name[f], (const size_t[]){t, k, j, i}) - want;
                        worst = fabs(off) <= worst ? worst : fabs(off);
                    }
        check(worst < 1e-12, "%s is exact without ghosts: off by %g", name[f], worst);
    }
    for (size_t k = 0; k < NZ; k++)
        check_rel(number(nc, "z", &k), ((double)k + 0.5) * 0.036 / NZ, 1e-14, "centre z");
    check_rel(number(nc, "xf", (const size_t[]){NX}), 0.012, 1e-14, "last face x");
    check_text(nc, "x", "axis", "X");
    check_text(nc, "yf", "axis", "Y");
    check_text(nc, "z", "axis", "Z");
    check_text(nc, "z", "units", "m");
}

static void check_results(int nc)
{
    const size_t last = 2, second = 1;
    check_dims(nc, "drop_simulated", "drop_row");
    check(number(nc, "drop_velocity", &last) == 0.00893, "a column of a table");
    check(number(nc, "drop_simulated", &last) == 127.3, "another column of a table");
    check(isnan(number(nc, "drop_simulated", &second)), "a gap in a table stays a gap");
    check_text(nc, "drop_simulated", "units", "Pa");
    check_text(nc, "figure_drop", "file", "drop.png");
    check_text(nc, "figure_drop", "x", "velocity");
    check_text(nc, "figure_drop", "y_label", "drop / Pa");
    check_text(nc, "figure_drop", "curve_0", "simulated|points|simulated");
    int var = -1, log[2] = {-1, -1};
    nc_inq_varid(nc, "figure_drop", &var);
    nc_get_att_int(nc, var, "log", log);
    check(log[0] == 0 && log[1] == 1, "log axes of a figure: %d %d", log[0], log[1]);
    check_dims(nc, "kinetic_energy", "sample");
    check_text(nc, "kinetic_energy", "units", "J");
    for (size_t k = 0; k < 3; k++) {
        check_rel(number(nc, "sample_time", &k), 0.237 * ((double)k + 1.0), 1e-14,
                  "sample time");
        check_rel(number(nc, "kinetic_energy", &k), 5.19 * 0.237 * ((double)k + 1.0), 1e-14,
                  "sample of a series");
    }
    double porosity = 0.0;
    nc_get_att_double(nc, NC_GLOBAL, "summary_bed_porosity", &porosity);
    check(porosity == 0.41237, "a number of the summary is an attribute: %g", porosity);
    check_text(nc, NULL, "summary_verdict", "within 1 % of the law");
}

static void check_globals(int nc)
{
    static const char *const key[] = {"revision",       "compiler",    "flags",
                                      "host",           "date",        "threads",
                                      "library_netcdf", "library_gsl", "module_fluid"};
    int dim, unlimited = -1, n = 0, both[2] = {-1, -1};
    check_text(nc, NULL, "Conventions", "CF-1.10");
    for (size_t i = 0; i < sizeof key / sizeof key[0]; i++) {
        const char *const text = attribute(nc, NULL, key[i]);
        check(text[0] != '\0' && strcmp(text, "no such attribute") != 0, "%s is there: %s",
              key[i], text);
    }
    check_text(nc, NULL, "module_shape", "sphere");
    check(strstr(attribute(nc, NULL, "scene"), "fluid.density = 871.3 kg/m3") != NULL,
          "the scene as resolved is there");
    check_text(nc, "time", "axis", "T");
    check_text(nc, "time", "units", "s");
    nc_inq_dimid(nc, "time", &dim);
    nc_inq_unlimdims(nc, &n, NULL);
    if (n <= 2)
        nc_inq_unlimdims(nc, &n, both);
    unlimited = both[0] == dim || both[1] == dim;
    check(n == 2 && unlimited, "time and sample, and only they, are unlimited: %d", n);
}

static char *read_file(const char *directory, const char *name)
{
    char *const path = xprintf("%s/%s/%s", folder, directory, name);
    FILE *const file = fopen(path, "r");
    char *const text = xalloc(1 << 16, 1);
    if (!check(file != NULL, "%s/%s is there", directory, name))
        exit(check_end());
    const size_t n = fread(text, 1, (1 << 16) - 1, file);
    text[n] = '\0';
    fclose(file);
    xfree(path);
    return text;
}

static void check_summary(void)
{
    static const char *const want =
        "bed_porosity = 0.41237\nbed_height = 0.014875 m\n"
        "verdict = within 1 % of the law\n"
        "drop_1_velocity = 0.00237 m s-1\ndrop_1_simulated = 31.9 Pa\n"
        "drop_2_velocity = 0.00471 m s-1\ndrop_2_simulated = nan Pa\n"
        "drop_3_velocity = 0.00893 m s-1\ndrop_3_simulated = 127.3 Pa\n";
    char *const text = read_file("both", "summary.txt");
    check(strcmp(text, want) == 0, "summary.txt holds a line for each entry, then the tables");
    xfree(text);
}

/* Every element is closed by its own name, none is left open. */
static bool well_formed(const char *text)
{
    char open[32][64];
    int depth = 0;
    for (const char *p = strchr(text, '<'); p; p = strchr(p + 1, '<')) {
        const char *const end = strchr(p, '>');
        char name[64];
        if (!end || sscanf(p + 1, "%63[?/A-Za-z]", name) != 1)
            return false;
        if (name[0] == '?')
            continue;
        if (name[0] == '/') {
            if (depth == 0 || strcmp(open[--depth], name + 1) != 0)
                return false;
        } else if (end[-1] != '/') {
            if (depth == 32)
                return false;
            strcpy(open[depth++], name);
        }
    }
    return depth == 0;
}

/* Every array that run.xmf names is a variable of run.nc with the dimensions that it says. */
static void check_xdmf(int nc)
{
    char *const text = read_file("both", "run.xmf");
    int arrays = 0, wrong = 0;
    check(well_formed(text), "run.xmf is well-formed");
    for (const char *p = strstr(text, "run.nc:/"); p; p = strstr(p + 1, "run.nc:/")) {
        char name[64];
        int var, n = 0, dim[NC_MAX_VAR_DIMS];
        const char *said = p;
        while (said > text && strncmp(said, "Dimensions=\"", 12) != 0)
            said--;
        said += 12;
        arrays++;
        if (sscanf(p, "run.nc:/%63[a-z_]", name) != 1 || nc_inq_varid(nc, name, &var) ||
            nc_inq_var(nc, var, NULL, NULL, &n, dim, NULL)) {
            wrong++;
            continue;
        }
        for (int i = 0; i < n; i++) {
            size_t length = 0;
            char *end;
            nc_inq_dimlen(nc, dim[i], &length);
            wrong += strtoul(said, &end, 10) != length;
            said = end;
        }
        wrong += *said != '"';
    }
    /* per output: positions, radius; fluid_fraction */
    check(arrays == 2 * 3, "run.xmf names %d arrays, want 6", arrays);
    check(wrong == 0, "arrays that run.nc does not hold so: %d", wrong);
    char *const when = xprintf("<Time Value=\"%.17g\"/>", 0.237 * 3);
    check(strstr(text, when) != NULL, "run.xmf says when");
    xfree(when);
    xfree(text);
}

static void test_whole(struct scene *scene)
{
    struct stat info;
    struct sim *const s = made_sim(true, true, "both");
    whole_run(s, scene);
    char *const part = xprintf("%s/run.nc.part", s->run.directory);
    check(stat(part, &info) != 0, "no temporary file is left");
    const int nc = open_nc("both", "run.nc");
    check_globals(nc);
    check_grains(nc);
    check_fields(nc);
    check_results(nc);
    check_summary();
    check_xdmf(nc);
    nc_close(nc);
    xfree(part);
    free_made(s);
}

/* Scenes without a fluid, without grains: none of their dimensions. */
static void test_halves(struct scene *scene)
{
    int dim;
    struct sim *s = made_sim(true, false, "dry");
    whole_run(s, scene);
    free_made(s);
    int nc = open_nc("dry", "run.nc");
    check_dims(nc, "position", "time grain component");
    check(nc_inq_dimid(nc, "x", &dim) == NC_EBADDIM, "a dry run has no grid");
    nc_close(nc);
    s = made_sim(false, true, "deep/in/clear");
    whole_run(s, scene);
    free_made(s);
    nc = open_nc("deep/in/clear", "run.nc");
    check_dims(nc, "fluid_fraction", "time z y x");
    check(nc_inq_dimid(nc, "grain", &dim) == NC_EBADDIM, "a run without grains has no grains");
    nc_close(nc);
}

int main(void)
{
    if (!mkdtemp(folder))
        return 2;
    struct scene *const scene = made_scene();
    test_whole(scene);
    test_halves(scene);
    scene_free(scene);
    clean_up();
    return check_end();
}
