/* verify/test_clump.c - clumps of spheres: mass properties of unions, energy and momentum of clumps
 * that tumble, action and reaction, frames. */
/* slots: shapes/clump contact/hertz_mindlin */
#include "../shapes/shape.h"
#include "../solver/disc_union.h"
#include "check.h"
#include "harness.h"

#define PI 3.14159265358979323846

/* Case 9e of clumps.csv: two equal spheres at a distance, in a turned frame. */
static void test_lens(void)
{
    static const double want[][4] = {{0.5, 5.726861608, 2.428802914, 3.131877442},
                                     {1.0, 7.068583471, 3.004147975, 5.21308031},
                                     {1.5, 8.017606251, 3.297240571, 8.032639263}};
    const vec3 axis = v3_scale(1.0 / sqrt(14.0), v3(1.0, 2.0, 3.0)), at = {0.3, -1.7, 2.9};
    for (size_t k = 0; k < sizeof want / sizeof want[0]; k++) {
        const struct ball pair[2] = {{v3_axpy(at, 0.37, axis), 1.0},
                                     {v3_axpy(at, 0.37 + want[k][0], axis), 1.0}};
        const struct ball_union u = ball_union(pair, 2);
        struct quat q;
        const vec3 j = rotation_principal(u.inertia, &q);
        check_rel(u.volume, want[k][1], 1e-9, "two spheres: volume of the union");
        check_rel(j.z, want[k][2], 1e-9, "inertia about the line of centres");
        check_rel(j.x, want[k][3], 1e-9, "across it");
        check_rel(j.y, want[k][3], 1e-9, "across it, the other way");
        check_rel(u.area, 2.0 * (4.0 * PI - 2.0 * PI * (1.0 - 0.5 * want[k][0])), 1e-9,
                  "area of its surface");
    }
}

/* Any union is the same body in any frame; a ball inside another changes nothing. */
static void test_frames(void)
{
    const struct ball b[6] = {{{0.1, 0.2, -0.3}, 0.81}, {{0.9, 0.1, 0.2}, 0.63},
                              {{-0.4, 0.8, 0.5}, 0.72}, {{0.2, -0.5, 0.7}, 0.55},
                              {{0.6, 0.6, 0.9}, 0.47},  {{0.15, 0.2, -0.3}, 0.2}};
    const struct quat turn = quat_unit((struct quat){0.4, -0.7, 0.2, 0.5});
    const struct mat3 m = quat_matrix(turn);
    struct ball c[6];
    struct quat axes[2];
    for (int k = 0; k < 6; k++)
        c[k] = (struct ball){v3_add(v3(3.1, -2.7, 0.4), mat3_turn(&m, b[k].centre)), b[k].r};
    const struct ball_union one = ball_union(b, 6), other = ball_union(c, 6),
                            without = ball_union(b, 5);
    const vec3 j = rotation_principal(one.inertia, &axes[0]);
    const vec3 i = rotation_principal(other.inertia, &axes[1]);
    check_rel(other.volume, one.volume, 1e-10, "six balls in another frame: volume");
    check_rel(other.area, one.area, 1e-10, "area");
    check_abs(v3_norm(v3_sub(i, j)) / j.x, 0.0, 1e-10, "principal moments");
    check_abs(
        v3_norm(v3_sub(other.centre, v3_add(v3(3.1, -2.7, 0.4), mat3_turn(&m, one.centre)))),
        0.0, 1e-10, "centre");
    check_rel(without.volume, one.volume, 1e-12, "a ball inside another adds nothing");
}

static const char tumble[] =
    "[domain]\nsize = 60 60 60 mm\ngravity = 0 0 0 m/s2\nx = periodic\ny = periodic\nz = "
    "periodic\n"
    "[grains a]\ndiameter = 6.3 mm\ndensity = 2385 kg/m3\nfill = random\ncount = 40\n"
    "clump = tetrapod\nmaterial = m\nvelocity = 0.7 0.2 -0.4 m/s\nspin = 17 -29 41 rad/s\n"
    "[grains b]\ndiameter = 5.1 mm\ndensity = 1713 kg/m3\nfill = random\ncount = 40\n"
    "spheres = -1 0 0 1, 0 0.2 0 1.1, 1 0 0.1 0.8\nmaterial = m\n"
    "velocity = -0.6 0.1 0.5 m/s\nspin = -31 13 7 rad/s\n"
    "[material m]\nyoung = 300 MPa\npoisson = 0.3\nrestitution = 1\nfriction = 0\n"
    "[run]\nend = 1 s\nsubsteps = 50\n";

static vec3 momentum(const struct sim *s)
{
    vec3 p = {0.0, 0.0, 0.0};
    for (int i = 0; i < s->grains.n; i++)
        p = v3_axpy(p, s->grains.mass[i], s->grains.vel[i]);
    return p;
}

