/* drag/brown_lawler.c - Brown and Lawler's sphere [BrownLawler03, eq. 19].
 *
 *   C_D  = 24/Re (1 + 0.150 Re^0.681) + 0.407/(1 + 8710/Re)
 *   Fhat = C_D Re/24
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {.name = "brown_lawler",
                                 .summary = "Brown and Lawler's isolated sphere",
                                 .equation =
                                     "Fhat = 1 + 0.15 Re^0.681 + (0.407/24) Re^2/(Re + 8710)",
                                 .source = "[BrownLawler03, eq. 19]",
                                 .range = "one sphere on its own (eps above 0.99), Re < 2e5",
                                 .cost = "a power of Re: a logarithm and an exponential"};
const struct drag_limits drag_limits = {
    .eps_min = 0.99, .eps_max = 1.0, .re_max = 2e5, .isolated = 1.0};
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
    const double re = p->re;
    return 1.0 + 0.15 * power(re, 0.681) + 0.407 / 24.0 * re * re / (re + 8710.0);
}
