/* rotation.h - quaternions and rotation matrices of three dimensions.
 *
 * A quaternion (w; x, y, z) of unit length turns the body's frame into the laboratory's: v_lab =
 * q v_body q*. Rates in the body's frame change it by dq/dt = q (0, w_body)/2 [Evans77]. */
#ifndef ROTATION_H
#define ROTATION_H

#include "vec3.h"

struct quat {
    double w, x, y, z;
};

struct mat3 {
    vec3 row
        [3]; /* a matrix that takes body to lab has the lab's components of the body's axes in
                    its columns */
};

static inline struct quat quat_one(void)
{
    return (struct quat){1.0, 0.0, 0.0, 0.0};
}

static inline struct quat quat_mul(struct quat a, struct quat b)
{
    return (struct quat){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                         a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                         a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                         a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

static inline struct quat quat_unit(struct quat q)
{
    const double s = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (struct quat){s * q.w, s * q.x, s * q.y, s * q.z};
}

/* By `angle` about a unit vector. */
static inline struct quat quat_about(vec3 axis, double angle)
{
    const double s = sin(0.5 * angle);
    return (struct quat){cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z};
}

static inline struct mat3 quat_matrix(struct quat q)
{
    const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    const double xy = q.x * q.y, yz = q.y * q.z, zx = q.z * q.x;
    const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return (struct mat3){{{1.0 - 2.0 * (yy + zz), 2.0 * (xy - wz), 2.0 * (zx + wy)},
                          {2.0 * (xy + wz), 1.0 - 2.0 * (zz + xx), 2.0 * (yz - wx)},
                          {2.0 * (zx - wy), 2.0 * (yz + wx), 1.0 - 2.0 * (xx + yy)}}};
}

/* m v: body to lab. */
static inline vec3 mat3_turn(const struct mat3 *m, vec3 v)
{
    return v3(v3_dot(m->row[0], v), v3_dot(m->row[1], v), v3_dot(m->row[2], v));
}

/* m^T v: lab to body. */
static inline vec3 mat3_back(const struct mat3 *m, vec3 v)
{
    const vec3 *const r = m->row;
    return v3(r[0].x * v.x + r[1].x * v.y + r[2].x * v.z,
              r[0].y * v.x + r[1].y * v.y + r[2].y * v.z,
              r[0].z * v.x + r[1].z * v.y + r[2].z * v.z);
}

static inline struct mat3 mat3_transposed(const struct mat3 *m)
{
    const vec3 *const r = m->row;
    return (struct mat3){
        {{r[0].x, r[1].x, r[2].x}, {r[0].y, r[1].y, r[2].y}, {r[0].z, r[1].z, r[2].z}}};
}

/* a^T b: takes the body's frame of b to that of a. */
static inline struct mat3 mat3_between(const struct mat3 *a, const struct mat3 *b)
{
    const struct mat3 t = mat3_transposed(a);
    struct mat3 m;
    for (int k = 0; k < 3; k++)
        m.row[k] = v3_axpy(v3_axpy(v3_scale(t.row[k].x, b->row[0]), t.row[k].y, b->row[1]),
                           t.row[k].z, b->row[2]);
    return m;
}

/* Uniformly over all orientations, from three numbers in [0, 1) [Shoemake92]. */
struct quat quat_random(const double u[3]);
/* Of the rotation that takes the axes to the columns of m (right-handed, unit). */
struct quat quat_of_matrix(const struct mat3 *m);

/* Diagonalises a symmetric tensor (xx yy zz xy yz zx): principal values, and the rotation that takes
 * the principal axes to the frame at hand. */
vec3 rotation_principal(const double tensor[6], struct quat *axes);

struct rotated {
    struct quat q;
    vec3 spin; /* rad/s, in the laboratory: the steady one that would have turned it as far */
};

/* A free body turns for a time dt: orientation q, angular momentum l [kg m2/s] in the laboratory
 * (which stays), principal inertia. Right where |spin| dt < 1 or so. See rotation.c. */
struct rotated rotation_free(struct quat q, vec3 l, vec3 inertia, double dt);

/* rad/s, in the laboratory, of a body with that angular momentum; and back. */
static inline vec3 rotation_spin(const struct mat3 *m, vec3 l, vec3 inertia)
{
    const vec3 b = mat3_back(m, l);
    return mat3_turn(m, v3(b.x / inertia.x, b.y / inertia.y, b.z / inertia.z));
}

static inline vec3 rotation_momentum(const struct mat3 *m, vec3 spin, vec3 inertia)
{
    const vec3 b = mat3_back(m, spin);
    return mat3_turn(m, v3(b.x * inertia.x, b.y * inertia.y, b.z * inertia.z));
}

#endif
