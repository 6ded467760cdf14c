/* drag/stokes.c - creeping flow past a sphere on its own [Stokes1851].
 *
 *   F_d = 3 pi mu d U,  U = eps u_r,   so Fhat = 1
 *
 * Exact for an isolated sphere as Re -> 0. The slip is the superficial one, as in every law
 * here; for eps = 1 the two slips agree. Neighbours are not felt: for a bed take another law.
 */
#include "drag.h"

const struct about drag_about = {.name = "stokes",
                                 .summary = "Stokes' drag of an isolated sphere",
                                 .equation = "Fhat = 1",
                                 .source = "[Stokes1851]",
                                 .range = "eps = 1, Re < 0.1"};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

double drag_factor(const struct drag_point *p)
{
    (void)p;
    return 1.0;
}
