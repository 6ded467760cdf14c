/* mesh.h - surfaces of triangles: read from STL, found by a tree of boxes. */
#ifndef MESH_H
#define MESH_H

#include <stdio.h>
#include "walls/wall_kind.h"

/* A triangle a, a + e1, a + e2, with what its nearest point takes: the part of a point along e1 is
 * (x - a) . g1, that along e2 (x - a) . g2. */
struct triangle {
    vec3 a, e1, e2, normal, g1, g2;
};

struct mesh_node {
    double low[3], high[3];
    int first, n; /* n > 0: a leaf of these triangles; else its children are first, first + 1 */
};

struct mesh {
    int n, n_nodes;
    struct triangle *triangle;
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
void triangle_views(const struct triangle *t, struct wall_looks *l);
void mesh_near(const struct mesh *m, vec3 x, double reach, struct found *out);

#endif
