/* shapes/geometry/polyhedron.h - convex polyhedra: faces, edges, and what they weigh.
 *
 * Built once per species, then only read. Numbers lie in arrays of one coordinate each, padded to
 * a whole number of lanes with copies of the first, so that a search over all of them needs no
 * rest of a loop. */
#ifndef POLYHEDRON_H
#define POLYHEDRON_H

#include <stdbool.h>
#include "../../solver/base.h"

enum { POLYHEDRON_LANES = 8, POLYHEDRON_MOST = 1024 /* vertices, faces */ };

struct polyhedron {
    int n_vertices, n_faces, n_edges;
    int vertex_room, face_room; /* with the padding */
    double *x, *y, *z;          /* m, vertices */
    double *nx, *ny, *nz, *off; /* faces: outward unit normal; normal . point = off, m */
    int (*edge)[2];             /* vertices of an edge */
    int (*edge_face)[2];    /* faces on its left and right, going from its first vertex to its
                                   second, seen from outside */
    int *loop_begin, *loop; /* vertices of face f, counter-clockwise from outside:
                                   loop[loop_begin[f]] ... loop[loop_begin[f + 1] - 1] */
    int *fan_begin, *fan;   /* likewise the faces round a vertex, counter-clockwise */
    double radius;          /* m, of the sphere about the origin that holds it */
};

/* The convex hull of n points [Barber96]; faces that lie in one plane are one face. NULL, and why
 * (free with xfree), where the points lie in a plane or are not finite. */
struct polyhedron *polyhedron_hull(const vec3 *point, int n, char **why);
void polyhedron_free(struct polyhedron *p);
/* Moves it by -origin, turns it so that the rows of `axes` become x, y, z, and scales it (by 0: all
 * vertices at the origin, the faces keep their normals). */
void polyhedron_move(struct polyhedron *p, vec3 origin, const vec3 axes[3], double scale);

static inline vec3 polyhedron_vertex(const struct polyhedron *p, int v)
{
    return v3(p->x[v], p->y[v], p->z[v]);
}

static inline vec3 polyhedron_normal(const struct polyhedron *p, int f)
{
    return v3(p->nx[f], p->ny[f], p->nz[f]);
}

/* Moments of a body of density 1: its volume, the integrals of x and of x x. */
struct moments {
    double volume;                 /* m3 */
    vec3 first;                    /* m4 */
    double xx, yy, zz, xy, xz, yz; /* m5 */
};

/* Adds those of the polyhedron, and of all points within r of it: the core, a slab of height r
 * on each face, a sector of a cylinder along each edge, and a cone of a sphere at each vertex
 * [Steiner1840]. Exact. */
void moments_of_core(struct moments *m, const struct polyhedron *p);
void moments_of_dilated(struct moments *m, const struct polyhedron *p, double r);
/* m2, of the polyhedron dilated by r. */
double polyhedron_surface(const struct polyhedron *p, double r);
/* m3, by Steiner's formula V + S r + M r^2 + 4/3 pi r^3. */
double polyhedron_steiner(const struct polyhedron *p, double r);

/* Centre of mass, principal moments of inertia (m5, of density 1, ascending) about it and principal
 * axes (rows, right-handed) [Jacobi1846]. */
void moments_principal(const struct moments *m, vec3 *centre, double inertia[3], vec3 axes[3]);

/* A ball of density 1 and a cell (a brick with sides along the axes) of that density: for grids. */
void moments_add_ball(struct moments *m, vec3 centre, double r);
void moments_add_brick(struct moments *m, double density, vec3 middle, vec3 sides);

#endif
