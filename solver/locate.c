/* locate.c - from a position to a cell. */
#include "locate.h"

int locate_index(const struct grid *g, const struct domain *d, int axis, int i)
{
    const int n = g->n[axis];
    if (d->periodic[axis]) {
        const int rest = i % n;
        return 1 + (rest < 0 ? rest + n : rest);
    }
    return i < 0 ? 1 : (i >= n ? n : i + 1);
}

int locate_cell(const struct grid *g, const struct domain *d, vec3 x)
{
    const int i = locate_index(g, d, 0, (int)floor(x.x / g->h[0]));
    const int j = locate_index(g, d, 1, (int)floor(x.y / g->h[1]));
    const int k = locate_index(g, d, 2, (int)floor(x.z / g->h[2]));
    return cell(g, i, j, k);
}
