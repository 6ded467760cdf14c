/* mesh.c - triangles, their nearest points, and the tree of boxes that finds them.
 *
 * The tree halves the triangles of a box at the median of their middles along its longest side,
 * down to a few per leaf: a grain far from the mesh looks at one box. */
#include "mesh.h"

#include <stdlib.h>

enum { LEAF = 4 };

/* Nearest point of the segment from + t along, 0 <= t <= 1, to x; squares of distances. */
static double segment(vec3 from, vec3 along, vec3 x, vec3 *away, enum wall_part *part)
{
    const vec3 rel = v3_sub(x, from);
    const double t = v3_dot(rel, along) / v3_dot(along, along);
    *part = t <= 0.0 || t >= 1.0 ? WALL_VERTEX : WALL_EDGE;
    *away = v3_axpy(rel, -fmin(fmax(t, 0.0), 1.0), along);
    if (t >= 1.0)
        *away = v3_sub(x, v3_add(from, along));
    return v3_dot(*away, *away);
}

/* The nearest of its edges and corners. */
static void view_rim(const struct triangle *t, vec3 x, struct wall_view *out)
{
    const vec3 from[3] = {t->a, t->a, v3_add(t->a, t->e1)};
    const vec3 along[3] = {t->e1, t->e2, v3_sub(t->e2, t->e1)};
    double least = (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        struct wall_view view = {.part = WALL_EDGE};
        const double square = segment(from[k], along[k], x, &view.away, &view.part);
        if (square < least) {
            least = square;
            *out = view;
        }
    }
}

void triangle_view(const struct triangle *t, const vec3 *x, struct wall_view *out)
{
    const vec3 at = v3(x->x, x->y, x->z), rel = v3_sub(at, t->a);
    const double u = v3_dot(rel, t->g1), v = v3_dot(rel, t->g2);
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0)
        wall_view_put(out, v3_scale(v3_dot(rel, t->normal), t->normal), 0.0, WALL_FACE);
    else
        view_rim(t, at, out);
}

/* From its nearest point of a segment to a point. */
struct rim {
    double x, y, z, square; /* m, m2 */
    int part;
};

#define RIM_INLINE static inline __attribute__((always_inline))

/* The segment along e from the origin, where it is nearer to f than what was found before. */
RIM_INLINE struct rim nearer_rim(struct rim r, double fx, double fy, double fz, double ex,
                                 double ey, double ez)
{
    const double t = (fx * ex + fy * ey + fz * ez) / (ex * ex + ey * ey + ez * ez);
    const double at = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    const double x = fx - at * ex, y = fy - at * ey, z = fz - at * ez;
    const double square = x * x + y * y + z * z;
    const int part = at == t ? WALL_EDGE : WALL_VERTEX;
    r.x = square < r.square ? x : r.x;
    r.y = square < r.square ? y : r.y;
    r.z = square < r.square ? z : r.z;
    r.part = square < r.square ? part : r.part;
    r.square = square < r.square ? square : r.square;
    return r;
}

/* triangle_view for several: face and rim are both computed, one is taken. The numbers of a triangle are
 * a row of doubles, which the compiler gathers. */
void triangle_views(const struct triangle *triangle, struct wall_looks *l)
{
    enum { A = 0, E1 = 3, E2 = 6, NORMAL = 9, G1 = 12, G2 = 15, ROW = 18 };
    _Static_assert(sizeof(struct triangle) == ROW * sizeof(double), "a row of numbers");
    const double *const row = &triangle->a.x;
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const int t = ROW * l->element[c];
        const double x = l->x[c] - row[t + A], y = l->y[c] - row[t + A + 1];
        const double z = l->z[c] - row[t + A + 2];
        const double ux = row[t + E1], uy = row[t + E1 + 1], uz = row[t + E1 + 2];
        const double vx = row[t + E2], vy = row[t + E2 + 1], vz = row[t + E2 + 2];
        const double nx = row[t + NORMAL], ny = row[t + NORMAL + 1], nz = row[t + NORMAL + 2];
        const double u = x * row[t + G1] + y * row[t + G1 + 1] + z * row[t + G1 + 2];
        const double v = x * row[t + G2] + y * row[t + G2 + 1] + z * row[t + G2 + 2];
        const double h = x * nx + y * ny + z * nz;
        const int face = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0);
        struct rim r = {.square = (double)INFINITY, .part = WALL_EDGE};
        r = nearer_rim(r, x, y, z, ux, uy, uz);
        r = nearer_rim(r, x, y, z, vx, vy, vz);
        r = nearer_rim(r, x - ux, y - uy, z - uz, vx - ux, vy - uy, vz - uz);
        l->ax[c] = face ? h * nx : r.x;
        l->ay[c] = face ? h * ny : r.y;
        l->az[c] = face ? h * nz : r.z;
        l->curvature[c] = 0.0;
        l->part[c] = face ? WALL_FACE : r.part;
    }
}

static bool set_triangle(struct triangle *t, const vec3 *c)
{
    const vec3 e1 = v3_sub(c[1], c[0]), e2 = v3_sub(c[2], c[0]), n = v3_cross(e1, e2);
    const double a = v3_dot(e1, e1), b = v3_dot(e1, e2), d = v3_dot(e2, e2);
    const vec3 e3 = v3_sub(e2, e1);
    const double longest = fmax(fmax(a, d), v3_dot(e3, e3)), twice = v3_norm(n);
    if (!(twice > 1e-10 * longest))
        return false;
    const double det = twice * twice;
    *t = (struct triangle){.a = c[0], .e1 = e1, .e2 = e2, .normal = v3_scale(1.0 / twice, n)};
    t->g1 = v3_axpy(v3_scale(d / det, e1), -b / det, e2);
    t->g2 = v3_axpy(v3_scale(a / det, e2), -b / det, e1);
    return true;
}

