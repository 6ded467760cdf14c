/* shapes/geometry/moments.c - volume, centre and inertia of polyhedra and of dilated ones, exactly.
 *
 * The points within r of a convex polyhedron are the polyhedron, a prism of height r on each face,
 * a sector of a cylinder of radius r along each edge, and at each vertex the cone of a sphere over
 * the spherical polygon of the normals of its faces [Steiner1840]. The moments of each are closed
 * forms. Over a spherical polygon of area A whose arcs have outward normals m (unit, in the plane of
 * the sphere's tangent, constant on a great circle) and lengths t,
 *     int n dA   = -1/2 sum t m,
 *     int n n dA = 1/3 (A I - sum m int n ds),
 * by the divergence theorem on the sphere [Arvo95]. */
#include "polyhedron.h"

#define PI 3.14159265358979323846

/* Adds weight * x x, symmetric in a and b: (a b + b a)/2. */
static void add_second(struct moments *m, double weight, vec3 a, vec3 b)
{
    m->xx += weight * a.x * b.x;
    m->yy += weight * a.y * b.y;
    m->zz += weight * a.z * b.z;
    m->xy += 0.5 * weight * (a.x * b.y + a.y * b.x);
    m->xz += 0.5 * weight * (a.x * b.z + a.z * b.x);
    m->yz += 0.5 * weight * (a.y * b.z + a.z * b.y);
}

/* Of the tetrahedron a b c d: int x x = V/20 (sum of x x + (sum of x)(sum of x)). */
static void add_tetrahedron(struct moments *m, vec3 a, vec3 b, vec3 c, vec3 d)
{
    const double v = v3_dot(v3_sub(b, a), v3_cross(v3_sub(c, a), v3_sub(d, a))) / 6.0;
    const vec3 sum = v3_add(v3_add(a, b), v3_add(c, d)), corner[4] = {a, b, c, d};
    m->volume += v;
    m->first = v3_axpy(m->first, 0.25 * v, sum);
    add_second(m, v / 20.0, sum, sum);
    for (int k = 0; k < 4; k++)
        add_second(m, v / 20.0, corner[k], corner[k]);
}

static vec3 middle_of(const struct polyhedron *p)
{
    vec3 middle = v3(0.0, 0.0, 0.0);
    for (int v = 0; v < p->n_vertices; v++)
        middle = v3_axpy(middle, 1.0 / p->n_vertices, polyhedron_vertex(p, v));
    return middle;
}

void moments_of_core(struct moments *m, const struct polyhedron *p)
{
    const vec3 middle = middle_of(p);
    for (int f = 0; f < p->n_faces; f++) {
        const int *const loop = &p->loop[p->loop_begin[f]];
        const int n = p->loop_begin[f + 1] - p->loop_begin[f];
        for (int k = 1; k < n - 1; k++)
            add_tetrahedron(m, middle, polyhedron_vertex(p, loop[0]),
                            polyhedron_vertex(p, loop[k]), polyhedron_vertex(p, loop[k + 1]));
    }
}

static void add_slab(struct moments *m, const struct polyhedron *p, int f, double r)
{
    const int *const loop = &p->loop[p->loop_begin[f]];
    const int n = p->loop_begin[f + 1] - p->loop_begin[f];
    const vec3 up = v3_scale(r, polyhedron_normal(p, f));
    for (int k = 1; k < n - 1; k++) {
        const vec3 a = polyhedron_vertex(p, loop[0]), b = polyhedron_vertex(p, loop[k]),
                   c = polyhedron_vertex(p, loop[k + 1]);
        const vec3 d = v3_add(a, up), e = v3_add(b, up), g = v3_add(c, up);
        add_tetrahedron(m, a, b, c, g);
        add_tetrahedron(m, a, b, g, e);
        add_tetrahedron(m, a, e, g, d);
    }
}

/* Angle between the normals of two faces that meet in an edge along `along`. */
static double edge_angle(const struct polyhedron *p, int e, vec3 along)
{
    const vec3 n1 = polyhedron_normal(p, p->edge_face[e][0]);
    const vec3 n2 = polyhedron_normal(p, p->edge_face[e][1]);
    return atan2(fabs(v3_dot(v3_cross(n1, n2), along)), v3_dot(n1, n2));
}

static vec3 edge_along(const struct polyhedron *p, int e, double *length)
{
    const vec3 along =
        v3_sub(polyhedron_vertex(p, p->edge[e][1]), polyhedron_vertex(p, p->edge[e][0]));
    *length = v3_norm(along);
    return v3_scale(1.0 / *length, along);
}

