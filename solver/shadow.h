/* shadow.h - the area of the shadow of a body of any shape along any direction, from a table. */
#ifndef SHADOW_H
#define SHADOW_H

#include "vec3.h"

struct shadow; /* opaque */

/* From n triangles, 3 corners each, within `radius` of the origin. To 1 % or so. */
struct shadow *shadow_create(const vec3 *corner, int n, double radius);
/* From a function of the direction, the same for the opposite one; `area` need not be one. */
struct shadow *shadow_of(double (*area)(const void *data, vec3 way), const void *data);
void shadow_free(struct shadow *s);
double shadow_area(const struct shadow *s, vec3 way); /* way: unit */

#endif
