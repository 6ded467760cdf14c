/* drag/schiller_naumann.c - Schiller and Naumann's sphere [SchillerNaumann35].
 *
 *   C_D  = 24/Re (1 + 0.15 Re^0.687), Re < 1000;  0.44 from there on
 *   Fhat = C_D Re/24
 *
 * At Re = 1000 it jumps up by 0.4 %: the first branch ends at 0.4383.
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. The review lists it with an Re that
 * contains eps and no such factor either: the law of an isolated sphere. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {.name = "schiller_naumann",
                                 .summary = "Schiller and Naumann's isolated sphere",
                                 .equation =
                                     "Fhat = 1 + 0.15 Re^0.687, Re < 1000; 0.44 Re/24 above",
                                 .source = "[SchillerNaumann35]",
                                 .range = "one sphere on its own (eps above 0.99), Re < 2e5",
                                 .cost = "a power of Re: a logarithm and an exponential"};
const struct drag_limits drag_limits = {
    .eps_min = 0.99, .eps_max = 1.0, .re_max = 2e5, .jump = 0.0039, .isolated = 1.0};
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
    return sphere_schiller_naumann(p->re);
}
