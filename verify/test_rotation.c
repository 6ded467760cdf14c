/* verify/test_rotation.c - orientations and the free top: the exact solution in Jacobi's elliptic
 * functions [LandauLifshitz76, sec. 37], what must stay, the order; principal axes. */
#include <gsl/gsl_sf_elljac.h>
#include <stdlib.h>
#include "../solver/rotation.h"
#include "check.h"

static const vec3 top = {3.0, 2.0, 1.0}; /* kg m2 */

/* Body rates at time t of a top with moments 3, 2, 1 that starts with w2 = 0 and L^2 > 2 E I2. */
static vec3 exact(vec3 w0, double t)
{
    const double i1 = top.z, i2 = top.y, i3 = top.x; /* Landau's order: I3 the largest */
    const double e2 = i1 * w0.z * w0.z + i3 * w0.x * w0.x;
    const double l2 = i1 * i1 * w0.z * w0.z + i3 * i3 * w0.x * w0.x;
    const double rate = sqrt((i3 - i2) * (l2 - e2 * i1) / (i1 * i2 * i3));
    const double k2 = (i2 - i1) * (e2 * i3 - l2) / ((i3 - i2) * (l2 - e2 * i1));
    double sn, cn, dn;
    gsl_sf_elljac_e(rate * t, k2, &sn, &cn, &dn);
    const double a1 = sqrt((e2 * i3 - l2) / (i1 * (i3 - i1)));
    const double a2 = sqrt((e2 * i3 - l2) / (i2 * (i3 - i2)));
    const double a3 = sqrt((l2 - e2 * i1) / (i3 * (i3 - i1)));
    return v3(a3 * dn, -a2 * sn, a1 * cn);
}

static vec3 body_rates(struct quat q, vec3 l)
{
    const struct mat3 m = quat_matrix(q);
    const vec3 b = mat3_back(&m, l);
    return v3(b.x / top.x, b.y / top.y, b.z / top.z);
}

/* Largest error of the body rates over time `end` in n steps. */
static double error_of(vec3 w0, double end, int n)
{
    const vec3 l = v3(top.x * w0.x, top.y * w0.y, top.z * w0.z);
    struct quat q = quat_one();
    double worst = 0.0;
    for (int k = 1; k <= n; k++) {
        q = rotation_free(q, l, top, end / n).q;
        worst = fmax(worst, v3_norm(v3_sub(body_rates(q, l), exact(w0, end * k / n))));
    }
    return worst;
}

static void test_exact(void)
{
    const vec3 w0 = {1.37, 0.0, 0.71};
    const double coarse = error_of(w0, 7.3, 730), fine = error_of(w0, 7.3, 1460);
    check(coarse < 1e-3, "body rates of the free top after 730 steps: error %.3g", coarse);
    check_rel(log2(coarse / fine), 2.0, 0.02, "order of the error of the body rates");
}

/* Orientations of case 9b of torque_free_orientation.csv, (3, 2, 1), w = (0.5773508465, 0, 1). */
static void test_orientation(void)
{
    static const struct {
        double t;
        struct quat q;
    } want[] = {{1.0, {0.84487935096, 0.28105309534, -0.12965914115, 0.43632160964}},
                {5.0, {-0.59715286430, 0.65336227032, -0.39896638512, -0.23948282595}},
                {20.0, {-0.60141217083, -0.03696564923, 0.38880549573, -0.69697003382}}};
    const vec3 l = v3(3.0 * 0.5773508465, 0.0, 1.0);
    for (size_t k = 0; k < sizeof want / sizeof want[0]; k++) {
        double error[2];
        for (int fine = 0; fine < 2; fine++) {
            const int n = (int)want[k].t * (fine ? 800 : 400);
            struct quat q = quat_one();
            for (int i = 0; i < n; i++)
                q = rotation_free(q, l, top, want[k].t / n).q;
            const struct quat w = want[k].q;
            const struct quat apart = quat_mul((struct quat){q.w, -q.x, -q.y, -q.z}, w);
            error[fine] = 2.0 * v3_norm(v3(apart.x, apart.y, apart.z));
        }
        check(error[0] < 1e-4, "orientation at t = %g, 400 steps a unit: off by %.3g rad",
              want[k].t, error[0]);
        /* later, the few digits of the start show: the separatrix is near */
        if (want[k].t < 10.0)
            check_rel(error[0] / error[1], 4.0, 0.02, "half the step: a quarter of it");
    }
}

