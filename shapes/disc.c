/* shapes/disc.c - a grain is a disc in the plane y = const, for runs in two dimensions: a cylinder as
 * long as the box is thick (or `thickness`), which touches others along its length. Mass and inertia
 * are those of the cylinder, m = rho pi/4 d^2 h and I = m d^2/8; forces and torques stay in the plane,
 * and the sides in y are not felt. r_eff of the laws is that of spheres of the same radii.
 *
 * Whatever places grains puts them halfway between the sides in y, and what would take them out of this
 * plane is refused. */
#include "shape.h"

#define PI 3.14159265358979323846

const struct about shape_about = {
    .name = "disc",
    .summary = "a disc in the plane of x and z, for two dimensions",
    .equation = "overlap = r_i + r_j - |x_i - x_j| in the plane; m = rho pi/4 d^2 h",
    .source = "exact",
    .range = "a box about as thick as the largest disc is wide, never less"};
const struct key shape_keys[] = {
    {"grains", "thickness", KEY_REAL, "m", "box | (0, inf)", "box",
     "length of the discs along y, for their mass"},
    {0},
};

enum { SPECIES_MOST = 64 };

static double thickness[SPECIES_MOST]; /* m */

/* Nothing may drive them out of the plane. */
static void check_plane(struct scene *scene, const char *name)
{
    const vec3 v = scene_vector(scene, "grains", name, "velocity");
    const vec3 w = scene_vector(scene, "grains", name, "spin");
    if (v.y != 0.0)
        scene_error(scene, "grains", name, "velocity",
                    "discs stay in their plane: y must be 0");
    if (w.x != 0.0 || w.z != 0.0)
        scene_error(scene, "grains", name, "spin",
                    "discs turn about y only: x and z must be 0");
}

static void init(struct scene *scene, const struct grains *g, struct shape_form *form)
{
    const double box = scene_vector(scene, "domain", NULL, "size").y;
    for (int k = 0; k < g->n_species && k < SPECIES_MOST; k++) {
        const char *const name = g->species[k].name;
        thickness[k] = scene_word(scene, "grains", name, "thickness", "box")
                           ? box
                           : scene_real(scene, "grains", name, "thickness");
        form[k].inertia = v3(0.5, 0.5, 0.5);
        check_plane(scene, name);
        if (box > 2.0 * g->species[k].largest)
            scene_error(
                scene, "grains", name, "diameter",
                "discs of %g m do not stay in one plane of a box that is %g m thick in y: "
                "make it as thick as the largest is wide",
                g->species[k].largest, box);
    }
    if (scene_vector(scene, "domain", NULL, "gravity").y != 0.0)
        scene_error(scene, "domain", NULL, "gravity", "discs stay in their plane: y must be 0");
    if (g->n_species > SPECIES_MOST)
        scene_error(scene, "grains", NULL, NULL, "at most %d species of discs", SPECIES_MOST);
}

static double volume(int species, double diameter)
{
    return 0.25 * PI * diameter * diameter * thickness[species];
}

static void overlaps(const struct grains *g, const struct candidates *c, struct touch *t,
                     struct levers *l)
{
    (void)g;
#pragma omp simd
    for (int k = 0; k < c->n; k++) {
        const real square = c->dx[k] * c->dx[k] + c->dz[k] * c->dz[k];
        const real inverse = inverse_root(square), distance = square * inverse;
        /* beside a side in y: never a contact */
        const real aside = square < c->dy[k] * c->dy[k] ? -1.0e3 * t->r_i[k] : 0.0;
        const real half = 0.5 * (t->r_i[k] + t->r_j[k] - distance + aside);
        const real arm_i = half - t->r_i[k];
        const real arm_j = t->r_j[k] > 0.0 ? t->r_j[k] - half : 0.0;
        t->depth[k] = 2.0 * half;
        t->nx[k] = c->dx[k] * inverse;
        t->ny[k] = 0.0;
        t->nz[k] = c->dz[k] * inverse;
        l->ix[k] = arm_i * t->nx[k];
        l->iy[k] = 0.0;
        l->iz[k] = arm_i * t->nz[k];
        l->jx[k] = arm_j * t->nx[k];
        l->jy[k] = 0.0;
        l->jz[k] = arm_j * t->nz[k];
    }
}

const struct shape shape = {.path = &contact_spheres,
                            .flat = true,
                            .init = init,
                            .volume = volume,
                            .overlaps = overlaps};
