/* insert_region.c - boxes, spheres, cylinders and discs in which grains come and go. */
#include "insert.h"

#include "sim.h"

#define PI 3.14159265358979323846

bool insert_region_holds(const struct sim *s, const struct insert_region *r, vec3 x)
{
    if (r->shape == REGION_BOX)
        return x.x >= r->from.x && x.x <= r->to.x && x.y >= r->from.y && x.y <= r->to.y &&
               x.z >= r->from.z && x.z <= r->to.z;
    if (r->shape == REGION_PLANE) /* what is behind it */
        return v3_dot(v3_sub(x, r->centre), r->axis) < 0.0;
    const vec3 d = domain_minimum_image(&s->domain, v3_sub(x, r->centre));
    if (r->shape == REGION_SPHERE)
        return v3_dot(d, d) <= r->radius * r->radius;
    const double along = v3_dot(d, r->axis);
    const vec3 off = v3_axpy(d, -along, r->axis);
    return fabs(along) <= 0.5 * r->length && v3_dot(off, off) <= r->radius * r->radius;
}

double insert_region_volume(const struct insert_region *r)
{
    const vec3 edge = v3_sub(r->to, r->from);
    switch (r->shape) {
    case REGION_BOX:
        return edge.x * edge.y * edge.z;
    case REGION_SPHERE:
        return 4.0 / 3.0 * PI * r->radius * r->radius * r->radius;
    default:
        return PI * r->radius * r->radius * r->length;
    }
}

double insert_region_room(const struct insert_region *r)
{
    const vec3 edge = v3_sub(r->to, r->from);
    switch (r->shape) {
    case REGION_BOX:
        return 0.5 * fmin(edge.x, fmin(edge.y, edge.z));
    case REGION_CYLINDER:
        return fmin(r->radius, 0.5 * r->length);
    default:
        return r->radius;
    }
}

vec3 insert_region_point(const struct insert_region *r, double radius, const double u[3])
{
    const vec3 edge = v3_sub(r->to, r->from);
    const double room = r->radius - radius, turn = 2.0 * PI * u[0];
    if (r->shape == REGION_BOX)
        return v3(r->from.x + radius + (edge.x - 2.0 * radius) * u[0],
                  r->from.y + radius + (edge.y - 2.0 * radius) * u[1],
                  r->from.z + radius + (edge.z - 2.0 * radius) * u[2]);
    if (r->shape == REGION_SPHERE) {
        const double distance = room * cbrt(u[1]), z = 2.0 * u[2] - 1.0;
        const double flat = sqrt(1.0 - z * z);
        return v3_axpy(r->centre, distance, v3(flat * cos(turn), flat * sin(turn), z));
    }
    const double out = room * sqrt(u[1]);
    const double along =
        r->shape == REGION_DISC ? 0.0 : (r->length - 2.0 * radius) * (u[2] - 0.5);
    vec3 x = v3_axpy(r->centre, along, r->axis);
    x = v3_axpy(x, out * cos(turn), r->across[0]);
    return v3_axpy(x, out * sin(turn), r->across[1]);
}

void insert_region_bounds(const struct insert_region *r, vec3 *lo, vec3 *hi)
{
    const double half = r->shape == REGION_SPHERE ? r->radius : 0.5 * r->length;
    const double n[3] = {r->axis.x, r->axis.y, r->axis.z};
    double reach[3];
    if (r->shape == REGION_BOX) {
        *lo = r->from;
        *hi = r->to;
        return;
    }
    for (int a = 0; a < 3; a++)
        reach[a] = r->shape == REGION_SPHERE
                       ? half
                       : half * fabs(n[a]) + r->radius * sqrt(fmax(0.0, 1.0 - n[a] * n[a]));
    *lo = v3_sub(r->centre, v3(reach[0], reach[1], reach[2]));
    *hi = v3_add(r->centre, v3(reach[0], reach[1], reach[2]));
}

static void set_axis(struct insert_region *r, vec3 axis)
{
    const vec3 aside =
        fabs(axis.z) < 0.9 * v3_norm(axis) ? v3(0.0, 0.0, 1.0) : v3(1.0, 0.0, 0.0);
    r->axis = v3_scale(1.0 / v3_norm(axis), axis);
    const vec3 across = v3_cross(aside, r->axis);
    r->across[0] = v3_scale(1.0 / v3_norm(across), across);
    r->across[1] = v3_cross(r->axis, r->across[0]);
}

static void read_box(struct sim *s, struct scene *scene, const char *section, const char *name,
                     struct insert_region *r)
{
    const double *const size = s->domain.size;
    if (!scene_word(scene, section, name, "from", "box"))
        r->from = scene_vector(scene, section, name, "from");
    r->to = v3(size[0], size[1], size[2]);
    if (!scene_word(scene, section, name, "to", "box"))
        r->to = scene_vector(scene, section, name, "to");
    if (!(r->from.x < r->to.x && r->from.y < r->to.y && r->from.z < r->to.z))
        scene_error(scene, section, name,
                    scene_given(scene, section, name, "to") ? "to" : "from",
                    "the region must reach from below to");
}

static double needed(struct scene *scene, const char *section, const char *name,
                     const char *key)
{
    if (!scene_word(scene, section, name, key, "none"))
        return scene_real(scene, section, name, key);
    scene_error(scene, section, name, key, "must be given for this shape");
    return 1.0;
}

void insert_region_read(struct sim *s, struct scene *scene, const char *section,
                        const char *name, struct insert_region *r)
{
    const double *const size = s->domain.size;
    *r = (struct insert_region){
        .shape = (enum region_shape)scene_choice(scene, section, name, "shape")};
    set_axis(r, v3(0.0, 0.0, 1.0));
    if (r->shape == REGION_BOX) {
        read_box(s, scene, section, name, r);
        return;
    }
    r->centre = v3(0.5 * size[0], 0.5 * size[1], 0.5 * size[2]);
    if (!scene_word(scene, section, name, "centre", "middle"))
        r->centre = scene_vector(scene, section, name, "centre");
    if (r->shape != REGION_PLANE)
        r->radius = needed(scene, section, name, "radius");
    if (r->shape == REGION_CYLINDER)
        r->length = needed(scene, section, name, "length");
    if (r->shape == REGION_SPHERE)
        return;
    const vec3 axis = scene_vector(scene, section, name, "axis");
    if (v3_norm(axis) > 0.0)
        set_axis(r, axis);
    else
        scene_error(scene, section, name, "axis", "must not be zero");
}
