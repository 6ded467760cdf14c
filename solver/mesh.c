/* mesh.c - triangles and the tree of boxes that finds them.
 *
 * The tree halves the triangles of a box at the median of their middles along its longest side,
 * down to a few per leaf: a grain far from the mesh looks at one box. */
#include "mesh.h"

#include <stdlib.h>

enum { LEAF = 4 };

static bool set_triangle(struct triangle *t, const vec3 *c)
{
    const vec3 e1 = v3_sub(c[1], c[0]), e2 = v3_sub(c[2], c[0]), n = v3_cross(e1, e2);
    const double a = v3_dot(e1, e1), b = v3_dot(e1, e2), d = v3_dot(e2, e2);
    const vec3 e3 = v3_sub(e2, e1);
    const double longest = fmax(fmax(a, d), v3_dot(e3, e3)), twice = v3_norm(n);
    if (!(twice > 1e-10 * longest))
        return false;
    const double det = twice * twice;
    *t = (struct triangle){.a = c[0],
                           .e1 = e1,
                           .e2 = e2,
                           .normal = v3_scale(1.0 / twice, n),
                           .g11 = d / det,
                           .g12 = -b / det,
                           .g22 = a / det};
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
    int *const patch = xalloc((size_t)m->n, sizeof *patch);
    for (int i = 0; i < m->n; i++) {
        sorted[i] = m->triangle[leaf[i].index];
        patch[i] = m->patch[leaf[i].index];
    }
    xfree(m->triangle);
    xfree(m->patch);
    m->triangle = sorted;
    m->patch = patch;
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
    mesh_sew(m, corner);
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
    xfree(m->patch);
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
