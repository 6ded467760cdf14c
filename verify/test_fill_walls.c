/* verify/test_fill_walls.c - grains that are placed at random, on a lattice, or let grow, keep clear
 * of walls; growth reaches the porosity that is asked for. */
/* slots: contact/linear */
#include "check.h"
#include <omp.h>
#include "harness.h"

#define REST                                                                                   \
    "[material m]\nstiffness = 2e5 N/m\nrestitution = 0.8\nfriction = 0.3\n[run]\nend = 1 s\n"
#define CYLINDER                                                                               \
    "[domain]\nsize = 13 12 11 mm\n[wall c]\nkind = cylinder\npoint = 6.1 5.7 0 mm\n"          \
    "axis = 0 0 1\nradius = 5.3 mm\nside = in\n"
#define CONE                                                                                   \
    "[domain]\nsize = 13 12 11 mm\n[wall c]\nkind = cone\npoint = 6.1 5.7 0 mm\naxis = 0 0 "   \
    "1\n"                                                                                      \
    "radius = 1.1 mm\nradius_end = 5.3 mm\nlength = 11 mm\nside = in\n"
#define SLOPE                                                                                  \
    "[domain]\nsize = 13 12 11 mm\ny = periodic\n[wall p]\npoint = 0 0 3 mm\n"                 \
    "normal = -0.3 0 0.8\n"
#define PERIODIC "[domain]\nsize = 7 7 7 mm\nx = periodic\ny = periodic\nz = periodic\n"
#define PI       3.14159265358979323846

/* Largest overlap of a pair over the smaller diameter, of a grain and a wall over its radius. */
static void worst(const struct sim *s, double *pair, double *wall)
{
    const struct grains *const g = &s->grains;
    *pair = *wall = -1.0;
    for (int i = 0; i < g->n; i++) {
        *wall = fmax(*wall,
                     -walls_gap(s, g->pos[i], g->radius[i], g->radius[i], NULL) / g->radius[i]);
        for (int j = 0; j < i; j++) {
            const vec3 r = domain_minimum_image(&s->domain, v3_sub(g->pos[i], g->pos[j]));
            const double depth = g->radius[i] + g->radius[j] - v3_norm(r);
            *pair = fmax(*pair, depth / (2.0 * fmin(g->radius[i], g->radius[j])));
        }
    }
}

static struct sim *make(const char *place, const char *keys)
{
    char *const text =
        xprintf("%s[grains a]\ndensity = 2500 kg/m3\nmaterial = m\n%s" REST, place, keys);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

static void keeps_clear(const char *what, const char *place, const char *keys, double most)
{
    struct sim *const s = make(place, keys);
    double pair, wall;
    worst(s, &pair, &wall);
    check(s->grains.n > 20 && pair <= most, "%s: %d grains, largest overlap %.2e d (%g)", what,
          s->grains.n, pair, most);
    check(wall <= 2.0 * most + 1e-9, "%s: none in a wall: %.2e of a radius", what, wall);
    sim_free(s);
}

/* The solid fraction that is really there, in a volume known exactly, to half a grain. */
static void grows(const char *what, const char *place, const char *keys, double volume,
                  double porosity)
{
    struct sim *const s = make(place, keys);
    double pair, wall, solid = 0.0, largest = 0.0;
    for (int i = 0; i < s->grains.n; i++) {
        solid += s->grains.volume[i];
        largest = fmax(largest, s->grains.volume[i]);
    }
    worst(s, &pair, &wall);
    check(pair <= 1e-3 && wall <= 2e-3, "%s: overlaps %.2e d, %.2e of a radius in a wall", what,
          pair, wall);
    check_abs(1.0 - solid / volume, porosity, 0.5 * largest / volume + 2e-5, what);
    sim_free(s);
}

int main(void)
{
    keeps_clear("random in a cylinder", CYLINDER,
                "diameter = 1.1 mm\nfill = random\nporosity = 0.6\n", 0.0);
    keeps_clear("random, dense, over a slope", SLOPE,
                "diameter = 1.1 mm\nfill = random\nporosity = 0.45\n", 0.0);
    keeps_clear("settle in a cone", CONE, "diameter = 0.9 mm\nfill = settle\ncount = 130\n",
                0.0);
    keeps_clear("a lattice in a cylinder", CYLINDER,
                "diameter = 0.9 mm\nfill = lattice\ncount = 400\n", 0.0);
    grows("porosity grown to, periodic", PERIODIC,
          "diameter = 1.03 mm\nfill = grow\nporosity = 0.385\n", 343e-9, 0.385);
    grows("the same of sizes 1:3", PERIODIC,
          "sizes = uniform\ndiameter_min = 0.5 mm\ndiameter_max = 1.5 mm\nfill = grow\n"
          "porosity = 0.36\n",
          343e-9, 0.36);
    grows("porosity grown to in a cylinder", CYLINDER,
          "diameter = 1.1 mm\nfill = grow\nporosity = 0.45\n", PI * 5.3e-3 * 5.3e-3 * 11e-3,
          0.45);
    struct sim *const a = make(CYLINDER, "diameter = 1.1 mm\nfill = grow\nporosity = 0.47\n");
    omp_set_num_threads(3);
    struct sim *const b = make(CYLINDER, "diameter = 1.1 mm\nfill = grow\nporosity = 0.47\n");
    check(sim_bits(a) == sim_bits(b), "the same bits on any number of threads");
    sim_free(a);
    sim_free(b);
    return check_end();
}
