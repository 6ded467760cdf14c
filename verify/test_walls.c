/* test_walls.c - walls: distances of every kind against closed forms; a floor of any kind, and of
 * triangles cut in any way, gives the rebound and the path of a plane; edges count once. */
/* slots: contact/hertz_mindlin */
#include "stl_floor.h"

#define BOX                                                                                    \
    "[domain]\nsize = 60 60 60 mm\n[run]\nend = 1 s\nsubsteps = 20\ndt = 2 us\n"               \
    "overlap_max = 0.3\n[grains a]\ndiameter = 5 mm\ndensity = 2385 kg/m3\nfill = point\n"     \
    "[material a]\nyoung = 2e7 Pa\npoisson = 0.3\nrestitution = 0.7\nfriction = 0.4\n"

static struct sim *ball(const char *wall, const char *grain)
{
    char *const text = xprintf("%s%s", wall, BOX);
    char *const split = strstr(text, "fill = point\n");
    char *const whole = xprintf("%.*s%s%s", (int)(split - text), text, grain, split);
    struct sim *const s = sim_from(whole);
    xfree(text);
    xfree(whole);
    return s;
}

#define IN_AIR "position = 30.3 29.1 50.2 mm\n"

/* From the nearest point of wall w to x. */
static double distance(const struct sim *s, vec3 x)
{
    double least = (double)INFINITY;
    for (int e = s->walls.first[6]; e < s->walls.first[7]; e++)
        least = fmin(least, v3_norm(wall_see(s, e, x).view.away));
    return least;
}

static double square(double x)
{
    return x * x;
}

static void check_distances(void)
{
    const vec3 x = v3(0.0217, 0.0413, 0.0129), y = v3(0.0332, 0.0265, 0.0418);
    struct sim *s = ball("[wall w]\nkind = disc\npoint = 20 30 20 mm\nnormal = 0 0 3\n"
                         "radius = 9 mm\nhole = 2 mm\n",
                         IN_AIR);
    double r = hypot(x.x - 0.02, x.y - 0.03);
    check_rel(distance(s, x), hypot(r - 0.009, x.z - 0.02), 1e-14, "disc: its rim");
    check_rel(distance(s, v3(0.0205, 0.0301, 0.011)),
              hypot(0.002 - hypot(0.0005, 0.0001), 0.009), 1e-14, "disc: its hole");
    check_rel(distance(s, v3(0.0253, 0.0301, 0.011)), 0.009, 1e-14, "disc: its face");
    sim_free(s);
    s = ball("[wall w]\nkind = cylinder\npoint = 30 30 5 mm\naxis = 0 0 1\nradius = 25 mm\n"
             "side = in\n",
             IN_AIR);
    r = hypot(x.x - 0.03, x.y - 0.03);
    check_rel(distance(s, x), 0.025 - r, 1e-14, "cylinder without end, from within");
    check_rel(wall_see(s, 6, x).view.curvature, -1.0 / 0.025, 1e-14, "its curvature is hollow");
    sim_free(s);
    s = ball("[wall w]\nkind = cylinder\npoint = 30 30 5 mm\naxis = 0 0 1\nradius = 4 mm\n"
             "length = 10 mm\ncaps = end\n",
             IN_AIR);
    r = hypot(y.x - 0.03, y.y - 0.03);
    check_rel(distance(s, y), hypot(fmax(0.0, r - 0.004), y.z - 0.015), 1e-14,
              "cylinder with a cap");
    check_rel(distance(s, v3(0.041, 0.03, 0.002)), hypot(0.007, 0.003), 1e-14, "its open rim");
    sim_free(s);
    s = ball("[wall w]\nkind = cone\npoint = 30 30 10 mm\naxis = 0 0 1\nradius = 4 mm\n"
             "radius_end = 20 mm\nlength = 30 mm\n",
             IN_AIR);
    r = hypot(y.x - 0.03, y.y - 0.03);
    const double slope = hypot(0.030, 0.016);
    const double z = 0.0218;
    check_rel(distance(s, v3(y.x, y.y, z)),
              fabs((r - 0.004) * 0.030 - (z - 0.010) * 0.016) / slope, 1e-13,
              "cone, from within");
    sim_free(s);
    s = ball("[wall w]\nkind = box\nfrom = 10 15 5 mm\nto = 50 45 55 mm\n", IN_AIR);
    check_rel(distance(s, x), 0.045 - x.y, 1e-13, "box, from within");
    check_rel(distance(s, v3(0.004, 0.047, 0.058)),
              sqrt(square(0.006) + square(0.002) + square(0.003)), 1e-13, "box, its corner");
    sim_free(s);
}

