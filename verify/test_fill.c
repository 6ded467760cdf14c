/* verify/test_fill.c - every way of placing grains, and parameters of pairs of materials. */
/* slots: contact/linear */
#include "check.h"
#include <string.h>
#include "../solver/bed_file.h"
#include "harness.h"

#define MATERIAL "[material m]\nstiffness = 2e5 N/m\nrestitution = 0.8\nfriction = 0.3\n"
#define RUN      "[run]\nend = 1 s\n"
#define PERIODIC "[domain]\nsize = 12 12 12 mm\nx = periodic\ny = periodic\nz = periodic\n"
#define BOX      "[domain]\nsize = 12 10 9 mm\n"

/* Smallest distance between two surfaces over the smaller diameter; the grains' reach in z, m. */
static double closest(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    double least = (double)INFINITY;
    for (int i = 0; i < g->n; i++)
        for (int j = 0; j < i; j++) {
            const vec3 r = domain_minimum_image(&s->domain, v3_sub(g->pos[i], g->pos[j]));
            const double gap = v3_norm(r) - g->radius[i] - g->radius[j];
            least = fmin(least, gap / (2.0 * fmin(g->radius[i], g->radius[j])));
        }
    return least;
}

static bool inside(const struct sim *s)
{
    for (int i = 0; i < s->grains.n; i++) {
        const double x[3] = {s->grains.pos[i].x, s->grains.pos[i].y, s->grains.pos[i].z};
        for (int a = 0; a < 3; a++) {
            const double edge =
                s->domain.periodic[a] ? 0.0 : s->grains.radius[i] * (1.0 - 1e-9);
            if (x[a] < edge || x[a] > s->domain.size[a] - edge)
                return false;
        }
    }
    return true;
}

static void check_bed(const char *what, const char *keys, int count, double gap,
                      double tolerance)
{
    char *const text =
        xprintf("[grains a]\ndiameter = 1 mm\ndensity = 2500 kg/m3\nmaterial = m\n%s"
                "%s" MATERIAL RUN,
                keys, strstr(keys, "cc\n") ? PERIODIC : BOX);
    struct sim *const s = sim_from(text);
    const double least = closest(s);
    check(s->grains.n == count, "%s: %d grains, want %d", what, s->grains.n, count);
    check(inside(s), "%s: all inside the box", what);
    check(tolerance > 0.0 ? fabs(least - gap) < tolerance : least >= gap,
          "%s: smallest gap %.3g d, want %s%.3g", what, least,
          tolerance > 0.0 ? "" : "at least ", gap);
    sim_free(s);
    xfree(text);
}

/* Grains written as text come back where they were; two materials, one pair given. */
static void check_file(void)
{
    char path[] = "/tmp/silt-bed-XXXXXX";
    const int fd = mkstemp(path);
    FILE *const file = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (!file)
        abort();
    fputs("# x y z d, m\n0.002 0.003 0.004 0.0011\n\n5e-3 4e-3 3e-3 1.3e-3 # another\n", file);
    fclose(file);
    char *const text =
        xprintf("[grains a]\ndiameter = 1 mm\ndensity = 2500 kg/m3\nmaterial = m\nfill = file\n"
                "file = %s\n" BOX MATERIAL RUN,
                path);
    struct sim *const s = sim_from(text);
    check(s->grains.n == 2, "a bed from text: %d grains", s->grains.n);
    const int b = grain_at(s, 1);
    check_abs(s->grains.pos[b].x, 5e-3, 0.0, "its second x");
    check_abs(s->grains.radius[b], 0.65e-3, 1e-18, "its second radius");
    sim_free(s);
    xfree(text);
    unlink(path);
}

#define TWO(how)                                                                               \
    "[grains a]\ndiameter = 1.3 mm\ndensity = 2500 kg/m3\nmaterial = m\n" how                  \
    "[grains b]\ndiameter = 0.9 mm\ndensity = 2900 kg/m3\nmaterial = m\n" how BOX MATERIAL     \
    "[run]\nend = 1 s\ndt = 1.7 us\n"

