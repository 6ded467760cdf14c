/* picture_shapes.c - see picture_shapes.h. The eye looks along +y; light comes from above, left and
 * behind it. Where two grains meet, or one ends, there is a dark line. */
#include "picture_shapes.h"

#include <stdio.h>
#include <string.h>
#include "rotation.h"

static const double line_colour[3] = {36.0, 54.0, 77.0};

bool picture_shapes_read(const struct run_file *r, struct shapes_seen *s)
{
    size_t n = 0;
    *s = (struct shapes_seen){0};
    if (run_variable(r, "surface_corner") < 0 || run_variable(r, "orientation") < 0)
        return false;
    s->corner = run_all(r, "surface_corner", &n);
    s->species = run_all(r, "surface_species", &s->corners);
    if (s->corner && s->species && n == 3 * s->corners && n > 0)
        return true;
    picture_shapes_free(s);
    return false;
}

void picture_shapes_free(struct shapes_seen *s)
{
    xfree(s->corner);
    xfree(s->species);
    *s = (struct shapes_seen){0};
}

/* The image: nearest y so far, the grain that is seen, its brightness. */
struct canvas {
    int across, up;
    double *depth, *light;
    int *grain;
};

/* Fills a triangle in pixels; z of the corners is their depth. */
static void fill_triangle(struct canvas *c, const vec3 p[3], double light, int grain)
{
    const double area =
        (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (area == 0.0)
        return;
    const int x0 = (int)fmax(0.0, ceil(fmin(p[0].x, fmin(p[1].x, p[2].x)))),
              x1 = (int)fmin(c->across - 1.0, fmax(p[0].x, fmax(p[1].x, p[2].x))),
              y0 = (int)fmax(0.0, ceil(fmin(p[0].y, fmin(p[1].y, p[2].y)))),
              y1 = (int)fmin(c->up - 1.0, fmax(p[0].y, fmax(p[1].y, p[2].y)));
    for (int y = y0; y <= y1; y++)
        for (int x = x0; x <= x1; x++) {
            const double a = ((p[1].x - x) * (p[2].y - y) - (p[2].x - x) * (p[1].y - y)) / area;
            const double b = ((p[2].x - x) * (p[0].y - y) - (p[0].x - x) * (p[2].y - y)) / area;
            const double z = a * p[0].z + b * p[1].z + (1.0 - a - b) * p[2].z;
            const size_t k = (size_t)y * c->across + x;
            if (a < 0.0 || b < 0.0 || a + b > 1.0 || z >= c->depth[k])
                continue;
            c->depth[k] = z;
            c->light[k] = light;
            c->grain[k] = grain;
        }
}

/* Grain i with its centre at x. */
static void draw_grain(struct canvas *c, const struct shapes_seen *s,
                       const struct shapes_view *v, size_t i, double x)
{
    const vec3 sun = v3_scale(1.0 / sqrt(3.5), v3(-0.5, -1.5, 1.0));
    const double *const q = &v->turn[4 * i];
    const struct mat3 m = quat_matrix((struct quat){q[0], q[1], q[2], q[3]});
    const double sx = c->across / (v->high[0] - v->low[0]),
                 sz = c->up / (v->high[1] - v->low[1]);
    for (size_t k = 0; k + 2 < s->corners; k += 3) {
        vec3 at[3], p[3];
        if (s->species[k] != v->species[i])
            continue;
        for (int a = 0; a < 3; a++) {
            const double *const corner = &s->corner[3 * (k + a)];
            at[a] = mat3_turn(&m, v3_scale(v->radius[i], v3(corner[0], corner[1], corner[2])));
            p[a] = v3((x + at[a].x - v->low[0]) * sx - 0.5,
                      (v->pos[3 * i + 2] + at[a].z - v->low[1]) * sz - 0.5,
                      v->pos[3 * i + 1] + at[a].y);
        }
        const vec3 n = v3_cross(v3_sub(at[1], at[0]), v3_sub(at[2], at[0]));
        const double size = v3_norm(n);
        if (n.y < 0.0) /* it faces the eye */
            fill_triangle(c, p, fmax(0.0, v3_dot(n, sun) / size), (int)i);
    }
}

/* One point of the picture, out of 2 x 2 of the image; returns how many of the four show a grain. */
static int mix(const struct canvas *c, const struct shapes_view *v, int x, int y, double out[3])
{
    int hits = 0;
    out[0] = out[1] = out[2] = 0.0;
    for (int k = 0; k < 4; k++) {
        const int px = 2 * x + k % 2, py = 2 * y + k / 2;
        const size_t at = (size_t)py * c->across + px;
        const int grain = c->grain[at];
        if (grain < 0)
            continue;
        const bool edge = (px + 1 < c->across && c->grain[at + 1] != grain) ||
                          (py + 1 < c->up && c->grain[at + c->across] != grain);
        const double light = 0.45 + 0.6 * c->light[at];
        hits++;
        for (int a = 0; a < 3; a++)
            out[a] += edge ? line_colour[a] : fmin(255.0, light * v->colour[3 * grain + a]);
    }
    for (int a = 0; a < 3 && hits > 0; a++)
        out[a] /= hits;
    return hits;
}

void picture_shapes_send(FILE *to, const struct shapes_seen *s, const struct shapes_view *v)
{
    struct canvas c = {.across = 2 * v->across, .up = 2 * v->up};
    const size_t n = (size_t)c.across * c.up;
    c.depth = xalloc(n, sizeof *c.depth);
    c.light = xalloc(n, sizeof *c.light);
    c.grain = xalloc(n, sizeof *c.grain);
    for (size_t k = 0; k < n; k++) {
        c.depth[k] = (double)INFINITY;
        c.grain[k] = -1;
    }
    for (size_t i = 0; i < v->n; i++) {
        const double x = v->pos[3 * i];
        draw_grain(&c, s, v, i, v->period > 0.0 ? x - v->period * floor(x / v->period) : x);
    }
    for (int y = 0; y < v->up; y++)
        for (int x = 0; x < v->across; x++) {
            double rgb[3];
            const int hits = mix(&c, v, x, y, rgb);
            fprintf(to, "%.6g %.6g %.0f %.0f %.0f %.0f\n",
                    1e3 * (v->low[0] + (v->high[0] - v->low[0]) * (x + 0.5) / v->across),
                    1e3 * (v->low[1] + (v->high[1] - v->low[1]) * (y + 0.5) / v->up), rgb[0],
                    rgb[1], rgb[2], 63.75 * hits);
        }
    xfree(c.depth);
    xfree(c.light);
    xfree(c.grain);
}
