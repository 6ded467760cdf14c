/* verify/test_course.c - values in time: constants, ramps, tables; profiles and courses at the
 * sides of the box. */
/* slots: solver/fluid/navier_stokes */
#include <string.h>
#include "../solver/fluid_state.h"
#include "check.h"
#include "harness.h"

static char table[] = "/tmp/silt-table-XXXXXX";

static void write_table(const char *text)
{
    FILE *const file = fopen(table, "w");
    if (!file)
        abort();
    fputs(text, file);
    fclose(file);
}

/* The largest error of a table's course, read by a scene; NAN where the scene refuses it. */
static struct course read_course(const char *text, int *errors)
{
    static const struct key keys[] = {{"flow", "table", KEY_TEXT, "", "", "", "a table"}, {0}};
    char *const override = xprintf("flow.table=%s", table);
    char *overrides[] = {override};
    write_table(text);
    struct scene *const scene = scene_load(NULL, 1, overrides);
    scene_declare(scene, keys);
    struct course c = {.value = 3.1};
    course_read_table(&c, scene, "flow", NULL, "table");
    *errors = scene_errors(scene);
    scene_free(scene);
    xfree(override);
    return c;
}

static void check_tables(void)
{
    int errors;
    struct course c =
        read_course("time, velocity\n# m/s\n0.5, 1.7\n1.25 -0.3\n\n3,2.385\n", &errors);
    check(errors == 0 && c.n == 3, "a table of three lines is read: %d", c.n);
    check_rel(course_at(&c, 0.1), 1.7, 1e-15, "before the first line");
    check_rel(course_at(&c, 0.875), 0.7, 1e-14, "between two lines");
    check_rel(course_at(&c, 2.125), 1.0425, 1e-14, "between two others");
    check_rel(course_at(&c, 99.0), 2.385, 1e-15, "after the last line");
    check_rel(course_most(&c), 2.385, 1e-15, "the largest");
    c.ramp = 3.5;
    check_rel(course_at(&c, 0.875), 0.25 * 0.7, 1e-14, "with a ramp");
    course_free(&c);
    static const char *const bad[] = {
        "", "0, 1\n0, 2\n", "0, 1\n1\n", "0, 1\nx, 2\n", "0, 1\n1, 2, 3\n", "0, inf\n"};
    for (int i = 0; i < 6; i++) {
        c = read_course(bad[i], &errors);
        check(errors == 1, "table %d is refused", i);
        course_free(&c);
    }
    c = (struct course){.value = 2.385, .ramp = 0.8};
    check_rel(course_at(&c, 0.3), 2.385 * 0.375, 1e-15, "a ramp");
    check_rel(course_at(&c, 4.0), 2.385, 1e-15, "after a ramp");
}

static double mean_through(const struct sim *s)
{
    double sum = 0.0;
    for (int k = 1; k <= s->grid.n[2]; k++)
        for (int j = 1; j <= s->grid.n[1]; j++)
            sum += s->fluid.u[0][cell(&s->grid, 1, j, k)];
    return sum / (s->grid.n[1] * s->grid.n[2]);
}

static void check_inflow(void)
{
    write_table("0, 0.01\n0.2, 0.03\n");
    char *const text =
        xprintf("[domain]\nsize = 4 3 2 mm\ncells = 4 7 5\nx- = inflow\nx+ = outflow\n"
                "[flow]\ntable = %s\nprofile = parabolic\n"
                "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 1 ms\n"
                "[run]\nend = 1 s\n",
                table);
    struct sim *const s = sim_from(text);
    fluid_velocity_sides(s, 0.05);
    check_rel(mean_through(s), 0.015, 1e-14, "parabola by parabola: mean of the table");
    const double x = 3.5 / 7.0, h = 1.0 / 7.0, z = 0.5, hz = 0.2;
    const double want =
        0.015 * 6.0 * (x * (1.0 - x) - h * h / 12.0) * 6.0 * (z * (1.0 - z) - hz * hz / 12.0);
    check_rel(s->fluid.u[0][cell(&s->grid, 1, 4, 3)], want, 1e-13, "in the middle");
    for (int k = 0; k < 3; k++)
        step(s);
    check_rel(mean_through(s), 0.0103, 1e-12, "after three steps");
    sim_free(s);
    xfree(text);
    struct sim *const own = sim_from(
        "[domain]\nsize = 4 3 2 mm\ncells = 4 7 5\nx- = inflow\nx+ = outflow\ny- = inflow\n"
        "[flow]\nvelocity = 2 mm/s\n[side x-]\ninflow = 7 mm/s\nramp = 10 ms\n"
        "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 1 ms\n[run]\nend = 1 s\n");
    fluid_velocity_sides(own, 0.004);
    check_rel(own->fluid.u[0][cell(&own->grid, 1, 2, 2)], 0.0028, 1e-14, "a side's own inflow");
    check_rel(own->fluid.u[1][cell(&own->grid, 2, 1, 2)], 0.002, 1e-14,
              "beside that of [flow]");
    sim_free(own);
}

int main(void)
{
    const int fd = mkstemp(table);
    if (fd < 0)
        abort();
    close(fd);
    check_tables();
    check_inflow();
    unlink(table);
    return check_end();
}
