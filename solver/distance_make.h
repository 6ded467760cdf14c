/* distance_make.h - for the makers of distance fields. */
#ifndef DISTANCE_MAKE_H
#define DISTANCE_MAKE_H

#include "distance_field.h"

struct distance_field *distance_new(const int n[3], double spacing, vec3 origin); /* zero */
void distance_make_spline(struct distance_field *f); /* once all values are there */

#endif
