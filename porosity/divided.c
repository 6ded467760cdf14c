/* porosity/divided.c - a grain's volume divided among the cells that it overlaps, exactly.
 *
 *   w_pc = |ball p in cell c|/V_p        (the bounding sphere of a grain that is no sphere)
 *
 * The cells that a ball meets form a small brick. With G(i,j,k) the part of the ball beyond the
 * low faces of cell (i,j,k) (solver/sphere_box.c; the low faces at the edge of the brick count
 * as infinitely far), the parts in the cells are the differences of G along x, y and z in turn.
 * What lies beyond a wall thereby stays in the outermost cell inside, and the parts sum to 1
 * but for round-off. A grain in one cell costs no formula, one cut by a single plane only that
 * of a cap.
 *
 * Shares below 1e-15 are round-off of cells in the brick's corners that the ball does not
 * reach; they are left out. A grain nearly as large as a periodic box may name a cell twice. */
#include "porosity.h"

#include "../solver/locate.h"
#include "../solver/sphere_box.h"

const struct about porosity_about = {
    .name = "divided",
    .summary = "a grain's volume divided among the cells that it overlaps, exactly",
    .equation = "w = volume of the sphere in the cell / volume of the sphere",
    .source = "solver/sphere_box.c; compare [StrobletAl16]",
    .range = "cells of a diameter or more (below, eps falls to 0 inside grains)"};
const struct key porosity_keys[] = {{0}};
const int porosity_displaces = 1;

/* The intervals of a direction that a ball meets. */
struct span {
    int first, n;         /* of the intervals, counted from 0 at the low side of the box */
    double centre, inv_r; /* centre from the low face of `first`, m; 1/m */
    double h;             /* m */
};

static const double beyond_all = -2.0; /* radii: a plane that cuts nothing off */

/* At most that many intervals of width h hold a length of 2 r. */
static int span_most(double radius, double h)
{
    return (int)ceil(2.0 * radius / h) + 1;
}

static struct span span_find(const struct grid *g, const struct domain *d, int axis, double x,
                             double radius)
{
    const double h = g->h[axis];
    const int n = g->n[axis], most = span_most(radius, h);
    if (n == 1)
        return (struct span){.first = 0, .n = 1};
    int lo = (int)floor((x - radius) / h);
    int hi = (int)ceil((x + radius) / h) - 1;
    if (!d->periodic[axis]) {
        lo = lo < 0 ? 0 : (lo >= n ? n - 1 : lo);
        hi = hi < lo ? lo : (hi >= n ? n - 1 : hi);
    }
    if (hi - lo >= most) /* by round-off; what is cut off stays in the last interval */
        hi = lo + most - 1;
    return (struct span){
        .first = lo, .n = hi - lo + 1, .centre = x - lo * h, .inv_r = 1.0 / radius, .h = h};
}

/* Low plane of interval i of the span, in radii from the centre. */
static double span_plane(const struct span *s, int i)
{
    return i == 0 ? beyond_all : (i * s->h - s->centre) * s->inv_r;
}

static double part_beyond(double a, double b, double c)
{
    if (b == beyond_all && c == beyond_all)
        return ball_beyond(a);
    if (a == beyond_all)
        return c == beyond_all ? ball_beyond(b) : ball_wedge(b, c);
    if (b == beyond_all)
        return ball_wedge(a, c);
    return c == beyond_all ? ball_wedge(a, b) : ball_octant(a, b, c);
}

/* G -> parts of the cells: each entry minus the next one along x, y, z. */
static void differences(const struct span s[3], struct share *out)
{
    const int nx = s[0].n, ny = s[1].n, n = nx * ny * s[2].n;
    for (int m = 0; m < n; m++)
        if (m % nx < nx - 1)
            out[m].weight -= out[m + 1].weight;
    for (int m = 0; m < n; m++)
        if (m / nx % ny < ny - 1)
            out[m].weight -= out[m + nx].weight;
    for (int m = 0; m + nx * ny < n; m++)
        out[m].weight -= out[m + nx * ny].weight;
}

/* Drops empty shares and makes the sum of the others 1; returns how many they are. */
static int normalise(struct share *out, int n)
{
    int used = 0;
    double sum = 0.0;
    for (int m = 0; m < n; m++)
        if (out[m].weight > 1e-15) {
            sum += out[m].weight;
            out[used++] = out[m];
        }
    for (int m = 0; m < used; m++)
        out[m].weight /= sum;
    return used;
}

void porosity_init(struct scene *s)
{
    (void)s;
}

int porosity_reach(const struct grid *g, double radius)
{
    int reach = 1;
    for (int axis = 0; axis < 3; axis++)
        reach *= g->n[axis] == 1 ? 1 : span_most(radius, g->h[axis]);
    return reach;
}

int porosity_shares(const struct grid *g, const struct domain *d, const struct grains *grains,
                    int i, struct share *out)
{
    const vec3 x = grains->pos[i];
    const double r = grains->radius[i];
    const struct span s[3] = {span_find(g, d, 0, x.x, r), span_find(g, d, 1, x.y, r),
                              span_find(g, d, 2, x.z, r)};
    int m = 0;
    for (int c = 0; c < s[2].n; c++) {
        const int k = locate_index(g, d, 2, s[2].first + c);
        for (int b = 0; b < s[1].n; b++) {
            const int j = locate_index(g, d, 1, s[1].first + b);
            for (int a = 0; a < s[0].n; a++, m++) {
                out[m].cell = cell(g, locate_index(g, d, 0, s[0].first + a), j, k);
                out[m].weight = part_beyond(span_plane(&s[0], a), span_plane(&s[1], b),
                                            span_plane(&s[2], c));
            }
        }
    }
    if (m == 1)
        return 1; /* the whole of it */
    differences(s, out);
    return normalise(out, m);
}