/* Elements of wall w from many points at once, as from one by one. */
static void check_together(const char *wall)
{
    struct sim *const s = ball(wall, IN_AIR);
    const struct wall *const w = &s->walls.wall[6];
    unsigned seed = 12345;
    double worst = 0.0;
    int parts[3] = {0}, unlike = 0;
    for (int round = 0; round < 60; round++) {
        struct wall_looks l = {.n = WALL_LOOKS};
        double arm[3][WALL_LOOKS];
        vec3 x[WALL_LOOKS];
        for (int c = 0; c < l.n; c++) {
            double u[3];
            for (int k = 0; k < 3; k++) {
                seed = 1664525u * seed + 1013904223u;
                u[k] = 0.06 * (double)(seed >> 8) / 16777216.0;
            }
            x[c] = v3(u[0], u[1], u[2]);
            l.element[c] = (int)(seed >> 9) % w->elements;
            l.x[c] = u[0];
            l.y[c] = u[1];
            l.z[c] = u[2];
        }
        walls_look(s, w, &l, arm);
        for (int c = 0; c < l.n; c++) {
            const struct wall_seen one = wall_see(s, s->walls.first[6] + l.element[c], x[c]);
            const vec3 away = v3_sub(v3(l.ax[c], l.ay[c], l.az[c]), one.view.away);
            const vec3 apart = v3_sub(v3(arm[0][c], arm[1][c], arm[2][c]), one.arm);
            worst = fmax(worst, fmax(v3_norm(away), v3_norm(apart)) / 0.06);
            worst = fmax(worst, 0.06 * fabs(l.curvature[c] - one.view.curvature));
            unlike += (enum wall_part)l.part[c] != one.view.part;
            parts[one.view.part]++;
        }
    }
    check(worst < 1e-12 && unlike == 0,
          "%.*s: together as one by one, to %.2g (%d faces, %d edges, %d vertices)",
          (int)strcspn(wall + 9, "\n"), wall + 9, worst, parts[0], parts[1], parts[2]);
    sim_free(s);
}

static void check_all_together(void)
{
    char *const mesh = floor_mesh(0);
    const char *const wall[] = {
        "[wall w]\nkind = plane\npoint = 20 30 20 mm\nnormal = 1 -2 3\n",
        "[wall w]\nkind = rectangle\ncorner = 10 15 20 mm\nedge1 = 20 10 5 mm\n"
        "edge2 = -10 20 0 mm\n",
        "[wall w]\nkind = disc\npoint = 20 30 20 mm\nnormal = 1 2 3\nradius = 15 mm\n"
        "hole = 6 mm\n",
        "[wall w]\nkind = cylinder\npoint = 30 28 5 mm\naxis = 0.2 0.3 1\nradius = 17 mm\n",
        "[wall w]\nkind = cone\npoint = 30 28 5 mm\naxis = 0.2 0.3 1\nradius = 17 mm\n"
        "radius_end = 5 mm\nlength = 30 mm\ncaps = both\nspin = 3 rad/s\n"
        "spin_axis = 1 2 0\nspin_point = 10 20 30 mm\n",
        "[wall w]\nkind = box\nfrom = 10 15 5 mm\nto = 50 45 55 mm\nvelocity = 1 2 0 mm/s\n",
        mesh};
    for (size_t k = 0; k < sizeof wall / sizeof wall[0]; k++)
        check_together(wall[k]);
    xfree(mesh);
}

/* Rebound of a ball thrown askew, spinning, on a floor at z = 10 mm: its state after the contact. */
struct flight {
    vec3 x, v, w;
    double force;
};

static struct flight fly(const char *floor, const char *grain, int steps)
{
    struct sim *const s = ball(floor, grain);
    struct flight f = {0};
    ledger_start(s);
    for (int k = 0; k < steps; k++) {
        step(s);
        f.force += v3_norm(s->walls.wall[6].force);
    }
    f.x = s->grains.pos[0];
    f.v = s->grains.vel[0];
    f.w = s->grains.spin[0];
    sim_free(s);
    return f;
}

