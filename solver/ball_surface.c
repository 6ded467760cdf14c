/* ball_surface.c - see ball_surface.h. A ball is an octahedron whose triangles were halved along each
 * edge and put onto the sphere. */
#include "ball_surface.h"

#define PI 3.14159265358979323846

enum { HALVINGS = 3, PROBES = 4 };

static bool inside(const struct ball *b, int n, int own, vec3 x)
{
    for (int k = 0; k < n; k++) {
        const vec3 d = v3_sub(x, b[k].centre);
        if (k != own && v3_dot(d, d) < b[k].r * b[k].r)
            return true;
    }
    return false;
}

static vec3 unit(vec3 x)
{
    return v3_scale(1.0 / v3_norm(x), x);
}

struct cover {
    const struct ball *b;
    int n, own;
    struct shape_canvas *canvas;
};

static void split(const struct cover *c, vec3 p, vec3 q, vec3 r, int halvings)
{
    const struct ball *const own = &c->b[c->own];
    if (halvings > 0) {
        const vec3 a = unit(v3_add(p, q)), b = unit(v3_add(q, r)), d = unit(v3_add(r, p));
        split(c, p, a, d, halvings - 1);
        split(c, a, q, b, halvings - 1);
        split(c, d, b, r, halvings - 1);
        split(c, a, b, d, halvings - 1);
        return;
    }
    const vec3 x = v3_axpy(own->centre, own->r, p), y = v3_axpy(own->centre, own->r, q),
               z = v3_axpy(own->centre, own->r, r);
    if (inside(c->b, c->n, c->own, x) && inside(c->b, c->n, c->own, y) &&
        inside(c->b, c->n, c->own, z))
        return;
    c->canvas->triangle(c->canvas, x, y, z);
}

void ball_surface(const struct ball *b, int n, struct shape_canvas *canvas)
{
    for (int own = 0; own < n; own++) {
        const struct cover c = {b, n, own, canvas};
        for (int octant = 0; octant < 8; octant++) {
            const vec3 x = {octant & 1 ? -1.0 : 1.0, 0.0, 0.0},
                       y = {0.0, octant & 2 ? -1.0 : 1.0, 0.0},
                       z = {0.0, 0.0, octant & 4 ? -1.0 : 1.0};
            const bool odd = (octant & 1) ^ ((octant >> 1) & 1) ^ ((octant >> 2) & 1);
            split(&c, x, odd ? z : y, odd ? y : z, HALVINGS);
        }
    }
}

/* Part of a cube's volume that is in the union, by probes; *at: their mean. */
static double filled(const struct ball *b, int n, vec3 low, double edge, vec3 *at)
{
    int hits = 0;
    vec3 sum = {0.0, 0.0, 0.0};
    for (int k = 0; k < PROBES * PROBES * PROBES; k++) {
        const double h = edge / PROBES;
        const vec3 x =
            v3(low.x + h * (k % PROBES + 0.5), low.y + h * (k / PROBES % PROBES + 0.5),
               low.z + h * (k / (PROBES * PROBES) + 0.5));
        if (!inside(b, n, -1, x))
            continue;
        hits++;
        sum = v3_add(sum, x);
    }
    if (hits > 0)
        *at = v3_scale(1.0 / hits, sum);
    return (double)hits / (PROBES * PROBES * PROBES);
}

struct shape_part *ball_parts(const struct ball *b, int n, double spacing, int *count)
{
    double reach = 0.0, sum = 0.0;
    struct shape_part *part = NULL;
    int room = 0;
    *count = 0;
    for (int k = 0; k < n; k++)
        reach = fmax(reach, v3_norm(b[k].centre) + b[k].r);
    const int cells = (int)ceil(2.0 * reach / spacing);
    for (int k = 0; k < cells * cells * cells; k++) {
        const vec3 low =
            v3(-reach + spacing * (k % cells), -reach + spacing * (k / cells % cells),
               -reach + spacing * (k / (cells * cells)));
        struct shape_part one;
        one.volume = filled(b, n, low, spacing, &one.at);
        if (one.volume == 0.0)
            continue;
        if (*count == room) {
            const int more = 2 * room + 256;
            part = xrealloc(part, (size_t)room, (size_t)more, sizeof *part);
            room = more;
        }
        sum += one.volume;
        part[(*count)++] = one;
    }
    for (int k = 0; k < *count; k++)
        part[k].volume *= 4.0 / 3.0 * PI / sum;
    return part;
}
