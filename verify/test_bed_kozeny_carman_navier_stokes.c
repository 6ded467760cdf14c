/* verify/test_bed_kozeny_carman_navier_stokes.c - a uniform bed, kozeny_carman, navier_stokes:
 * see uniform_bed.h. */
/* slots: drag/kozeny_carman porosity/divided solver/fluid/navier_stokes */
#include "uniform_bed.h"

static double law_gradient(double phi, double eps, double U)
{
    const double e3 = eps * eps * eps; /* [Carman37] */
    return 180.0 * phi * phi * bed_mu * U / (e3 * bed_d * bed_d);
}

int main(void)
{
    check_navier_stokes();
    return check_end();
}
