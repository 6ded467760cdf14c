/* verify/test_bed_kozeny_carman_darcy.c - a uniform bed, kozeny_carman, darcy: see
 * uniform_bed.h. */
/* slots: drag/kozeny_carman porosity/divided solver/fluid/darcy */
#include "uniform_bed.h"

static double law_gradient(double phi, double eps, double U)
{
    const double e3 = eps * eps * eps; /* [Carman37] */
    return 180.0 * phi * phi * bed_mu * U / (e3 * bed_d * bed_d);
}

int main(void)
{
    check_darcy();
    return check_end();
}