/* x = from + t along + s (u cos q + w sin q), 0 < q < angle, 0 < s < r, 0 < t < length. */
static void add_sector(struct moments *m, const struct polyhedron *p, int e, double r)
{
    double length;
    const vec3 along = edge_along(p, e, &length), from = polyhedron_vertex(p, p->edge[e][0]);
    const double q = edge_angle(p, e, along);
    const vec3 u = polyhedron_normal(p, p->edge_face[e][0]);
    const vec3 n2 = polyhedron_normal(p, p->edge_face[e][1]);
    const vec3 across = v3_axpy(n2, -v3_dot(n2, u), u);
    const double width = v3_norm(across);
    if (!(width > 0.0))
        return;
    const vec3 w = v3_scale(1.0 / width, across);
    const vec3 middle = v3_axpy(from, 0.5 * length, along);
    const double area = 0.5 * q * r * r, volume = area * length;
    /* int of s (u cos + w sin) over the sector, per length */
    const vec3 arm = v3_scale(r * r * r / 3.0, v3_axpy(v3_scale(sin(q), u), 1.0 - cos(q), w));
    const double fourth = 0.25 * r * r * r * r * length;
    m->volume += volume;
    m->first = v3_add(m->first, v3_axpy(v3_scale(volume, middle), length, arm));
    add_second(m, volume, middle, middle);
    add_second(m, volume * length * length / 12.0, along, along);
    add_second(m, 2.0 * length, middle, arm);
    add_second(m, fourth * (0.5 * q + 0.25 * sin(2.0 * q)), u, u);
    add_second(m, fourth * (0.5 * q - 0.25 * sin(2.0 * q)), w, w);
    add_second(m, fourth * sin(q) * sin(q), u, w);
}

/* Solid angle of the triangle of unit vectors [VanOosteromStrackee83]. */
static double solid_angle(vec3 a, vec3 b, vec3 c)
{
    const double above = v3_dot(a, v3_cross(b, c));
    const double below = 1.0 + v3_dot(a, b) + v3_dot(b, c) + v3_dot(c, a);
    return 2.0 * atan2(above, below);
}

static double fan_area(const struct polyhedron *p, int v)
{
    const int *const fan = &p->fan[p->fan_begin[v]];
    const int n = p->fan_begin[v + 1] - p->fan_begin[v];
    double area = 0.0;
    for (int k = 1; k < n - 1; k++)
        area += solid_angle(polyhedron_normal(p, fan[0]), polyhedron_normal(p, fan[k]),
                            polyhedron_normal(p, fan[k + 1]));
    return fabs(area);
}

static void add_cone(struct moments *m, const struct polyhedron *p, int v, double r)
{
    const int *const fan = &p->fan[p->fan_begin[v]];
    const int n = p->fan_begin[v + 1] - p->fan_begin[v];
    const vec3 at = polyhedron_vertex(p, v);
    const double area = fan_area(p, v), r3 = r * r * r / 3.0, r4 = r * r * r * r / 4.0,
                 r5 = r * r * r * r * r / 5.0;
    vec3 mean = v3(0.0, 0.0, 0.0), inside = mean;
    for (int k = 0; k < n; k++)
        inside = v3_add(inside, polyhedron_normal(p, fan[k]));
    for (int k = 0; k < n; k++) {
        const vec3 a = polyhedron_normal(p, fan[k]), b = polyhedron_normal(p, fan[(k + 1) % n]);
        const vec3 turn = v3_cross(a, b);
        const double sine = v3_norm(turn), cosine = v3_dot(a, b), t = atan2(sine, cosine);
        if (!(sine > 0.0))
            continue;
        vec3 out = v3_scale(1.0 / sine, turn);
        if (v3_dot(out, inside) > 0.0)
            out = v3_scale(-1.0, out);
        const vec3 w = v3_scale(1.0 / sine, v3_axpy(b, -cosine, a));
        mean = v3_axpy(mean, -0.5 * t, out);
        add_second(m, -r5 / 3.0, out, v3_axpy(v3_scale(sine, a), 1.0 - cosine, w));
    }
    m->xx += r5 / 3.0 * area;
    m->yy += r5 / 3.0 * area;
    m->zz += r5 / 3.0 * area;
    m->volume += r3 * area;
    m->first = v3_add(m->first, v3_axpy(v3_scale(r3 * area, at), r4, mean));
    add_second(m, r3 * area, at, at);
    add_second(m, 2.0 * r4, at, mean);
}

void moments_of_dilated(struct moments *m, const struct polyhedron *p, double r)
{
    moments_of_core(m, p);
    if (!(r > 0.0))
        return;
    for (int f = 0; f < p->n_faces; f++)
        add_slab(m, p, f, r);
    for (int e = 0; e < p->n_edges; e++)
        add_sector(m, p, e, r);
    for (int v = 0; v < p->n_vertices; v++)
        add_cone(m, p, v, r);
}

