/* krylov_single.c - conjugate gradients and multigrid in single precision, see krylov.h. */
#include <omp.h>
#include "krylov.h"

#define REAL   float
#define DIRECT poisson_solve_single
#include "rows_body.h"
#include "multigrid_body.h"
#include "krylov_body.h"

const struct krylov_kind krylov_single = {krylov_create, krylov_free, krylov_start,
                                          krylov_coarsen, krylov_solve};
