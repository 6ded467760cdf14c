/* verify/test_wall_kinds.c - the same surface by every kind of wall that has it, moving in every way, and
 * edges and corners of meshes beside those of plates and boxes: a thrown ball ends up the same. */
/* slots: contact/hertz_mindlin */
#include <omp.h>
#include "stl_floor.h"

#define SCENE                                                                                  \
    "[domain]\nsize = 60 60 60 mm\ngravity = 0 0 -9.81 m/s2\n[grains a]\ndiameter = 5 mm\n"    \
    "density = 2385 kg/m3\nfill = point\n%s[material a]\nyoung = 7 MPa\npoisson = 0.27\n"      \
    "restitution = 0.63\nfriction = 0.37\n[run]\nend = 1 s\ndt = 11 us\n%s"

struct end {
    vec3 x, v, w;
    double force; /* N, summed over steps, on all named walls: they were met */
};

static struct end fly(const char *walls, const char *grain, int steps)
{
    char *const text = xprintf(SCENE, grain, walls);
    struct sim *const s = sim_from(text);
    struct end e = {.force = 0.0};
    xfree(text);
    for (int k = 0; k < steps; k++) {
        step_grains(s, 1);
        s->t += s->run.dt;
        for (int w = 6; w < s->walls.n; w++)
            e.force += v3_norm(s->walls.wall[w].force);
    }
    e.x = s->grains.pos[0];
    e.v = s->grains.vel[0];
    e.w = s->grains.spin[0];
    sim_free(s);
    return e;
}

static double differ(const struct end *a, const struct end *b)
{
    const double x = v3_norm(v3_sub(a->x, b->x)) / 0.06;
    const double v = v3_norm(v3_sub(a->v, b->v)) / v3_norm(a->v);
    const double w = v3_norm(v3_sub(a->w, b->w)) / fmax(v3_norm(a->w), 1e-9);
    return fmax(x, fmax(v, w));
}

static void check_same(const struct end *a, const struct end *b, double tolerance,
                       const char *what, const char *how)
{
    check(b->force > 1.0 && differ(a, b) < tolerance, "%s, %s: the same to %.2g", what, how,
          differ(a, b));
}

/* Floors at z = 10 mm. */
static const char *const flat[] = {
    "[wall floor]\nkind = rectangle\ncorner = 5 6 10 mm\nedge1 = 48 0 0 mm\nedge2 = 0 47 0 "
    "mm\n",
    "[wall floor]\npoint = 0 0 10 mm\nnormal = 0 0 1\n",
    "[wall floor]\nkind = disc\npoint = 31 29 10 mm\nnormal = 0 0 -1\nradius = 24 mm\n",
    "[wall floor]\nkind = box\nfrom = 6 5 4 mm\nto = 54 53 10 mm\nside = out\n",
    "[wall floor]\nkind = cylinder\npoint = 30 30 4 mm\naxis = 0 0 1\nradius = 24 mm\n"
    "length = 6 mm\ncaps = both\n"};
static const char *const flat_name[] = {"rectangle", "plane", "disc", "box", "capped cylinder"};
enum { FLATS = sizeof flat / sizeof flat[0], PLANE_AT = 1 };

#define THROWN                                                                                 \
    "position = 29.1 31.7 12.7 mm\nvelocity = 0.43 -0.21 -0.71 m/s\nspin = 31 -57 83 rad/s\n"

static void check_motion(const char *how, const char *motion, bool plane, double tolerance)
{
    struct end first = {.force = 0.0};
    for (int k = 0; k < FLATS + FLOORS; k++) {
        if ((k == PLANE_AT && !plane) || (k == FLATS + CUT_FINE && plane))
            continue; /* a plane has no axis to swing about; the finest mesh takes long to read */
        char *const floor = k < FLATS ? xstrdup(flat[k]) : floor_mesh(k - FLATS);
        char *const wall = xprintf("%s%s", floor, motion);
        const struct end e = fly(wall, THROWN, 900);
        if (k == 0)
            first = e;
        else
            check_same(&first, &e, tolerance, k < FLATS ? flat_name[k] : floor_name[k - FLATS],
                       how);
        xfree(wall);
        if (k < FLATS)
            xfree(floor);
        else
            floor_remove(floor);
    }
}

