/* drag/rong.c - Rong, Dong and Yu's voidage function on Dallavalle's sphere, from lattice-
 * Boltzmann runs of packed beds [RongDongYu13].
 *
 *   Fhat = (C_D Re/24) eps^-b,   C_D = (0.63 + 4.8/sqrt(Re))^2
 *   b    = 2.65 (eps + 1) - (5.3 - 3.5 eps) eps^2 exp[-(1.5 - log10 Re)^2/2]
 *
 * Di Felice's form with an exponent that depends on eps too. An isolated creeping sphere feels
 * 0.96 of Stokes' drag, as Dallavalle's does. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {
    .name = "rong",
    .summary = "Rong, Dong and Yu's voidage function on Dallavalle's sphere",
    .equation = "Fhat = (0.63 sqrt(Re) + 4.8)^2/24 eps^-b, b = 2.65 (eps+1) - (5.3 - 3.5 eps) "
                "eps^2 exp[-(1.5 - log10 Re)^2/2]",
    .source = "[RongDongYu13]; [Dallavalle48]",
    .range = "eps 0.37 to 1, Re < 3000",
    .cost = "two logarithms and two exponentials: eps to a power that follows log Re"};
const struct drag_limits drag_limits = {
    .eps_min = 0.37, .eps_max = 1.0, .re_max = 3000.0, .isolated = 0.96};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

void drag_prepare(struct drag_grain *grain)
{
    (void)grain;
}

double drag_factor(const struct drag_point *p)
{
    const double eps = p->eps;
    const double b =
        2.65 * (eps + 1.0) - (5.3 - 3.5 * eps) * eps * eps * sphere_intermediate(p->re);
    return sphere_dallavalle(p->re) * voidage(eps, b);
}
