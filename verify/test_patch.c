/* verify/test_patch.c - how the corners of two faces share a contact; force and couple along sweeps;
 * the envelope against the exact distance. */
#include "../shapes/geometry/envelope.h"
#include "../shapes/geometry/patch.h"
#include "polyhedra.h"

#define TILT 0.1
#define R    0.05

struct meeting {
    struct polyhedron *p, *q;
    struct placed a, b;
    struct gap gap;
    struct patch_point point[PATCH_MOST];
    int n;
};

static const vec3 unit[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

static void axes_are(struct placed *b, const vec3 axes[3])
{
    for (int k = 0; k < 3; k++)
        b->axes[k] = axes[k];
}

static struct patch_body seen(const struct polyhedron *p, const struct placed *b)
{
    return (struct patch_body){p, b->points, {b->axes[0], b->axes[1], b->axes[2]}, b->at, 1.0};
}

static void meet(struct meeting *m)
{
    struct gap_memory memory = {0};
    place(&m->a, m->p);
    place(&m->b, m->q);
    gap_find(&m->a.points, m->p, &m->b.points, m->q, m->b.axes, 1e9, &memory, &m->gap);
    const struct patch_body a = seen(m->p, &m->a), b = seen(m->q, &m->b);
    m->n = patch_find(&a, &b, &m->gap, TILT, PATCH_MOST, m->point);
}

/* Force of springs of stiffness 1 in all, and its couple about the middle of b. */
static vec3 force(const struct meeting *m, vec3 *couple)
{
    vec3 f = {0.0, 0.0, 0.0};
    *couple = f;
    for (int k = 0; k < m->n; k++) {
        const struct patch_point *const p = &m->point[k];
        const double depth = fmax(2.0 * R - p->gap, 0.0);
        const vec3 one = v3_scale(p->share * depth, m->gap.normal);
        f = v3_add(f, one);
        const vec3 at = v3_axpy(p->on_b, 0.5 * p->gap, m->gap.normal);
        *couple = v3_add(*couple, v3_cross(v3_sub(at, m->b.at), one));
    }
    return f;
}

static struct meeting *cubes(void)
{
    struct meeting *const m = xalloc(1, sizeof *m);
    m->p = box_of(v3(1.0, 1.0, 1.0), v3(0.0, 0.0, 0.0));
    m->q = box_of(v3(1.0, 1.0, 1.0), v3(0.0, 0.0, 0.0));
    axes_are(&m->a, unit);
    axes_are(&m->b, unit);
    return m;
}

static void meeting_free(struct meeting *m)
{
    polyhedron_free(m->p);
    polyhedron_free(m->q);
    xfree(m);
}

static double total(const struct meeting *m)
{
    double sum = 0.0;
    for (int k = 0; k < m->n; k++)
        sum += m->point[k].share;
    return sum;
}

static void check_shares(void)
{
    struct meeting *const m = cubes();
    vec3 axes[3];
    m->a.at = v3(0.3, 0.2, 1.09);
    meet(m);
    bool even = m->n == 4;
    for (int k = 0; k < m->n; k++)
        even = even && fabs(m->point[k].share - 0.25) < 1e-12 &&
               fabs(m->point[k].gap - 0.09) < 1e-14;
    check(even, "cube shifted on a cube: four corners of a quarter each (%d)", m->n);
    turn_about(unit[2], 0.25 * PI, axes);
    axes_are(&m->a, axes);
    m->a.at = v3(0.0, 0.0, 1.09);
    meet(m);
    even = m->n == 8;
    for (int k = 0; k < m->n; k++)
        even = even && fabs(m->point[k].share - 0.125) < 1e-12;
    check(even, "turned by 45 degrees: eight of an eighth each (%d)", m->n);
    turn_about(unit[0], 0.25 * PI, axes);
    axes_are(&m->a, axes);
    m->a.at = v3(0.2, 0.1, 0.5 + sqrt(0.5) + 0.09);
    meet(m);
    check(m->n == 2 && fabs(m->point[0].share - 0.5) < 1e-12, "edge on a face: two halves (%d)",
          m->n);
    check_abs(m->point[0].gap + m->point[1].gap, 0.18, 1e-14, "  both gaps");
    turn_about(v3_scale(sqrt(0.5), v3(1.0, 1.0, 0.0)), 0.6, axes);
    axes_are(&m->a, axes);
    m->a.at = v3(0.2, 0.1, 1.6);
    meet(m);
    check(m->n == 1 && m->point[0].share == 1.0, "vertex on a face: one (%d)", m->n);
    meeting_free(m);
}

static void check_sums(void)
{
    gsl_rng *const r = gsl_rng_alloc(gsl_rng_mt19937);
    double worst = 0.0, out = 0.0, nearest = 0.0;
    int most = 0;
    for (int trial = 0; trial < 3000; trial++) {
        struct meeting *const m = cubes();
        vec3 axes[3];
        if (trial % 3 == 0) {
            polyhedron_free(m->q);
            m->q = cloud_of(r, 30, v3(1.0, 1.0, 1.0));
        }
        turn_about(any_direction(r), trial % 2 ? between(r, 0.0, 3.0) : between(r, 0.0, 0.1),
                   axes);
        axes_are(&m->a, axes);
        m->a.at = v3(between(r, -1.0, 1.0), between(r, -1.0, 1.0), 2.0);
        meet(m);
        m->a.at = v3_axpy(m->a.at, 0.08 - m->gap.distance, m->gap.normal);
        meet(m);
        double least = (double)INFINITY;
        for (int k = 0; k < m->n; k++) {
            out = fmax(out, m->gap.distance - m->point[k].gap);
            least = fmin(least, m->point[k].gap);
        }
        nearest = fmax(nearest, least - m->gap.distance);
        worst = fmax(worst, fabs(total(m) - 1.0));
        most = m->n > most ? m->n : most;
        meeting_free(m);
    }
    check(worst < 1e-12, "shares add up to 1 within %.2g, %d points at most", worst, most);
    check(out < 1e-12, "no corner is nearer than the distance: %.2g", out);
    check(nearest < 1e-9, "one of them is at the distance: %.2g", nearest);
    gsl_rng_free(r);
}

/* A way that cube a takes past cube b: s from 0 to 1. */
static void on_way(struct meeting *m, int way, double s)
{
    vec3 axes[3];
    const vec3 up = {0.0, 0.0, 1.0};
    vec3 tip = v3_scale(1.0 / sqrt(1.37), v3(1.0, 0.6, 0.1));
    m->a.at = v3(0.3, 0.1, 1.09);
    turn_about(up, 0.2, axes);
    if (way == 0) { /* slides off across edges and a corner */
        m->a.at = v3(1.3 - 2.6 * s, 0.9 * s - 0.3, 1.09);
    } else if (way == 1) { /* turns on the spot */
        turn_about(up, 1.7 * s, axes);
    } else if (way ==
               2) { /* tips over an edge from face to face, the lowest point at one height */
        turn_about(unit[0], 0.02 + 1.53 * s, axes);
    } else if (way == 3) { /* tips over a vertex */
        turn_about(tip, 0.6 * s - 0.3, axes);
    } else if (way == 4) { /* rolls past in the air with its faces tilted little */
        turn_about(tip, 0.04, axes);
        m->a.at = v3(1.3 - 2.6 * s, 0.9 * s - 0.3, 1.09);
    } else { /* edges in parallel pass each other */
        turn_about(up, 0.0, axes);
        m->a.at = v3(0.85 + 0.3 * s, 0.2, 1.09);
    }
    axes_are(&m->a, axes);
    if (way == 2 || way == 3) {
        double low = (double)INFINITY;
        place(&m->a, m->p);
        for (int k = 0; k < 8; k++)
            low = fmin(low, m->a.z[k]);
        m->a.at.z += 0.59 - low;
    }
}

static const char *const way_name[] = {"slides off over edges and a corner",
                                       "turns face on face",
                                       "tips over an edge",
                                       "tips over a vertex",
                                       "slides off, tilted by 2 degrees",
                                       "edges in parallel pass"};

static void largest_jumps(struct meeting *m, int way, int steps, double *force_jump,
                          double *couple_jump, double *most)
{
    vec3 last = {0.0, 0.0, 0.0}, last_couple = last;
    *force_jump = *couple_jump = *most = 0.0;
    for (int k = 0; k <= steps; k++) {
        vec3 couple;
        on_way(m, way, (double)k / steps);
        meet(m);
        const vec3 f = force(m, &couple);
        *most = fmax(*most, v3_norm(f));
        if (k > 0) {
            *force_jump = fmax(*force_jump, v3_norm(v3_sub(f, last)));
            *couple_jump = fmax(*couple_jump, v3_norm(v3_sub(couple, last_couple)));
        }
        last = f;
        last_couple = couple;
    }
}

/* What jumps does so in any step. Shares begin and end as the root of the way (an arc where a line comes
 * to cut a circle), so that a tenth of the step changes them by a third at most. */
static void check_sweeps(void)
{
    struct meeting *const m = cubes();
    for (int way = 0; way < 6; way++) {
        double f, c, most, f10, c10;
        largest_jumps(m, way, 2000, &f, &c, &most);
        largest_jumps(m, way, 20000, &f10, &c10, &most);
        check(f10 < 0.4 * f + 1e-12 && f10 < 0.1 * most,
              "%s: largest jump of the force %.2g of it in steps of 1/2000, %.2g in 1/20000",
              way_name[way], f / most, f10 / most);
        check(c10 < 0.4 * c + 1e-12 && c10 < 0.1 * most,
              "  of the couple %.2g and %.2g of force times size", c / most, c10 / most);
    }
    meeting_free(m);
}

/* Depths by the envelope against those by the distance, for cubes at random turns. */
static void check_envelope(void)
{
    static const double k[] = {0.3, 0.1, 0.03, 0.01, 0.003, 0.001};
    double last = (double)INFINITY;
    for (int c = 0; c < 6; c++) {
        gsl_rng *const r = gsl_rng_alloc(gsl_rng_mt19937);
        double worst = 0.0, bend = 0.0, sum = 0.0;
        const int trials = 300;
        for (int trial = 0; trial < trials; trial++) {
            struct meeting *const m = cubes();
            vec3 axes[3];
            turn_about(any_direction(r), between(r, 0.0, 3.0), axes);
            axes_are(&m->a, axes);
            m->a.at = v3_scale(2.0, any_direction(r));
            meet(m);
            m->a.at = v3_axpy(m->a.at, 1.9 * R - m->gap.distance, m->gap.normal);
            meet(m);
            struct gap e = m->gap;
            const struct patch_body a = seen(m->p, &m->a), b = seen(m->q, &m->b);
            envelope_gap(&a, R, &b, R, k[c], &e);
            const double error = fabs(e.distance - m->gap.distance) / R;
            worst = fmax(worst, error);
            sum += error;
            bend = fmax(bend, v3_norm(v3_sub(e.normal, m->gap.normal)));
            meeting_free(m);
        }
        check(
            sum / trials < last && isfinite(worst),
            "envelope, k = %g: depth off by %.3g r in the mean, %.3g r at most; normal by %.2g",
            k[c], sum / trials, worst, bend);
        last = sum / trials;
        gsl_rng_free(r);
    }
    check(last < 0.05, "envelope at k = 0.001 within 5 %% of r in the mean: %.3g", last);
}

int main(void)
{
    check_shares();
    check_sums();
    check_sweeps();
    check_envelope();
    return check_end();
}
