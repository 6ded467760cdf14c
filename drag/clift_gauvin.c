/* drag/clift_gauvin.c - Clift and Gauvin's sphere [CliftGauvin71].
 *
 *   C_D  = 24/Re (1 + 0.15 Re^0.687) + 0.42/(1 + 42500 Re^-1.16)
 *   Fhat = C_D Re/24
 *
 * There is no voidage factor: the slip is the superficial one, and neighbours are not felt.
 * For a bed or a suspension take a law that has one. */
#include "drag.h"

#include <math.h>

const struct about drag_about = {
    .name = "clift_gauvin",
    .summary = "Clift and Gauvin's isolated sphere",
    .equation = "Fhat = 1 + 0.15 Re^0.687 + (0.42/24) Re/(1 + 42500 Re^-1.16)",
    .source = "[CliftGauvin71]",
    .range = "one sphere on its own (eps above 0.99), Re < 3e5",
    .cost = "two powers of Re: a logarithm and two exponentials"};
const struct drag_limits drag_limits = {
    .eps_min = 0.99, .eps_max = 1.0, .re_max = 3e5, .isolated = 1.0};
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
    if (!(p->re > 0.0))
        return 1.0;
    const double re = p->re, log_re = log(re), slow = exp(-1.16 * log_re);
    return 1.0 + 0.15 * exp(0.687 * log_re) + 0.42 / 24.0 * re / (1.0 + 42500.0 * slow);
}
