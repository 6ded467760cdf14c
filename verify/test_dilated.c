/* verify/test_dilated.c - grains of dilated polyhedra in whole runs: a cube on a plane and on a cube,
 * a stack, an elastic bounce, a slope; the bodies of named and of read solids. */
/* slots: shapes/dilated_polyhedron contact/hertz_mindlin */
#include <stdlib.h>
#include <string.h>
#include <omp.h>
#include <unistd.h>
#include "../shapes/geometry/dilated_species.h"
#include "check.h"
#include "harness.h"

#define MATERIAL "[material m]\nyoung = 20 MPa\npoisson = 0.3\n"
#define CUBE     "form = cube\ndilation = 1 mm\ndensity = 2500 kg/m3\nfill = point\nmaterial = m\n"

/* mm, of a cube of side 10 with edges rounded by 1. */
static double diameter_of_cube(void)
{
    const double a = 8.0, r = 1.0;
    const double v =
        a * a * a + 6.0 * a * a * r + 3.0 * PI * a * r * r + 4.0 / 3.0 * PI * r * r * r;
    return cbrt(6.0 * v / PI);
}

static double kinetic(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    double sum = 0.0;
    for (int i = 0; i < g->n; i++)
        sum += 0.5 * g->mass[i] * v3_dot(g->vel[i], g->vel[i]) +
               0.2 * g->mass[i] * g->radius[i] * g->radius[i] * v3_dot(g->spin[i], g->spin[i]);
    return sum;
}

static void run_for(struct sim *s, double time, double *most)
{
    const long steps = lround(time / (s->run.dt * s->run.substeps));
    for (long k = 0; k < steps; k++) {
        step(s);
        *most = fmax(*most, kinetic(s));
    }
}

/* Cubes one on the other, a hair apart at first, perhaps shifted. */
static char *stack_of(int n, double shift)
{
    char *text =
        xprintf("[domain]\nsize = 100 100 200 mm\n[run]\nend = 10 s\nsubsteps = 20\n" MATERIAL
                "restitution = 0.3\nfriction = 0.5\n");
    for (int k = 0; k < n; k++) {
        char *const more =
            xprintf("%s[grains c%d]\n" CUBE "orientation = aligned\ndiameter = %.15g mm\n"
                    "position = %.15g %.15g %.15g mm\n",
                    text, k, diameter_of_cube(), 50.0 + shift * ((k * 7) % 5 - 2),
                    50.0 + shift * ((k * 3) % 5 - 2), 5.1 + 10.1 * k);
        xfree(text);
        text = more;
    }
    return text;
}

static void check_stack(int n, double shift, double time, double least)
{
    char *const text = stack_of(n, shift);
    struct sim *const s = sim_from(text);
    double most = 0.0, none = 0.0, walk = 0.0, turn = 0.0;
    run_for(s, time, &most);
    const double left = kinetic(s);
    check(left < least * most,
          "stack of %d, shifted by %g mm: energy after %g s %.2g of its most", n, shift, time,
          left / most);
    vec3 *const at = xalloc((size_t)n, sizeof *at);
    struct quat *const q = xalloc((size_t)n, sizeof *q);
    for (int i = 0; i < n; i++) {
        at[i] = s->grains.pos[i];
        q[i] = s->grains.orientation[i];
    }
    run_for(s, 0.1, &none);
    for (int i = 0; i < n; i++) {
        walk = fmax(walk, v3_norm(v3_sub(s->grains.pos[i], at[i])));
        turn = fmax(turn, fabs(s->grains.orientation[i].x - q[i].x) +
                              fabs(s->grains.orientation[i].y - q[i].y) +
                              fabs(s->grains.orientation[i].z - q[i].z));
    }
    check(walk < 1e-8 && turn < 1e-6, "  in 0.1 s more it walks by %.2g m and turns by %.2g",
          walk, turn);
    sim_free(s);
    xfree(at);
    xfree(q);
    xfree(text);
}

/* J, of one cube that touches nothing. */
static double energy_of(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    const struct shape_form *const f = &g->species[0].form;
    const double size = g->radius[0] / f->bounding, i = f->inertia.x * g->mass[0] * size * size;
    return g->mass[0] * (0.5 * v3_dot(g->vel[0], g->vel[0]) + 9.80665 * g->pos[0].z) +
           0.5 * i * v3_dot(g->spin[0], g->spin[0]);
}

#define PLATE(corner, edge1)                                                                   \
    "[wall p]\nkind = rectangle\ncorner = " corner " mm\nedge1 = " edge1                       \
    " mm\nedge2 = 0 40 0 mm\nmaterial = m\n"

