/* test_wall_motion.c - walls that move: along, turning, vibrating, pressed by a servo. Against closed
 * forms; the ledger closes; the same bits on any number of threads. */
/* slots: contact/hertz_mindlin */
#include <omp.h>
#include "stl_floor.h"

#define PI     3.14159265358979323846
#define DOMAIN "[domain]\nsize = 60 60 60 mm\ngravity = 0 0 %s m/s2\n"
#define RUN_OF                                                                                 \
    "[run]\nend = 1 s\nsubsteps = 20\ndt = 5 us\noverlap_max = 0.3\n[material a]\n"            \
    "young = 2e7 Pa\npoisson = 0.3\nrestitution = %s\nfriction = %s\n"
#define BALL "[grains a]\ndiameter = 5 mm\ndensity = 2385 kg/m3\nfill = point\n%s\n"

static struct sim *ball(const char *wall, const char *grain, const char *gravity,
                        const char *restitution, const char *friction)
{
    char *const text =
        xprintf(DOMAIN RUN_OF BALL "%s", gravity, restitution, friction, grain, wall);
    struct sim *const s = sim_from(text);
    xfree(text);
    ledger_start(s);
    return s;
}

static void go(struct sim *s, double until)
{
    while (s->t < until - 0.5 * s->run.dt)
        step(s);
}

/* The wall has no weight of its own: in its frame a collision loses m V^2 (1 - e^2) / 2. */
static void check_translation(void)
{
    struct sim *const s = ball(
        "[wall w]\nkind = plane\npoint = 5 0 0 mm\nnormal = 1 0 0\nvelocity = 0.37 0 0 m/s\n"
        "start = 1.3 ms\nstop = 31 ms\n",
        "position = 9 30 30 mm", "0", "0.63", "0.4");
    const struct wall *const w = &s->walls.wall[6];
    const double m = 1.0 / s->grains.inv_mass[0], v = 0.37;
    go(s, 0.05);
    check_rel(w->pose.shift.x, v * (0.031 - 0.0013), 1e-12, "a wall from start to stop");
    check_rel(s->grains.vel[0].x, v * 1.63, 3e-3, "a grain hit by it: V (1 + e)");
    check_rel(s->ledger.dissipated, 0.5 * m * v * v * (1.0 - 0.63 * 0.63), 1e-2,
              "what the collision loses");
    check(s->ledger.momentum_error < 1e-9, "its momentum closes: %.2g",
          s->ledger.momentum_error);
    check_rel(walls_work(s), m * v * 1.63 * v, 3e-3, "work of the wall: m V^2 (1 + e)");
    sim_free(s);
}

static void check_pushing(void)
{
    struct sim *const s =
        ball("[wall w]\nkind = plane\npoint = 6 0 0 mm\nnormal = 1 0 0\n"
             "velocity = 0.11 0 0 m/s\n"
             "[wall floor]\nkind = plane\npoint = 0 0 10 mm\nnormal = 0 0 1\n",
             "position = 8.6 30 12.499 mm", "-9.81", "0.1", "0.3");
    go(s, 0.13);
    const double rolls = s->grains.vel[0].x;
    check(rolls > 0.109 && s->grains.pos[0].x > 0.02, "a wall pushes a grain along: %g m/s",
          rolls);
    check(s->ledger.momentum_error < 1e-9, "its momentum closes: %.2g",
          s->ledger.momentum_error);
    sim_free(s);
}

