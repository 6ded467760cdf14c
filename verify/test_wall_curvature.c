/* test_wall_curvature.c - what a contact feels of a wall's curvature: Hertz's exact force in tubes, on
 * rods and in cones, that of a plane at edges; and walls that turn across a periodic side. */
/* slots: contact/hertz_mindlin */
#include <gsl/gsl_sf_ellint.h>
#include "stl_floor.h"

enum { FIRST = 6 }; /* wall after the sides */

#define RADIUS 0.0025
#define YOUNG  2e7
#define E_STAR (0.5 * YOUNG / (1.0 - 0.3 * 0.3)) /* of equal bodies */
#define BALL                                                                                   \
    "[run]\nend = 1 s\nsubsteps = 1\ndt = %g us\noverlap_max = 0.3\n[material a]\n"            \
    "young = 2e7 Pa\npoisson = 0.3\nrestitution = 1\nfriction = %g\n[grains a]\n"              \
    "diameter = 5 mm\ndensity = 2385 kg/m3\nfill = point\nposition = %.17g %.17g %.17g mm\n"
#define STILL "[domain]\nsize = 60 60 60 mm\ngravity = 0 0 0 m/s2\n"

/* N, by the wall on a ball at rest. */
static vec3 force(const char *wall, vec3 x)
{
    char *const text =
        xprintf(STILL "%s" BALL, wall, 0.1, 0.0, 1e3 * x.x, 1e3 * x.y, 1e3 * x.z);
    struct sim *const s = sim_from(text);
    ledger_start(s);
    step(s);
    const vec3 f = v3_scale(1e7 / s->grains.inv_mass[0], s->grains.vel[0]); /* over 0.1 us */
    check(s->walls.n >= FIRST, "%d walls", s->walls.n);
    sim_free(s);
    xfree(text);
    return f;
}

/* Hertz's force at a depth for principal relative curvatures a >= b, 1/m [Johnson85, eqs. 4.26 to
 * 4.32]: the ellipse of contact by bisection on its eccentricity. */
static double hertz(double a, double b, double depth)
{
    double low = 1e-6, high = 1.0 - 1e-12;
    double e = 0.0, k = 0.5 * PI, f1 = 1.0, slim = 1.0;
    for (int i = 0; i < 200 && a > b * (1.0 + 1e-9); i++) {
        e = 0.5 * (low + high);
        k = gsl_sf_ellint_Kcomp(e, GSL_PREC_DOUBLE);
        const double l = gsl_sf_ellint_Ecomp(e, GSL_PREC_DOUBLE), u = 1.0 - e * e;
        slim = sqrt(u);
        f1 = cbrt(4.0 / (PI * e * e) * pow(u, 0.75) * sqrt((l / u - k) * (k - l)));
        if ((l / u - k) / (k - l) < a / b)
            low = e;
        else
            high = e;
    }
    const double f2 = 2.0 / PI * sqrt(slim) * k / f1;
    return 4.0 / 3.0 * E_STAR * pow(a * b, -0.25) * pow(depth / f2, 1.5);
}

static void expect(const char *wall, vec3 x, double curvature, double depth, double exact,
                   const char *name)
{
    const double f = v3_norm(force(wall, x)), r = 1.0 / RADIUS;
    const double law = 4.0 / 3.0 * E_STAR * pow(r * (r + curvature), -0.25) * pow(depth, 1.5);
    /* over the first step the ball moves by less than 1e-6 of its depth */
    check_rel(f, law, 1e-6, name);
    check_rel(f, hertz(fmax(r, r + curvature), fmin(r, r + curvature), depth), exact, name);
}

static void check_tubes(void)
{
    const double way = 0.73, depth = 4.1e-5;
    const double radii[] = {0.004, 0.0071, 0.025};
    const double hollow[] = {0.03, 0.006, 3e-4}, bulge[] = {0.008, 0.003, 4e-4};
    for (int k = 0; k < 3; k++) {
        const double r = radii[k];
        char *const wall = xprintf(
            "[wall w]\nkind = cylinder\npoint = 30 30 5 mm\naxis = 0 0 1\nradius = %g mm\n"
            "length = 50 mm\n",
            1e3 * r);
        const double in = r - RADIUS + depth, out = r + RADIUS - depth;
        expect(wall, v3(0.03 + in * cos(way), 0.03 + in * sin(way), 0.0273), -1.0 / r, depth,
               hollow[k], "in a tube");
        expect(wall, v3(0.03 + out * cos(way), 0.03 + out * sin(way), 0.0273), 1.0 / r, depth,
               bulge[k], "on a rod");
        char *const endless = xprintf("[wall w]\nkind = cylinder\npoint = 30 30 5 mm\n"
                                      "axis = 0 0 1\nradius = %g mm\n",
                                      1e3 * r);
        expect(endless, v3(0.03 + in * cos(way), 0.03 + in * sin(way), 0.0273), -1.0 / r, depth,
               hollow[k], "in a tube without end");
        xfree(endless);
        xfree(wall);
    }
}

