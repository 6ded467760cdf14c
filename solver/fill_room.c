/* fill_room.c - the part of a region that walls leave to grains.
 *
 * Its volume is the box times the part of a Niederreiter sequence [Niederreiter92] that falls where
 * grains may be: of 2^18 points, to about 1e-5 of the box for smooth walls. */
#include "fill_room.h"

#include <gsl/gsl_qrng.h>
#include "fill_patterns.h"
#include "sim.h"

enum { TRIES = 4000 };

double room_volume(const struct sim *walls, const struct fill_region *r, int points)
{
    bool hide = false; /* some wall takes room */
    for (int k = 0; walls && k < walls->walls.n; k++)
        hide = hide ||
               (walls->walls.wall[k].kind != &wall_side && walls->walls.wall[k].kind->behind);
    if (!hide)
        return region_volume(r);
    gsl_qrng *const q = gsl_qrng_alloc(gsl_qrng_niederreiter_2, 3);
    long room = 0;
    for (int i = 0; i < points; i++) {
        double u[3];
        gsl_qrng_get(q, u);
        for (int a = 0; a < 3; a++)
            u[a] = r->from[a] + u[a] * (r->to[a] - r->from[a]);
        room += !walls_hide(walls, v3(u[0], u[1], u[2]));
    }
    gsl_qrng_free(q);
    return region_volume(r) * (double)room / points;
}

bool room_somewhere(const struct sim *walls, const struct fill_region *r, double radius,
                    gsl_rng *rng, vec3 *x)
{
    double lo[3], hi[3], u[3];
    region_bounds(r, radius, lo, hi);
    for (int k = 0; k < TRIES; k++) {
        for (int a = 0; a < 3; a++)
            u[a] = lo[a] + (hi[a] - lo[a]) * gsl_rng_uniform(rng);
        *x = v3(u[0], u[1], u[2]);
        if (!walls || walls_gap(walls, *x, radius, 0.0, NULL) >= 0.0)
            return true;
    }
    return false;
}