static void check_motions(void)
{
    check_motion("at rest", "", true, 1e-11);
    check_motion("moving along", "velocity = 0.13 -0.07 0.17 m/s\n", true, 1e-11);
    check_motion("a belt", "surface_velocity = 0.83 -0.47 0 m/s\n", true, 1e-11);
    check_motion("vibrating", "direction = 1 -2 9\namplitude = 0.4 mm\nfrequency = 137 Hz\n",
                 true, 1e-11);
    check_motion("turning", "spin = 17 rad/s\nspin_axis = 0 0 1\nspin_point = 30 30 0 mm\n",
                 true, 1e-11);
    check_motion("swinging",
                 "swing = 0.04 rad\nfrequency = 61 Hz\nspin_axis = 1 0.5 0\n"
                 "spin_point = 30 30 12 mm\n",
                 false, 1e-11);
    check_motion("servo", "push = 0.3 N\ndirection = 0 0 1\nspeed_max = 0.4 m/s\n", true, 1e-9);
}

/* A mesh of n triangles for walls by their names. */
static void check_against(const char *plates, const vec3 *corner, int n, const char *grain,
                          int steps, const char *what, const char *how)
{
    char *const mesh = stl_wall(corner, n);
    const struct end a = fly(plates, grain, steps), b = fly(mesh, grain, steps);
    check_same(&a, &b, 1e-9, what, how);
    floor_remove(mesh);
}

/* The sides of a box as twelve triangles, from outside. */
static void box_triangles(vec3 low, vec3 high, vec3 *t)
{
    const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (int f = 0; f < 6; f++) {
        vec3 c[4];
        for (int k = 0; k < 4; k++)
            c[k] = v3(face[f][k] & 1 ? high.x : low.x, face[f][k] & 2 ? high.y : low.y,
                      face[f][k] & 4 ? high.z : low.z);
        const vec3 two[6] = {c[0], c[1], c[2], c[0], c[2], c[3]};
        memcpy(t, two, sizeof two);
        t += 6;
    }
}

static void check_corners(void)
{
    vec3 t[36];
    const char *const box = "[wall w]\nkind = box\nfrom = 17 19 5 mm\nto = 43 41 21 mm\n";
    box_triangles(v3(0.017, 0.019, 0.005), v3(0.043, 0.041, 0.021), t);
    check_against(
        box, t, 12,
        "position = 17.3 30 24 mm\nvelocity = 0.2 0.3 -0.9 m/s\nspin = 9 50 -20 rad/s\n", 1500,
        "a convex edge", "a box by triangles");
    check_against(
        box, t, 12,
        "position = 16.7 18.5 23.9 mm\nvelocity = 0.1 0.2 -0.7 m/s\nspin = 9 5 20 rad/s\n",
        1500, "a convex corner", "a box by triangles");
    check_against(
        box, t, 12,
        "position = 21 33 9 mm\nvelocity = -0.9 1.3 -0.7 m/s\nspin = 9 50 -20 rad/s\n", 6000,
        "hollow edges and corners", "a box by triangles");
    /* a valley of two plates at an angle, along x, of triangles that join and of such as do not quite: then
     * nothing is known of their edges beforehand */
    const vec3 a = v3(0.005, 0.03, 0.01), b = v3(0.055, 0.03, 0.01);
    const vec3 c = v3(0.005, 0.006, 0.02), d = v3(0.055, 0.006, 0.02);
    const vec3 e = v3(0.005, 0.054, 0.02), f = v3(0.055, 0.054, 0.02);
    const vec3 valley[12] = {a, b, d, a, d, c, a, f, b, a, e, f};
    for (int k = 0; k < 12; k++)
        t[k] = v3_add(valley[k], v3(0.0, 0.0, 1e-14 * (k / 3)));
    char *const apart = stl_wall(t, 4);
    check_against(
        apart, valley, 4,
        "position = 20 27 14.5 mm\nvelocity = 0.2 0.5 -0.5 m/s\nspin = 0 90 30 rad/s\n", 6000,
        "a valley", "joined or not");
    floor_remove(apart);
}

int main(void)
{
    omp_set_num_threads(1); /* one grain */
    check_motions();
    check_corners();
    return check_end();
}