static void test_long(void)
{
    const vec3 w0 = {0.83, 1.27, -0.59};
    const struct quat start = quat_unit((struct quat){0.31, -0.72, 0.45, 0.17});
    const struct mat3 m0 = quat_matrix(start);
    const vec3 spin = mat3_turn(&m0, w0);
    vec3 l = rotation_momentum(&m0, spin, top);
    const double energy = 0.5 * v3_dot(spin, l);
    const vec3 l0 = l;
    struct quat q = start;
    double worst_energy = 0.0, worst_l = 0.0;
    for (int k = 0; k < 100000; k++) {
        q = rotation_free(q, l, top, 0.013).q;
        const struct mat3 m = quat_matrix(q);
        const vec3 w = rotation_spin(&m, l, top);
        if (k % 100 == 99) /* as at the end of a call of the steps */
            l = rotation_momentum(&m, w, top);
        worst_energy = fmax(worst_energy, fabs(0.5 * v3_dot(w, l) / energy - 1.0));
        worst_l = fmax(worst_l, v3_norm(v3_sub(l, l0)) / v3_norm(l0));
    }
    check(worst_energy < 1e-8, "energy of the free top over 1e5 steps: drift %.3g",
          worst_energy);
    check(worst_l < 1e-8, "its angular momentum: drift %.3g", worst_l);
    check_abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-14,
              "its quaternion's norm");
    /* there and back again */
    for (int k = 0; k < 1000; k++)
        q = rotation_free(q, l, top, 0.013).q;
    struct quat back = q;
    for (int k = 0; k < 1000; k++)
        back = rotation_free(back, l, top, -0.013).q;
    for (int k = 0; k < 1000; k++)
        back = rotation_free(back, l, top, 0.013).q;
    check_abs(fabs(back.w * q.w + back.x * q.x + back.y * q.y + back.z * q.z), 1.0, 1e-11,
              "a thousand steps back and forth: the same orientation");
}

/* The steady spin of a step turns the body as far as the step did. */
static void test_steady(void)
{
    const vec3 l = {0.43, -1.31, 0.87};
    const struct quat q = quat_unit((struct quat){0.5, 0.23, -0.61, 0.4});
    const double dt = 0.011;
    const struct rotated r = rotation_free(q, l, top, dt);
    const double w = v3_norm(r.spin);
    const struct quat turned =
        quat_mul(quat_about(v3_scale(1.0 / w, r.spin), 2.0 * atan(0.5 * dt * w)), q);
    check_abs(fabs(turned.w * r.q.w + turned.x * r.q.x + turned.y * r.q.y + turned.z * r.q.z),
              1.0, 1e-15, "the steady spin of a step turns as far");
}

static void test_principal(void)
{
    const struct quat q = quat_unit((struct quat){-0.2, 0.53, 0.71, 0.39});
    const struct mat3 m = quat_matrix(q), t = mat3_transposed(&m);
    const vec3 j = {5.3, 2.9, 1.7};
    double a[3][3];
    for (int x = 0; x < 3; x++) {
        const double e[3] = {x == 0, x == 1, x == 2};
        const vec3 b = mat3_turn(&t, v3(e[0], e[1], e[2]));
        const vec3 c = mat3_turn(&m, v3(j.x * b.x, j.y * b.y, j.z * b.z));
        a[x][0] = c.x;
        a[x][1] = c.y;
        a[x][2] = c.z;
    }
    const double tensor[6] = {a[0][0], a[1][1], a[2][2], a[0][1], a[1][2], a[2][0]};
    struct quat axes;
    const vec3 found = rotation_principal(tensor, &axes);
    check_abs(v3_norm(v3_sub(found, j)), 0.0, 1e-13, "principal moments of a turned body");
    const struct mat3 f = quat_matrix(axes);
    double worst = 0.0;
    for (int x = 0; x < 3; x++) {
        const vec3 e = v3(x == 0, x == 1, x == 2), c = mat3_turn(&f, e);
        const double value[3] = {j.x, j.y, j.z};
        const vec3 image = v3(a[0][0] * c.x + a[0][1] * c.y + a[0][2] * c.z,
                              a[1][0] * c.x + a[1][1] * c.y + a[1][2] * c.z,
                              a[2][0] * c.x + a[2][1] * c.y + a[2][2] * c.z);
        worst = fmax(worst, v3_norm(v3_axpy(image, -value[x], c)));
    }
    check_abs(worst, 0.0, 1e-13, "the axes are its eigenvectors");
}

static void test_random(void)
{
    enum { N = 20000 };
    double mean[3] = {0.0}, square[3] = {0.0};
    srand(4711);
    for (int k = 0; k < N; k++) {
        const double u[3] = {rand() / (RAND_MAX + 1.0), rand() / (RAND_MAX + 1.0),
                             rand() / (RAND_MAX + 1.0)};
        const struct mat3 m = quat_matrix(quat_random(u));
        const double z[3] = {m.row[0].z, m.row[1].x, m.row[2].z};
        for (int a = 0; a < 3; a++) {
            mean[a] += z[a] / N;
            square[a] += z[a] * z[a] / N;
        }
    }
    for (int a = 0; a < 3; a++) {
        check_abs(mean[a], 0.0, 0.02, "random orientations: mean component of an axis");
        check_rel(square[a], 1.0 / 3.0, 0.03, "and its mean square");
    }
}

int main(void)
{
    test_exact();
    test_orientation();
    test_long();
    test_steady();
    test_principal();
    test_random();
    return check_end();
}
