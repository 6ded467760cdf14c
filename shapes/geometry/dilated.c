/* shapes/geometry/dilated.c - a body of dilated polyhedra: its size, mass, centre and axes.
 *
 * One part: Steiner's formula and exact moments. Several that overlap: a background grid whose
 * cells count as far as they are inside, with the cell's own moment [LiLiuJi23, eqs 2-11; there
 * they count in full where their middles are inside, and eqs 6 to 8 leave out the cell's own
 * moment]. The body is scaled until its volume is that of the sphere of its size, with the ball's
 * radius held. */
#include "dilated.h"

#include <string.h>

#define PI          3.14159265358979323846
#define UNIT_VOLUME (4.0 / 3.0 * PI)

enum { COARSE = 48, ROUNDS = 4, ROUNDS_MOST = 40 };

void dilated_free(struct dilated *d)
{
    if (!d)
        return;
    for (int k = 0; k < d->n_parts; k++) {
        polyhedron_free(d->part[k].core);
        xfree(d->part[k].log_weight);
    }
    xfree(d->ball);
    xfree(d->shadow);
    xfree(d);
}

static void set_box(struct dilated_part *p, double r)
{
    const struct polyhedron *const c = p->core;
    const double far = (double)INFINITY;
    vec3 low = {far, far, far}, high = {-far, -far, -far};
    p->radius = 0.0;
    for (int v = 0; v < c->n_vertices; v++) {
        const vec3 x = polyhedron_vertex(c, v);
        low = v3(fmin(low.x, x.x), fmin(low.y, x.y), fmin(low.z, x.z));
        high = v3(fmax(high.x, x.x), fmax(high.y, x.y), fmax(high.z, x.z));
    }
    p->middle = v3_scale(0.5, v3_add(low, high));
    p->half = v3_add(v3_scale(0.5, v3_sub(high, low)), v3(r, r, r));
    for (int v = 0; v < c->n_vertices; v++)
        p->radius = fmax(p->radius, v3_norm(v3_sub(polyhedron_vertex(c, v), p->middle)) + r);
}

static void set_boxes(struct dilated *d)
{
    d->radius = 0.0;
    for (int k = 0; k < d->n_parts; k++) {
        set_box(&d->part[k], d->r);
        d->radius = fmax(d->radius, d->part[k].core->radius + d->r);
    }
}

static void move(struct dilated *d, vec3 origin, double scale, const vec3 axes[3])
{
    for (int k = 0; k < d->n_parts; k++)
        polyhedron_move(d->part[k].core, origin, axes, scale);
    set_boxes(d);
}

static const vec3 unit_axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

/* The box of the whole body. */
static void bounds(const struct dilated *d, vec3 *low, vec3 *high)
{
    *low = v3_sub(d->part[0].middle, d->part[0].half);
    *high = v3_add(d->part[0].middle, d->part[0].half);
    for (int k = 1; k < d->n_parts; k++) {
        const vec3 a = v3_sub(d->part[k].middle, d->part[k].half);
        const vec3 b = v3_add(d->part[k].middle, d->part[k].half);
        *low = v3(fmin(low->x, a.x), fmin(low->y, a.y), fmin(low->z, a.z));
        *high = v3(fmax(high->x, b.x), fmax(high->y, b.y), fmax(high->z, b.z));
    }
}

/* How much of a cell is inside, were the surface flat: from 1 to 0 over the cell's breadth along the
 * surface's normal. Planes of cells that the surface is parallel to, however it is turned, then
 * err by nothing in the mean, where cells that count in full or not at all err all alike. */
static double filled(const struct dilated *d, vec3 x, vec3 h)
{
    const double reach = v3_norm(h), step = 1e-3 * reach, out = dilated_out(d, x, reach);
    if (!(fabs(out) < 0.5 * reach))
        return out < 0.0 ? 1.0 : 0.0;
    const double gx = dilated_out(d, v3(x.x + step, x.y, x.z), reach) - out,
                 gy = dilated_out(d, v3(x.x, x.y + step, x.z), reach) - out,
                 gz = dilated_out(d, v3(x.x, x.y, x.z + step), reach) - out;
    const double breadth = (fabs(gx) * h.x + fabs(gy) * h.y + fabs(gz) * h.z) / step;
    return fmin(fmax(0.5 - out / breadth, 0.0), 1.0);
}

/* Moments over a grid of about that spacing. */
static void sum_grid(const struct dilated *d, double spacing, struct moments *m)
{
    vec3 low, high, h;
    bounds(d, &low, &high);
    const vec3 sides = v3_sub(high, low);
    const int nx = (int)ceil(sides.x / spacing), ny = (int)ceil(sides.y / spacing),
              nz = (int)ceil(sides.z / spacing);
    h = v3(sides.x / nx, sides.y / ny, sides.z / nz);
    *m = (struct moments){0.0};
    for (int k = 0; k < nz; k++)
        for (int j = 0; j < ny; j++)
            for (int i = 0; i < nx; i++) {
                const vec3 x = {low.x + (i + 0.5) * h.x, low.y + (j + 0.5) * h.y,
                                low.z + (k + 0.5) * h.z};
                moments_add_brick(m, filled(d, x, h), x, h);
            }
}

static double longest(const struct dilated *d)
{
    vec3 low, high;
    bounds(d, &low, &high);
    return fmax(high.x - low.x, fmax(high.y - low.y, high.z - low.z));
}

