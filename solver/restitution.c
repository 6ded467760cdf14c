/* restitution.c - damping ratio from restitution, for a contact without pull.
 *
 * A damped spring lets go when its force is zero, before the overlap is [SchwagerPoeschel07].
 * With zeta = sin(theta) that is at omega t = pi - 2 theta, and ln e = -(pi - 2 theta)
 * tan(theta),        zeta < 1  (e > exp(-2)) ln e = -2 psi coth(psi), zeta = cosh(psi), zeta >
 * 1 (derived here from their eq. 7 and 13). The customary zeta = -ln e/sqrt(ln^2 e + pi^2)
 * holds for a contact that pulls at its end; cut at zero force it rebounds with 0.550 where 0.5
 * is asked. Tsuji's damping of a Hertz contact [Tsuji92] maps onto the same oscillator
 * [AntypovElliott11]. */
#include "restitution.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#define PI 3.14159265358979323846

static double under_damped(double theta, void *log_e)
{
    return (PI - 2.0 * theta) * tan(theta) + *(const double *)log_e;
}

static double over_damped(double psi, void *log_e)
{
    return 2.0 * psi / tanh(psi) + *(const double *)log_e;
}

static double root(double (*f)(double, void *), double lo, double hi, double log_e)
{
    gsl_function g = {.function = f, .params = &log_e};
    gsl_root_fsolver *const solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    gsl_root_fsolver_set(solver, &g, lo, hi);
    for (int i = 0; i < 200; i++) {
        gsl_root_fsolver_iterate(solver);
        if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver),
                                   gsl_root_fsolver_x_upper(solver), 0.0, 1e-15) == GSL_SUCCESS)
            break;
    }
    const double x = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return x;
}

double damping_ratio(double e)
{
    if (e >= 1.0)
        return 0.0;
    const double log_e = log(e), edge = 1e-6;
    if (log_e > -2.0 + 1e-9)
        return sin(root(under_damped, 0.0, 0.5 * PI - edge, log_e));
    if (log_e < -2.0 - 1e-9)
        return cosh(root(over_damped, edge, 1.0 - log_e, log_e));
    return 1.0;
}

double damping_step(double zeta)
{
    return 2.0 * (sqrt(1.0 + zeta * zeta) - zeta);
}
