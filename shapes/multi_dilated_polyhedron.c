/* shapes/multi_dilated_polyhedron.c - a grain is one rigid body of several dilated polyhedra that may
 * overlap: concave grains, letters, dolosse, hollow boxes [LiLiuJi23].
 *
 * Mass, centre and inertia over a background grid [LiLiuJi23, eqs 2-11]; contacts between grains are
 * those between their parts, found as in dilated_polyhedron, and each part keeps its place in the
 * body [LiLiuJi23, eq. 21]. A place where two parts of a grain touch the same part of another is two
 * contacts. */
#include "geometry/dilated_species.h"
#include "shape.h"

const struct about shape_about = {
    .name = "multi_dilated_polyhedron",
    .summary = "overlapping dilated polyhedra as one concave grain: letters, dolos ...",
    .equation = "contacts of the parts; mass over a grid",
    .source = "LiLiuJi23, eqs 2-13, 21",
    .range = "up to 64 convex parts a grain"};
const struct key shape_keys[] = {
    DILATED_KEYS(FORMS_ALL),
    {"grains", "mass_spacing", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "of the grid over which volume, centre and inertia of several parts are summed"},
    {0}};

static struct dilated_species all;

static void init(struct scene *scene, const struct grains *g, struct shape_form *form)
{
    dilated_species_read(&all, false, scene, g, form);
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
                            .memory = DILATED_LEFT + DILATED_KEPT * DILATED_MEMORY,
                            .balls = balls,
                            .convex_parts = parts_of,
                            .meet_flat = meet_flat,
                            .surface = surface,
                            .parts = parts,
                            .crosswise = crosswise};