/* Clumps that collide without loss keep energy and momentum. */
static void test_tumbling(void)
{
    struct sim *const s = sim_from(tumble);
    ledger_start(s);
    const struct ledger *const l = &s->ledger;
    const double start = l->kinetic + l->elastic;
    const vec3 p = momentum(s);
    double worst = 0.0;
    long touched = 0;
    for (int k = 0; k < 60; k++) {
        step(s);
        touched += s->neighbours.touching;
        worst = fmax(worst, fabs((l->kinetic + l->elastic) / start - 1.0));
    }
    const double scale = sqrt(2.0 * start * l->mass);
    check(touched > 10, "the clumps collide: %ld contacts seen", touched);
    check(worst < 1e-3, "energy of clumps that collide without loss: off by %.3g", worst);
    check_abs(v3_norm(v3_sub(momentum(s), p)) / scale, 0.0, 1e-12, "their momentum stays");
    double norm = 0.0;
    for (int i = 0; i < s->grains.n; i++) {
        const struct quat q = s->grains.orientation[i];
        norm = fmax(norm, fabs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0));
    }
    check_abs(norm, 0.0, 1e-14, "their quaternions are unit ones");
    sim_free(s);
}

static struct shape_pose pose(const struct sim *s, int kind, double size, vec3 x, struct quat q)
{
    (void)s;
    return (struct shape_pose){
        .species = kind, .size = size, .centre = x, .q = q, .turn = quat_matrix(q)};
}

/* Force and torque on i by unit stiffness at each point, and the same on j. */
static void load(const struct shape_point *p, int n, vec3 *force, vec3 *torque_i,
                 vec3 *torque_j)
{
    *force = *torque_i = *torque_j = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < n; k++) {
        const vec3 f = v3_scale(p[k].depth, p[k].normal);
        *force = v3_add(*force, f);
        *torque_i = v3_add(*torque_i, v3_cross(p[k].at_i, f));
        *torque_j = v3_add(*torque_j, v3_cross(p[k].at_j, v3_scale(-1.0, f)));
    }
}

/* The contract: i against j is j against i; the same in any frame; at_i and at_j are one place. */
static void test_contract(void)
{
    enum { MOST = 64 };
    struct sim *const s = sim_from(tumble);
    struct shape_point p[MOST], r[MOST];
    real memory[64] = {0.0};
    double worst = 0.0, frame = 0.0, place = 0.0;
    int found = 0;
    for (int k = 0; k < 2000; k++) {
        double u[12];
        for (int a = 0; a < 12; a++)
            u[a] = fmod(0.5 + (k * 12 + a + 1) * 0.6180339887498949 + 0.137 * a * k, 1.0);
        const struct quat qi = quat_random(u), qj = quat_random(u + 3),
                          turn = quat_random(u + 6);
        const vec3 d =
            v3(3e-3 * (2.0 * u[9] - 1.0) + 3e-3, 6e-3 * (u[10] - 0.5), 6e-3 * (u[11] - 0.5));
        const struct mat3 m = quat_matrix(turn);
        struct shape_pair pair = {.memory = memory};
        pair.i = pose(s, 0, 3.1e-3, v3(0.0, 0.0, 0.0), qi);
        pair.j = pose(s, 1, 2.5e-3, v3_scale(-1.0, d), qj);
        const int n = shape.points(&pair, MOST, p);
        pair.i = pose(s, 1, 2.5e-3, v3(0.0, 0.0, 0.0), qj);
        pair.j = pose(s, 0, 3.1e-3, d, qi);
        const int swapped = shape.points(&pair, MOST, r);
        vec3 f, ti, tj, g, hi, hj;
        load(p, n, &f, &ti, &tj);
        load(r, swapped, &g, &hi, &hj);
        worst = fmax(worst, v3_norm(v3_add(f, g)) + 1e3 * v3_norm(v3_sub(ti, hj)) +
                                1e3 * v3_norm(v3_sub(tj, hi)));
        pair.i = pose(s, 0, 3.1e-3, v3(0.0, 0.0, 0.0), quat_mul(turn, qi));
        pair.j = pose(s, 1, 2.5e-3, v3_scale(-1.0, mat3_turn(&m, d)), quat_mul(turn, qj));
        load(r, shape.points(&pair, MOST, r), &g, &hi, &hj);
        frame = fmax(frame, v3_norm(v3_sub(g, mat3_turn(&m, f))) +
                                1e3 * v3_norm(v3_sub(hi, mat3_turn(&m, ti))));
        for (int a = 0; a < n; a++)
            place = fmax(place, v3_norm(v3_sub(v3_sub(p[a].at_j, p[a].at_i), d)));
        found += n;
    }
    check(found > 1000, "points of contact found: %d", found);
    check_abs(worst, 0.0, 1e-15,
              "i against j is j against i: force (unit stiffness) and torques");
    check_abs(frame, 0.0, 1e-15, "the same in a turned frame");
    check_abs(place, 0.0, 1e-16, "both bodies see the point in one place");
    sim_free(s);
}

int main(void)
{
    test_lens();
    test_frames();
    test_contract();
    test_tumbling();
    return check_end();
}
