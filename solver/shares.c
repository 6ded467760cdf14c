/* shares.c - bodies on the grid, see shares.h.
 *
 * The cells that a ball meets form a small brick. With G(i,j,k) the part of the ball beyond the low
 * faces of cell (i,j,k) (solver/sphere_box.c; the low faces at the edge of the brick count as
 * infinitely far), the parts in the cells are the differences of G along x, y and z in turn, and they
 * sum to 1 but for round-off. A ball in one cell costs no formula, one cut by a single plane only
 * that of a cap; where many planes cut it, what depends on two of them is found once per pair. */
#include "shares.h"

#include <string.h>

#include "sphere_box.h"

static const double beyond_all = -2.0; /* radii: a plane that cuts nothing off */

enum {
    PLANES_MOST = 16, /* intervals per direction, for the table of pairs: BALL_PAIRS */
    PARTS_MOST = PLANES_MOST * PLANES_MOST * PLANES_MOST
};

/* Interior index 1..n of interval i, counted from 0 at the low side and on beyond the box. */
static inline int fold(const struct grid *g, const struct domain *d, int axis, int i)
{
    const int n = g->n[axis];
    if (i >= 0 && i < n)
        return 1 + i;
    const int period = d->periodic[axis] ? n : 2 * n;
    const int rest = i % period, m = rest < 0 ? rest + period : rest;
    return 1 + (m < n ? m : period - 1 - m);
}

/* The lower of the two cell centres around x, as an interval, and the weight of the upper one. */
static int trilinear_interval(const struct grid *g, int axis, double x, double *upper)
{
    if (g->n[axis] == 1) {
        *upper = 0.0;
        return 0;
    }
    const double at = x / g->h[axis] - 0.5, low = floor(at);
    *upper = at - low;
    return (int)low;
}

int shares_trilinear(const struct grid *g, const struct domain *d, vec3 x, struct share *out)
{
    const double at[3] = {x.x, x.y, x.z};
    int index[3][2], n = 0;
    double weight[3][2];
    for (int a = 0; a < 3; a++) {
        double upper;
        const int low = trilinear_interval(g, a, at[a], &upper);
        index[a][0] = fold(g, d, a, low);
        index[a][1] = fold(g, d, a, low + 1);
        weight[a][0] = 1.0 - upper;
        weight[a][1] = upper;
        if (index[a][0] == index[a][1]) { /* next to a wall both are the same cell */
            weight[a][0] = 1.0;
            weight[a][1] = 0.0;
        }
    }
    for (int c = 0; c < 2; c++)
        for (int b = 0; b < 2; b++)
            for (int e = 0; e < 2; e++) {
                const double w = weight[0][e] * weight[1][b] * weight[2][c];
                if (w > 0.0)
                    out[n++] =
                        (struct share){cell(g, index[0][e], index[1][b], index[2][c]), w};
            }
    return n;
}

/* The intervals of a direction that a ball meets. */
struct span {
    int first, n;         /* of the intervals, counted from 0 at the low side of the box */
    double centre, inv_r; /* centre from the low face of `first`, m; 1/m */
    double h, inv_h;      /* m, 1/m */
};

/* At most that many intervals of width h hold a length of 2 r. */
static int span_most(double radius, double h)
{
    return (int)ceil(2.0 * radius / h) + 1;
}