/* The cube drops on a corner, an edge, a face, anyhow, on a plane or what else there is, without loss:
 * its energy after some bounces, in flight. */
static void check_bounce(const char *orientation, const char *name, const char *what)
{
    char *const text =
        xprintf("[domain]\nsize = 100 100 100 mm\n[run]\nend = 10 s\nsubsteps = 1\nsafety = "
                "0.05\n" MATERIAL "restitution = 1\nfriction = 0\n[grains c]\n" CUBE
                "orientation = %s\ndiameter = %.15g mm\nposition = 51 52 40 mm\n%s",
                orientation, diameter_of_cube(), what);
    struct sim *const s = sim_from(text);
    const double start = energy_of(s);
    double worst = 0.0;
    int bounces = 0;
    bool touched = false;
    while (s->t < 0.3) {
        step(s);
        if (touched && s->neighbours.touching == 0) {
            bounces++;
            worst = fmax(worst, fabs(energy_of(s) / start - 1.0));
        }
        touched = s->neighbours.touching > 0;
    }
    check(bounces >= 2 && worst < 1e-3, "%d bounces on a %s (%s): energy kept within %.2g",
          bounces, name, orientation, worst);
    sim_free(s);
    xfree(text);
}

/* On a slope below the angle of friction it stays, above it slides; it does not tip below 45 degrees.
 */
static double slides(double angle, double settle, double *gain)
{
    const double g = 9.81;
    char *const text = xprintf(
        "[domain]\nsize = 400 100 100 mm\ngravity = %.17g 0 %.17g m/s2\n[run]\nend = 10 s\n"
        "substeps = 20\n" MATERIAL "restitution = 0.3\nfriction = 0.5\n[grains c]\n" CUBE
        "orientation = aligned\ndiameter = %.15g mm\nposition = 50 50 5.0 mm\n",
        g * sin(angle), -g * cos(angle), diameter_of_cube());
    struct sim *const s = sim_from(text);
    double most = 0.0;
    run_for(s, settle, &most);
    const double v = s->grains.vel[0].x;
    run_for(s, 0.1, &most);
    *gain = s->grains.vel[0].x - v; /* in 0.1 s, after the drop by its own overlap */
    check(v3_norm(s->grains.spin[0]) < 1.0, "slope of %.3g: spin %.2g", angle,
          v3_norm(s->grains.spin[0]));
    sim_free(s);
    xfree(text);
    return v;
}

static void check_slope(void)
{
    const double limit = atan(0.5);
    double gain;
    /* at rest once the crown has rolled to where the load is, in 0.03 s to 1/e */
    check(slides(0.97 * limit, 0.3, &gain) < 1e-4 && fabs(gain) < 1e-5,
          "a cube on a slope of 0.97 of the angle of friction stays");
    const double g = 9.81;
    slides(1.1 * limit, 0.1, &gain);
    const double want = 0.1 * g * (sin(1.1 * limit) - 0.5 * cos(1.1 * limit));
    check_rel(gain, want, 3e-3, "of 1.1 of it, it slides as the law says, m/s in 0.1 s");
}

/* A cube on a plane, tilted by far less than its crown lets it: it rights itself as slowly as the
 * dashpot of rocking lets it (contact_rocking.c), I* x^2 - C x + K = 0 with K = m g (radius of the
 * crown - height). */
static void check_rocking(double zeta)
{
    const double tilt = 2e-4, edge = 8e-3, r = 1e-3, young = 20e6, poisson = 0.3;
    char *const text =
        xprintf("[domain]\nsize = 100 100 100 mm\n[run]\nend = 10 s\nsubsteps = 5\nsafety = "
                "0.1\n" MATERIAL "damping_ratio = %.17g\nfriction = 0.5\n[grains c]\n" CUBE
                "orientation = 1 %.17g 0 0\ndiameter = %.15g mm\nposition = 50 50 4.9995 mm\n",
                zeta, 0.5 * tilt, diameter_of_cube());
    struct sim *const s = sim_from(text);
    const struct grains *const g = &s->grains;
    const double m = g->mass[0], size = 0.5e-3 * diameter_of_cube(), weight = m * 9.80665;
    const double e_star = young / (1.0 - poisson * poisson) / 2.0;
    const double depth = pow(weight / (4.0 / 3.0 * e_star * sqrt(size)), 2.0 / 3.0);
    const double c = 2.0 * sqrt(5.0 / 6.0) * zeta * sqrt(2.0 * e_star * sqrt(size * depth) * m);
    const double inertia = 1.0 / g->inv_inertia[0] + m * size * size, far = edge / sqrt(2.0);
    const double whole =
        c * sqrt(inertia / m * (2.0 / 3.0) * far * far * far / sqrt(size * depth));
    const double spread = 0.5 * c * far * far; /* of the normal dashpot itself */
    const double big = spread + (whole - spread) / (1.0 + whole * s->run.dt / inertia);
    const double k = weight * (CROWN_SHARP / size * edge * edge / 4.0 + r - (5e-3 - depth));
    const double own = g->inertia[0].x + m * 25e-6;
    const double slow = 2.0 * k / (big + sqrt(big * big - 4.0 * own * k));
    double most = 0.0;
    run_for(s, 1.0 / slow, &most);
    const double before = g->orientation[0].x;
    run_for(s, 1.0 / slow, &most);
    check_rel(log(before / g->orientation[0].x), 1.0, 0.02,
              "a tilted cube rights itself as the dashpot of a flat face lets it");
    sim_free(s);
    xfree(text);
}

