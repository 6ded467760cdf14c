/* distance_field.h - a body given by its signed distance on a regular grid: < 0 inside.
 *
 * Made of a closed surface of triangles, of an array of voxels, or read as it is. Between nodes
 * it is a quadratic spline in each direction: with a gradient that has no jumps, as a force that follows from
 * it must have. Lengths in the units of the source, until distance_field_scale. */
#ifndef DISTANCE_FIELD_H
#define DISTANCE_FIELD_H

#include <stdbool.h>
#include "vec3.h"

struct distance_field {
    int n[3]; /* nodes */
    double spacing, inv_spacing;
    vec3 origin;  /* of node 0 0 0 */
    float *value; /* control values of the spline; x runs fastest; the owner's, xfree */
};

/* From the corners of n triangles, 3 each, of a closed surface; `across`: nodes over the longest edge
 * of its box. NULL and *why (xfree) where the surface is not closed. The distance is exact within three
 * spacings of the surface, farther away that of the eikonal equation. */
struct distance_field *distance_of_triangles(const vec3 *corner, int n, int across, char **why);

/* From voxels that are solid (non-zero) or not, x fastest: exact distance between the centres of the
 * last of one and the first of the other kind, less half a voxel, smoothed by a Gaussian of that
 * standard deviation (voxels), which takes the stairs off. */
struct distance_field *distance_of_voxels(const unsigned char *solid, const int n[3],
                                          double edge, double smooth);

/* From a netCDF file: a variable `solid` of three dimensions z y x (non-zero: solid), or `distance`
 * (m, < 0 inside); its attribute `spacing` is the edge of a voxel (1, if there is none). NULL and
 * *why (xfree) where it is not so. */
struct distance_field *distance_read(const char *path, double smooth, char **why);

void distance_free(struct distance_field *f);

/* The distance by the spline; beyond the grid at most the true distance. With its gradient. */
double distance_at(const struct distance_field *f, vec3 x);
double distance_slope(const struct distance_field *f, vec3 x, vec3 *gradient);

/* The surface as a closed net of triangles with corners about `spacing` apart; outward ones counter-
 * clockwise. */
struct surface_net {
    int n, n_triangles;
    vec3 *at;     /* corners, on the surface */
    vec3 *normal; /* unit, outward */
    double *area; /* of each corner: a third of its triangles' */
    int (*triangle)[3];
};

struct surface_net *surface_net(const struct distance_field *f, double spacing);
void surface_net_free(struct surface_net *s);

#endif
