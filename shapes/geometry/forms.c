/* shapes/geometry/forms.c - named solids.
 *
 * Cube, tetrahedron, octahedron, icosahedron and dodecahedron are the regular ones; prism and
 * pyramid have a regular base and are as high as an equilateral one of three sides is wide; wedge
 * is half a cube. cone_pair: two cut pyramids that meet at their narrow ends, upright and upside
 * down [LiLiuJi23, fig. 5]; tetrapod: four legs from the centre to the corners of a tetrahedron;
 * dolos: a stem and two flukes at right angles [MerrifieldZwamborn66]; cross: three bars at right
 * angles; hollow_box: the twelve edges of a cube as bars. The letters are 100 wide and 180 high, of
 * strokes 30 by 30 [LiLiuJi23, fig. 10]. */
#include "forms.h"

#include <string.h>

#define PI     3.14159265358979323846
#define GOLDEN 1.61803398874989484820

void solid_add(struct solid *s, const vec3 *point, int n)
{
    const size_t parts = (size_t)s->n;
    s->count = xrealloc(s->count, parts, parts + 1, sizeof *s->count);
    s->point = xrealloc(s->point, parts, parts + 1, sizeof *s->point);
    s->point[s->n] = xalloc((size_t)n, sizeof **s->point);
    memcpy(s->point[s->n], point, (size_t)n * sizeof *point);
    s->count[s->n++] = n;
}

void solid_free(struct solid *s)
{
    for (int k = 0; k < s->n; k++)
        xfree(s->point[k]);
    xfree(s->count);
    xfree(s->point);
    *s = (struct solid){0};
}

void solid_stretch(struct solid *s, vec3 f)
{
    for (int k = 0; k < s->n; k++)
        for (int i = 0; i < s->count[k]; i++) {
            const vec3 x = s->point[k][i];
            s->point[k][i] = v3(f.x * x.x, f.y * x.y, f.z * x.z);
        }
}

static void add_brick(struct solid *s, vec3 low, vec3 high)
{
    vec3 c[8];
    for (int k = 0; k < 8; k++)
        c[k] = v3(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
    solid_add(s, c, 8);
}

static void cube(struct solid *s, int sides)
{
    (void)sides;
    add_brick(s, v3(-1.0, -1.0, -1.0), v3(1.0, 1.0, 1.0));
}

static void tetrahedron(struct solid *s, int sides)
{
    const vec3 c[4] = {
        {1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, 1.0, -1.0}, {-1.0, -1.0, 1.0}};
    (void)sides;
    solid_add(s, c, 4);
}

static void octahedron(struct solid *s, int sides)
{
    const vec3 c[6] = {{1.0, 0.0, 0.0},  {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0},
                       {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0},  {0.0, 0.0, -1.0}};
    (void)sides;
    solid_add(s, c, 6);
}

/* The points (0, +-a, +-b) and their cyclic permutations. */
static int rectangles(vec3 *c, double a, double b)
{
    int n = 0;
    for (int k = 0; k < 4; k++) {
        const double p = k & 1 ? a : -a, q = k & 2 ? b : -b;
        c[n++] = v3(0.0, p, q);
        c[n++] = v3(p, q, 0.0);
        c[n++] = v3(q, 0.0, p);
    }
    return n;
}

static void icosahedron(struct solid *s, int sides)
{
    vec3 c[12];
    (void)sides;
    solid_add(s, c, rectangles(c, 1.0, GOLDEN));
}

static void dodecahedron(struct solid *s, int sides)
{
    vec3 c[20];
    int n = rectangles(c, 1.0 / GOLDEN, GOLDEN);
    (void)sides;
    for (int k = 0; k < 8; k++)
        c[n++] = v3(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
    solid_add(s, c, n);
}

enum { SIDES_MOST = 64 };

static int ring(vec3 *c, int sides, double z)
{
    const int n = sides < SIDES_MOST ? sides : SIDES_MOST;
    for (int k = 0; k < n; k++)
        c[k] = v3(cos(2.0 * PI * k / n), sin(2.0 * PI * k / n), z);
    return n;
}

static void prism(struct solid *s, int sides)
{
    vec3 c[2 * SIDES_MOST];
    const int n = ring(c, sides, -0.5 * sqrt(3.0));
    ring(c + n, sides, 0.5 * sqrt(3.0));
    solid_add(s, c, 2 * n);
}

static void pyramid(struct solid *s, int sides)
{
    vec3 c[SIDES_MOST + 1];
    const int n = ring(c, sides, 0.0);
    c[n] = v3(0.0, 0.0, sqrt(3.0));
    solid_add(s, c, n + 1);
}

static void wedge(struct solid *s, int sides)
{
    const vec3 c[6] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0},
                       {0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 1.0}};
    (void)sides;
    solid_add(s, c, 6);
}

static void cone_pair(struct solid *s, int sides)
{
    const double neck = 0.2;
    (void)sides;
    for (int end = -1; end <= 1; end += 2) {
        vec3 c[8];
        for (int k = 0; k < 8; k++) {
            const double w = k & 4 ? 1.0 : neck, z = k & 4 ? end : -0.1 * end;
            c[k] = v3(k & 1 ? w : -w, k & 2 ? w : -w, z);
        }
        solid_add(s, c, 8);
    }
}

