/* verify/test_fill_sizes.c - size distributions: quantiles by mass and by number, amounts by count,
 * mass and porosity, wide distributions, dense random fillings; the same on any number of threads. */
/* slots: contact/linear */
#include "check.h"
#include <omp.h>
#include <string.h>
#include "harness.h"

#define REST                                                                                   \
    "[material m]\nstiffness = 2e5 N/m\nrestitution = 0.8\nfriction = 0.3\n[run]\nend = 1 s\n"
#define HEAD "[grains a]\ndensity = 2385 kg/m3\nmaterial = m\nfill = random\n"

static char table[] = "/tmp/silt-sizes-XXXXXX";

static void write_table(const char *text)
{
    FILE *const file = fopen(table, "w");
    if (!file)
        abort();
    fputs(text, file);
    fclose(file);
}

static struct sim *filled(const char *box, const char *keys)
{
    char *const text = xprintf("[domain]\nsize = %s\nx = periodic\n" HEAD "%s" REST, box, keys);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

static double measured(const struct sim *s, double q, bool by_mass)
{
    const size_t n = (size_t)s->grains.n;
    double *const d = xalloc(n, sizeof *d);
    for (size_t i = 0; i < n; i++)
        d[i] = 2.0 * s->grains.radius[i];
    const double at = sizes_measured(d, n, q); /* sorts */
    const double result = by_mass ? at : d[(size_t)(q * (double)n)];
    xfree(d);
    return result;
}

/* Part of the mass in grains finer than d. */
static double finer(const struct sim *s, double d)
{
    double below = 0.0, all = 0.0;
    for (int i = 0; i < s->grains.n; i++) {
        all += s->grains.mass[i];
        below += 2.0 * s->grains.radius[i] <= d ? s->grains.mass[i] : 0.0;
    }
    return below / all;
}

/* D10, D50, D90 of a log-normal, with its cut: mid quantiles barely feel it, but are corrected. */
static void check_lognormal(bool by_mass)
{
    char *const keys = xprintf("sizes = lognormal\nsizes_by = %s\ndiameter = 0.731 mm\n"
                               "spread = 1.35\ncount = 3000\n",
                               by_mass ? "mass" : "number");
    struct sim *const s = filled("16 17 18 mm", keys);
    static const double part[3] = {0.1, 0.5, 0.9}, z[3] = {-1.2815515655, 0.0, 1.2815515655};
    for (int k = 0; k < 3; k++) {
        char *const text =
            xprintf("log-normal by %s: D%g", by_mass ? "mass" : "number", 100.0 * part[k]);
        /* the cut takes 0.62 % at either end: 0.8 % of ln d at the tenths */
        check_rel(measured(s, part[k], by_mass), 0.731e-3 * exp(z[k] * log(1.35)), 0.012, text);
        xfree(text);
    }
    sim_free(s);
    xfree(keys);
}

static void check_uniform(void)
{
    struct sim *s = filled("16 17 18 mm", "sizes = uniform\ndiameter_min = 0.4 mm\n"
                                          "diameter_max = 1.3 mm\ncount = 3000\n");
    check_abs(finer(s, 0.7e-3), (0.7 - 0.4) / 0.9, 0.003,
              "uniform by mass: part finer than 0.7 mm");
    check_abs(finer(s, 1.1e-3), (1.1 - 0.4) / 0.9, 0.003,
              "uniform by mass: part finer than 1.1 mm");
    sim_free(s);
    s = filled("26 27 28 mm", "sizes = uniform\nsizes_by = number\ndiameter_min = 0.4 mm\n"
                              "diameter_max = 1.3 mm\ncount = 3000\n");
    check_rel(measured(s, 0.3, false), 0.67e-3, 0.003,
              "uniform by number: three tenths are finer");
    sim_free(s);
}

static void check_tables(void)
{
    write_table("# two sands\ndiameter mm, fraction\n0.5, 30\n1.0, 45\n1.5, 25\n");
    char *const classes = xprintf("sizes = table\nsize_file = %s\nmass = 1.2 g\n", table);
    struct sim *s = filled("10 11 12 mm", classes);
    double mass = 0.0;
    for (int i = 0; i < s->grains.n; i++)
        mass += s->grains.mass[i];
    check_abs(mass, 1.2e-3, 0.5 * 2385.0 * PI / 6.0 * 1.5e-3 * 1.5e-3 * 1.5e-3,
              "table: the mass asked for, to half a grain");
    check_abs(finer(s, 0.6e-3), 0.30, 0.006, "table by mass: part of the finest");
    check_abs(finer(s, 1.2e-3), 0.75, 0.006, "table by mass: part of the two finest");
    sim_free(s);
    write_table("diameter [um], finer\n400, 0\n600, 0.2\n1000, 0.75\n1400, 1\n");
    char *const curve = xprintf("sizes = curve\nsize_file = %s\ncount = 3000\n", table);
    s = filled("20 21 22 mm", curve);
    check_abs(finer(s, 0.6e-3), 0.2, 0.004, "curve: part finer than its second point");
    check_abs(finer(s, 0.8e-3), 0.475, 0.004, "curve: part finer between points");
    check_abs(finer(s, 1.0e-3), 0.75, 0.004, "curve: part finer than its third point");
    sim_free(s);
    xfree(classes);
    xfree(curve);
}

/* Largest overlap over the smaller diameter, by brute force. */
static double worst_overlap(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    double worst = -1.0;
    for (int i = 0; i < g->n; i++)
        for (int j = 0; j < i; j++) {
            const vec3 r = domain_minimum_image(&s->domain, v3_sub(g->pos[i], g->pos[j]));
            const double apart = g->radius[i] + g->radius[j];
            if (v3_dot(r, r) < apart * apart)
                worst = fmax(worst, (apart - v3_norm(r)) / fmin(g->radius[i], g->radius[j]));
        }
    return worst;
}

static void check_dense(const char *what, const char *box, const char *keys, double porosity,
                        double tolerance)
{
    unsigned long bits[3];
    static const int threads[3] = {1, 3, 7};
    for (int k = 0; k < 3; k++) {
        omp_set_num_threads(threads[k]);
        struct sim *const s = filled(box, keys);
        bits[k] = sim_bits(s);
        if (k == 0) {
            double solid = 0.0;
            for (int i = 0; i < s->grains.n; i++)
                solid += s->grains.volume[i];
            const double *const size = s->domain.size;
            check_abs(1.0 - solid / (size[0] * size[1] * size[2]), porosity, tolerance, what);
            check(worst_overlap(s) <= 1e-12, "%s: %d grains, none overlaps", what, s->grains.n);
        }
        sim_free(s);
    }
    check(bits[0] == bits[1] && bits[0] == bits[2], "%s: the same bits on 1, 3, 7 threads",
          what);
}

int main(void)
{
    const int fd = mkstemp(table);
    if (fd < 0)
        abort();
    close(fd);
    check_lognormal(true);
    check_lognormal(false);
    check_uniform();
    check_tables();
    check_dense("equal spheres at 0.45", "12 13 14 mm",
                "diameter = 0.937 mm\nporosity = 0.45\n", 0.45, 3e-4);
    check_dense("10:1 by mass at 0.45", "6 5 5.5 mm",
                "sizes = uniform\ndiameter_min = 0.237 mm\ndiameter_max = 2.37 mm\n"
                "porosity = 0.45\n",
                0.45, 0.5 * PI / 6.0 * 2.37 * 2.37 * 2.37 / 165.0); /* half a grain */
    unlink(table);
    return check_end();
}
