/* rotation.c - orientations, principal axes, and the free top.
 *
 * The free top is stepped by the midpoint rule on the group of rotations [SimoWong91] [Krysl05]: with
 * M the angular momentum in the body's frame,
 *   M1 - M0 = dt Mm x (I^-1 Mm),   Mm = (M0 + M1)/2,
 * and the body turns by the Cayley map of dt I^-1 Mm, which in quaternions is (1, dt I^-1 Mm/2) made
 * a unit one. As the same map takes M0 to M1, the angular momentum in the laboratory stays exactly;
 * as M is moved at right angles to I^-1 Mm, so does the energy (a quadratic form at its midpoint).
 * Time-reversible, second order. It takes the place of the explicit Euler steps of [LiLiuJi23,
 * eqs 24-27], whose energy and norm grow. */
#include "rotation.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_math.h>

#define PI 3.14159265358979323846

struct quat quat_random(const double u[3])
{
    const double a = sqrt(1.0 - u[0]), b = sqrt(u[0]);
    const double s = 2.0 * PI * u[1], t = 2.0 * PI * u[2];
    return quat_unit((struct quat){b * cos(t), a * sin(s), a * cos(s), b * sin(t)});
}

/* From the largest component, so that nothing small is divided by [Shepperd78]. */
struct quat quat_of_matrix(const struct mat3 *m)
{
    const vec3 *const r = m->row;
    const double four[4] = {1.0 + r[0].x + r[1].y + r[2].z, 1.0 + r[0].x - r[1].y - r[2].z,
                            1.0 - r[0].x + r[1].y - r[2].z, 1.0 - r[0].x - r[1].y + r[2].z};
    int k = 0;
    for (int a = 1; a < 4; a++)
        k = four[a] > four[k] ? a : k;
    const double d = 0.5 * sqrt(four[k]), c = 0.25 / d;
    const double wx = c * (r[2].y - r[1].z), wy = c * (r[0].z - r[2].x),
                 wz = c * (r[1].x - r[0].y);
    const double xy = c * (r[0].y + r[1].x), yz = c * (r[1].z + r[2].y),
                 zx = c * (r[2].x + r[0].z);
    const struct quat all[4] = {
        {d, wx, wy, wz}, {wx, d, xy, zx}, {wy, xy, d, yz}, {wz, zx, yz, d}};
    return quat_unit(all[k]);
}

vec3 rotation_principal(const double t[6], struct quat *axes)
{
    double a[9] = {t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2]};
    double value[3], column[9];
    gsl_matrix_view m = gsl_matrix_view_array(a, 3, 3), v = gsl_matrix_view_array(column, 3, 3);
    gsl_vector_view e = gsl_vector_view_array(value, 3);
    gsl_eigen_symmv_workspace *const w = gsl_eigen_symmv_alloc(3);
    gsl_eigen_symmv(&m.matrix, &e.vector, &v.matrix, w);
    gsl_eigen_symmv_free(w);
    gsl_eigen_symmv_sort(&e.vector, &v.matrix, GSL_EIGEN_SORT_VAL_DESC);
    struct mat3 r = {{{column[0], column[1], column[2]},
                      {column[3], column[4], column[5]},
                      {column[6], column[7], column[8]}}};
    const struct mat3 c = mat3_transposed(&r);
    if (v3_dot(v3_cross(c.row[0], c.row[1]), c.row[2]) < 0.0) { /* make it right-handed */
        r.row[0].z = -r.row[0].z;
        r.row[1].z = -r.row[1].z;
        r.row[2].z = -r.row[2].z;
    }
    *axes = quat_of_matrix(&r);
    return v3(value[0], value[1], value[2]);
}

struct rotated rotation_free(struct quat q, vec3 l, vec3 inertia, double dt)
{
    enum { MOST = 100 };
    const struct mat3 m = quat_matrix(q);
    const vec3 start = mat3_back(&m, l);
    const double enough = 1e-32 * v3_dot(start, start);
    vec3 middle = start, w = start;
    for (int k = 0; k < MOST; k++) {
        w = v3(middle.x / inertia.x, middle.y / inertia.y, middle.z / inertia.z);
        const vec3 next = v3_axpy(start, 0.5 * dt, v3_cross(middle, w)),
                   change = v3_sub(next, middle);
        middle = next;
        if (!(v3_dot(change, change) > enough))
            break;
    }
    const double h = 0.5 * dt;
    return (struct rotated){
        .q = quat_unit(quat_mul(q, (struct quat){1.0, h * w.x, h * w.y, h * w.z})),
        .spin = mat3_turn(&m, w)};
}
