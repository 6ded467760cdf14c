/* shapes/superquadric.c - a grain is a superquadric: ellipsoids, and on to blocks and cylinders
 * with rounded edges.
 *
 *   (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1         [Barr81]
 *
 * a, b, c from grains.half_axes, scaled to the volume of the grain's diameter; n1 = blockiness, n2 =
 * blockiness_across: 2 2 an ellipsoid, 8 8 a box, 8 2 a cylinder along z. Two grains touch at one
 * point at most, on their common normal (solver/superquadric_pair.c): the depth is that of the
 * shallowest overlap, which makes elastic forces of it conservative. Planes and other walls are met
 * by the farthest point along their normal, exactly.
 *
 * Radii of curvature for the contact law: of the surfaces, r_eff = 1/sqrt(det(K_i + K_j)), Hertz's
 * mean radius for an elliptic contact [Johnson85, sect. 4.2], no larger than grains.flattest_radius
 * where faces are flat; or the volume-equivalent radii. Blocky grains touch at one point also where
 * face lies on face: what stands on a face can rock; dilated polyhedra have points enough. */
#include "shape.h"

#include "../solver/scene.h"
#include "../solver/superquadric.h"
#include "../solver/volume_parts.h"

enum {
    MEMORY = 4
}; /* the last normal, in the frame of the flatter body; 1: that of i, 2: of j */

const struct about shape_about = {
    .name = "superquadric",
    .summary = "ellipsoids, and blocks and cylinders with rounded edges",
    .equation = "(|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1",
    .source = "[Barr81]; contact by the common normal, see [Wellmann08], [Podlozhnyuk17]",
    .range = "blockiness 2 to 20; one point of contact a pair"};

const struct key shape_keys[] = {
    {"grains", "half_axes", KEY_VECTOR, "1", "(0, 1000]", "1 1 1",
     "half axes of the superquadric along x, y, z, to one another; the diameter sets the size"},
    {"grains", "blockiness", KEY_REAL, "1", "[2, 20]", "2",
     "n1, exponent of its outlines through the z axis: 2 ellipses, 4 and more boxes"},
    {"grains", "blockiness_across", KEY_REAL, "1", "same | [2, 20]", "same",
     "n2, exponent of its sections across the z axis; same: as blockiness"},
    {"grains", "contact_radius", KEY_CHOICE, "", "curvature | equivalent", "curvature",
     "radius for the contact law: of the surfaces where they touch, or of the sphere of equal "
     "volume"},
    {"grains", "flattest_radius", KEY_REAL, "1", "(0, 1000]", "4",
     "largest radius of curvature for the contact law, in radii of the sphere of equal volume"},
    {0}};

static struct species_form {
    struct superquadric body; /* of the volume of the unit ball */
    bool curved;              /* radii of curvature count */
    double flattest, thin;    /* largest radius; least half axis */
} * forms;

static void read_form(struct scene *scene, const char *name, struct species_form *f)
{
    const vec3 axes = scene_vector(scene, "grains", name, "half_axes");
    const double n1 = scene_real(scene, "grains", name, "blockiness");
    const double n2 = scene_word(scene, "grains", name, "blockiness_across", "same")
                          ? n1
                          : scene_real(scene, "grains", name, "blockiness_across");
    double a[3] = {axes.x, axes.y, axes.z};
    for (int k = 0; k < 3; k++)
        if (!(a[k] > 0.0))
            a[k] = 1.0; /* refused: it is on the list */
    superquadric_set(&f->body, a, n1 >= 2.0 ? n1 : 2.0, n2 >= 2.0 ? n2 : 2.0);
    const double unit =
        cbrt(4.0 / 3.0 * 3.14159265358979323846 / superquadric_volume(&f->body));
    for (int k = 0; k < 3; k++)
        a[k] *= unit;
    superquadric_set(&f->body, a, f->body.n1, f->body.n2);
    f->curved = scene_choice(scene, "grains", name, "contact_radius") == 0;
    f->flattest = scene_real(scene, "grains", name, "flattest_radius");
    f->thin = fmin(a[0], fmin(a[1], a[2]));
}

static void init(struct scene *scene, const struct grains *g, struct shape_form *form)
{
    forms = xalloc((size_t)g->n_species + 1, sizeof *forms);
    for (int k = 0; k < g->n_species; k++) {
        struct species_form *const f = &forms[k];
        double inertia[3];
        read_form(scene, g->species[k].name, f);
        const double volume = superquadric_volume(&f->body);
        superquadric_inertia(&f->body, inertia);
        form[k].bounding = superquadric_radius(&f->body) * (1.0 + 1e-14);
        form[k].inertia = v3(inertia[0] / volume, inertia[1] / volume, inertia[2] / volume);
        form[k].sphericity =
            f->body.ellipsoid && f->thin * form[k].bounding > 1.0 - 1e-12
                ? 1.0
                : fmin(1.0, 4.0 * 3.14159265358979323846 / superquadric_area(&f->body));
        form[k].points_most = 1;
    }
}

static void end(void)
{
    xfree(forms);
    forms = NULL;
}

static struct superquadric_placed placed(const struct shape_pose *p)
{
    return (struct superquadric_placed){
        .shape = &forms[p->species].body, .size = p->size, .turn = p->turn};
}

