/* mesh.h - surfaces of triangles: read from STL, found by a tree of boxes. */
#ifndef MESH_H
#define MESH_H

#include <stdio.h>
#include "walls/wall_kind.h"

/* A triangle a, a + e1, a + e2, with what its nearest point takes: with p = (x - a) . e1 and
 * q = (x - a) . e2 the part of a point along e1 is g11 p + g12 q, that along e2 g12 p + g22 q. */
struct triangle {
    _Alignas(64) vec3 a;
    vec3 e1, e2, normal;
    double g11, g12, g22; /* 1/m2 */
    double hollow;        /* a sum of the numbers below: 0 to 63 */
};

/* Its edges e1, e2, e2 - e1 (1, 2, 4 times this) are hollow on the side of the normal, on the other. */
enum { HOLLOW_FRONT = 1, HOLLOW_BACK = 8 };

struct mesh_node {
    double low[3], high[3];
    int first, n; /* n > 0: a leaf of these triangles; else its children are first, first + 1 */
};

struct mesh {
    int n, n_nodes;
    struct triangle *triangle;
    int *patch; /* per triangle: equal for those that lie in one plane and join */
    struct mesh_node *node;
    vec3 low, high;
};

/* Corners of the triangles of an STL file, 3 n of them, m = file's unit (free with xfree); or NULL,
 * and what is wrong with the file in *why (free with xfree). */
vec3 *mesh_read_stl(const char *path, int *n, char **why);

/* The triangles with edges of at most `most` along x, y, z (INFINITY: of any length), each edge
 * halved as often as it takes (not beyond four million triangles); takes `corner`, and returns what replaces it. */
vec3 *mesh_split(vec3 *corner, int *n, const double most[3]);

/* The mesh of n triangles; NULL, and why, where one is degenerate or not finite. */
struct mesh *mesh_create(const vec3 *corner, int n, char **why);
void mesh_free(void *mesh);

void triangle_view(const struct triangle *t, const vec3 *x, struct wall_view *out);
void mesh_views(const struct mesh *m, struct wall_looks *l);
/* Finds the edges that two triangles share, by the corners: patches and hollow edges. */
void mesh_sew(struct mesh *m, const vec3 *corner);
/* As of wall_kind.h. */
bool triangle_flat(const struct triangle *t, const vec3 *x, struct wall_flat *plane,
                   double *within);
void mesh_near(const struct mesh *m, vec3 x, double reach, struct found *out);

#endif