/* A cube of side 10 mm, turned by 20 degrees, into which the edge of a plate reaches 2.65 mm
 * through its side: that depth, not the 6.4 mm to its top or bottom, as its centre passes the
 * plate's plane. */
static void check_plate(void)
{
    char *const text =
        xprintf("[domain]\nsize = 100 100 100 mm\n[run]\nend = 1 s\n" MATERIAL
                "restitution = 0.3\nfriction = 0.5\n[grains c]\n" CUBE
                "orientation = aligned\ndiameter = %.15g mm\nposition = 50 50 50 mm\n",
                diameter_of_cube());
    struct sim *const s = sim_from(text);
    const double turn = -20.0 * PI / 180.0, edge = 2.5e-3;
    struct shape_pose pose = {.size = s->grains.radius[0] / s->grains.species[0].form.bounding,
                              .q = {cos(0.5 * turn), 0.0, sin(0.5 * turn), 0.0}};
    pose.turn = quat_matrix(pose.q);
    for (int k = 0; k < 2; k++) {
        const double z =
            k == 0 ? -0.07e-3 : 0.07e-3; /* of the plate; the centre is above, then below */
        const struct shape_facet plate = {.n = 4,
                                          .corner = {v3(edge, -0.05, z), v3(0.05, -0.05, z),
                                                     v3(0.05, 0.05, z), v3(edge, 0.05, z)},
                                          .normal = v3(0.0, 0.0, k == 0 ? 1.0 : -1.0)};
        const double side = 5e-3 - edge * cos(turn) - z * sin(-turn);
        struct shape_point p[4];
        vec3 core;
        const int n = shape.meet_flat(&pose, 0, &plate, 1e-3, &core, p);
        check(n > 0, "a plate that reaches into a cube is met");
        check_rel(p[0].depth, side, 0.03, "through its side, m");
        check(p[0].normal.x < -0.9, "and pushed back to where it came from: %g", p[0].normal.x);
    }
    sim_free(s);
    xfree(text);
}

/* A prism that hangs past a plate's edge, as one did in a hopper: its top is abreast of the plate,
 * its centre below, its side a little off the edge. Whatever side the plate is seen from, it is met
 * there. */
static void check_hanging(void)
{
    struct sim *const s =
        sim_from("[domain]\nsize = 100 100 100 mm\n[run]\nend = 1 s\n" MATERIAL
                 "restitution = 0.3\nfriction = 0.5\n[grains c]\nform = prism\nsides = "
                 "3\ndilation = 1 mm\n"
                 "diameter = 10.05 mm\ndensity = 652 kg/m3\nfill = point\nmaterial = "
                 "m\nposition = 50 50 50 mm\n");
    struct shape_pose pose = {.size = s->grains.radius[0] / s->grains.species[0].form.bounding,
                              .q = {-0.5884895151762461, -0.27240878706789784,
                                    0.11201807627857434, 0.75294454898264}};
    const double x = 4.14931e-3, z = 0.600172e-3;
    double depth[2];
    pose.turn = quat_matrix(pose.q);
    for (int k = 0; k < 2; k++) {
        const struct shape_facet plate = {.n = 4,
                                          .corner = {v3(x, -0.0439, z), v3(0.0541, -0.0439, z),
                                                     v3(0.0541, 0.006, z), v3(x, 0.006, z)},
                                          .normal = v3(0.0, 0.0, k == 0 ? 1.0 : -1.0)};
        struct shape_point p[4];
        vec3 core;
        depth[k] = shape.meet_flat(&pose, 0, &plate, 3e-3, &core, p) > 0 ? p[0].depth : -1.0;
        check_abs(
            depth[k], 1e-3 - 1.0445534e-3, 0.007 * pose.size,
            "a plate beside a prism: dilation less distance (by search), within the crown");
    }
    check_abs(depth[1], depth[0], 2e-5, "the same from below as from above");
    sim_free(s);
}