/* A cone's curvature: the cosine of its slope over the radius where it is met. */
static void check_cone(void)
{
    const double slope = atan2(12.0, 35.0), depth = 3.7e-5, h = 0.0193;
    const double radius = 0.006 + h * tan(slope), across = RADIUS - depth;
    const char *const cone = "[wall w]\nkind = cone\npoint = 30 30 8 mm\naxis = 0 0 1\n"
                             "radius = 6 mm\nradius_end = 18 mm\nlength = 35 mm\n";
    expect(cone, v3(0.03 + radius - across * cos(slope), 0.03, 0.008 + h + across * sin(slope)),
           -cos(slope) / radius, depth, 0.002, "in a cone");
    expect(cone, v3(0.03 + radius + across * cos(slope), 0.03, 0.008 + h - across * sin(slope)),
           cos(slope) / radius, depth, 0.002, "on a cone");
}

/* At an edge and at a corner the contact is that with a plane, along the line to it. */
static void expect_flat(const char *wall, vec3 point, vec3 way, const char *name)
{
    const double depth = 2.9e-5;
    const vec3 n = v3_scale(1.0 / v3_norm(way), way);
    const vec3 f = force(wall, v3_axpy(point, RADIUS - depth, n));
    check_rel(v3_dot(f, n), 4.0 / 3.0 * E_STAR * sqrt(RADIUS) * pow(depth, 1.5), 1e-6, name);
    check(v3_norm(v3_cross(f, n)) < 1e-9 * v3_norm(f), "%s: along the line to it", name);
}

static void check_edges(void)
{
    const char *const disc = "[wall w]\nkind = disc\npoint = 30 30 20 mm\nnormal = 0 0 1\n"
                             "radius = 9 mm\nhole = 4 mm\n";
    expect_flat(disc, v3(0.039, 0.03, 0.02), v3(0.61, 0.0, 0.37), "rim of a disc");
    expect_flat(disc, v3(0.034, 0.03, 0.02), v3(-0.29, 0.0, 0.83), "rim of its hole");
    const char *const plate = "[wall w]\nkind = rectangle\ncorner = 20 21 22 mm\n"
                              "edge1 = 17 0 0 mm\nedge2 = 0 14 0 mm\n";
    expect_flat(plate, v3(0.037, 0.0291, 0.022), v3(0.41, 0.0, -0.53), "edge of a plate");
    expect_flat(plate, v3(0.037, 0.035, 0.022), v3(0.41, 0.23, 0.71), "its corner");
    const vec3 a = v3(0.02, 0.021, 0.02), b = v3(0.04, 0.02, 0.02), c = v3(0.03, 0.04, 0.02);
    const vec3 top = v3(0.03, 0.027, 0.04), tip[] = {a, b, top, b, c, top, c, a, top};
    char *const mesh = stl_wall(tip, 3);
    expect_flat(mesh, top, v3(0.11, -0.07, 0.93), "tip of a mesh");
    const vec3 along = v3_sub(top, a), out = v3(-0.5, -0.4, 0.1);
    const double part = v3_dot(out, along) / v3_dot(along, along);
    expect_flat(mesh, v3_axpy(a, 0.57, along), v3_axpy(out, -part, along), "edge of a mesh");
    floor_remove(mesh);
}

/* The same wall and ball, moved along the periodic x by `shift`; where the ball is after. */
static void turn_by(const char *wall, double shift, vec3 x, int steps, vec3 end[3])
{
    char *const text =
        xprintf("[domain]\nsize = 60 60 60 mm\nx = periodic\n"
                "gravity = 0 0 0 m/s2\n%s" BALL "velocity = 0.31 -0.17 -0.53 m/s\n",
                wall, 1.0, 0.4, 1e3 * fmod(x.x + shift, 0.06), 1e3 * x.y, 1e3 * x.z);
    struct sim *const s = sim_from(text);
    ledger_start(s);
    for (int k = 0; k < steps; k++)
        step(s);
    end[0] = s->grains.pos[0];
    end[0].x = fmod(end[0].x - shift + 0.12, 0.06);
    end[1] = s->grains.vel[0];
    end[2] = v3_scale(RADIUS, s->grains.spin[0]);
    check(s->ledger.momentum_error < 1e-9, "momentum closes: %.2g", s->ledger.momentum_error);
    sim_free(s);
    xfree(text);
}