static double differ(const struct flight *a, const struct flight *b)
{
    const double x = v3_norm(v3_sub(a->x, b->x)) / v3_norm(a->x);
    const double v = v3_norm(v3_sub(a->v, b->v)) / v3_norm(a->v);
    const double w = v3_norm(v3_sub(a->w, b->w)) / fmax(v3_norm(a->w), 1e-9);
    return fmax(x, fmax(v, w));
}

#define PLANE "[wall floor]\npoint = 0 0 10 mm\nnormal = 0 0 1\n"
#define THROWN                                                                                 \
    "position = 23.1 31.7 13.3 mm\nvelocity = 0.73 -0.41 -1.13 m/s\nspin = 31 -57 83 rad/s\n"
#define ROLLING                                                                                \
    "position = 13.1 21.7 12.499 mm\nvelocity = 0.91 0.37 0 m/s\nspin = 0 120 17 rad/s\n"

static void check_floors(void)
{
    const char *const floor[] = {
        "[wall floor]\nkind = rectangle\ncorner = 1 2 10 mm\nedge1 = 57 0 0 mm\n"
        "edge2 = 0 55 0 mm\n",
        "[wall floor]\nkind = disc\npoint = 31 29 10 mm\nnormal = 0 0 -1\nradius = 28 mm\n",
        "[wall floor]\nkind = box\nfrom = 1 1 2 mm\nto = 59 58 10 mm\nside = out\n",
        "[wall floor]\nkind = cylinder\npoint = 30 30 2 mm\naxis = 0 0 1\nradius = 29 mm\n"
        "length = 8 mm\ncaps = both\n"};
    const char *const name[] = {"rectangle", "disc", "box", "capped cylinder"};
    const struct flight plane = fly(PLANE, THROWN, 200), roll = fly(PLANE, ROLLING, 500);
    check(plane.v.z > 0.5 && plane.force > 1.0, "the ball rebounds: %g m/s", plane.v.z);
    check(roll.x.x > 0.028 && roll.force > 0.0, "the ball rolls: to %g m", roll.x.x);
    for (int k = 0; k < 4; k++) {
        const struct flight f = fly(floor[k], THROWN, 200), r = fly(floor[k], ROLLING, 500);
        check(differ(&f, &plane) < 1e-12, "%s: the rebound of a plane to %.2g", name[k],
              differ(&f, &plane));
        check(differ(&r, &roll) < 1e-12, "%s: the rolling of a plane to %.2g", name[k],
              differ(&r, &roll));
    }
    for (int how = 0; how < FLOORS; how++) {
        char *const mesh = floor_mesh(how);
        const struct flight f = fly(mesh, THROWN, 200), r = fly(mesh, ROLLING, 500);
        check(differ(&f, &plane) < 1e-12, "mesh cut %s: the rebound of a plane to %.2g",
              floor_name[how], differ(&f, &plane));
        check(differ(&r, &roll) < 1e-12, "mesh cut %s: the rolling of a plane to %.2g",
              floor_name[how], differ(&r, &roll));
        floor_remove(mesh);
    }
}

/* Contacts of a ball near an edge of two plates at an angle, met by triangles. */
static long contacts(const vec3 *corner, int n, const char *grain)
{
    char *const wall = stl_wall(corner, n);
    struct sim *const s = ball(wall, grain);
    const long touching = s->neighbours.touching;
    sim_free(s);
    floor_remove(wall);
    return touching;
}

static void check_edges(void)
{
    /* a roof: two plates that fall off on both sides of the ridge y = 30 mm, z = 20 mm */
    const vec3 a = v3(0.01, 0.03, 0.02), b = v3(0.05, 0.03, 0.02);
    const vec3 c = v3(0.01, 0.01, 0.012), d = v3(0.05, 0.01, 0.012);
    const vec3 e = v3(0.01, 0.05, 0.012), f = v3(0.05, 0.05, 0.012);
    const vec3 roof[] = {a, b, c, b, d, c, a, e, b, b, e, f};
    check(contacts(roof, 4, "position = 27 30 22.45 mm\n") == 1,
          "on a convex edge: one contact");
    check(contacts(roof, 4, "position = 27 29.2 22.3 mm\n") == 1, "beside it: one contact");
    /* a valley */
    vec3 valley[12];
    for (int k = 0; k < 12; k++)
        valley[k] = v3(roof[k].x, roof[k].y, 0.04 - roof[k].z);
    check(contacts(valley, 4, "position = 27 30 22.65 mm\n") == 2, "in a valley: two contacts");
}

