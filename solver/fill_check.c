/* fill_check.c - what is wrong with the places of the grains at the start. */
#include "fill_grid.h"
#include "sim.h"

/* A grain that moves must not start inside a wall of the box. */
static void check_walls(const struct sim *s, struct scene *scene, const struct fill_grid *b,
                        const char *const *names)
{
    for (int i = 0; i < b->n; i++) {
        const struct placed *const p = &b->grain[i];
        const double x[3] = {p->pos.x, p->pos.y, p->pos.z};
        for (int a = 0; a < 3 && !s->grains.species[p->species].frozen; a++) {
            const double room = fmin(x[a], s->domain.size[a] - x[a]),
                         radius = 0.5 * p->diameter;
            if (s->domain.periodic[a] || room >= (1.0 - s->run.overlap_max) * radius)
                continue;
            scene_error(
                scene, "grains", names[p->species], "fill",
                "places a grain at %.6g %.6g %.6g m, of radius %g m, inside a wall in %c", x[0],
                x[1], x[2], radius, 'x' + a);
            return;
        }
    }
}

/* Grains that are put where they are told to be must not start deep in one another. */
static void check_pairs(const struct sim *s, struct scene *scene, const struct fill_grid *b,
                        const char *const *names)
{
    enum { MOST = 64 };
    int near[MOST];
    for (int i = 0; i < b->n; i++) {
        const struct placed *const p = &b->grain[i];
        const int found = fill_grid_near(b, i, 0.0, near, MOST);
        for (int k = 0; k < found && k < MOST; k++) {
            const struct placed *const q = &b->grain[near[k]];
            const vec3 r = domain_minimum_image(&s->domain, v3_sub(p->pos, q->pos));
            const double depth = 0.5 * (p->diameter + q->diameter) - v3_norm(r);
            const double part = depth / (0.5 * fmin(p->diameter, q->diameter));
            if (part <= s->run.overlap_max ||
                (s->grains.species[p->species].frozen && s->grains.species[q->species].frozen))
                continue;
            scene_error(scene, "grains", names[p->species], "fill",
                        "places a grain at %.6g %.6g %.6g m, which overlaps one of %s at %.6g "
                        "%.6g %.6g m by %.3g of its radius (run.overlap_max = %g)",
                        p->pos.x, p->pos.y, p->pos.z, names[q->species], q->pos.x, q->pos.y,
                        q->pos.z, part, s->run.overlap_max);
            return;
        }
    }
}

void fill_check(const struct sim *s, struct scene *scene, const struct fill_grid *b,
                const char *const *names)
{
    check_walls(s, scene, b, names);
    check_pairs(s, scene, b, names);
}
