/* shapes/geometry/polyhedron.c - the hull of points as a polyhedron, by libqhull [Barber96]. */
#include "polyhedron.h"

#include <libqhull_r/libqhull_r.h>
#include <libqhull_r/poly_r.h>
#include <stdlib.h>
#include <string.h>

static int padded(int n)
{
    return (n + POLYHEDRON_LANES - 1) / POLYHEDRON_LANES * POLYHEDRON_LANES;
}

void polyhedron_free(struct polyhedron *p)
{
    if (!p)
        return;
    void *const all[] = {p->x,   p->y,    p->z,         p->nx,         p->ny,   p->nz,
                         p->off, p->edge, p->edge_face, p->loop_begin, p->loop, p->fan_begin,
                         p->fan, p};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        xfree(all[k]);
}

static void pad(double *x, int n, int room)
{
    for (int k = n; k < room; k++)
        x[k] = x[0];
}

static void make_room(struct polyhedron *p, int vertices, int faces, int loop)
{
    p->n_vertices = vertices;
    p->n_faces = faces;
    p->vertex_room = padded(vertices);
    p->face_room = padded(faces);
    double **const of_vertex[] = {&p->x, &p->y, &p->z};
    double **const of_face[] = {&p->nx, &p->ny, &p->nz, &p->off};
    for (int k = 0; k < 3; k++)
        *of_vertex[k] = xalloc((size_t)p->vertex_room, sizeof(double));
    for (int k = 0; k < 4; k++)
        *of_face[k] = xalloc((size_t)p->face_room, sizeof(double));
    p->loop_begin = xalloc((size_t)faces + 1, sizeof(int));
    p->loop = xalloc((size_t)loop, sizeof(int));
}

/* The plane of a face through its vertices, in the mean if there are more than three by the sum of its corner products. */
static void set_plane(struct polyhedron *p, int f)
{
    vec3 normal = v3(0.0, 0.0, 0.0), middle = normal;
    const int begin = p->loop_begin[f], n = p->loop_begin[f + 1] - begin;
    const vec3 first = polyhedron_vertex(p, p->loop[begin]);
    for (int k = 0; k < n; k++) {
        const vec3 a = polyhedron_vertex(p, p->loop[begin + k]);
        const vec3 b = polyhedron_vertex(p, p->loop[begin + (k + 1) % n]);
        normal = v3_add(normal, v3_cross(v3_sub(a, first), v3_sub(b, first)));
        middle = v3_axpy(middle, 1.0 / n, a);
    }
    normal = v3_scale(1.0 / v3_norm(normal), normal);
    p->nx[f] = normal.x;
    p->ny[f] = normal.y;
    p->nz[f] = normal.z;
    p->off[f] = v3_dot(normal, middle);
}

static void pad_faces(struct polyhedron *p)
{
    double *const all[] = {p->nx, p->ny, p->nz, p->off};
    for (int k = 0; k < 4; k++)
        pad(all[k], p->n_faces, p->face_room);
}

static void finish_faces(struct polyhedron *p)
{
    for (int f = 0; f < p->n_faces; f++)
        set_plane(p, f);
    pad_faces(p);
}

static void finish_vertices(struct polyhedron *p)
{
    double *const all[] = {p->x, p->y, p->z};
    for (int k = 0; k < 3; k++)
        pad(all[k], p->n_vertices, p->vertex_room);
    p->radius = 0.0;
    for (int v = 0; v < p->n_vertices; v++)
        p->radius = fmax(p->radius, v3_norm(polyhedron_vertex(p, v)));
}

/* The face whose loop goes from a to b; -1: none. */
static int face_along(const struct polyhedron *p, int a, int b)
{
    for (int f = 0; f < p->n_faces; f++) {
        const int begin = p->loop_begin[f], n = p->loop_begin[f + 1] - begin;
        for (int k = 0; k < n; k++)
            if (p->loop[begin + k] == a && p->loop[begin + (k + 1) % n] == b)
                return f;
    }
    return -1;
}

static bool make_edges(struct polyhedron *p)
{
    const int ends = p->loop_begin[p->n_faces];
    p->edge = xalloc((size_t)ends / 2 + 1, sizeof *p->edge);
    p->edge_face = xalloc((size_t)ends / 2 + 1, sizeof *p->edge_face);
    for (int f = 0; f < p->n_faces; f++) {
        const int begin = p->loop_begin[f], n = p->loop_begin[f + 1] - begin;
        for (int k = 0; k < n; k++) {
            const int a = p->loop[begin + k], b = p->loop[begin + (k + 1) % n];
            const int other = face_along(p, b, a);
            if (other < 0)
                return false;
            if (a > b)
                continue;
            p->edge[p->n_edges][0] = a;
            p->edge[p->n_edges][1] = b;
            p->edge_face[p->n_edges][0] = f;
            p->edge_face[p->n_edges++][1] = other;
        }
    }
    return p->n_vertices - p->n_edges + p->n_faces == 2;
}

/* The vertex before v in the loop of f. */
static int before_in(const struct polyhedron *p, int f, int v)
{
    const int begin = p->loop_begin[f], n = p->loop_begin[f + 1] - begin;
    for (int k = 0; k < n; k++)
        if (p->loop[begin + (k + 1) % n] == v)
            return p->loop[begin + k];
    return -1;
}

