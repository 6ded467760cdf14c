/* poisson_single.c - the direct solve in single precision, for preconditioners. */
#include <omp.h>
#include "poisson_plan.h"

#define REAL  float
#define INDEX int
static inline const float *table_of(const struct transform *t)
{
    return t->table_single;
}
#include "poisson_body.h"

void poisson_solve_single(struct poisson *p, const double *flat, const double *up, double shift,
                          const float *rhs, float *out, const struct poisson_hook *hook)
{
    poisson_prepare(p, flat, up, shift, true);
    poisson_layout(p, false);
    direct(p, rhs, out, hook);
}