/* An STL file of these bytes is refused for a reason with `why` in it, or (NULL) holds `count` triangles. */
static void read_file(const char *name, const void *data, size_t size, const char *why,
                      int count)
{
    char path[] = "/tmp/silt-stl-XXXXXX";
    const int fd = mkstemp(path);
    const bool written = fd >= 0 && write(fd, data, size) == (ssize_t)size;
    close(fd);
    int n;
    char *reason = NULL;
    vec3 *const corner = mesh_read_stl(path, &n, &reason);
    struct mesh *const m = corner ? mesh_create(corner, n, &reason) : NULL;
    if (why)
        check(written && !m && reason && strstr(reason, why), "%s is refused: %s", name,
              reason ? reason : "(it is not)");
    else
        check(written && m && n == count, "%s: %d of %d triangles, %s", name, n, count,
              reason ? reason : "read");
    unlink(path);
    mesh_free(m);
    xfree(corner);
    xfree(reason);
}

static void expect_refused(const char *name, const void *data, size_t size, const char *why)
{
    read_file(name, data, size, why, 0);
}

#define FACET(c)                                                                               \
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " c                    \
    "\nendloop\nendfacet\n"

static void check_files(void)
{
    const char *const cut = "solid a\n" FACET("0 1 0") "facet normal 0 0 1\nouter loop\nvertex";
    const char *const flat = "solid a\n" FACET("0 1 0") FACET("2 0 0") "endsolid a\n";
    const char *const nan = "solid a\n" FACET("0 nan 0") "endsolid a\n";
    const char *const word = "solid a\n" FACET("0 one 0") "endsolid a\n";
    unsigned char binary[84 + 100] = "binary";
    expect_refused("a text that ends", cut, strlen(cut), "truncated");
    expect_refused("a triangle without area", flat, strlen(flat), "1 of 2 triangles are degen");
    expect_refused("a corner that is no number", nan, strlen(nan), "not finite");
    expect_refused("a word for a number", word, strlen(word), "where a number is expected");
    expect_refused("a solid of nothing", "solid a\nendsolid a\n", 19, "holds no triangle");
    expect_refused("an empty file", "", 0, "truncated");
    binary[80] = 3;
    expect_refused("a binary file that ends", binary, sizeof binary, "is truncated: its head");
    binary[80] = 1;
    const char *const two =
        "SOLID upper half\r\n" FACET("0 1 0") "endsolid\nsolid b c\n" FACET("0 2 0")
            FACET("0 3 0") "endsolid b c\n";
    const char *const junk = "solid a\n" FACET("0 1 0") "endsolid a\nfacet";
    read_file("two solids in one file", two, strlen(two), NULL, 3);
    expect_refused("words after a solid", junk, strlen(junk), "where solid is expected");
    expect_refused("a wrong count", binary, sizeof binary, "wrong count");
}

/* A floor of two triangles that span both periods is felt everywhere, as its plane is. */
static void check_periods(void)
{
    const vec3 p = v3(0.0, 0.0, 0.011), q = v3(0.06, 0.0, 0.011), r = v3(0.0, 0.06, 0.011),
               o = v3(0.06, 0.06, 0.011);
    const vec3 two[6] = {p, q, r, q, o, r};
    char *const wall = stl_wall(two, 2);
    char *const text = xprintf(
        "%s[domain]\nsize = 60 60 60 mm\nx = periodic\ny = periodic\n[run]\nend = 1 s\n"
        "[grains a]\ndiameter = 5 mm\ndensity = 2385 kg/m3\nfill = point\n"
        "[material a]\nyoung = 2e7 Pa\npoisson = 0.3\nrestitution = 0.7\nfriction = 0.4\n",
        wall);
    struct sim *const s = sim_from(text);
    double worst = 0.0;
    for (int i = 0; i < 4096; i++) {
        const vec3 x = v3(0.06 * (i % 64 + 0.37) / 64.0, 0.06 * (i / 64 + 0.61) / 64.0, 0.0132);
        worst = fmax(worst, fabs(walls_gap(s, x, 0.0, 0.005, NULL) - 0.0022));
    }
    check_abs(worst, 0.0, 1e-16,
              "a floor of two triangles as wide as the periods: its distance");
    check(s->walls.first[s->walls.n] > 2, "they were cut");
    sim_free(s);
    xfree(text);
    floor_remove(wall);
}

int main(void)
{
    check_periods();
    check_distances();
    check_all_together();
    check_floors();
    check_edges();
    check_files();
    return check_end();
}
