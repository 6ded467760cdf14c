/* shadow.c - shadows by painting triangles on a plane, see shadow.h.
 *
 * A direction and its opposite have the same shadow, so the table spans the half sphere z >= 0:
 * rows of z, columns of the angle; bilinear between. */
#include "shadow.h"

#include <string.h>
#include "base.h"

enum { ROWS = 11, COLUMNS = 40, PIXELS = 128 };

struct shadow {
    double area[ROWS][COLUMNS];
};

struct canvas {
    double pixel, radius;
    unsigned char painted[PIXELS][PIXELS];
};

static void paint(struct canvas *c, double p[3][2])
{
    double lo[2], hi[2];
    int from[2], to[2];
    for (int a = 0; a < 2; a++) {
        lo[a] = fmin(p[0][a], fmin(p[1][a], p[2][a])) + c->radius;
        hi[a] = fmax(p[0][a], fmax(p[1][a], p[2][a])) + c->radius;
        from[a] = (int)fmax(0.0, ceil(lo[a] / c->pixel - 0.5));
        to[a] = (int)fmin(PIXELS - 1.0, floor(hi[a] / c->pixel - 0.5));
    }
    for (int k = from[1]; k <= to[1]; k++)
        for (int i = from[0]; i <= to[0]; i++) {
            const double x = (i + 0.5) * c->pixel - c->radius,
                         y = (k + 0.5) * c->pixel - c->radius;
            int left = 0, right = 0;
            for (int e = 0; e < 3; e++) {
                const double *const a = p[e], *const b = p[(e + 1) % 3];
                const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
                left += side >= 0.0;
                right += side <= 0.0;
            }
            if (left == 3 || right == 3)
                c->painted[k][i] = 1;
        }
}

/* Triangles to be painted. */
struct scene_of {
    const vec3 *corner;
    int n;
    struct canvas *canvas;
};

static double painted(const void *data, vec3 way)
{
    const struct scene_of *const all = data;
    struct canvas *const c = all->canvas;
    const vec3 u = fabs(way.z) < 0.7 ? v3(-way.y, way.x, 0.0) : v3(0.0, -way.z, way.y);
    const vec3 e = v3_scale(1.0 / v3_norm(u), u), f = v3_cross(way, e);
    int count = 0;
    memset(c->painted, 0, sizeof c->painted);
    for (int t = 0; t < all->n; t++) {
        double p[3][2];
        for (int k = 0; k < 3; k++) {
            p[k][0] = v3_dot(e, all->corner[3 * t + k]);
            p[k][1] = v3_dot(f, all->corner[3 * t + k]);
        }
        paint(c, p);
    }
    for (int k = 0; k < PIXELS; k++)
        for (int i = 0; i < PIXELS; i++)
            count += c->painted[k][i];
    return count * c->pixel * c->pixel;
}

struct shadow *shadow_of(double (*area)(const void *data, vec3 way), const void *data)
{
    struct shadow *const s = xalloc(1, sizeof *s);
    for (int r = 0; r < ROWS; r++)
        for (int k = 0; k < COLUMNS; k++) {
            const double z = r / (ROWS - 1.0), out = sqrt(1.0 - z * z);
            const double angle = 2.0 * 3.14159265358979323846 * k / COLUMNS;
            s->area[r][k] = area(data, v3(out * cos(angle), out * sin(angle), z));
        }
    return s;
}

struct shadow *shadow_create(const vec3 *corner, int n, double radius)
{
    struct canvas *const c = xalloc(1, sizeof *c);
    c->radius = radius;
    c->pixel = 2.0 * radius / PIXELS;
    struct shadow *const s =
        shadow_of(painted, &(struct scene_of){.corner = corner, .n = n, .canvas = c});
    xfree(c);
    return s;
}

void shadow_free(struct shadow *s)
{
    xfree(s);
}

double shadow_area(const struct shadow *s, vec3 way)
{
    const double sign = way.z < 0.0 ? -1.0 : 1.0;
    const double row = fmin(1.0, sign * way.z) * (ROWS - 1);
    double column =
        atan2(sign * way.y, sign * way.x) / (2.0 * 3.14159265358979323846) * COLUMNS;
    column += column < 0.0 ? COLUMNS : 0.0;
    const int r = (int)row < ROWS - 1 ? (int)row : ROWS - 2, k = (int)column % COLUMNS;
    const double u = row - r, w = column - floor(column);
    const double *const lo = s->area[r], *const hi = s->area[r + 1];
    const int next = (k + 1) % COLUMNS;
    return (1.0 - u) * ((1.0 - w) * lo[k] + w * lo[next]) +
           u * ((1.0 - w) * hi[k] + w * hi[next]);
}