static char *paddle(const char *kind, double shift, double pivot)
{
    const double x = 1e3 * shift;
    char *const turn = xprintf(
        "spin = -61 rad/s\nspin_axis = 0.3 1 0.2\nspin_point = %.17g 27 24 mm\n", x + pivot);
    char *wall;
    if (strcmp(kind, "mesh") == 0) {
        const vec3 o = v3(0.017 + shift, 0.013, 0.024), p = v3(0.043 + shift, 0.011, 0.025);
        const vec3 q = v3(0.041 + shift, 0.047, 0.023), r = v3(0.018 + shift, 0.049, 0.026);
        const vec3 c[] = {o, p, q, o, q, r};
        char *const mesh = stl_wall(c, 2);
        wall = xprintf("%s%s", mesh, turn);
        xfree(mesh);
    } else {
        wall = xprintf("[wall floor]\nkind = cylinder\npoint = %.17g 30 24 mm\naxis = 1 0 0\n"
                       "radius = 3 mm\nlength = 26 mm\ncaps = both\n%s",
                       17.0 + x, turn);
    }
    xfree(turn);
    return wall;
}

static void check_across(const char *kind, vec3 x, double pivot, int steps)
{
    vec3 want[3], got[3];
    const double shifts[] = {0.0, 0.0291, 0.0413};
    for (int k = 0; k < 3; k++) {
        char *const wall = paddle(kind, shifts[k], pivot);
        turn_by(wall, shifts[k], x, steps, k == 0 ? want : got);
        if (strcmp(kind, "mesh") == 0)
            floor_remove(wall);
        else
            xfree(wall);
        if (k == 0) {
            const double kick = v3_norm(v3_sub(want[1], v3(0.31, -0.17, -0.53)));
            check(kick > 0.2 && v3_norm(want[2]) > 0.01, "%s hits: %g m/s, spins %g m/s", kind,
                  kick, v3_norm(want[2]));
            continue;
        }
        vec3 off = v3_sub(got[0], want[0]);
        off.x -= 0.06 * round(off.x / 0.06);
        check(v3_norm(off) < 1e-13, "%s across the side: place to %.2g m", kind, v3_norm(off));
        for (int j = 1; j < 3; j++)
            check(v3_norm(v3_sub(got[j], want[j])) < 1e-10,
                  "%s across the side: %s to %.2g m/s", kind, j == 1 ? "velocity" : "spin",
                  v3_norm(v3_sub(got[j], want[j])));
    }
}

/* A wall that turns about a point far off is more than a period away from where it began. */
static void check_far(void)
{
    char *const text =
        xprintf("[domain]\nsize = 60 60 60 mm\nx = periodic\n[wall w]\nkind = rectangle\n"
                "corner = 20 25 20 mm\nedge1 = 20 0 0 mm\nedge2 = 0 10 0 mm\nspin = 1 rad/s\n"
                "spin_axis = 0 0 1\nspin_point = %g 30 20 mm\n" BALL,
                -30.0, 1.0, 0.0, 5.0, 5.0, 50.0);
    struct sim *const s = sim_from(text);
    struct wall *const w = &s->walls.wall[s->walls.n - 1];
    const vec3 x = v3(0.0317, 0.0291, 0.0213);
    check_abs(walls_gap(s, x, 1e-4, 5e-3, NULL), 1.2e-3, 1e-14, "room over a plate");
    wall_pose_at(w, PI, 0.0); /* half a turn about a point 60 mm off: two periods */
    check_abs(walls_gap(s, x, 1e-4, 5e-3, NULL), 1.2e-3, 1e-14,
              "half a turn about a far point");
    sim_free(s);
    xfree(text);
}

int main(void)
{
    check_tubes();
    check_cone();
    check_edges();
    check_across("mesh", v3(0.0391, 0.029, 0.0323), 30.0, 16000);
    check_across("cylinder", v3(0.0391, 0.029, 0.0353), 30.0, 16000);
    check_far();
    return check_end();
}
