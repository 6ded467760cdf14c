/* drag/stokes.c - creeping flow past a sphere on its own [Stokes1851].
 *
 *   F_d = 3 pi mu d U,  U = eps u_r,   so Fhat = 1
 *
 * Exact for an isolated sphere as Re -> 0. There is no voidage factor: the slip is the
 * superficial one, as in every law here, and neighbours are not felt. For a bed or a
 * suspension take a law that has one. */
#include "drag.h"

const struct about drag_about = {.name = "stokes",
                                 .summary = "Stokes' drag of an isolated sphere",
                                 .equation = "Fhat = 1",
                                 .source = "[Stokes1851]",
                                 .range = "one sphere on its own (eps above 0.99), Re < 0.1"};
const struct drag_limits drag_limits = {
    .eps_min = 0.99, .eps_max = 1.0, .re_max = 0.1, .isolated = 1.0};
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
    (void)p;
    return 1.0;
}
