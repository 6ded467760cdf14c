/* verify/test_meters.c - flow meters and free surfaces where the answer is known: grains that fly
 * through planes, heaps made by hand. */
/* slots: contact/linear */
#include <string.h>
#include "check.h"
#include "harness.h"
#include "../solver/meter.h"
#include "../solver/surface.h"

#define MATERIAL "[material m]\nstiffness = 1e3 N/m\nrestitution = 0.8\nfriction = 0.3\n"

/* Two species fly across a periodic box, one up and one down, without touching: every passing is
 * counted by arithmetic. */
static void check_meters(void)
{
    struct sim *const s = sim_from(
        "[grains up]\ndiameter = 1 mm\ndensity = 2385 kg/m3\nfill = lattice\ncount = 45\n"
        "spacing = 3.7 mm\nfrom = 0 0 0 mm\nto = 10 20 20 mm\nvelocity = 0 0 0.731 "
        "m/s\nmaterial = m\n"
        "[grains down]\ndiameter = 1.5 mm\ndensity = 1723 kg/m3\nfill = lattice\ncount = 31\n"
        "spacing = 3.3 mm\nfrom = 10 0 0 mm\nto = 20 20 20 mm\nvelocity = 0 0 -0.257 "
        "m/s\nmaterial = m\n"
        "[domain]\nsize = 20 20 20 mm\nx = periodic\ny = periodic\nz = periodic\n"
        "gravity = 0 0 0 m/s2\n"
        "[meter all]\npoint = 0 0 7.3 mm\nnormal = 0 0 2\n"
        "[meter left]\npoint = 0 0 7.3 mm\nnormal = 0 0 1\nfrom = 0 0 0 mm\nto = 10 20 20 mm\n"
        "[run]\nend = 1 s\ndt = 20 us\nsubsteps = 10\n" MATERIAL);
    double start[2][64];
    int n[2] = {0, 0};
    for (int i = 0; i < s->grains.n; i++)
        start[s->grains.kind[i]][n[s->grains.kind[i]]++] = s->grains.pos[i].z;
    const double mass[2] = {2385.0 * PI / 6.0 * 1e-9, 1723.0 * PI / 6.0 * 3.375e-9};
    const double speed[2] = {0.731, -0.257};
    ledger_start(s);
    analysis_start(s);
    for (int k = 0; k < 1000; k++) {
        step(s);
        analysis_watch(s);
        if (k % 50 == 49)
            analysis_sample(s);
    }
    double want[2] = {0.0, 0.0};
    for (int kind = 0; kind < 2; kind++)
        for (int i = 0; i < n[kind]; i++) {
            const double at = start[kind][i], end = at + speed[kind] * s->t;
            want[kind] += floor((end - 7.3e-3) / 20e-3) - floor((at - 7.3e-3) / 20e-3);
        }
    const struct meter *const all = meter_find(s, "all"), *const left = meter_find(s, "left");
    check(want[0] > 250.0 && want[1] < -50.0, "grains pass: %g up, %g down", want[0], want[1]);
    check(all->count == want[0] + want[1], "count: %g, want %g", all->count, want[0] + want[1]);
    check(all->count_of[0] == want[0] && all->count_of[1] == want[1], "count by species: %g %g",
          all->count_of[0], all->count_of[1]);
    check_rel(all->mass, want[0] * mass[0] + want[1] * mass[1], 1e-12, "mass");
    check_rel(all->momentum, want[0] * mass[0] * speed[0] + want[1] * mass[1] * speed[1], 1e-9,
              "momentum");
    check(left->count == want[0], "a meter over half of the plane: %g", left->count);
    double error;
    check_rel(meter_slope(left, 0.0, 1.0, &error), 45.0 * mass[0] * 0.731 / 20e-3, 0.02,
              "mean rate of the steady stream");
    sim_free(s);
}

/* A heap of single grains whose tops lie on a cone, a roof or a slope. */
static void check_heap(const char *kind, const char *keys, double angle, double cone,
                       double x_of)
{
    char path[] = "/tmp/silt-heap-XXXXXX";
    const int fd = mkstemp(path);
    FILE *const file = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (!file)
        abort();
    const double slope = tan(angle * PI / 180.0);
    for (int j = 0; j < 31; j++)
        for (int i = 0; i < 31; i++) {
            const double x = 3e-3 * (i + 0.5), y = 3e-3 * (j + 0.5);
            const double a = x - 46.5e-3, b = y - 46.5e-3;
            const double r = cone > 0.0 ? sqrt(a * a + b * b) : x_of > 0.0 ? fabs(a) : -b;
            const double h = 60e-3 - slope * r;
            if (h > 3e-3)
                fprintf(file, "%.17g %.17g %.17g 1e-3\n", x, y, h - 0.5e-3);
        }
    fclose(file);
    char *const text = xprintf(
        "[grains a]\ndiameter = 1 mm\ndensity = 2500 kg/m3\nmaterial = m\nfill = file\n"
        "file = %s\n[domain]\nsize = 93 93 150 mm\n[surface heap]\nflying = on\ncell = 3 mm\n%s"
        "[run]\nend = 1 s\n" MATERIAL,
        path, keys);
    struct sim *const s = sim_from(text);
    analysis_sample(s);
    const struct surface *const f = surface_find(s, "heap");
    check_rel(f->angle, angle, 1e-9, kind);
    check(f->scatter < 1e-12 && f->points > 100, "%s: scatter %.3g m about %d points", kind,
          f->scatter, f->points);
    sim_free(s);
    xfree(text);
    unlink(path);
}

int main(void)
{
    check_meters();
    check_heap("angle of a cone", "kind = heap\n", 27.31, 1.0, 0.0);
    check_heap("angle of a steep cone", "kind = heap\nlow = 10 %\nhigh = 90 %\n", 41.7, 1.0,
               0.0);
    check_heap("angle of a roof", "kind = ridge\naxis = x\n", 33.83, 0.0, 1.0);
    check_heap("angle of a slope", "kind = slope\naxis = y\n", 36.17, 0.0, 0.0);
    check_heap("angle of a shallow slope", "kind = slope\naxis = y\nmiddle = 80 %\n", 3.21, 0.0,
               0.0);
    return check_end();
}
