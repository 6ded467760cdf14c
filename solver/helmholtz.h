/* helmholtz.h - (A - div nu grad) w = r for one component of the velocity, with A and nu even in space,
 * directly, on the faces of the staggered grid that have an equation: those between two cells, and those
 * of open sides (half a control volume, nothing through the side).
 *
 * w is 0 on walls and on sides with a flow given, even beyond slip sides and, for the components along them,
 * open ones. The bits of the result do not depend on the number of threads. */
#ifndef HELMHOLTZ_H
#define HELMHOLTZ_H

#include "domain.h"
#include "grid.h"

struct helmholtz; /* tables of the component */

struct helmholtz *helmholtz_create(const struct grid *g, const struct domain *d, int a);
void helmholtz_free(struct helmholtz *h); /* h may be NULL */

/* Rows of faces (j, k), faces first..last of each: before() just before they are read, after() when
 * the result is in them; from any thread, each row once, other rows untouched. */
struct helmholtz_hook {
    void (*before)(const void *with, int j, int k, int first, int last);
    void (*after)(const void *with, int j, int k, int first, int last);
    const void *with;
};

/* field: face field of the component; r in, w out. A > 0, nu >= 0 in units of A m2. */
void helmholtz_solve(struct helmholtz *h, double A, double nu, double *field,
                     const struct helmholtz_hook *hook);

#endif
