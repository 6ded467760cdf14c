/* verify/test_bed_ergun_navier_stokes.c - a uniform bed, ergun, navier_stokes: see
 * uniform_bed.h. */
/* slots: drag/ergun porosity/divided solver/fluid/navier_stokes */
#include "uniform_bed.h"

static double law_gradient(double phi, double eps, double U)
{
    const double e3 = eps * eps * eps; /* [Ergun52, eq. 9] */
    return 150.0 * phi * phi * bed_mu * U / (e3 * bed_d * bed_d) +
           1.75 * phi * bed_rho * U * U / (e3 * bed_d);
}

int main(void)
{
    check_navier_stokes();
    return check_end();
}
