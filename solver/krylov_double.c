/* krylov_double.c - conjugate gradients and multigrid in double precision, see krylov.h. */
#include <omp.h>
#include "krylov.h"

#define REAL   double
#define DIRECT poisson_solve_double
#include "rows_body.h"
#include "multigrid_body.h"
#include "krylov_body.h"

const struct krylov_kind krylov_double = {krylov_create, krylov_free, krylov_start,
                                          krylov_coarsen, krylov_solve};