static struct span span_find(const struct grid *g, int axis, double x, double radius)
{
    const double h = g->h[axis];
    const int most = span_most(radius, h);
    if (g->n[axis] == 1)
        return (struct span){.first = 0, .n = 1};
    const int lo = (int)floor((x - radius) / h);
    int hi = (int)ceil((x + radius) / h) - 1;
    if (hi - lo >= most) /* by round-off; what is cut off stays in the last interval */
        hi = lo + most - 1;
    hi = hi < lo ? lo : hi;
    return (struct span){.first = lo,
                         .n = hi - lo + 1,
                         .centre = x - lo * h,
                         .inv_r = 1.0 / radius,
                         .h = h,
                         .inv_h = 1.0 / h};
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

static void parts_directly(const struct span s[3], double *G)
{
    for (int c = 0, m = 0; c < s[2].n; c++)
        for (int b = 0; b < s[1].n; b++)
            for (int a = 0; a < s[0].n; a++, m++)
                G[m] = part_beyond(span_plane(&s[0], a), span_plane(&s[1], b),
                                   span_plane(&s[2], c));
}

/* Adds the pairs of the planes of two directions, the second one's fastest; returns the first's place. */
static int pairs_add(const struct span *s, const struct span *t, struct ball_pairs *p)
{
    const int first = p->n;
    for (int i = 1; i < s->n; i++)
        for (int k = 1; k < t->n; k++) {
            p->a[p->n] = span_plane(s, i);
            p->b[p->n++] = span_plane(t, k);
        }
    return first;
}

static void parts_by_pairs(const struct span s[3], double *G)
{
    struct ball_pairs p;
    p.n = 0;
    /* of planes i and k from 1 on: pair i stride + k - 1, from there on */
    const int y = s[1].n - 1, z = s[2].n - 1;
    const int xy = pairs_add(&s[0], &s[1], &p) - y - 1,
              xz = pairs_add(&s[0], &s[2], &p) - z - 1;
    const int yz = pairs_add(&s[1], &s[2], &p) - z - 1;
    ball_pairs_find(&p);
    for (int c = 0, m = 0; c < s[2].n; c++)
        for (int b = 0; b < s[1].n; b++)
            for (int a = 0; a < s[0].n; a++, m++) {
                const int ab = xy + a * y + b, ac = xz + a * z + c, bc = yz + b * z + c;
                if (a && b && c)
                    G[m] = ball_octant_of(&p, ab, ac, bc);
                else if (b && c)
                    G[m] = p.wedge[bc];
                else if (a && c)
                    G[m] = p.wedge[ac];
                else if (a && b)
                    G[m] = p.wedge[ab];
                else
                    G[m] = ball_beyond(span_plane(&s[a ? 0 : b ? 1 : 2], a ? a : b ? b : c));
            }
}

/* G -> parts of the cells: each entry minus the next one along x, y, z. */
static void differences(const struct span s[3], double *G)
{
    const int nx = s[0].n, ny = s[1].n, n = nx * ny * s[2].n;
    for (int row = 0; row < n; row += nx)
        for (int m = row; m < row + nx - 1; m++)
            G[m] -= G[m + 1];
    for (int layer = 0; layer < n; layer += nx * ny)
        for (int m = layer; m < layer + nx * (ny - 1); m++)
            G[m] -= G[m + nx];
    for (int m = 0; m + nx * ny < n; m++)
        G[m] -= G[m + nx * ny];
}

/* Interior indices of the intervals of a span. */
static void fold_all(const struct grid *g, const struct domain *d, int axis,
                     const struct span *s, int *index)
{
    for (int i = 0; i < s->n; i++)
        index[i] = fold(g, d, axis, s->first + i);
}

/* The parts above 1e-15 (smaller ones are round-off of cells in the brick's corners that the ball
 * does not reach), with their sum made 1; returns how many they are. */
static int keep(const struct grid *g, const struct domain *d, const struct span s[3],
                const double *parts, struct share *out)
{
    int few[PLANES_MOST + 1], used = 0;
    int *const x = s[0].n <= PLANES_MOST + 1 ? few : xalloc((size_t)s[0].n, sizeof *x);
    double sum = 0.0;
    fold_all(g, d, 0, &s[0], x);
    for (int c = 0, m = 0; c < s[2].n; c++) {
        const int k = fold(g, d, 2, s[2].first + c);
        for (int b = 0; b < s[1].n; b++) {
            const int row = cell(g, 0, fold(g, d, 1, s[1].first + b), k);
            for (int a = 0; a < s[0].n; a++, m++) {
                out[used] = (struct share){row + x[a], parts[m]};
                const bool some = parts[m] > 1e-15;
                sum += some ? parts[m] : 0.0;
                used += some;
            }
        }
    }
    const double inverse = 1.0 / sum;
    for (int m = 0; m < used; m++)
        out[m].weight *= inverse;
    if (x != few)
        xfree(x);
    return used;
}

int shares_ball_most(const struct grid *g, double radius)
{
    int most = 1;
    for (int axis = 0; axis < 3; axis++)
        most *= g->n[axis] == 1 ? 1 : span_most(radius, g->h[axis]);
    return most;
}

int shares_ball(const struct grid *g, const struct domain *d, vec3 x, double radius,
                struct share *out)
{
    const struct span s[3] = {span_find(g, 0, x.x, radius), span_find(g, 1, x.y, radius),
                              span_find(g, 2, x.z, radius)};
    const int n = s[0].n * s[1].n * s[2].n;
    const bool small = s[0].n <= PLANES_MOST && s[1].n <= PLANES_MOST && s[2].n <= PLANES_MOST;
    double parts[PARTS_MOST];
    if (n == 1) {
        out[0] = (struct share){cell(g, fold(g, d, 0, s[0].first), fold(g, d, 1, s[1].first),
                                     fold(g, d, 2, s[2].first)),
                                1.0};
        return 1; /* the whole of it */
    }
    double *const G = n <= PARTS_MOST ? parts : xalloc((size_t)n, sizeof *G);
    if (small)
        parts_by_pairs(s, G);
    else
        parts_directly(s, G);
    differences(s, G);
    const int used = keep(g, d, s, G, out);
    if (G != parts)
        xfree(G);
    return used;
}

int shares_parts_most(const struct grid *g, double reach)
{
    return shares_ball_most(g, reach);
}

/* Adds a cube that spans any number of cells: the part of its edge in each interval of each
 * direction, times one another. */
static void cube_wide(const struct span s[3], const double at[3], double half, double weight,
                      double *G)
{
    const int nx = s[0].n, ny = s[1].n;
    int first[3], last[3];
    for (int a = 0; a < 3; a++) {
        first[a] = (int)fmax(0.0, (at[a] - half) * s[a].inv_h);
        last[a] = (int)fmin(s[a].n - 2, (at[a] + half) * s[a].inv_h);
    }
    for (int c = first[2]; c <= last[2]; c++)
        for (int b = first[1]; b <= last[1]; b++)
            for (int e = first[0]; e <= last[0]; e++) {
                const int index[3] = {e, b, c};
                double part = weight;
                for (int a = 0; a < 3; a++) {
                    const double lo = fmax(at[a] - half, index[a] * s[a].h);
                    const double hi = fmin(at[a] + half, (index[a] + 1) * s[a].h);
                    part *= s[a].h > 0.0 ? fmax(0.0, hi - lo) / (2.0 * half) : 1.0;
                }
                G[e + nx * (b + ny * c)] += part;
            }
}

/* Adds a cube no wider than a cell: to two intervals of each direction, the upper one perhaps with
 * nothing. */
static inline void cube_narrow(const struct span s[3], const double at[3], double half,
                               double inv, double weight, double *G)
{
    int first[3];
    double head[3];
    for (int a = 0; a < 3; a++) {
        const double lo = (at[a] - half) * s[a].inv_h;
        const int k = (int)lo, most = s[a].n - 2;
        first[a] = k < 0 ? 0 : k > most ? most : k;
        head[a] = s[a].h > 0.0 ? fmin(1.0, (first[a] + 1 - lo) * s[a].h * inv) : 1.0;
    }
    const int nx = s[0].n, nxy = nx * s[1].n;
    double *const cell00 = G + first[0] + nx * first[1] + nxy * first[2];
    const double up = weight * head[2], above = weight - up;
    const double w[4] = {up * head[1], up - up * head[1], above * head[1],
                         above - above * head[1]};
    double *const row[4] = {cell00, cell00 + nx, cell00 + nxy, cell00 + nxy + nx};
    for (int r = 0; r < 4; r++) {
        row[r][0] += w[r] * head[0];
        row[r][1] += w[r] - w[r] * head[0];
    }
}

/* Adds the cubes to the cells of the brick; `at`: m, the body's origin in it. */
static void cubes_add(const struct span s[3], const struct parts *p, const double at[3],
                      const struct mat3 *turn, double size, double *G)
{
    const double inv_size = 0.5 / size;
    double least = INFINITY;
    for (int a = 0; a < 3; a++)
        least = s[a].h > 0.0 ? fmin(least, s[a].h) : least;
    for (int k = 0; k < p->n; k++) {
        const vec3 x = mat3_turn(turn, p->at[k]);
        const double half = size * p->half[k];
        const double place[3] = {at[0] + size * x.x, at[1] + size * x.y, at[2] + size * x.z};
        if (2.0 * half <= least)
            cube_narrow(s, place, half, inv_size * p->inv_half[k], p->weight[k], G);
        else
            cube_wide(s, place, half, p->weight[k], G);
    }
}

int shares_parts(const struct grid *g, const struct domain *d, const struct parts *p, vec3 x,
                 const struct mat3 *turn, double size, struct share *out)
{
    const double reach = size * p->reach;
    struct span s[3] = {span_find(g, 0, x.x, reach), span_find(g, 1, x.y, reach),
                        span_find(g, 2, x.z, reach)};
    double few[PARTS_MOST], at[3];
    if (s[0].n * s[1].n * s[2].n == 1) {
        out[0] = (struct share){cell(g, fold(g, d, 0, s[0].first), fold(g, d, 1, s[1].first),
                                     fold(g, d, 2, s[2].first)),
                                1.0};
        return 1;
    }
    for (int a = 0; a < 3; a++) {
        at[a] = s[a].centre;
        s[a].n++; /* an interval beyond, which gets nothing */
    }
    const int n = s[0].n * s[1].n * s[2].n;
    double *const G = n <= PARTS_MOST ? few : xalloc((size_t)n, sizeof *G);
    memset(G, 0, (size_t)n * sizeof *G);
    cubes_add(s, p, at, turn, size, G);
    const int used = keep(g, d, s, G, out);
    if (G != few)
        xfree(G);
    return used;
}
