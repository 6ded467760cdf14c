/* volume_parts.c - a body cut into parts, see volume_parts.h.
 *
 * Bricks of a lattice, as many as fit the body's box, count whole if 27 points of them are inside, and
 * not at all if none is. The others are cut again into small ones of a quarter their edge, and of each
 * the part inside is taken from the depth at its centre and its gradient, as of a half space. The
 * volumes are then scaled, and the places moved, so that volume and centre are those given. */
#include "volume_parts.h"

#include "../shapes/shape.h"
#include "base.h"

enum { FINE = 4 };

struct cutting {
    volume_depth *depth;
    const void *body;
    vec3 edge; /* of a brick */
    int n, room;
    struct shape_part *part;
};

/* Part of a small brick inside, 0 to 1: the depth over the thickness of the brick along its
 * gradient. */
static double inside_part(const struct cutting *c, vec3 x, vec3 edge)
{
    const vec3 e = v3_scale(0.25, edge);
    const double at = c->depth(c->body, x);
    const double dx =
        c->depth(c->body, v3(x.x + e.x, x.y, x.z)) - c->depth(c->body, v3(x.x - e.x, x.y, x.z));
    const double dy =
        c->depth(c->body, v3(x.x, x.y + e.y, x.z)) - c->depth(c->body, v3(x.x, x.y - e.y, x.z));
    const double dz =
        c->depth(c->body, v3(x.x, x.y, x.z + e.z)) - c->depth(c->body, v3(x.x, x.y, x.z - e.z));
    const double thick = 2.0 * (fabs(dx) + fabs(dy) + fabs(dz)); /* of the depth */
    if (thick <= 0.0)
        return at > 0.0 ? 1.0 : 0.0;
    return fmax(0.0, fmin(1.0, 0.5 + at / thick));
}

static void add(struct cutting *c, vec3 at, double volume)
{
    if (c->n == c->room) {
        const int room = 2 * c->room + 64;
        c->part = xrealloc(c->part, (size_t)c->room, (size_t)room, sizeof *c->part);
        c->room = room;
    }
    c->part[c->n++] = (struct shape_part){.at = at, .volume = volume};
}

/* The centre of brick i j k of a row of n, of that edge, whose middle is `middle`. */
static vec3 brick(vec3 middle, vec3 edge, const int index[3], const int n[3])
{
    return v3(middle.x + edge.x * (index[0] - 0.5 * (n[0] - 1)),
              middle.y + edge.y * (index[1] - 0.5 * (n[1] - 1)),
              middle.z + edge.z * (index[2] - 0.5 * (n[2] - 1)));
}

/* How many of 27 points of a brick - corners, middles of edges and faces, centre - are inside. */
static int inside(const struct cutting *c, vec3 centre)
{
    const int three[3] = {3, 3, 3};
    int in = 0;
    for (int k = 0; k < 27; k++) {
        const int index[3] = {k % 3, k / 3 % 3, k / 9};
        const vec3 x = brick(centre, v3_scale(0.5 - 1e-9, c->edge), index, three);
        in += c->depth(c->body, x) > 0.0;
    }
    return in;
}

static void cut(struct cutting *c, vec3 centre)
{
    const int fine[3] = {FINE, FINE, FINE};
    const vec3 edge = v3_scale(1.0 / FINE, c->edge);
    double sum = 0.0;
    vec3 moment = v3(0.0, 0.0, 0.0);
    const int in = inside(c, centre);
    if (in == 27)
        add(c, centre, c->edge.x * c->edge.y * c->edge.z);
    if (in == 27 || in == 0)
        return;
    for (int k = 0; k < FINE * FINE * FINE; k++) {
        const int index[3] = {k % FINE, k / FINE % FINE, k / (FINE * FINE)};
        const vec3 x = brick(centre, edge, index, fine);
        const double part = inside_part(c, x, edge);
        sum += part;
        moment = v3_axpy(moment, part, x);
    }
    if (sum > 0.0)
        add(c, v3_scale(1.0 / sum, moment), sum * edge.x * edge.y * edge.z);
}

/* Volume (0: as it is) and centre as they must be. */
static void settle(struct cutting *c, double volume, const vec3 *centre)
{
    double sum = 0.0;
    vec3 moment = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < c->n; k++) {
        sum += c->part[k].volume;
        moment = v3_axpy(moment, c->part[k].volume, c->part[k].at);
    }
    const vec3 shift = centre ? v3_axpy(*centre, -1.0 / sum, moment) : v3(0.0, 0.0, 0.0);
    for (int k = 0; k < c->n; k++) {
        c->part[k].volume *= volume > 0.0 ? volume / sum : 1.0;
        c->part[k].at = v3_add(c->part[k].at, shift);
    }
}

struct shape_part *volume_shape_parts(volume_depth *depth, const void *body, vec3 lo, vec3 hi,
                                      double spacing, double volume, const vec3 *centre, int *n)
{
    const vec3 size = v3_sub(hi, lo), middle = v3_scale(0.5, v3_add(lo, hi));
    const int number[3] = {(int)ceil(size.x / spacing), (int)ceil(size.y / spacing),
                           (int)ceil(size.z / spacing)};
    struct cutting c = {.depth = depth, .body = body};
    c.edge = v3(size.x / number[0], size.y / number[1], size.z / number[2]);
    for (int k = 0; k < number[2]; k++)
        for (int j = 0; j < number[1]; j++)
            for (int i = 0; i < number[0]; i++) {
                const int index[3] = {i, j, k};
                cut(&c, brick(middle, c.edge, index, number));
            }
    if (c.n > 0)
        settle(&c, volume, centre);
    *n = c.n;
    return c.part;
}

struct parts volume_parts(volume_depth *depth, const void *body, vec3 lo, vec3 hi,
                          double spacing, const vec3 *centre)
{
    int n;
    struct shape_part *const part =
        volume_shape_parts(depth, body, lo, hi, spacing, 0.0, centre, &n);
    const struct parts p = parts_of(part, n);
    xfree(part);
    return p;
}

struct parts parts_of(const struct shape_part *part, int n)
{
    struct parts p = {.n = n};
    const size_t room = (size_t)n + 1;
    double sum = 0.0;
    p.at = xalloc(room, sizeof *p.at);
    p.half = xalloc(room, sizeof *p.half);
    p.inv_half = xalloc(room, sizeof *p.inv_half);
    p.weight = xalloc(room, sizeof *p.weight);
    for (int k = 0; k < n; k++)
        sum += part[k].volume;
    for (int k = 0; k < n; k++) {
        p.at[k] = part[k].at;
        p.half[k] = 0.5 * cbrt(part[k].volume);
        p.inv_half[k] = 1.0 / p.half[k];
        p.weight[k] = part[k].volume / sum;
        p.reach = fmax(p.reach, v3_norm(part[k].at) + sqrt(3.0) * p.half[k]);
    }
    return p;
}

void parts_free(struct parts *p)
{
    xfree(p->at);
    xfree(p->half);
    xfree(p->inv_half);
    xfree(p->weight);
    *p = (struct parts){0};
}
