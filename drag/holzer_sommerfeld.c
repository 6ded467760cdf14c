/* drag/holzer_sommerfeld.c - Hoelzer and Sommerfeld's grain of any shape and orientation
 * [HoelzerSommerfeld08].
 *
 *   C_D  = 8/(Re sqrt(Phi_l)) + 16/(Re sqrt(Phi)) + 3/(sqrt(Re) Phi^(3/4))
 *          + 0.42 x 10^{0.4 (-log10 Phi)^0.2}/Phi_c
 *   Fhat = 1/(3 sqrt(Phi_l)) + 2/(3 sqrt(Phi)) + sqrt(Re)/(8 Phi^(3/4))
 *          + (0.42/24) 10^{...} Re/Phi_c
 *
 * Phi is the sphericity, Phi_c the crosswise, Phi_l the lengthwise sphericity. Where the last
 * is not known the authors' simple form takes Phi_c for it: grains.lengthwise_sphericity =
 * auto. For a sphere it tends to 24/Re + 3/sqrt(Re) + 0.42, not quite Schiller and Naumann's.
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. */
#include "drag.h"

#include <math.h>

enum { CREEPING, MIDDLE, FAST };

const struct about drag_about = {
    .name = "holzer_sommerfeld",
    .summary = "Hoelzer and Sommerfeld's isolated grain of any shape and orientation",
    .equation = "Fhat = 1/(3 sqrt(Phi_l)) + 2/(3 sqrt(Phi)) + sqrt(Re)/(8 Phi^(3/4)) + "
                "(0.42/24) 10^{0.4 (-log10 Phi)^0.2} Re/Phi_c",
    .source = "[HoelzerSommerfeld08]",
    .range = "one grain on its own (eps above 0.99), Re < 1e5"};
const struct drag_limits drag_limits = {.eps_min = 0.99,
                                        .eps_max = 1.0,
                                        .re_max = 1e5,
                                        .isolated = 1.0,
                                        .shape =
                                            DRAG_SPHERICITY | DRAG_CROSSWISE | DRAG_LENGTHWISE};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

void drag_prepare(struct drag_grain *grain)
{
    const double phi = grain->sphericity;
    grain->own[CREEPING] = 1.0 / (3.0 * sqrt(grain->lengthwise)) + 2.0 / (3.0 * sqrt(phi));
    grain->own[MIDDLE] = 0.125 / pow(phi, 0.75);
    grain->own[FAST] =
        0.42 / 24.0 * pow(10.0, 0.4 * pow(-log10(fmin(phi, 1.0)), 0.2)) / grain->crosswise;
}

double drag_factor(const struct drag_point *p)
{
    const double *const own = p->grain->own;
    return own[CREEPING] + own[MIDDLE] * sqrt(p->re) + own[FAST] * p->re;
}
