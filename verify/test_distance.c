/* verify/test_distance.c - the distance of polyhedra against brute force: cubes face to face, edge
 * to edge, vertex to face, and any hulls, each at 1,000 random turns; overlap; memory; bounds. */
#include "polyhedra.h"

enum { TURNS = 1000 };

static void check_cubes(gsl_rng *r, enum cubes_meet how, int turns, double least)
{
    struct polyhedron *const p = box_of(v3(1.0, 1.0, 1.0), v3(0.0, 0.0, 0.0));
    static struct placed a, b;
    double worst = 0.0, nearness = 0.0, off = 0.0;
    for (int k = 0; k < turns; k++) {
        struct gap_memory memory = {0};
        struct gap gap;
        set_pair(r, how, pow(10.0, between(r, least, 0.0)), 1.0, &a, &b);
        place(&a, p);
        place(&b, p);
        gap_find(&a.points, p, &b.points, p, b.axes, 1e9, &memory, &gap);
        worst = fmax(worst, fabs(gap.distance - brute_distance(p, &a.points, p, &b.points)));
        off =
            fmax(off, v3_norm(v3_axpy(v3_sub(gap.on_a, gap.on_b), -gap.distance, gap.normal)));
        nearness = fmax(nearness, gap.distance - gap_along(&a.points, &b.points, gap.normal));
    }
    check(worst < 1e-10, "two cubes %s, %d turns: distance within %.2g of brute force",
          cubes_meet_name[how], turns, worst);
    /* a difference of places has a direction to 1e-16 of the places: of a gap of 1e-6, 1e-10 */
    check(nearness < 1e-9 && off < 1e-9,
          "  the normal tells the distance within %.2g, the points within %.2g", nearness, off);
    polyhedron_free(p);
}

/* Any two hulls, one of them long or flat, at any turn, as near as a bisection puts them. */
static void check_hulls(gsl_rng *r)
{
    static struct placed a, b;
    double worst = 0.0, warm = 0.0, least = (double)INFINITY;
    for (int k = 0; k < TURNS; k++) {
        struct polyhedron *const p = cloud_of(r, 4 + k % 30, v3(1.0, 1.0, 1.0)),
                                 *const q = cloud_of(r, 4 + k % 17, v3(5.0, 1.0, 0.05));
        struct gap_memory memory = {0};
        struct gap gap, again;
        const vec3 way = any_direction(r);
        turn_about(any_direction(r), between(r, 0.0, 3.0), a.axes);
        turn_about(any_direction(r), between(r, 0.0, 3.0), b.axes);
        b.at = v3(0.0, 0.0, 0.0);
        a.at = v3_scale(8.0, way);
        place(&b, q);
        for (int nearer = 0; nearer < 3; nearer++) { /* the memory of the last place helps */
            place(&a, p);
            gap_find(&a.points, p, &b.points, q, b.axes, 1e9, &memory, &gap);
            a.at = v3_axpy(a.at, -0.9 * gap.distance, gap.normal);
        }
        place(&a, p);
        gap_find(&a.points, p, &b.points, q, b.axes, 1e9, &memory, &gap);
        memory.n = 0;
        gap_find(&a.points, p, &b.points, q, b.axes, 1e9, &memory, &again);
        warm = fmax(warm, fabs(gap.distance - again.distance) +
                              v3_norm(v3_sub(gap.normal, again.normal)));
        worst = fmax(worst, fabs(gap.distance - brute_distance(p, &a.points, q, &b.points)));
        least = fmin(least, gap.distance);
        polyhedron_free(p);
        polyhedron_free(q);
    }
    check(worst < 1e-10, "%d pairs of hulls, down to %.1g apart: within %.2g of brute force",
          TURNS, least, worst);
    check(warm < 1e-9, "  from memory or not: distance and normal agree within %.2g", warm);
}

/* A cube pushed into a cube by a known depth, less than what would part them another way. */
static void check_overlap(gsl_rng *r)
{
    struct polyhedron *const p = box_of(v3(1.0, 1.0, 1.0), v3(0.0, 0.0, 0.0));
    static struct placed a, b;
    double worst = 0.0, bend = 0.0;
    for (int k = 0; k < TURNS; k++) {
        const double depth = pow(10.0, between(r, -15.0, -1.0));
        struct gap_memory memory = {0};
        struct gap gap, apart;
        gsl_rng *const again = gsl_rng_clone(r);
        set_pair(r, (enum cubes_meet)(1 + k % 2), -depth, 0.0, &a, &b);
        place(&a, p);
        place(&b, p);
        gap_find(&a.points, p, &b.points, p, b.axes, 1e9, &memory, &gap);
        set_pair(again, (enum cubes_meet)(1 + k % 2), 1e-3, 0.0, &a, &b);
        place(&a, p);
        place(&b, p);
        gap_find(&a.points, p, &b.points, p, b.axes, 1e9, &memory, &apart);
        gsl_rng_free(again);
        worst = fmax(worst, fabs(gap.distance + depth));
        bend = fmax(bend, v3_norm(v3_sub(gap.normal, apart.normal)));
    }
    check(worst < 1e-14 * 100.0, "cubes that overlap by 1e-15 to 0.1: within %.2g", worst);
    check(bend < 1e-9, "  the normal is that of the cubes apart, within %.2g", bend);
    polyhedron_free(p);
}

static void check_reach(gsl_rng *r)
{
    struct polyhedron *const p = cloud_of(r, 12, v3(1.0, 1.0, 1.0));
    static struct placed a, b;
    int wrong = 0, far = 0;
    for (int k = 0; k < TURNS; k++) {
        struct gap_memory memory = {0};
        struct gap near, cut;
        a.at = v3_scale(between(r, 0.0, 3.0), any_direction(r));
        b.at = v3(0.0, 0.0, 0.0);
        turn_about(any_direction(r), between(r, 0.0, 3.0), a.axes);
        turn_about(any_direction(r), between(r, 0.0, 3.0), b.axes);
        place(&a, p);
        place(&b, p);
        gap_find(&a.points, p, &b.points, p, b.axes, 1e9, &memory, &near);
        memory.n = 0;
        gap_find(&a.points, p, &b.points, p, b.axes, 0.3, &memory, &cut);
        far += near.distance >= 0.3;
        wrong += (near.distance >= 0.3) != (cut.distance >= 0.3);
        wrong += cut.distance > near.distance + 1e-12;
        wrong += near.distance < 0.3 && fabs(cut.distance - near.distance) > 1e-12;
    }
    check(wrong == 0 && far > 100,
          "a pair further than the reach is told by a bound (%d of %d)", far, TURNS);
    polyhedron_free(p);
}

int main(void)
{
    gsl_rng *const r = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(r, 61);
    for (enum cubes_meet how = FACES; how <= PARALLEL_EDGES; how++)
        if (how != ANYWHERE)
            check_cubes(r, how, TURNS, -6.0);
    /* some have three corners of the differences on a line, which the nearest point is on */
    check_cubes(r, FACES, 20 * TURNS, -1.0);
    check_hulls(r);
    check_overlap(r);
    check_reach(r);
    gsl_rng_free(r);
    return check_end();
}