/* Sets the radii, such that 1/(1/r_i + 1/r_j) is the effective one. */
static void radii(const struct shape_pair *p, const struct superquadric_touch *t,
                  struct shape_point *out)
{
    const struct species_form *const fi = &forms[p->i.species], *const fj =
                                                                    &forms[p->j.species];
    if (!fi->curved || !fj->curved) {
        out->r_i = p->i.size;
        out->r_j = p->j.size;
        return;
    }
    /* a body's share of the curvature in the same ratio as its own */
    const double part = t->r_j / (t->r_i + t->r_j), most_i = fi->flattest * p->i.size;
    const double most_j = fj->flattest * p->j.size;
    out->r_i = part > 0.0 ? fmin(most_i, t->r_eff / part) : most_i;
    out->r_j = part < 1.0 ? fmin(most_j, t->r_eff / (1.0 - part)) : most_j;
}

/* Where a face meets an edge or a corner the normal turns with the face, and the point on the face moves as
 * a high root of it: so it is kept in the frame of the body that is flatter there. */
static vec3 recall_normal(const struct shape_pair *p)
{
    const vec3 n = v3((double)p->memory[0], (double)p->memory[1], (double)p->memory[2]);
    return mat3_turn(p->memory[3] == (real)2.0 ? &p->j.turn : &p->i.turn, n);
}

static void keep_normal(const struct shape_pair *p, const struct superquadric_touch *t,
                        bool of_j)
{
    const vec3 n = mat3_back(of_j ? &p->j.turn : &p->i.turn, t->normal);
    p->memory[0] = (real)n.x;
    p->memory[1] = (real)n.y;
    p->memory[2] = (real)n.z;
    p->memory[3] = of_j ? (real)2.0 : (real)1.0;
}

static int points(const struct shape_pair *p, int most, struct shape_point *out)
{
    const struct superquadric_placed i = placed(&p->i), j = placed(&p->j);
    struct superquadric_touch t = {.normal = recall_normal(p)};
    const bool near = superquadric_meet(&i, &j, v3_scale(-1.0, p->j.centre), p->reach, &t);
    keep_normal(p, &t, near && t.r_j > t.r_i);
    if (!near && p->apart)
        *p->apart = t.gap;
    if (!near || most < 1)
        return near;
    const vec3 half = v3_scale(0.5 * t.gap, t.normal);
    *out = (struct shape_point){.id = 0,
                                .depth = -t.gap,
                                .normal = t.normal,
                                .at_i = v3_sub(t.at_i, half),
                                .at_j = v3_add(t.at_j, half),
                                .from_i = t.at_i,
                                .from_j = t.at_j,
                                .scale = fmin(forms[p->i.species].thin * p->i.size,
                                              forms[p->j.species].thin * p->j.size)};
    radii(p, &t, out);
    return 1;
}

static vec3 support(const struct shape_pose *p, vec3 way, double *radius)
{
    const struct species_form *const f = &forms[p->species];
    const vec3 n = mat3_back(&p->turn, way);
    const vec3 at = superquadric_support(&f->body, n);
    const double r = f->curved ? superquadric_curvature_radius(&f->body, n) : 1.0;
    *radius = p->size * fmin(f->flattest, r);
    return v3_scale(p->size, mat3_turn(&p->turn, at));
}

/* The octahedron's faces, each in N^2 triangles, drawn out to the surface. */
static void surface(int species, struct shape_canvas *c)
{
    enum { N = 12 };
    const struct superquadric *const s = &forms[species].body;
    for (int octant = 0; octant < 8; octant++) {
        const double sx = octant & 1 ? -1.0 : 1.0, sy = octant & 2 ? -1.0 : 1.0;
        const double sz = octant & 4 ? -1.0 : 1.0;
        const bool inward = sx * sy * sz < 0.0;
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N - i; j++) {
                vec3 p[4];
                for (int k = 0; k < 4; k++) {
                    const int u = i + (k == 1 || k == 3), v = j + (k == 2 || k == 3);
                    const vec3 x =
                        v3(sx * s->a[0] * u, sy * s->a[1] * v, sz * s->a[2] * (N - u - v));
                    p[k] = v3_scale(1.0 / (superquadric_inside(s, x) + 1.0), x);
                }
                c->triangle(c, p[0], inward ? p[2] : p[1], inward ? p[1] : p[2]);
                if (i + j + 2 <= N)
                    c->triangle(c, p[3], inward ? p[1] : p[2], inward ? p[2] : p[1]);
            }
    }
}

static double depth(const void *body, vec3 x)
{
    return -superquadric_inside(body, x);
}

static struct shape_part *parts(int species, double spacing, int *n)
{
    const struct superquadric *const s = &forms[species].body;
    const vec3 hi = v3(s->a[0], s->a[1], s->a[2]), centre = v3(0.0, 0.0, 0.0);
    return volume_shape_parts(depth, s, v3_scale(-1.0, hi), hi, spacing, superquadric_volume(s),
                              &centre, n);
}

static double crosswise(int species, vec3 flow)
{
    return 3.14159265358979323846 / superquadric_shadow(&forms[species].body, flow);
}

const struct shape shape = {.path = &contact_points,
                            .init = init,
                            .free = end,
                            .points = points,
                            .memory = MEMORY,
                            .support = support,
                            .surface = surface,
                            .parts = parts,
                            .crosswise = crosswise};