static void triangle_box(const struct triangle *t, double low[3], double high[3])
{
    const vec3 b = v3_add(t->a, t->e1), c = v3_add(t->a, t->e2);
    const double x[3][3] = {{t->a.x, b.x, c.x}, {t->a.y, b.y, c.y}, {t->a.z, b.z, c.z}};
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(x[k][0], fmin(x[k][1], x[k][2]));
        high[k] = fmax(x[k][0], fmax(x[k][1], x[k][2]));
    }
}

/* A triangle on its way into the tree. */
struct leaf {
    double middle[3], key; /* m */
    int index;
};

static int by_key(const void *a, const void *b)
{
    const struct leaf *const p = a, *const q = b;
    return p->key < q->key ? -1 : p->key > q->key ? 1 : p->index - q->index;
}

static void fit_box(struct mesh_node *node, const struct triangle *t, const struct leaf *leaf,
                    int n)
{
    for (int k = 0; k < 3; k++) {
        node->low[k] = (double)INFINITY;
        node->high[k] = -(double)INFINITY;
    }
    for (int i = 0; i < n; i++) {
        double low[3], high[3];
        triangle_box(&t[leaf[i].index], low, high);
        for (int k = 0; k < 3; k++) {
            node->low[k] = fmin(node->low[k], low[k]);
            node->high[k] = fmax(node->high[k], high[k]);
        }
    }
}

static void grow(struct mesh *m, int at, struct leaf *leaf, int first, int n)
{
    struct mesh_node *const node = &m->node[at];
    fit_box(node, m->triangle, leaf + first, n);
    if (n <= LEAF) {
        node->first = first;
        node->n = n;
        return;
    }
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (node->high[k] - node->low[k] > node->high[axis] - node->low[axis])
            axis = k;
    for (int i = first; i < first + n; i++)
        leaf[i].key = leaf[i].middle[axis];
    qsort(leaf + first, (size_t)n, sizeof *leaf, by_key);
    const int children = m->n_nodes;
    node->first = children;
    m->n_nodes += 2;
    grow(m, children, leaf, first, n / 2);
    grow(m, children + 1, leaf, first + n / 2, n - n / 2);
}

/* The triangles are then stored in the order of the leaves. */
static void plant(struct mesh *m)
{
    struct leaf *const leaf = xalloc((size_t)m->n, sizeof *leaf);
    m->node = xalloc(2 * (size_t)m->n + 1, sizeof *m->node);
    for (int i = 0; i < m->n; i++) {
        double low[3], high[3];
        triangle_box(&m->triangle[i], low, high);
        leaf[i].index = i;
        for (int k = 0; k < 3; k++)
            leaf[i].middle[k] = 0.5 * (low[k] + high[k]);
    }
    m->n_nodes = 1;
    grow(m, 0, leaf, 0, m->n);
    struct triangle *const sorted = xalloc((size_t)m->n, sizeof *sorted);
    for (int i = 0; i < m->n; i++)
        sorted[i] = m->triangle[leaf[i].index];
    xfree(m->triangle);
    m->triangle = sorted;
    xfree(leaf);
}

struct mesh *mesh_create(const vec3 *corner, int n, char **why)
{
    struct mesh *const m = xalloc(1, sizeof *m);
    int degenerate = 0, first = 0;
    m->n = n;
    m->triangle = xalloc((size_t)n, sizeof *m->triangle);
    *why = NULL;
    for (int i = 0; i < n && !*why; i++) {
        const vec3 *const c = &corner[3 * i];
        const vec3 sum = v3_add(c[0], v3_add(c[1], c[2]));
        if (!isfinite(sum.x + sum.y + sum.z))
            *why = xprintf("triangle %d has a corner that is not finite", i + 1);
        else if (!set_triangle(&m->triangle[i], c) && degenerate++ == 0)
            first = i + 1;
    }
    if (!*why && degenerate > 0)
        *why = xprintf("%d of %d triangles are degenerate (no area), the first is number %d",
                       degenerate, n, first);
    if (*why) {
        mesh_free(m);
        return NULL;
    }
    plant(m);
    const struct mesh_node *const root = &m->node[0];
    m->low = v3(root->low[0], root->low[1], root->low[2]);
    m->high = v3(root->high[0], root->high[1], root->high[2]);
    return m;
}

void mesh_free(void *mesh)
{
    struct mesh *const m = mesh;
    if (!m)
        return;
    xfree(m->triangle);
    xfree(m->node);
    xfree(m);
}

static bool box_near(const struct mesh_node *n, const double x[3], double square)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double d = fmax(fmax(n->low[k] - x[k], x[k] - n->high[k]), 0.0);
        sum += d * d;
    }
    return sum < square;
}

void mesh_near(const struct mesh *m, vec3 x, double reach, struct found *out)
{
    const double at[3] = {x.x, x.y, x.z}, square = reach * reach;
    int stack[128], n = 0; /* halving 2^31 triangles goes 31 deep */
    stack[n++] = 0;
    while (n > 0) {
        const struct mesh_node *const node = &m->node[stack[--n]];
        if (!box_near(node, at, square))
            continue;
        if (node->n == 0) {
            stack[n++] = node->first + 1;
            stack[n++] = node->first;
            continue;
        }
        for (int i = node->first; i < node->first + node->n; i++) {
            struct wall_view view;
            triangle_view(&m->triangle[i], &x, &view);
            if (v3_dot(view.away, view.away) < square)
                found_add(out, i);
        }
    }
}