static void make_fans(struct polyhedron *p)
{
    int at = 0;
    p->fan_begin = xalloc((size_t)p->n_vertices + 1, sizeof(int));
    p->fan = xalloc((size_t)p->loop_begin[p->n_faces], sizeof(int));
    for (int v = 0; v < p->n_vertices; v++) {
        int first = -1;
        p->fan_begin[v] = at;
        for (int f = 0; f < p->n_faces && first < 0; f++)
            if (before_in(p, f, v) >= 0)
                first = f;
        for (int f = first; f >= 0 && (f != first || at == p->fan_begin[v]);) {
            p->fan[at++] = f;
            f = face_along(p, v, before_in(p, f, v)); /* across the edge that comes in */
        }
    }
    p->fan_begin[p->n_vertices] = at;
}

/* Loops of the facets of a hull, with the vertices numbered as they come. */
static int read_facets(qhT *qh, struct polyhedron *p, const vec3 *point)
{
    facetT *facet;
    vertexT *vertex, **vertexp;
    int vertices = 0, faces = 0, loop = 0;
    FORALLvertices vertex->visitid = (unsigned)vertices++;
    FORALLfacets
    {
        faces++;
        loop += qh_setsize(qh, facet->vertices);
    }
    if (vertices > POLYHEDRON_MOST || faces > POLYHEDRON_MOST)
        return vertices > faces ? vertices : faces;
    make_room(p, vertices, faces, loop);
    int k = 0, at = 0;
    FORALLvertices
    {
        const vec3 x = point[qh_pointid(qh, vertex->point)];
        p->x[k] = x.x;
        p->y[k] = x.y;
        p->z[k++] = x.z;
    }
    int f = 0;
    FORALLfacets
    {
        setT *around = qh_facet3vertex(qh, facet);
        p->loop_begin[f++] = at;
        FOREACHvertex_(around) p->loop[at++] = (int)vertex->visitid;
        qh_settempfree(qh, &around);
        p->loop_begin[f] = at;
    }
    return 0;
}

/* qhull's loops may go either way round: outward normals are what is wanted. */
static void orient(struct polyhedron *p)
{
    vec3 inside = v3(0.0, 0.0, 0.0);
    for (int v = 0; v < p->n_vertices; v++)
        inside = v3_axpy(inside, 1.0 / p->n_vertices, polyhedron_vertex(p, v));
    for (int f = 0; f < p->n_faces; f++) {
        const int begin = p->loop_begin[f], end = p->loop_begin[f + 1];
        set_plane(p, f);
        if (v3_dot(polyhedron_normal(p, f), inside) < p->off[f])
            continue;
        for (int a = begin, b = end - 1; a < b; a++, b--) {
            const int swap = p->loop[a];
            p->loop[a] = p->loop[b];
            p->loop[b] = swap;
        }
    }
}

static struct polyhedron *from_hull(qhT *qh, const vec3 *point, char **why)
{
    struct polyhedron *const p = xalloc(1, sizeof *p);
    const int too_many = read_facets(qh, p, point);
    if (too_many > 0) {
        *why = xprintf("has %d vertices or faces: %d at most", too_many, POLYHEDRON_MOST);
    } else {
        finish_vertices(p);
        orient(p);
        finish_faces(p);
        if (!make_edges(p))
            *why = xprintf("its hull is no polyhedron: faces that nearly lie in one plane");
        else
            make_fans(p);
    }
    if (*why) {
        polyhedron_free(p);
        return NULL;
    }
    return p;
}

static bool finite_points(const vec3 *point, int n)
{
    for (int k = 0; k < n; k++)
        if (!isfinite(point[k].x) || !isfinite(point[k].y) || !isfinite(point[k].z))
            return false;
    return true;
}

struct polyhedron *polyhedron_hull(const vec3 *point, int n, char **why)
{
    struct polyhedron *p = NULL;
    char options[] = "qhull ", *said = NULL;
    size_t length = 0;
    int left = 0, total = 0;
    *why = NULL;
    if (!finite_points(point, n)) {
        *why = xprintf("has a point that is not finite");
        return NULL;
    }
    if (n < 4) {
        *why = xprintf("has %d points: a polyhedron takes 4 or more", n);
        return NULL;
    }
    coordT *const at = xalloc(3 * (size_t)n, sizeof *at);
    for (int k = 0; k < n; k++)
        memcpy(&at[3 * k], (coordT[3]){point[k].x, point[k].y, point[k].z}, 3 * sizeof *at);
    FILE *const errors = open_memstream(&said, &length);
    qhT *const qh = xalloc(1, sizeof *qh);
    qh_zero(qh, errors);
    if (qh_new_qhull(qh, 3, n, at, false, options, NULL, errors) == 0)
        p = from_hull(qh, point, why);
    else
        *why = xprintf("has no volume: its points lie in a plane");
    qh_freeqhull(qh, !qh_ALL);
    qh_memfreeshort(qh, &left, &total);
    fclose(errors);
    free(said); /* of open_memstream */
    xfree(qh);
    xfree(at);
    return p;
}

void polyhedron_move(struct polyhedron *p, vec3 origin, const vec3 axes[3], double scale)
{
    for (int v = 0; v < p->n_vertices; v++) {
        const vec3 x = v3_sub(polyhedron_vertex(p, v), origin);
        p->x[v] = scale * v3_dot(axes[0], x);
        p->y[v] = scale * v3_dot(axes[1], x);
        p->z[v] = scale * v3_dot(axes[2], x);
    }
    for (int f = 0; f < p->n_faces; f++) {
        const vec3 n = polyhedron_normal(p, f);
        p->off[f] = scale * (p->off[f] - v3_dot(n, origin));
        p->nx[f] = v3_dot(axes[0], n);
        p->ny[f] = v3_dot(axes[1], n);
        p->nz[f] = v3_dot(axes[2], n);
    }
    finish_vertices(p);
    pad_faces(p);
}