/* A tilted cube that stands on a plate by a corner, near an edge beyond which its highest corner is: as
 * a part of a grain whose centre is below the plate already, it is seen from there. */
static void check_leaning(void)
{
    struct sim *const s =
        sim_from("[domain]\nsize = 100 100 100 mm\n[run]\nend = 1 s\n" MATERIAL
                 "restitution = 0.3\nfriction = 0.5\n[grains c]\nform = cube\ndilation = 1 mm\n"
                 "diameter = 10.05 mm\ndensity = 652 kg/m3\nfill = point\nmaterial = "
                 "m\nposition = 50 50 50 mm\n");
    const double turn = 0.37, gap = 0.31e-3, h = (s->grains.radius[0] - 1e-3) / sqrt(3.0);
    struct shape_pose pose = {.size = s->grains.radius[0] / s->grains.species[0].form.bounding,
                              .q = {cos(0.5 * turn), 0.0, -sin(0.5 * turn), 0.0}};
    pose.turn = quat_matrix(pose.q);
    const vec3 low = mat3_turn(&pose.turn, v3(-h, 0.0, -h)),
               high = mat3_turn(&pose.turn, v3(h, 0.0, h));
    const double edge = 0.5 * (low.x + high.x), z = low.z - gap;
    for (int k = 0; k < 2; k++) {
        const struct shape_facet plate = {
            .n = 4,
            .corner = {v3(edge, -0.04, z), v3(edge - 0.05, -0.04, z), v3(edge - 0.05, 0.04, z),
                       v3(edge, 0.04, z)},
            .normal = v3(0.0, 0.0, k == 0 ? 1.0 : -1.0)};
        struct shape_point p[4];
        vec3 core;
        const int n = shape.meet_flat(&pose, 0, &plate, 0.0, &core, p);
        check(n > 0, "a cube that stands on a plate is met, seen from %s",
              k ? "below" : "above");
        check_abs(n > 0 ? n * p[0].share * p[0].depth : -1.0, 1e-3 - gap, 0.02 * pose.size,
                  "where its corners stand, within what these lie inside of the cube's");
    }
    sim_free(s);
}

/* Volumes: those of the parts for grids, and the shadow's mean, a quarter of the surface of a
 * convex body [Cauchy1841]. */
static void check_body(int form, double r, bool convex)
{
    struct solid solid = {0};
    char *why = NULL;
    solid_named(&solid, form, 3);
    struct dilated *const d = dilated_create(&solid, r, 0.05, &why);
    if (!check(d != NULL, "form %d with dilation %g: %s", form, r, why ? why : "made"))
        return;
    dilated_make_shadows(d);
    int n = 0;
    struct shape_part *const part = dilated_parts(d, 0.2, &n);
    double volume = 0.0, mean = 0.0;
    vec3 first = {0.0, 0.0, 0.0};
    for (int k = 0; k < n; k++) {
        volume += part[k].volume;
        first = v3_axpy(first, part[k].volume, part[k].at);
    }
    check_rel(volume, 4.0 / 3.0 * PI, 1e-12, "  volume of the parts for grids");
    check(v3_norm(first) < 0.02 * volume, "  their centre is that of mass within %.2g",
          v3_norm(first) / volume);
    const int many = 500;
    for (int k = 0; k < many; k++) {
        const double z = (2.0 * k + 1.0) / many - 1.0, q = 2.399963229728653 * k,
                     s = sqrt(1.0 - z * z);
        mean += dilated_shadow(d, v3(s * cos(q), s * sin(q), z)) / many;
    }
    if (convex)
        check_rel(mean, 0.25 * d->surface, 2e-3,
                  "  mean shadow of a convex body: quarter surface");
    else
        check(mean < 0.25 * d->surface && d->surface > 4.0 * PI,
              "  a concave body's shadow %.3g is less than a quarter of its surface %.3g", mean,
              0.25 * d->surface);
    xfree(part);
    dilated_free(d);
    solid_free(&solid);
}

/* A cube of two halves that overlap, as several parts: moments over a grid, to the order of its
 * spacing. */
