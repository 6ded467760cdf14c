/* drag/tang.c - Tang and others' law, from resolved runs of static random arrays [TangetAl15],
 * with their addition for grains that move [TangetAl16].
 *
 *   Fhat = 10 phi/eps^2 + eps^2 (1 + 1.5 sqrt(phi)) + Re {0.11 phi (1+phi) - 0.00456/eps^4
 *          + [0.169 eps + 0.0644/eps^4] Re^-0.343},   phi = 1 - eps
 *   with drag.mobility = on:  + 2.98 (phi/eps^2) Re_T,
 *          Re_T = 2.108 Re^0.85 (rho_p/rho_f)^-0.5   (gas and solids only)
 *
 * Beyond its range 0.00456/eps^4 wins and the published drag becomes negative: from Re = 1e5
 * at eps = 1, 3.5e4 at 0.4. The braces are kept at 0.00114/eps^4 at least, a quarter of what
 * is subtracted, so that the force rises with the slip for ever; in the fitted range nothing
 * changes. */
#include "drag.h"

#include <math.h>

enum { MOBILE };
static bool mobility;

const struct about drag_about = {
    .name = "tang",
    .summary = "Tang and others' law of random arrays, static or moving",
    .equation = "Fhat = 10 phi/eps^2 + eps^2 (1 + 1.5 sqrt(phi)) + Re {0.11 phi (1+phi) - "
                "0.00456/eps^4 + [0.169 eps + 0.0644/eps^4] Re^-0.343}",
    .source = "[TangetAl15]; [TangetAl16]",
    .range = "eps 0.4 to 1, Re < 1000",
    .cost = "a power of Re and a root"};
const struct drag_limits drag_limits = {
    .eps_min = 0.4, .eps_max = 1.0, .re_max = 1000.0, .isolated = 1.0};
const struct key drag_keys[] = {{"drag", "mobility", KEY_CHOICE, "", "off | on", "off",
                                 "addition for grains that move freely in a gas"},
                                {0}};

void drag_init(struct scene *s)
{
    mobility = scene_choice(s, "drag", NULL, "mobility") == 1;
}

void drag_prepare(struct drag_grain *grain)
{
    grain->own[MOBILE] = 2.98 * 2.108 / sqrt(grain->density_ratio);
}

double drag_factor(const struct drag_point *p)
{
    const double eps = p->eps, phi = 1.0 - eps, eps2 = eps * eps, re = p->re;
    double factor = 10.0 * phi / eps2 + eps2 * (1.0 + 1.5 * sqrt(phi));
    if (!(re > 0.0))
        return factor;
    const double log_re = log(re), inverse4 = 1.0 / (eps2 * eps2);
    const double inertia = 0.11 * phi * (1.0 + phi) - 0.00456 * inverse4 +
                           (0.169 * eps + 0.0644 * inverse4) * exp(-0.343 * log_re);
    factor += re * fmax(inertia, 0.00114 * inverse4);
    return mobility ? factor + p->grain->own[MOBILE] * phi / eps2 * exp(0.85 * log_re) : factor;
}
