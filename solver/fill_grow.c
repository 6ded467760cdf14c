/* fill_grow.c - growth to a dense packing, without friction.
 *
 * In the manner of [LubachevskyStillinger90], but with the relaxation of [OHern03] in place of
 * collisions: the grains start small where they were put down and grow in steps, in each of which
 * they are pushed apart. They grow a little too large, so that they jam at the least energy of their
 * overlaps, and are then let back to their own size by halves: where they jam at more than that,
 * nothing overlaps any more. What a first growth does not reach is tried again from the jammed state
 * with more of overgrowth, which packs it denser each time, a few times while little is missing. Equal spheres in a periodic
 * box come to random close packing, a solid fraction of about 0.64; mixtures to more, packings
 * between walls to less. */
#include "fill_grow.h"

#define SOLID_START 0.30 /* where anything finds room */
#define STEP        0.05 /* of the size */
#define OVER_FIRST  0.010
#define OVER_LEAST  5e-5
#define BALANCE     1e-3
#define HOPELESS    0.02 /* overlap that tapping does not take away */

enum { TAPS = 6, SWEEPS = 2000, FEW_SWEEPS = 200, HALVINGS = 8, MANY = 3000 };

static struct relaxed relax(struct fill_grid *b, int first, const struct fill_region *region,
                            const struct grow_goal *goal, struct relax_goal how,
                            struct grown *g)
{
    how.overlap = goal->overlap;
    how.walls = goal->walls;
    const struct relaxed r = fill_relax(b, first, region, &how);
    const double size = how.scale * (1.0 + how.swell); /* it grows, then comes back */
    if (b->n - first >= MANY)
        progress_update(&g->progress, how.swell > 0.0 ? 1.5 - 25.0 * how.swell : 0.5 * size,
                        (double)r.sweeps * (b->n - first));
    g->sweeps += r.sweeps;
    g->overlap = r.overlap;
    return r;
}

/* From an overgrown size back to `scale`; true if there is room at that. */
static bool let_back(struct fill_grid *b, int first, const struct fill_region *region,
                     const struct grow_goal *goal, double scale, double over, struct grown *g)
{
    for (; over > OVER_LEAST; over *= 0.5)
        if (relax(b, first, region, goal,
                  (struct relax_goal){
                      .scale = scale, .swell = over, .balance = BALANCE, .sweeps = SWEEPS},
                  g)
                .overlap <= goal->overlap)
            return true;
    return false;
}

/* The size at which jammed grains have room, by halves. */
static void find_scale(struct fill_grid *b, int first, const struct fill_region *region,
                       const struct grow_goal *goal, struct grown *g)
{
    struct grown there = *g;
    double lo = 0.0, hi = 1.0, scale = 0.98;
    for (int k = 0; k < HALVINGS; k++) {
        const bool room = let_back(b, first, region, goal, scale, 8.0 * OVER_LEAST, &there);
        if (room)
            lo = scale;
        else
            hi = scale;
        scale = lo > 0.0 ? 0.5 * (lo + hi) : 0.98 * scale;
    }
    g->scale = lo;
    g->sweeps = there.sweeps;
}

struct grown fill_grow(struct fill_grid *b, int first, const struct fill_region *region,
                       const struct grow_goal *goal)
{
    struct grown g = {.scale = 1.0};
    double over = OVER_FIRST;
    if (b->n - first >= MANY)
        progress_start(&g.progress, 0.0, 1.5, "growing");
    for (double scale = cbrt(SOLID_START / goal->solid); scale < 1.0 + over; scale += STEP)
        relax(b, first, region, goal,
              (struct relax_goal){.scale = scale, .balance = 0.1, .sweeps = FEW_SWEEPS}, &g);
    while (!let_back(b, first, region, goal, 1.0, over, &g)) {
        if (++g.taps > TAPS || g.overlap > HOPELESS + goal->overlap) {
            find_scale(b, first, region, goal, &g);
            break;
        }
        over += 0.5 * OVER_FIRST;
    }
    if (b->n - first >= MANY)
        progress_end(&g.progress);
    return g;
}
