/* verify/impact.h - one sphere meets the floor, or another sphere: what it has afterwards. For tests
 * that link a law of contact. */
#ifndef IMPACT_H
#define IMPACT_H

#include "check.h"
#include <omp.h>
#include "harness.h"

struct impact {
    double r, density;    /* m, kg/m3 */
    double vt, vn, spin;  /* m/s along x, towards the floor; rad/s about y */
    const char *material; /* rows of its section */
    double dt;            /* s */
    bool pair;     /* two such spheres head on, each with this vn and spin; else the floor */
    bool opposite; /* the other spins the other way */
};

struct rebound {
    double vt, vn, spin;
    double depth, duration; /* largest, m; s: the law's steps in contact */
};

static inline struct rebound impact_run(const struct impact *p)
{
    const double half = 100.0 * p->r, gap = 0.01 * p->vn * p->dt;
    char *const other = xprintf(
        "[grains b]\ndiameter = %.17g m\ndensity = %.17g kg/m3\nfill = point\nmaterial = m\n"
        "position = %.17g %.17g %.17g m\nvelocity = %.17g 0 %.17g m/s\nspin = 0 %.17g 0 "
        "rad/s\n",
        2.0 * p->r, p->density, half, half, half - p->r - gap, -p->vt, p->vn,
        p->opposite ? -p->spin : p->spin);
    char *const text = xprintf(
        "[grains a]\ndiameter = %.17g m\ndensity = %.17g kg/m3\nfill = point\nmaterial = m\n"
        "position = %.17g %.17g %.17g m\nvelocity = %.17g 0 %.17g m/s\nspin = 0 %.17g 0 rad/s\n"
        "%s[domain]\nsize = %.17g %.17g %.17g m\ngravity = 0 0 0 m/s2\nx = periodic\n"
        "y = periodic\n[run]\nend = 1 s\nsubsteps = 1\ndt = %.17g s\nspeed = %g m/s\n"
        "overlap_max = 0.5\n[material m]\n%s",
        2.0 * p->r, p->density, half, half, p->pair ? half + p->r + gap : p->r + gap, p->vt,
        -p->vn, p->spin, p->pair ? other : "", 2.0 * half, 2.0 * half, 2.0 * half, p->dt, p->vn,
        p->material);
    omp_set_num_threads(1); /* one grain: nothing to share */
    struct sim *const s = sim_from(text);
    struct rebound r = {0};
    bool touched = false;
    for (long k = 0; k < 10000000; k++) {
        step(s);
        if (s->neighbours.touching > 0) {
            touched = true;
            r.duration += p->dt;
            r.depth = fmax(r.depth, s->overlap * p->r);
        } else if (touched) {
            break;
        }
    }
    const int a = grain_at(s, 0);
    r.vt = s->grains.vel[a].x;
    r.vn = s->grains.vel[a].z;
    r.spin = s->grains.spin[a].y;
    sim_free(s);
    xfree(text);
    xfree(other);
    return r;
}

#endif
