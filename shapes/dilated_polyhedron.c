/* shapes/dilated_polyhedron.c - a grain is a convex polyhedron whose corners and edges are rounded by a
 * ball: all points within its radius of a core (the Minkowski sum of both) [LiLiuJi23, eq. 1].
 *
 * Volume, surface and inertia are exact [Steiner1840]. Contact: the distance of the cores less both
 * radii, where the faces of the cores are crowned by a fraction of a percent of the size, so that the
 * force is smooth and follows from an energy (geometry/crown.h); one stiffness for faces, edges and
 * vertices, on grains and on flat walls, that of two spheres of the grains' volumes (r_eff of the
 * laws is made of the volume-equivalent radii; the seed leaves its R* open). Where faces lie on
 * faces, four points carry friction, the dashpots of the patch and that of rocking
 * (solver/contact_rocking.c). Curved walls are met by the vertices. The search starts from the last
 * normal, or from the exact distance [Gilbert88]; cores that overlap are still parted, along the
 * direction of least overlap. Or the smoothed envelope of the seed [LiLiuJi23, eqs 12-13]: one point
 * of contact. */
#include "geometry/dilated_species.h"
#include "shape.h"

const struct about shape_about = {
    .name = "dilated_polyhedron",
    .summary = "a convex polyhedron with rounded edges: cube, prism, STL ...",
    .equation = "depth = r_i + r_j - distance of the cores",
    .source = "LiLiuJi23, eqs 1, 12-13; Gilbert88; Boyd04",
    .range = "overlaps below r_i + r_j"};
const struct key shape_keys[] = {DILATED_KEYS(FORMS_CONVEX), {0}};

static struct dilated_species all;

static void init(struct scene *scene, const struct grains *g, struct shape_form *form)
{
    dilated_species_read(&all, true, scene, g, form);
}

static void finish(void)
{
    dilated_species_free(&all);
}

static int points(const struct shape_pair *p, int most, struct shape_point *out)
{
    return dilated_points(all.body[p->i.species], all.body[p->j.species], &all.how, p, all.kept,
                          most, out);
}

static const struct shape_ball *balls(int species, int *n)
{
    *n = all.body[species]->n_balls;
    return all.body[species]->ball;
}

static int parts_of(int species)
{
    return all.body[species]->n_parts;
}

static int meet_flat(const struct shape_pose *i, int part, const struct shape_facet *f,
                     double reach, vec3 *core, struct shape_point out[4])
{
    return dilated_flat(all.body[i->species], i, part, f, reach, core, out);
}

static void surface(int species, struct shape_canvas *c)
{
    dilated_surface(all.body[species], c);
}

static struct shape_part *parts(int species, double spacing, int *n)
{
    return dilated_parts(all.body[species], spacing, n);
}

static double crosswise(int species, vec3 flow)
{
    return 3.14159265358979323846 / dilated_shadow(all.body[species], flow);
}

const struct shape shape = {.path = &contact_points,
                            .init = init,
                            .free = finish,
                            .points = points,
                            .memory = DILATED_MEMORY,
                            .balls = balls,
                            .convex_parts = parts_of,
                            .meet_flat = meet_flat,
                            .surface = surface,
                            .parts = parts,
                            .crosswise = crosswise};
