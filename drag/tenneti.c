/* drag/tenneti.c - Tenneti, Garg and Subramaniam's law, from resolved runs of fixed random
 * arrays [TennetiGargSubramaniam11].
 *
 *   F    = F_iso/eps^3 + 5.81 phi/eps^3 + 0.48 phi^(1/3)/eps^4
 *          + phi^3 Re [0.95 + 0.61 phi^3/eps^2],   phi = 1 - eps
 *   F_iso = 1 + 0.15 Re^0.687 (Schiller and Naumann)
 *   Fhat = eps F   (F is the total force, with the mean pressure gradient)
 *
 * phi^(1/3) makes the factor rise with infinite slope at eps = 1. One program adds F_iso
 * without its division by eps in this normalisation, another prints (1-phi) 2 for (1-phi)^2:
 * neither is followed. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {
    .name = "tenneti",
    .summary = "Tenneti, Garg and Subramaniam's law of random arrays",
    .equation = "Fhat = eps {F_iso/eps^3 + 5.81 phi/eps^3 + 0.48 phi^(1/3)/eps^4 + phi^3 Re "
                "[0.95 + 0.61 phi^3/eps^2]}",
    .source = "[TennetiGargSubramaniam11]; [SchillerNaumann35]",
    .range = "eps 0.5 to 0.9, Re < 300",
    .cost = "a power of Re and a cube root of phi"};
const struct drag_limits drag_limits = {
    .eps_min = 0.5, .eps_max = 0.9, .re_max = 300.0, .isolated = 1.0};
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
    const double eps = p->eps, phi = 1.0 - eps, eps2 = eps * eps, phi3 = phi * phi * phi;
    return (sphere_schiller_naumann(p->re) + 5.81 * phi) / eps2 +
           0.48 * cbrt(phi) / (eps2 * eps) + eps * phi3 * p->re * (0.95 + 0.61 * phi3 / eps2);
}