/* The scale at which Steiner's polynomial of the core as it is has the volume; 0: the ball alone. */
static double scale_of_one(const struct polyhedron *p, double r)
{
    const double v = polyhedron_steiner(p, 0.0), s = polyhedron_surface(p, 0.0);
    const double m = (polyhedron_surface(p, 1.0) - s - 4.0 * PI) / 2.0;
    const double left = UNIT_VOLUME * (1.0 - r * r * r);
    double low = 0.0, high = cbrt(left / v);
    if (!(left > 0.0))
        return 0.0;
    for (int k = 0; k < 200; k++) {
        const double x = 0.5 * (low + high);
        if (v * x * x * x + s * r * x * x + m * r * r * x > left)
            high = x;
        else
            low = x;
    }
    return 0.5 * (low + high);
}

static void weigh_one(struct dilated *d, struct moments *m)
{
    *m = (struct moments){0.0};
    move(d, v3(0.0, 0.0, 0.0), scale_of_one(d->part[0].core, d->r), unit_axes);
    if (d->part[0].core->radius > 0.0)
        moments_of_dilated(m, d->part[0].core, d->r);
    else
        moments_add_ball(m, v3(0.0, 0.0, 0.0), d->r);
}

/* The volume grows with a power of the scale: 3, less where much of it is the ball's, which is held;
 * the last two sums say which. */
static bool weigh_several(struct dilated *d, double spacing, struct moments *m)
{
    double power = 3.0;
    for (int k = 0; k < d->n_parts; k++) /* sets a scale near the last one */
        if (d->part[k].core->radius <= 0.0)
            return false;
    sum_grid(d, longest(d) / COARSE, m);
    for (int round = 0, more = ROUNDS_MOST; round < ROUNDS; round++) {
        const bool coarse = round < ROUNDS - 2;
        const double before = m->volume, by = pow(UNIT_VOLUME / before, 1.0 / power);
        if (!(by > 0.0) || !isfinite(by))
            return false;
        move(d, v3(0.0, 0.0, 0.0), by, unit_axes);
        sum_grid(d, coarse ? longest(d) / COARSE : spacing, m);
        if (coarse && fabs(by - 1.0) > 1e-3)
            power = fmin(fmax(log(m->volume / before) / log(by), 0.2), 3.0);
        /* thin parts are slow: most of their volume is the ball's */
        if (round == ROUNDS - 3 && fabs(m->volume / UNIT_VOLUME - 1.0) > 0.005 && more-- > 0)
            round--;
    }
    return fabs(m->volume / UNIT_VOLUME - 1.0) < 0.02;
}

static void add_balls(struct dilated *d)
{
    int n = 0;
    for (int k = 0; k < d->n_parts; k++)
        n += d->part[k].core->n_vertices;
    d->ball = xalloc((size_t)n, sizeof *d->ball);
    for (int k = 0; k < d->n_parts; k++) {
        const struct polyhedron *const p = d->part[k].core;
        const int count = p->radius > 0.0 ? p->n_vertices : 1;
        for (int v = 0; v < count; v++)
            d->ball[d->n_balls++] = (struct shape_ball){
                .centre = polyhedron_vertex(p, v), .radius = d->r, .curve = 1.0};
    }
}

static bool hulls(struct dilated *d, const struct solid *s, char **why)
{
    for (int k = 0; k < s->n; k++) {
        char *what = NULL;
        struct polyhedron *const p = polyhedron_hull(s->point[k], s->count[k], &what);
        if (!p) {
            *why =
                s->n > 1 ? xprintf("part %d %s", k + 1, what) : xprintf("the solid %s", what);
            xfree(what);
            return false;
        }
        d->part[d->n_parts++].core = p;
    }
    return true;
}

/* Starts at a scale at which the parts, if they did not overlap, had the volume. */
static void start_scale(struct dilated *d)
{
    double v = 0.0;
    for (int k = 0; k < d->n_parts; k++)
        v += polyhedron_steiner(d->part[k].core, 0.0);
    move(d, v3(0.0, 0.0, 0.0), cbrt(UNIT_VOLUME / v), unit_axes);
}

struct dilated *dilated_create(const struct solid *s, double r, double spacing, char **why)
{
    struct dilated *const d = xalloc(1, sizeof *d);
    struct moments m;
    vec3 centre, axes[3];
    double inertia[3];
    *why = NULL;
    d->r = r;
    if (s->n > PARTS_MOST)
        *why = xprintf("has %d parts: %d at most", s->n, PARTS_MOST);
    if (*why || !hulls(d, s, why)) {
        dilated_free(d);
        return NULL;
    }
    start_scale(d);
    if (d->n_parts == 1) {
        weigh_one(d, &m);
    } else if (!weigh_several(d, spacing, &m)) {
        *why = xprintf("leaves no volume for its parts beside the dilation");
        dilated_free(d);
        return NULL;
    }
    moments_principal(&m, &centre, inertia, axes);
    move(d, centre, 1.0, axes);
    d->inertia = v3(inertia[0] / m.volume, inertia[1] / m.volume, inertia[2] / m.volume);
    const struct mat3 columns = {{{axes[0].x, axes[1].x, axes[2].x},
                                  {axes[0].y, axes[1].y, axes[2].y},
                                  {axes[0].z, axes[1].z, axes[2].z}}};
    d->axes = quat_of_matrix(&columns);
    add_balls(d);
    for (int k = 0; k < d->n_parts; k++) {
        struct dilated_part *const p = &d->part[k];
        p->log_weight = xalloc((size_t)p->core->vertex_room, sizeof *p->log_weight);
        crown_weights(p->core, p->log_weight);
    }
    return d;
}
