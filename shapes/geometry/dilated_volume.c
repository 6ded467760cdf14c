/* shapes/geometry/dilated_volume.c - what is inside of a body of dilated polyhedra; its volume in
 * small parts, for grids of a fluid. */
#include "dilated.h"

enum { SUB = 3 /* points per cell and direction */, ACROSS = 6 /* least number of cells */ };

static bool part_holds(const struct dilated_part *p, double r, vec3 x)
{
    const struct polyhedron *const c = p->core;
    const vec3 d = v3_sub(x, p->middle);
    double out = -(double)INFINITY;
    if (fabs(d.x) > p->half.x || fabs(d.y) > p->half.y || fabs(d.z) > p->half.z)
        return false;
    for (int f = 0; f < c->face_room; f++)
        out = fmax(out, c->nx[f] * x.x + c->ny[f] * x.y + c->nz[f] * x.z - c->off[f]);
    if (out <= 0.0)
        return true;
    return out <= r && polyhedron_distance(c, x) <= r;
}

bool dilated_part_holds(const struct dilated *d, int part, vec3 x)
{
    return part_holds(&d->part[part], d->r, x);
}

bool dilated_holds(const struct dilated *d, vec3 x)
{
    for (int k = 0; k < d->n_parts; k++)
        if (part_holds(&d->part[k], d->r, x))
            return true;
    return false;
}

static double part_out(const struct dilated_part *p, double r, vec3 x, double reach)
{
    const struct polyhedron *const c = p->core;
    const vec3 d = v3_sub(x, p->middle);
    const double far = (double)INFINITY;
    double out = -far;
    if (fabs(d.x) > p->half.x + reach || fabs(d.y) > p->half.y + reach ||
        fabs(d.z) > p->half.z + reach)
        return far;
    for (int f = 0; f < c->face_room; f++)
        out = fmax(out, c->nx[f] * x.x + c->ny[f] * x.y + c->nz[f] * x.z - c->off[f]);
    if (out <= 0.0)
        return out - r;
    return out > r + reach ? far : polyhedron_distance(c, x) - r;
}

double dilated_out(const struct dilated *d, vec3 x, double reach)
{
    double out = (double)INFINITY;
    for (int k = 0; k < d->n_parts; k++)
        out = fmin(out, part_out(&d->part[k], d->r, x, reach));
    return out;
}

/* The part of a cell that is inside, and its middle. */
static struct shape_part look(const struct dilated *d, vec3 low, double h)
{
    struct shape_part out = {.volume = 0.0};
    int n = 0;
    for (int k = 0; k < SUB * SUB * SUB; k++) {
        const vec3 x = {low.x + h * (k % SUB + 0.5) / SUB,
                        low.y + h * (k / SUB % SUB + 0.5) / SUB,
                        low.z + h * (k / (SUB * SUB) + 0.5) / SUB};
        if (!dilated_holds(d, x))
            continue;
        n++;
        out.at = v3_add(out.at, x);
    }
    if (n > 0)
        out.at = v3_scale(1.0 / n, out.at);
    out.volume = h * h * h * n / (SUB * SUB * SUB);
    return out;
}

struct shape_part *dilated_parts(const struct dilated *d, double spacing, int *n)
{
    const double h = fmin(spacing, 2.0 * d->radius / ACROSS);
    const int side = (int)ceil(2.0 * d->radius / h);
    double sum = 0.0;
    int room = 64;
    struct shape_part *part = xalloc((size_t)room, sizeof *part);
    *n = 0;
    for (int k = 0; k < side * side * side; k++) {
        const vec3 low = {h * (k % side - 0.5 * side), h * (k / side % side - 0.5 * side),
                          h * (k / (side * side) - 0.5 * side)};
        const struct shape_part new = look(d, low, h);
        if (!(new.volume > 0.0))
            continue;
        if (*n == room) {
            part = xrealloc(part, (size_t)room, 2 * (size_t)room, sizeof *part);
            room *= 2;
        }
        part[(*n)++] = new;
        sum += new.volume;
    }
    for (int k = 0; k < *n; k++)
        part[k].volume *= 4.0 / 3.0 * 3.14159265358979323846 / sum;
    return part;
}
