/* verify/mass_error.c - what the background grid costs in accuracy: volume, centre and inertia of
 * grains of several dilated polyhedra against exact ones, for spacings of the grid
 * (grains.mass_spacing).
 *
 * Cube, tetrahedron, dodecahedron: each is cut by two planes into halves that overlap, which
 * together are the whole again, dilated as well: volume by Steiner's formula V + S r + M r^2 + 4/3
 * pi r^3 [Steiner1840], centre and moments in closed form (shapes/geometry/moments.c). The letter
 * T, concave: cut across by a plane of constant x it is a T of two rectangles dilated by s =
 * sqrt(r^2 - d^2), where d is how far outside of the core the plane is. Its width is known at every
 * height; integrals over height and x are by Gauss's rule, of pieces in which the width is smooth.
 * The volume so found is checked against
 *     V = 30 A(r) + 2 A r + P pi r^2 / 2 + (6 pi / 4 - 2) 4/3 r^3,  A(s) = A + P s + (6 pi / 4 - 2) s^2,
 * with area A and girth P of a T that has six corners which stand out, of pi / 4 each, and two
 * which do not.
 *
 * mass_error FOLDER writes FOLDER/NAME.dat, a line a spacing: spacing over the volume-equivalent
 * diameter; errors of volume (relative), centre (of a diameter), inertia (the worst of three,
 * relative). */
/* slots: shapes/multi_dilated_polyhedron */
#include <gsl/gsl_fit.h>
#include <gsl/gsl_integration.h>
#include <stdlib.h>
#include "../shapes/geometry/dilated.h"
#include "../shapes/geometry/polyhedron.h"

#define PI 3.14159265358979323846

enum { CUBE = 0, TETRAHEDRON = 1, DODECAHEDRON = 4, LETTER_T = 14 }; /* places in FORMS_ALL */
enum { SPACINGS = 9, NODES = 24, COLUMNS = 3 };

static const double dilation = 0.15; /* of the radius */

struct exact {
    double volume, centre; /* how far that of the body is from its origin */
    double inertia[3];     /* over the mass, ascending */
};

static gsl_integration_glfixed_table *gauss;

/* Corners of that side of the plane x = at: of points, edges that it cuts. */
static int cut(const struct polyhedron *p, double at, double side, vec3 *out)
{
    int n = 0;
    for (int v = 0; v < p->n_vertices; v++)
        if (side * (p->x[v] - at) >= 0.0)
            out[n++] = polyhedron_vertex(p, v);
    for (int e = 0; e < p->n_edges; e++) {
        const vec3 a = polyhedron_vertex(p, p->edge[e][0]),
                   b = polyhedron_vertex(p, p->edge[e][1]);
        if ((a.x - at) * (b.x - at) < 0.0)
            out[n++] = v3_axpy(a, (at - a.x) / (b.x - a.x), v3_sub(b, a));
    }
    return n;
}

static void halves(struct solid *two, int form)
{
    struct solid one = {0};
    char *why = NULL;
    vec3 corner[128];
    solid_named(&one, form, 3);
    struct polyhedron *const p = polyhedron_hull(one.point[0], one.count[0], &why);
    solid_add(two, corner, cut(p, -0.23 * p->radius, 1.0, corner));
    solid_add(two, corner, cut(p, 0.17 * p->radius, -1.0, corner));
    polyhedron_free(p);
    solid_free(&one);
}

static void finish(struct exact *e, const struct moments *m)
{
    vec3 centre, axes[3];
    moments_principal(m, &centre, e->inertia, axes);
    e->volume = m->volume;
    e->centre = v3_norm(centre);
    for (int k = 0; k < 3; k++)
        e->inertia[k] /= m->volume;
}

static void exact_of_hull(struct exact *e, const struct dilated *d)
{
    vec3 corner[256];
    int n = 0;
    char *why = NULL;
    struct moments m = {0};
    for (int k = 0; k < d->n_parts; k++)
        for (int v = 0; v < d->part[k].core->n_vertices; v++)
            corner[n++] = polyhedron_vertex(d->part[k].core, v);
    struct polyhedron *const whole = polyhedron_hull(corner, n, &why);
    moments_of_dilated(&m, whole, d->r);
    finish(e, &m);
    polyhedron_free(whole);
}

/* Half the width in y of a rectangle |y| <= y, z0 <= z <= z1 dilated by s; less than 0: none. */
static double half_width(double y, double z0, double z1, double s, double z)
{
    const double out = fmax(0.0, fmax(z0 - z, z - z1));
    return out >= s ? -1.0 : y + sqrt(s * s - out * out);
}

/* Adds what one plane x with weight `by` has between two heights; fold: of a quarter of a circle, which
 * t = sin(q) makes smooth, towards z1 (1) or z0 (-1). */
static void add_heights(struct moments *m, double l, double x, double s, double by, double z0,
                        double z1, int fold)
{
    for (size_t k = 0; k < NODES; k++) {
        double q, weight;
        gsl_integration_glfixed_point(0.0, fold ? 0.5 * PI : 1.0, k, &q, &weight, gauss);
        const double t = fold ? sin(q) : q, up = fold < 0 ? 1.0 - t : t;
        const double z = z0 + (z1 - z0) * up;
        weight *= by * (z1 - z0) * (fold ? cos(q) : 1.0);
        const double w = fmax(half_width(15.0 * l, -90.0 * l, 90.0 * l, s, z),
                              half_width(50.0 * l, 60.0 * l, 90.0 * l, s, z));
        m->volume += weight * 2.0 * w;
        m->first.z += weight * 2.0 * w * z;
        m->xx += weight * 2.0 * w * x * x;
        m->yy += weight * 2.0 / 3.0 * w * w * w;
        m->zz += weight * 2.0 * w * z * z;
    }
}