static void check_vibration(void)
{
    struct sim *const s =
        ball("[wall w]\nkind = plane\npoint = 0 0 10 mm\nnormal = 0 0 1\namplitude = 0.73 mm\n"
             "direction = 0 0 2\nfrequency = 83 Hz\nphase = 0.7 rad\n",
             "position = 30 30 12.9 mm", "-9.81", "1", "0");
    const struct wall *const w = &s->walls.wall[6];
    double off = 0.0, most = 0.0;
    for (int k = 0; k < 700; k++) {
        step(s);
        const double z = 7.3e-4 * (sin(2.0 * PI * 83.0 * s->t + 0.7) - sin(0.7));
        off = fmax(off, fabs(w->pose.shift.z - z));
        most = fmax(most, fabs(walls_work(s)));
    }
    const struct ledger *const l = &s->ledger;
    check(off < 1e-15, "the floor is where its formula says: off by %.2g m", off);
    check(most > 1e-5, "it works: %g J", most);
    check(fabs(l->dissipated) < 1e-4 * most, "elastic: energy is the work, off by %.2g",
          l->dissipated / most);
    check(l->momentum_error < 1e-9, "its momentum closes: %.2g", l->momentum_error);
    sim_free(s);
}

/* A ball that rolls on a turntable: v' = 2/7 spin x v [Weltner79]. */
static void check_turntable(const char *wall, const char *name)
{
    const double turn = 23.0, radius = 0.0025;
    struct sim *const s = ball(wall, "position = 37 26 12.4990 mm", "-9.81", "0.3", "0.9");
    const vec3 x = v3_sub(s->grains.pos[0], v3(0.03, 0.03, 0.0)), v = v3(0.031, 0.047, 0.0);
    const vec3 u = v3_sub(v3(-turn * x.y, turn * x.x, 0.0), v);
    s->grains.vel[0] = v;
    s->grains.spin[0] = v3(u.y / radius, -u.x / radius, 0.0);
    ledger_start(s);
    go(s, 0.06);
    const vec3 end = s->grains.vel[0];
    const double angle = atan2(v3_cross(v, end).z, v3_dot(v, end));
    check_rel(angle, 2.0 / 7.0 * turn * 0.06, 1e-2, name);
    check_rel(v3_norm(v3(end.x, end.y, 0.0)), v3_norm(v), 1e-2, name);
    check(s->ledger.momentum_error < 1e-9, "%s: momentum closes: %.2g", name,
          s->ledger.momentum_error);
    sim_free(s);
}

static void check_turntables(void)
{
    check_turntable(
        "[wall w]\nkind = disc\npoint = 30 30 10 mm\nnormal = 0 0 1\nradius = 29 mm\n"
        "spin = 23 rad/s\nspin_axis = 0 0 1\nspin_point = 30 30 5 mm\n",
        "a ball on a turning disc");
    check_turntable("[wall w]\nkind = box\nfrom = 10 10 2 mm\nto = 50 50 10 mm\n"
                    "spin = 23 rad/s\nspin_axis = 0 0 3\nspin_point = 30 30 10 mm\n",
                    "a ball on a turning box");
    char *const mesh = floor_mesh(CUT_GRID);
    char *const wall =
        xprintf("%sspin = 23 rad/s\nspin_axis = 0 0 1\nspin_point = 30 30 0 mm\n", mesh);
    check_turntable(wall, "a ball on turning triangles");
    xfree(wall);
    floor_remove(mesh);
}

/* While the ball slips, friction is mu N along the surface of the drum. */
static void check_drum(void)
{
    struct sim *const s =
        ball("[wall w]\nkind = cylinder\npoint = 30 1 30 mm\naxis = 0 1 0\nradius = 25 mm\n"
             "length = 58 mm\nside = in\nspin = 17 rad/s\nspin_axis = 0 1 0\n"
             "spin_point = 30 0 30 mm\n",
             "position = 30 30 7.499 mm", "-9.81", "0.3", "0.4");
    const struct wall *const w = &s->walls.wall[6];
    const double m = 1.0 / s->grains.inv_mass[0];
    go(s, 0.006);
    check_rel(s->grains.vel[0].x, -0.4 * 9.81 * 0.006, 1e-2, "a drum drags a ball along");
    check_rel(s->grains.spin[0].y, 2.5 * 0.4 * 9.81 * 0.006 / 0.0025, 1e-2, "and spins it");
    check_rel(w->turn_impulse.y, m * s->grains.vel[0].x * 0.025, 1e-2, "its torque resists");
    check_rel(w->turn_impulse.x, 0.03 * w->impulse.z, 1e-2, "that of the weight, about x");
    check_rel(walls_work(s), -17.0 * w->turn_impulse.y, 1e-3, "its work is spin times torque");
    check(s->ledger.momentum_error < 1e-9, "its momentum closes: %.2g",
          s->ledger.momentum_error);
    sim_free(s);
}

