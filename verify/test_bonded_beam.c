/* verify/test_bonded_beam.c - parallel bonds in runs: a chain of spheres, the first held, the last
 * loaded: deflection, stretch and torsion of the chain (exact for small strains), and the load at
 * which it breaks, in tension, in shear, in bending. */
/* slots: contact/linear contact/bond/parallel_bond */
#include "check.h"
#include <omp.h>
#include "csv.h"
#include "harness.h"

#define R     1e-3 /* m, of the spheres */
#define RB    0.5e-3
#define KN    1e12 /* Pa/m */
#define KS    4e11
#define SIGMA 3e7 /* Pa */
#define TAU   2e7

/* n + 1 spheres along x, the first of a frozen species. */
static struct sim *chain(int n, bool breaks)
{
    char *grains =
        xprintf("[grains held]\ndiameter = 2 mm\ndensity = 2500 kg/m3\nfill = point\n"
                "position = 2 10 10 mm\nmaterial = m\nfrozen = yes\n");
    for (int k = 1; k <= n; k++) {
        char *const longer =
            xprintf("%s[grains g%d]\ndiameter = 2 mm\ndensity = 2500 kg/m3\nfill = point\n"
                    "position = %d 10 10 mm\nmaterial = m\n",
                    grains, k, 2 + 2 * k);
        xfree(grains);
        grains = longer;
    }
    char *const strengths =
        breaks ? xprintf("bond_strength = 30 MPa\nbond_strength_shear = 20 MPa\n")
               : xprintf("bond_strength = unbreakable\nbond_strength_shear = "
                         "unbreakable\n");
    char *const text = xprintf(
        "%s[domain]\nsize = 40 20 20 mm\ngravity = 0 0 0 m/s2\n[run]\nend = 10 s\nsubsteps = "
        "1\n"
        "dt = 2e-7 s\n[material m]\nstiffness = 1 N/m\nrestitution = 1\nfriction = 0\n"
        "bond_stiffness = 1e12 Pa/m\nbond_stiffness_shear = 4e11 Pa/m\n%s[bond]\nradius = 0.5\n"
        "gap = 1 um\nstretch = 50 um\n",
        grains, strengths);
    omp_set_num_threads(1);
    struct sim *const s = sim_from(text);
    xfree(text);
    xfree(grains);
    xfree(strengths);
    return s;
}

static void drain_motion(struct sim *s, double part)
{
    for (int i = 0; i < s->grains.n; i++) {
        s->grains.vel[i] = v3_scale(1.0 - part, s->grains.vel[i]);
        s->grains.spin[i] = v3_scale(1.0 - part, s->grains.spin[i]);
    }
}

/* Steps with the motion drained, so that the chain comes to rest under its load. */
static void relax(struct sim *s, int steps, double drain)
{
    for (int k = 0; k < steps; k++) {
        step(s);
        drain_motion(s, drain);
    }
}

/* One row of the table: deflection and stretch by 1e-3 N at the tip, twist by 1e-6 N m. The chain's
 * lowest mode goes as 1/n^2 and is drained near its critical rate. */
static void check_stiffness(int n, double across, double along, double twist)
{
    const int steps = 3000 + 1000 * n * n;
    const double drain = 0.03 / (n * n) + 1e-5;
    struct sim *s = chain(n, false);
    int tip = grain_at(s, n);
    double start = s->grains.pos[tip].z;
    s->grains.load[tip] = v3(0.0, 0.0, 1e-3);
    relax(s, steps, drain);
    char *const text = xprintf("%d bonds, load at the tip: deflection, m", n);
    tip = grain_at(s, n);
    check_rel(s->grains.pos[tip].z - start, across, 1e-4, text);
    xfree(text);
    sim_free(s);
    s = chain(n, false);
    tip = grain_at(s, n);
    start = s->grains.pos[tip].x;
    s->grains.load[tip] = v3(1e-3, 0.0, 0.0);
    relax(s, 4000 * n, 0.03 / n);
    check_rel(s->grains.pos[grain_at(s, n)].x - start, along, 1e-4, "  pulled: stretch, m");
    sim_free(s);
    s = chain(n, false);
    s->grains.load_torque[grain_at(s, n)] = v3(1e-6, 0.0, 0.0);
    double turned = 0.0;
    for (int k = 0; k < 4000 * n; k++) {
        const double before = s->grains.spin[grain_at(s, n)].x;
        step(s);
        turned += 0.5 * (before + s->grains.spin[grain_at(s, n)].x) * s->run.dt;
        drain_motion(s, 0.03 / n);
    }
    check_rel(turned, twist, 1e-3, "  twisted: angle, rad");
    sim_free(s);
}

/* The load at the tip grows until a bond breaks and the tip flies off, slowly against the chain's
 * vibrations. */
static void check_break(vec3 load, vec3 torque, double want, const char *text)
{
    enum { N = 3, STEPS = 100000 };
    struct sim *const s = chain(N, true);
    double at = 0.0;
    for (int k = 0; k < STEPS && at == 0.0; k++) {
        const int tip = grain_at(s, N);
        const double now =
            want * (k < 40000 ? 0.9 * k / 40000 : 0.9 + 0.2 * (k - 40000) / 60000);
        s->grains.load[tip] = v3_scale(now, load);
        s->grains.load_torque[tip] = v3_scale(now, torque);
        relax(s, 1, 3e-3);
        if (v3_norm(s->grains.vel[tip]) > 5.0 || v3_norm(s->grains.spin[tip]) > 3e3)
            at = now;
    }
    check_rel(at, want, 1e-2, text);
    sim_free(s);
}

int main(void)
{
    const double area = PI * RB * RB, inertia = 0.25 * area * RB * RB;
    const struct csv *const t = csv_read("bonded_cantilever.csv");
    for (int i = 0; i < t->n; i++)
        if (csv_value(t, i, "N") < 8.0)
            check_stiffness((int)csv_value(t, i, "N"), csv_value(t, i, "w_tip_m"),
                            csv_value(t, i, "u_axial_m"), csv_value(t, i, "theta_torsion_rad"));
    check_break(v3(1, 0, 0), v3(0, 0, 0), SIGMA * area, "breaks in tension at, N");
    check_break(v3(0, 0, 0), v3(0, 1, 0), SIGMA * inertia / RB, "breaks in bending at, N m");
    check_break(v3(0, 0, 0), v3(1, 0, 0), TAU * 2.0 * inertia / RB,
                "breaks in torsion at, N m");
    return check_end();
}