static void add_plane(struct moments *m, double l, double x, double s, double by)
{
    add_heights(m, l, x, s, by, -90.0 * l - s, -90.0 * l, -1);
    add_heights(m, l, x, s, by, -90.0 * l, 60.0 * l - s, 0);
    add_heights(m, l, x, s, by, 60.0 * l - s, 60.0 * l, -1);
    add_heights(m, l, x, s, by, 60.0 * l, 90.0 * l, 0);
    add_heights(m, l, x, s, by, 90.0 * l, 90.0 * l + s, 1);
}

/* The stem is 180 l high and 30 l thick; its middle is the origin. */
static void moments_of_t(struct moments *m, double l, double r)
{
    *m = (struct moments){0};
    for (size_t k = 0; k < NODES; k++) {
        double x, q, weight;
        gsl_integration_glfixed_point(0.0, 15.0 * l, k, &x, &weight, gauss);
        add_plane(m, l, x, r, 2.0 * weight);
        gsl_integration_glfixed_point(0.0, 0.5 * PI, k, &q, &weight, gauss);
        add_plane(m, l, 15.0 * l + r * sin(q), r * cos(q), 2.0 * weight * r * cos(q));
    }
    const double a = (30.0 * 180.0 + 70.0 * 30.0) * l * l, p = 560.0 * l, c = 1.5 * PI - 2.0;
    const double v = 30.0 * l * (a + p * r + c * r * r) + 2.0 * a * r + 0.5 * PI * p * r * r +
                     4.0 / 3.0 * c * r * r * r;
    if (!(fabs(m->volume / v - 1.0) < 1e-11)) {
        printf("FAIL the T's volume by Gauss's rule %.12g, in closed form %.12g\n", m->volume,
               v);
        exit(1);
    }
}

static void exact_of_t(struct exact *e, const struct dilated *d)
{
    const vec3 stem = d->part[0].middle, between = v3_sub(d->part[1].middle, stem);
    const double apart = v3_norm(between), l = apart / 75.0;
    struct moments m;
    moments_of_t(&m, l, d->r);
    finish(e, &m);
    const double own =
        -v3_dot(stem, between) / apart; /* of the grid, above the stem's middle */
    e->centre = fabs(m.first.z / m.volume - own);
}

static void errors(const struct solid *s, bool letter, double spacing, double out[COLUMNS])
{
    char *why = NULL;
    struct exact e;
    struct dilated *const d = dilated_create(s, dilation, 2.0 * spacing, &why);
    if (!d) {
        printf("FAIL %s\n", why);
        exit(1);
    }
    if (letter)
        exact_of_t(&e, d);
    else
        exact_of_hull(&e, d);
    const double own[3] = {d->inertia.x, d->inertia.y, d->inertia.z};
    out[0] = fabs(e.volume / (4.0 / 3.0 * PI) - 1.0);
    out[1] = 0.5 * e.centre;
    out[2] = 0.0;
    for (int k = 0; k < 3; k++)
        out[2] = fmax(out[2], fabs(own[k] / e.inertia[k] - 1.0));
    dilated_free(d);
}

/* Least squares through the logarithms. */
static double order(const double *h, double (*error)[COLUMNS], int column)
{
    double x[SPACINGS], y[SPACINGS], c0, c1, v00, v01, v11, sum;
    for (int k = 0; k < SPACINGS; k++) {
        x[k] = log(h[k]);
        y[k] = log(fmax(error[k][column], 1e-12));
    }
    gsl_fit_linear(x, 1, y, 1, SPACINGS, &c0, &c1, &v00, &v01, &v11, &sum);
    return c1;
}

static void table(const char *folder, const char *name, int form)
{
    struct solid s = {0};
    double h[SPACINGS], error[SPACINGS][COLUMNS];
    if (form == LETTER_T)
        solid_named(&s, form, 3);
    else
        halves(&s, form);
    char *const path = xprintf("%s/%s.dat", folder, name);
    FILE *const f = fopen(path, "w");
    if (!f)
        exit(4);
    for (int k = 0; k < SPACINGS; k++) {
        h[k] = 0.06 * pow(5.0, -k / (SPACINGS - 1.0));
        errors(&s, form == LETTER_T, h[k], error[k]);
        fprintf(f, "%.6g %.6g %.6g %.6g\n", h[k], error[k][0], error[k][1], error[k][2]);
    }
    fclose(f);
    printf("%s %.2f %.2f %.2f\n", name, order(h, error, 0), order(h, error, 1),
           order(h, error, 2));
    xfree(path);
    solid_free(&s);
}

int main(int n, char **argument)
{
    if (n != 2) {
        fprintf(stderr, "usage: mass_error FOLDER\n");
        return 2;
    }
    gauss = gsl_integration_glfixed_table_alloc(NODES);
    table(argument[1], "cube", CUBE);
    table(argument[1], "tetrahedron", TETRAHEDRON);
    table(argument[1], "dodecahedron", DODECAHEDRON);
    table(argument[1], "T", LETTER_T);
    gsl_integration_glfixed_table_free(gauss);
    return 0;
}