static double face_area(const struct polyhedron *p, int f)
{
    const int *const loop = &p->loop[p->loop_begin[f]];
    const int n = p->loop_begin[f + 1] - p->loop_begin[f];
    vec3 sum = v3(0.0, 0.0, 0.0);
    for (int k = 1; k < n - 1; k++) {
        const vec3 a = polyhedron_vertex(p, loop[0]);
        sum = v3_add(sum, v3_cross(v3_sub(polyhedron_vertex(p, loop[k]), a),
                                   v3_sub(polyhedron_vertex(p, loop[k + 1]), a)));
    }
    return 0.5 * v3_norm(sum);
}

static double core_surface(const struct polyhedron *p)
{
    double surface = 0.0;
    for (int f = 0; f < p->n_faces; f++)
        surface += face_area(p, f);
    return surface;
}

/* Half the sum of length times angle: the integral of the mean curvature. */
static double mean_curvature(const struct polyhedron *p)
{
    double sum = 0.0;
    for (int e = 0; e < p->n_edges; e++) {
        double length;
        const vec3 along = edge_along(p, e, &length);
        sum += 0.5 * length * edge_angle(p, e, along);
    }
    return sum;
}

double polyhedron_surface(const struct polyhedron *p, double r)
{
    return core_surface(p) + 2.0 * mean_curvature(p) * r + 4.0 * PI * r * r;
}

double polyhedron_steiner(const struct polyhedron *p, double r)
{
    struct moments core = {0.0};
    moments_of_core(&core, p);
    return core.volume + core_surface(p) * r + mean_curvature(p) * r * r +
           4.0 / 3.0 * PI * r * r * r;
}

void moments_add_ball(struct moments *m, vec3 centre, double r)
{
    const double v = 4.0 / 3.0 * PI * r * r * r, own = 0.2 * v * r * r;
    m->volume += v;
    m->first = v3_axpy(m->first, v, centre);
    add_second(m, v, centre, centre);
    m->xx += own;
    m->yy += own;
    m->zz += own;
}

void moments_add_brick(struct moments *m, double density, vec3 middle, vec3 sides)
{
    const double v = density * sides.x * sides.y * sides.z;
    m->volume += v;
    m->first = v3_axpy(m->first, v, middle);
    add_second(m, v, middle, middle);
    m->xx += v * sides.x * sides.x / 12.0;
    m->yy += v * sides.y * sides.y / 12.0;
    m->zz += v * sides.z * sides.z / 12.0;
}

/* One rotation that makes a[p][q] zero; the rows of `axes` turn along. */
static void rotate(double a[3][3], double axes[3][3], int p, int q)
{
    if (a[p][q] == 0.0)
        return;
    const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    const double t = copysign(1.0, theta) / (fabs(theta) + sqrt(theta * theta + 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    for (int k = 0; k < 3; k++) {
        const double x = a[k][p], y = a[k][q];
        a[k][p] = c * x - s * y;
        a[k][q] = s * x + c * y;
    }
    for (int k = 0; k < 3; k++) {
        const double x = a[p][k], y = a[q][k], u = axes[p][k], v = axes[q][k];
        a[p][k] = c * x - s * y;
        a[q][k] = s * x + c * y;
        axes[p][k] = c * u - s * v;
        axes[q][k] = s * u + c * v;
    }
}

void moments_principal(const struct moments *m, vec3 *centre, double inertia[3], vec3 axes[3])
{
    const vec3 c = v3_scale(1.0 / m->volume, m->first);
    const double v = m->volume, xx = m->xx - v * c.x * c.x, yy = m->yy - v * c.y * c.y,
                 zz = m->zz - v * c.z * c.z;
    double a[3][3] = {{yy + zz, v * c.x * c.y - m->xy, v * c.x * c.z - m->xz},
                      {v * c.x * c.y - m->xy, xx + zz, v * c.y * c.z - m->yz},
                      {v * c.x * c.z - m->xz, v * c.y * c.z - m->yz, xx + yy}};
    double e[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const double small = 1e-14 * (a[0][0] + a[1][1] + a[2][2]);
    for (int sweep = 0; sweep < 30; sweep++) {
        if (fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]) <= small)
            break; /* what is round-off does not turn a body that is already in its axes */
        rotate(a, e, 0, 1);
        rotate(a, e, 0, 2);
        rotate(a, e, 1, 2);
    }
    *centre = c;
    int order[3] = {0, 1, 2};
    for (int k = 0; k < 2; k++)
        for (int l = 0; l < 2 - k; l++)
            if (a[order[l]][order[l]] > a[order[l + 1]][order[l + 1]] + small) {
                const int swap = order[l];
                order[l] = order[l + 1];
                order[l + 1] = swap;
            }
    for (int k = 0; k < 3; k++) {
        const double *const row = e[order[k]];
        inertia[k] = a[order[k]][order[k]];
        axes[k] = v3(row[0], row[1], row[2]);
    }
    if (v3_dot(v3_cross(axes[0], axes[1]), axes[2]) < 0.0)
        axes[2] = v3_scale(-1.0, axes[2]);
}
