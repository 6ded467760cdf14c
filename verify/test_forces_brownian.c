/* verify/test_forces_brownian.c - thermal agitation against Einstein, in runs. */
/* slots: drag/stokes solver/fluid/navier_stokes forces/brownian */
#include <omp.h>
#include "check.h"
#include "harness.h"

static const double kT = 1.380649e-23 * 293.15, mu = 1.07e-3, d = 1.03e-6;

/* Spheres of a micron in still water; theta = fluid.dt over their relaxation time. */
static struct sim *suspension(int n, double theta, int seed)
{
    const double rho_p = 2650.0, tau = rho_p * d * d / (18.0 * mu);
    char *const text = xprintf(
        "[domain]\nsize = 1 1 1 mm\ncells = 3 3 3\nx = periodic\ny = periodic\nz = periodic\n"
        "gravity = 0 0 0 m/s2\n[fluid]\ndensity = 1000 kg/m3\nviscosity = %.17g Pa s\ndt = "
        "%.17g s\n"
        "[grains silica]\ndiameter = %.17g m\ndensity = %g kg/m3\ncount = %d\nfill = random\n"
        "[coupling]\nways = one\n[run]\nend = 1 s\nseed = %d\nforce = on\n",
        mu, theta * tau, d, rho_p, n, seed);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

static void test_energy(void)
{
    enum { N = 500, WAIT = 100, STEPS = 1000 };
    const double theta = 0.1;
    struct sim *const s = suspension(N, theta, 3);
    double sum = 0.0;
    for (int k = 0; k < WAIT + STEPS; k++) {
        step(s);
        for (int i = 0; i < N && k >= WAIT; i++)
            sum += v3_dot(s->grains.vel[i], s->grains.vel[i]) / (3.0 * N * STEPS);
    }
    /* 3 N components, each independent about once in 2/theta steps */
    const double sigma = sqrt(2.0 / (3.0 * N * STEPS * theta / 2.0));
    const double want = kT / s->grains.mass[0] / (1.0 + 0.5 * theta);
    char *const what =
        xprintf("<v^2> per component over that of backward Euler (kT/m less %.1f %%)",
                100.0 * (1.0 - 1.0 / (1.0 + 0.5 * theta)));
    check_abs(sum / want, 1.0, 4.0 * sigma, what);
    xfree(what);
    sim_free(s);
}

static void test_diffusion(double theta)
{
    enum { N = 500, BLOCKS = 10, STEPS = 100 };
    struct sim *const s = suspension(N, theta, 5);
    const double dt = s->fluid.dt, D = kT / (3.0 * PI * mu * d);
    double square = 0.0;
    vec3 *const moved = xalloc(N, sizeof *moved);
    for (int k = 0; k < 20; k++)
        step(s);
    for (int b = 0; b < BLOCKS; b++) {
        for (int i = 0; i < N; i++)
            moved[i] = v3(0.0, 0.0, 0.0);
        for (int k = 0; k < STEPS; k++) {
            vec3 before[N];
            for (int i = 0; i < N; i++)
                before[s->grains.id[i]] = s->grains.pos[i];
            step(s);
            for (int i = 0; i < N; i++) {
                vec3 *const m = &moved[s->grains.id[i]];
                const vec3 by = v3_sub(s->grains.pos[i], before[s->grains.id[i]]);
                *m = v3_add(*m, domain_minimum_image(&s->domain, by));
            }
        }
        for (int i = 0; i < N; i++)
            square += v3_dot(moved[i], moved[i]) / ((double)N * BLOCKS);
    }
    /* a step moves a grain by the mean of its velocities before and after: half a step is lost */
    const double want = 6.0 * D * dt * (STEPS - 0.5), sigma = sqrt(2.0 / (3.0 * N * BLOCKS));
    char *const what =
        xprintf("mean square displacement over 6 D t, step %g relaxation times", theta);
    check_abs(square / want, 1.0, 4.0 * sigma, what);
    xfree(what);
    xfree(moved);
    sim_free(s);
}

static void test_bits(void)
{
    const int team[] = {1, 2, 3, 7};
    unsigned long bits[4];
    for (int t = 0; t < 4; t++) {
        omp_set_num_threads(team[t]);
        struct sim *const s = suspension(400, 3.0, 7);
        for (int k = 0; k < 40; k++)
            step(s);
        bits[t] = sim_bits(s);
        sim_free(s);
        check(bits[t] == bits[0], "the same bits on %d threads", team[t]);
    }
    struct sim *const s = suspension(400, 3.0, 8);
    for (int k = 0; k < 40; k++)
        step(s);
    check(sim_bits(s) != bits[0], "another seed, another path");
    sim_free(s);
}

int main(void)
{
    omp_set_num_threads(1);
    test_energy();
    test_diffusion(50.0);
    test_diffusion(1000.0);
    test_bits();
    return check_end();
}