/* A bed in motion is saved and read again, species by species: every bit of it. */
static void check_saved(void)
{
    char folder[] = "/tmp/silt-saved-XXXXXX";
    struct sim *const s =
        sim_from(TWO("count = 90\nfill = random\nvelocity = 0.1 0.2 -0.3 m/s\n"));
    step_grains(s, 900);
    s->run.directory = mkdtemp(folder) ? xstrdup(folder) : NULL;
    bed_file_write(s);
    char *const keys = xprintf("fill = file\nfile = %s/bed.nc\n", folder);
    char *const text = xprintf(TWO("%s"), keys, keys);
    struct sim *const again = sim_from(text);
    const struct grains *const g = &s->grains, *const h = &again->grains;
    int same = 0;
    for (int id = 0; id < g->n && h->n == g->n; id++) {
        const int i = grain_at(s, id), j = grain_at(again, id);
        same += memcmp(&g->pos[i], &h->pos[j], sizeof(vec3)) == 0 &&
                memcmp(&g->vel[i], &h->vel[j], sizeof(vec3)) == 0 &&
                memcmp(&g->spin[i], &h->spin[j], sizeof(vec3)) == 0 &&
                g->radius[i] == h->radius[j] && g->mass[i] == h->mass[j] &&
                g->kind[i] == h->kind[j];
    }
    check(same == 180 && v3_norm(g->spin[0]) > 0.0,
          "a saved bed: %d of 180 grains come back to the last bit", same);
    char *const file = xprintf("%s/bed.nc", folder);
    unlink(file);
    rmdir(folder);
    sim_free(s);
    sim_free(again);
    xfree(file);
    xfree(text);
    xfree(keys);
}

/* A ball of one material on a wall of another: the pair's restitution, and the mixed one. */
static double bounce(const char *pair)
{
    char *const text = xprintf(
        "[grains a]\ndiameter = 1 mm\ndensity = 2500 kg/m3\nmaterial = m\nfill = point\n"
        "position = 5 5 0.6 mm\nvelocity = 0 0 -0.3 m/s\n[domain]\nsize = 12 10 9 mm\n"
        "gravity = 0 0 0 m/s2\n" MATERIAL "[material wall]\nstiffness = 1e5 N/m\n"
        "restitution = 0.45\nfriction = 0.1\n%s[run]\nend = 1 s\ndt = 5 ns\nsubsteps = 1\n",
        pair);
    struct sim *const s = sim_from(text);
    bool touched = false;
    do {
        step(s);
        touched = touched || s->neighbours.touching > 0;
    } while (!touched || s->neighbours.touching > 0);
    const double e = s->grains.vel[0].z / 0.3;
    sim_free(s);
    xfree(text);
    return e;
}

int main(void)
{
    check_bed("lattice", "fill = lattice\ncount = 700\n", 700, 0.05, 1e-9);
    check_bed("lattice with spacing", "fill = lattice\ncount = 100\nspacing = 1.7 mm\n", 100,
              0.7, 1e-9);
    check_bed("random", "fill = random\ncount = 500\n", 500, 0.0, 0.0);
    check_bed("region", "fill = random\ncount = 60\nfrom = 2 2 2 mm\nto = 8 8 7 mm\n", 60, 0.0,
              0.0);
    check_bed("simple cubic", "fill = unit_cell\n", 12 * 10 * 9, 0.0, 1e-9);
    check_bed("body-centred", "fill = unit_cell\ncell = bcc\nspacing = 1.2 mm\n",
              2 * 10 * 10 * 10, 0.5 * sqrt(3.0) * 1.2 - 1.0, 1e-9);
    check_bed("face-centred", "fill = unit_cell\ncell = fcc\nspacing = 1.5 mm\n", 4 * 8 * 8 * 8,
              1.5 / sqrt(2.0) - 1.0, 1e-9);
    check_bed("point", "fill = point\nposition = 3 4 5 mm\n", 1, 0.0, 0.0);
    check_file();
    check_saved();
    check_rel(bounce("[pair m-wall]\nrestitution = 0.66\n"), 0.66, 1e-3,
              "restitution of the pair");
    check_rel(bounce("[pair wall-m]\nrestitution = 0.66\n"), 0.66, 1e-3, "named the other way");
    check_rel(bounce(""), sqrt(0.8 * 0.45), 1e-3, "or else the geometric mean");
    return check_end();
}