/* Swings to and fro about its edge as a flap does. */
static void check_swing(void)
{
    struct sim *const s =
        ball("[wall w]\nkind = rectangle\ncorner = 10 10 10 mm\nedge1 = 40 0 0 mm\n"
             "edge2 = 0 40 0 mm\nswing = 0.2 rad\nfrequency = 13 Hz\nspin_axis = 0 1 0\n"
             "spin_point = 10 0 10 mm\n",
             "position = 30 30 52 mm", "0", "1", "0");
    const struct wall *const w = &s->walls.wall[6];
    go(s, 0.011);
    const double angle = 0.2 * sin(2.0 * PI * 13.0 * s->t);
    const vec3 x = v3(0.04, 0.03, 0.03);
    check_rel(w->pose.angle, angle, 1e-12, "a flap swings");
    /* a turn about y takes x to -z */
    check_rel(v3_norm(wall_see(s, 6, x).view.away), 0.02 * cos(angle) + 0.03 * sin(angle),
              1e-12, "the distance from it");
    sim_free(s);
}

#define COLUMN                                                                                 \
    "[domain]\nsize = 5 5 50 mm\ngravity = 0 0 0 m/s2\n" RUN_OF                                \
    "[grains a]\ndiameter = 4.99 mm\ndensity = 2385 kg/m3\nfill = lattice\nspacing = 4.99 "    \
    "mm\n"                                                                                     \
    "count = 6\nfrom = 0 0 0 mm\nto = 5 5 30 mm\n"

static void check_servo(const char *wall, double target, const char *name)
{
    char *const text = xprintf(COLUMN "%s", "0.3", "0.4", wall);
    struct sim *const s = sim_from(text);
    xfree(text);
    ledger_start(s);
    const struct wall *const w = &s->walls.wall[6];
    go(s, 0.12); /* the soft column lets the integral part come to rest in some 15 ms */
    double worst = 0.0, floor = 0.0;
    for (int k = 0; k < 60; k++) {
        step(s);
        worst = fmax(worst, fabs(-v3_dot(w->force, w->motion.direction) / target - 1.0));
        floor = fmax(floor, fabs(-s->walls.wall[4].force.z / target - 1.0));
    }
    check(worst < 0.01, "%s: within %.2g of its force", name, worst);
    check(floor < 0.01, "%s: the floor bears it within %.2g", name, floor);
    check(w->pose.shift.z < -1e-5, "%s: it moved by %g m", name, w->pose.shift.z);
    check(walls_work(s) > 0.0, "%s: it worked, %g J", name, walls_work(s));
    check(s->ledger.momentum_error < 1e-9, "%s: momentum closes: %.2g", name,
          s->ledger.momentum_error);
    sim_free(s);
}

#define LID                                                                                    \
    "[wall lid]\npoint = 0 0 31 mm\nnormal = 0 0 -1\ndirection = 0 0 -1\nspeed_max = 0.2 "     \
    "m/s\n"

static void check_servos(void)
{
    char path[] = "/tmp/silt-table-XXXXXX";
    const int fd = mkstemp(path);
    const char *const rows = "t,push\n0,0\n0.02,1.2\n0.04,0.37\n10,0.37\n";
    const bool written = fd >= 0 && write(fd, rows, strlen(rows)) == (ssize_t)strlen(rows);
    close(fd);
    check(written, "the table is written");
    check_servo(LID "push = 1.37 N\n", 1.37, "push");
    check_servo(LID "stress = 41 kPa\npush_ramp = 20 ms\n", 41e3 * 25e-6,
                "stress, with a ramp");
    check_servo(LID "stress = 41 kPa\narea = 13 mm2\n", 41e3 * 13e-6, "stress on its own area");
    char *const table = xprintf(LID "push_table = %s\n", path);
    check_servo(table, 0.37, "table");
    xfree(table);
    unlink(path);
}