static void check_grid_moments(void)
{
    const double spacing[] = {0.2, 0.1, 0.05};
    double last = 1.0;
    for (int k = 0; k < 3; k++) {
        struct solid two = {0}, one = {0};
        char *why = NULL;
        vec3 c[8], d[8];
        solid_named(&one, 0, 3);
        for (int i = 0; i < 8; i++) {
            c[i] = d[i] = one.point[0][i];
            if (c[i].x > 0.0)
                c[i].x = 0.3;
            else
                d[i].x = -0.4;
        }
        solid_add(&two, c, 8);
        solid_add(&two, d, 8);
        struct dilated *const a = dilated_create(&one, 0.15, spacing[k], &why),
                              *const b = dilated_create(&two, 0.15, spacing[k], &why);
        const double error = fmax(fabs(b->inertia.x / a->inertia.x - 1.0),
                                  fabs(b->inertia.z / a->inertia.z - 1.0));
        check(error < last && error < 0.2 * spacing[k],
              "inertia over a grid of %g: off by %.2g", spacing[k], error);
        last = fmax(error, 2e-4);
        dilated_free(a);
        dilated_free(b);
        solid_free(&one);
        solid_free(&two);
    }
}

/* A box in OBJ with something wrong. */
static void check_mesh(const char *faces, bool convex, const char *expected)
{
    char folder[] = "/tmp/silt_meshXXXXXX";
    char *const path = mkdtemp(folder) ? xprintf("%s/part.obj", folder) : NULL;
    struct solid s = {0};
    char *why = NULL;
    FILE *const f = fopen(path, "w");
    fputs("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
          "v 0.5 0.5 0.7\n",
          f);
    fputs(faces, f);
    fclose(f);
    const bool good = solid_of_mesh(&s, path, convex, &why);
    if (expected)
        check(!good && why && strstr(why, expected), "refused: %s", why ? why : "not refused");
    else
        check(good && s.n > 0, "taken: %d parts %s", s.n, why ? why : "");
    xfree(why);
    solid_free(&s);
    unlink(path);
    rmdir(folder);
    xfree(path);
}

#define SIDES "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"

static void check_meshes(void)
{
    check_mesh(SIDES "f 4 3 2 1\nf 5 6 7 8\n", true, NULL);
    check_mesh("o a\n" SIDES "f 4 3 2 1\nf 5 6 7 8\no b\n" SIDES "f 4 3 2 1\nf 5 6 7 8\n",
               false, NULL);
    check_mesh("o a\n" SIDES "f 4 3 2 1\nf 5 6 7 8\no b\n" SIDES "f 4 3 2 1\nf 5 6 7 8\n", true,
               "holds 2 objects");
    check_mesh(SIDES "f 4 3 2 1\n", true, "is open");
    check_mesh("f 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\nf 1 2 3 4\nf 8 7 6 5\n", true,
               "inside out");
    check_mesh(SIDES "f 4 3 2 1\nf 8 7 6 5\n", true, "same way");
    check_mesh(SIDES "f 4 3 2 1\nf 5 6 7 8\nf 1 1 2\n", true, "degenerate");
    check_mesh(SIDES "f 4 3 2 1\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n", true, "not convex");
    check_mesh(SIDES "f 4 3 2 1\nf 5 6 77\n", true, "vertex 77");
    check_mesh("v 0.5 0.5 -0.5\n" SIDES "f 4 3 2 1\nf 5 6 10\nf 6 7 10\nf 7 8 10\nf 8 5 10\n",
               true, "crosses itself");
}

int main(void)
{
    check_plate();
    check_hanging();
    check_leaning();
    omp_set_num_threads(1); /* small scenes: more threads only wait for each other */
    check_body(0, 0.1, true);
    check_body(1, 0.3, true);
    check_body(4, 0.05, true);
    check_body(5, 0.2, true);
    check_body(0, 1.0, true);
    check_body(9, 0.1, false);
    check_body(13, 0.05, false);
    check_grid_moments();
    check_meshes();
    check_stack(1, 0.0, 0.3, 1e-12);
    check_stack(3, 0.0, 0.3, 1e-12);
    check_stack(3, 0.3, 2.0, 1e-12);
    const char *const way[] = {"0.3 0.2 -0.4 0.1", "aligned", "1 0.02 0.01 0", "1 0.4142 0 0"};
    for (int k = 0; k < 4; k++) {
        check_bounce(way[k], "plane", "");
        check_bounce(way[k], "rib narrower than it", PLATE("48 30 20", "4 0 0"));
        check_bounce(way[k], "table over its edge", PLATE("52.5 30 20", "30 0 0"));
        if (k == 0 || k == 2)
            check_bounce(way[k], "block over its edge",
                         "[wall p]\nkind = box\nfrom = 52.5 30 10 mm\nto = 80 70 20 "
                         "mm\nmaterial = m\n");
    }
    check_slope();
    check_rocking(0.1);
    check_rocking(0.36);
    return check_end();
}