static void tetrapod(struct solid *s, int sides)
{
    struct solid corners = {0};
    tetrahedron(&corners, sides);
    for (int k = 0; k < 4; k++) {
        const vec3 tip = corners.point[0][k];
        vec3 c[12], e = v3_cross(tip, fabs(tip.x - tip.y) > 1.0 ? v3(0, 0, 1) : v3(1, 0, 0));
        e = v3_scale(1.0 / v3_norm(e), e);
        const vec3 f = v3_scale(1.0 / v3_norm(tip), v3_cross(tip, e));
        for (int i = 0; i < 12; i++) { /* six sides, thinner at the tip */
            const double w = i < 6 ? 0.55 : 0.38, q = PI / 3.0 * i;
            c[i] = v3_add(v3_scale(i < 6 ? -0.15 : 1.0, tip),
                          v3_axpy(v3_scale(w * cos(q), e), w * sin(q), f));
        }
        solid_add(s, c, 12);
    }
    solid_free(&corners);
}

static void dolos(struct solid *s, int sides)
{
    const double w = 0.17;
    (void)sides;
    add_brick(s, v3(-w, -w, -1.0), v3(w, w, 1.0));
    add_brick(s, v3(-1.0, -w, -1.0), v3(1.0, w, -1.0 + 2.0 * w));
    add_brick(s, v3(-w, -1.0, 1.0 - 2.0 * w), v3(w, 1.0, 1.0));
}

static void cross(struct solid *s, int sides)
{
    const double w = 0.25;
    (void)sides;
    add_brick(s, v3(-1.0, -w, -w), v3(1.0, w, w));
    add_brick(s, v3(-w, -1.0, -w), v3(w, 1.0, w));
    add_brick(s, v3(-w, -w, -1.0), v3(w, w, 1.0));
}

static void hollow_box(struct solid *s, int sides)
{
    const double t = 0.3; /* of the bars */
    (void)sides;
    for (int k = 0; k < 4; k++) {
        const double p = k & 1 ? 1.0 - t : -1.0, q = k & 2 ? 1.0 - t : -1.0;
        add_brick(s, v3(-1.0, p, q), v3(1.0, p + t, q + t));
        add_brick(s, v3(p, -1.0, q), v3(p + t, 1.0, q + t));
        add_brick(s, v3(p, q, -1.0), v3(p + t, q + t, 1.0));
    }
}

/* A straight stroke of a letter in the plane y, z; its corners may be cut to the letter's box. */
static void stroke(struct solid *s, double y0, double z0, double y1, double z1)
{
    add_brick(s, v3(-15.0, y0, z0), v3(15.0, y1, z1));
}

/* A slanted one: 30 wide in y, from height z0 to z1. */
static void slant(struct solid *s, double y0, double z0, double y1, double z1)
{
    vec3 c[8];
    for (int k = 0; k < 8; k++)
        c[k] = v3(k & 1 ? 15.0 : -15.0, (k & 4 ? y1 : y0) + (k & 2 ? 15.0 : -15.0),
                  k & 4 ? z1 : z0);
    solid_add(s, c, 8);
}

static void letter_o(struct solid *s, int sides)
{
    (void)sides;
    stroke(s, -50.0, -90.0, -20.0, 90.0);
    stroke(s, 20.0, -90.0, 50.0, 90.0);
    stroke(s, -50.0, -90.0, 50.0, -60.0);
    stroke(s, -50.0, 60.0, 50.0, 90.0);
}

static void letter_t(struct solid *s, int sides)
{
    (void)sides;
    stroke(s, -15.0, -90.0, 15.0, 90.0);
    stroke(s, -50.0, 60.0, 50.0, 90.0);
}

static void letter_z(struct solid *s, int sides)
{
    (void)sides;
    stroke(s, -50.0, -90.0, 50.0, -60.0);
    stroke(s, -50.0, 60.0, 50.0, 90.0);
    slant(s, -35.0, -75.0, 35.0, 75.0);
}

static void letter_k(struct solid *s, int sides)
{
    (void)sides;
    stroke(s, -50.0, -90.0, -20.0, 90.0);
    slant(s, -35.0, 0.0, 35.0, 90.0);
    slant(s, -35.0, 0.0, 35.0, -90.0);
}

static void letter_a(struct solid *s, int sides)
{
    (void)sides;
    slant(s, -35.0, -90.0, 0.0, 90.0);
    slant(s, 35.0, -90.0, 0.0, 90.0);
    stroke(s, -25.0, -40.0, 25.0, -10.0);
}

static void letter_c(struct solid *s, int sides)
{
    (void)sides;
    stroke(s, -50.0, -90.0, -20.0, 90.0);
    stroke(s, -50.0, -90.0, 50.0, -60.0);
    stroke(s, -50.0, 60.0, 50.0, 90.0);
}

void solid_named(struct solid *s, int which, int sides)
{
    static void (*const make[])(struct solid *, int) = {
        cube,     tetrahedron, octahedron, icosahedron, dodecahedron, prism,      pyramid,
        wedge,    cone_pair,   tetrapod,   dolos,       cross,        hollow_box, letter_o,
        letter_t, letter_z,    letter_k,   letter_a,    letter_c};
    make[which](s, sides);
}