/* A servo follows a ball that another wall takes away at 11 mm/s: what it bears is the target less
 * v / (gain speed_max) of it, and with the integral part the target. */
static double followed(const char *keys)
{
    char *const text =
        xprintf("[domain]\nsize = 20 20 40 mm\ngravity = 0 0 0 m/s2\n"
                "[grains a]\ndiameter = 4 mm\ndensity = 2500 kg/m3\nfill = point\n"
                "position = 10 10 20 mm\n[material a]\nyoung = 20 MPa\npoisson = 0.3\n"
                "restitution = 0.4\nfriction = 0.3\n[run]\nend = 1 s\ndt = 2 us\n"
                "[wall floor]\npoint = 0 0 18 mm\nnormal = 0 0 1\nvelocity = 0 0 -11 mm/s\n"
                "[wall lid]\npoint = 0 0 22.1 mm\nnormal = 0 0 -1\ndirection = 0 0 -1\n"
                "speed_max = 0.2 m/s\ngain = 1.7\npush = 0.83 N\n%s",
                keys);
    struct sim *const s = sim_from(text);
    for (int k = 0; k < 500; k++) /* of 100 grain steps */
        step(s);
    double sum = 0.0;
    const struct wall *lid = &s->walls.wall[s->walls.n - 1];
    for (int k = 0; k < 50; k++) {
        step(s);
        sum += lid->series.pushed / 50.0;
    }
    sim_free(s);
    xfree(text);
    return sum / 0.83;
}

static void check_following(void)
{
    check_rel(followed("integral_time = off\n"), 1.0 - 11e-3 / (1.7 * 0.2), 2e-4,
              "a proportional servo lags behind what moves away");
    check_rel(followed(""), 1.0, 2e-4, "its integral part makes up for it");
    check_rel(followed("integral_time = 4 ms\n"), 1.0, 2e-4, "at a time of one's own");
}

/* Corners that a float holds exactly. */
static void check_binary(void)
{
    const double c[18] = {0.0, 0.0, 1.5, 3.25,   0.125, 1.5, 0.0,   2.5,   1.5,
                          3.0, 3.0, 2.0, 0.0625, 2.5,   1.5, 3.375, 0.125, -1.5};
    unsigned char binary[84 + 100] = "solid though it is binary";
    char text[2000] = "solid a\n", path[] = "/tmp/silt-stl-XXXXXX",
         same[] = "/tmp/silt-stl-XXXXXX";
    binary[80] = 2;
    for (int t = 0; t < 2; t++) {
        char *const facet =
            xprintf("FACET normal 0 0 0\n outer loop\n  vertex %g %g %g\n"
                    "  vertex %g %g %e\r\n  vertex %g %g %g\n endloop\nendfacet\n",
                    c[9 * t], c[9 * t + 1], c[9 * t + 2], c[9 * t + 3], c[9 * t + 4],
                    c[9 * t + 5], c[9 * t + 6], c[9 * t + 7], c[9 * t + 8]);
        strncat(text, facet, sizeof text - strlen(text) - 1);
        xfree(facet);
        for (int k = 0; k < 9; k++) {
            const float f = (float)c[9 * t + k];
            memcpy(&binary[84 + 50 * t + 12 + 4 * k], &f, sizeof f);
        }
    }
    strncat(text, "endsolid\n", sizeof text - strlen(text) - 1);
    const int a = mkstemp(path), b = mkstemp(same);
    const bool written = write(a, binary, sizeof binary) == (ssize_t)sizeof binary &&
                         write(b, text, strlen(text)) == (ssize_t)strlen(text);
    close(a);
    close(b);
    int n = 0, m = 0;
    char *why = NULL, *whyn = NULL;
    vec3 *const one = mesh_read_stl(path, &n, &why), *const two =
                                                         mesh_read_stl(same, &m, &whyn);
    check(written && one && two && n == 2 && m == 2,
          "binary and ASCII STL: %d and %d triangles: %s", n, m,
          why    ? why
          : whyn ? whyn
                 : "read");
    check(one && two && memcmp(one, two, 6 * sizeof *one) == 0 && one[3].z == 2.0 &&
              one[5].z == -1.5,
          "with the same corners");
    xfree(one);
    xfree(two);
    xfree(why);
    xfree(whyn);
    unlink(path);
    unlink(same);
}

#define CROWD                                                                                  \
    "[domain]\nsize = 60 60 60 mm\ny = periodic\ngravity = 20 0 -400 m/s2\n" RUN_OF            \
    "[grains a]\ndiameter = 5 mm\ndensity = 2385 kg/m3\nfill = random\ncount = 600\n"          \
    "from = 12 0 12 mm\nto = 57 60 48 mm\n"                                                    \
    "[wall lid]\npoint = 0 0 50 mm\nnormal = 0 0 -1\ndirection = 0 0 -1\nspeed_max = 0.5 "     \
    "m/s\n"                                                                                    \
    "stress = 3 kPa\n"                                                                         \
    "[wall paddle]\nkind = rectangle\ncorner = 5 10 5 mm\nedge1 = 0 0 50 mm\nedge2 = 0 40 0 "  \
    "mm\n"                                                                                     \
    "velocity = 0.3 0 0 m/s\nspin = 3 rad/s\nspin_axis = 0 0 1\nspin_point = 5 30 5 mm\n"      \
    "%samplitude = 0.4 mm\nfrequency = 60 Hz\ndirection = 1 0 1\n"

static void check_threads(void)
{
    const int threads[] = {1, 2, 3, 7, 16};
    char *const mesh = floor_mesh(CUT_GRID);
    char *const text = xprintf(CROWD, "0.3", "0.4", mesh);
    unsigned long bits = 0, walls = 0;
    for (int k = 0; k < 5; k++) {
        omp_set_num_threads(threads[k]);
        struct sim *const s = sim_from(text);
        ledger_start(s);
        for (int n = 0; n < 60; n++)
            step(s);
        unsigned long h = 14695981039346656037ul;
        for (int w = 0; w < s->walls.n; w++) {
            const double v[] = {s->walls.wall[w].state.travel, s->walls.wall[w].state.work,
                                s->walls.wall[w].impulse.z, s->walls.wall[w].turn_impulse.x};
            for (size_t b = 0; b < sizeof v; b++)
                h = (h ^ ((const unsigned char *)v)[b]) * 1099511628211ul;
        }
        if (k == 0) {
            bits = sim_bits(s);
            walls = h;
            check(s->neighbours.touching > 100, "%ld contacts", s->neighbours.touching);
            check(s->walls.wall[s->walls.n - 1].impulse.x != 0.0, "the mesh is hit");
            check(s->ledger.momentum_error < 1e-9, "all walls: momentum closes: %.2g",
                  s->ledger.momentum_error);
            check(s->ledger.dissipated_least > -1e-6 * s->ledger.kinetic,
                  "no contact makes energy: %g J", s->ledger.dissipated_least);
        }
        check(sim_bits(s) == bits && h == walls, "the same bits on 1 and %d threads",
              threads[k]);
        sim_free(s);
    }
    xfree(text);
    floor_remove(mesh);
}

int main(void)
{
    omp_set_num_threads(1);
    check_translation();
    check_pushing();
    check_vibration();
    check_turntables();
    check_drum();
    check_swing();
    check_servos();
    check_following();
    check_binary();
    check_threads();
    return check_end();
}
