/* verify/test_drag_steps.c - drag and the fluid's step: implicit drag sets no limit, explicit drag does,
 * at twice the relaxation time, and the run that passes it says so. */
/* slots: drag/stokes porosity/trilinear solver/fluid/navier_stokes */
#include <omp.h>
#include <string.h>
#include <sys/wait.h>
#include "check.h"
#include "harness.h"

/* Silica of 13 um in water, one to a cell or so, two-way: m/kappa = 25 us. */
static const double d = 13e-6, rho_p = 2650.0, rho = 998.0, mu = 1.002e-3;

static struct sim *silica(const char *drag, double dt, double depth)
{
    char *const text = xprintf(
        "[domain]\nsize = 800 800 1600 um\ncells = 4 4 8\nx = periodic\ny = periodic\nz- = "
        "slip\n"
        "z+ = outflow\n[fluid]\ndensity = %g kg/m3\nviscosity = %g Pa s\ndt = %.17g s\n"
        "[grains silica]\ndiameter = %g m\ndensity = %g kg/m3\nfill = random\ncount = 2000\n"
        "from = 0 0 %g um\n[coupling]\ndrag = %s\n[run]\nend = 1 s\nforce = on\n",
        rho, mu, dt, d, rho_p, depth, drag);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

static double mean_velocity(const struct sim *s)
{
    double sum = 0.0;
    for (int i = 0; i < s->grains.n; i++)
        sum += s->grains.vel[i].z / s->grains.n;
    return sum;
}

/* At 40 relaxation times a step: the velocity of a fine step, whatever the step. */
static void test_implicit(void)
{
    double velocity[3];
    const double dt[3] = {5e-6, 1e-3, 1e-2};
    const double tau = rho_p * d * d / (18.0 * mu);
    for (int k = 0; k < 3; k++) {
        struct sim *const s = silica("implicit", dt[k], 800.0);
        const int steps = k == 0 ? 400 : 2 + 8 * (k == 1);
        for (int t = 0; t < steps; t++)
            step(s);
        velocity[k] = mean_velocity(s);
        check(s->ledger.handover_error < 1e-9, "  handed over but for %.1e",
              s->ledger.handover_error);
        char *const what = xprintf("13 um silica, a step of %g s = %.3g relaxation times: m/s",
                                   dt[k], dt[k] / tau);
        check_rel(velocity[k], velocity[0], 0.02, what);
        xfree(what);
        sim_free(s);
    }
    const double alone = -(rho_p - rho) * 9.81 * d * d / (18.0 * mu);
    printf("    %.4g m/s; one alone in endless water falls with %.4g m/s\n", velocity[0],
           alone);
}

/* The relaxation as the program has it at this step. */
static double relaxation(double dt)
{
    struct sim *const s = silica("implicit", dt, 800.0);
    fluid_sense(s);
    const double r = s->coupling.relaxation;
    sim_free(s);
    return r;
}

/* Exit status of an explicit run in a child; its velocity goes to *out. */
static int explicit_run(double dt, int steps, double *out, char *words, size_t room)
{
    int pipes[2], status = 0;
    if (pipe(pipes) != 0)
        return -1;
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        dup2(pipes[1], STDERR_FILENO);
        struct sim *const s = silica("explicit", dt, 800.0);
        for (int t = 0; t < steps; t++)
            step(s);
        fprintf(stderr, "%.17g", mean_velocity(s));
        _exit(0);
    }
    close(pipes[1]);
    size_t n = 0;
    for (ssize_t got; n + 1 < room && (got = read(pipes[0], words + n, room - 1 - n)) > 0;)
        n += (size_t)got;
    words[n] = '\0';
    close(pipes[0]);
    waitpid(child, &status, 0);
    *out = strtod(words, NULL);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void test_explicit(void)
{
    char words[1024];
    double fine, coarse;
    const double limit = 2.0 / relaxation(1.0);
    check(explicit_run(0.2 * limit, 100, &fine, words, sizeof words) == 0,
          "explicit drag at a fifth of its limit, %.3g s, runs", limit);
    check(explicit_run(0.9 * limit, 100, &coarse, words, sizeof words) == 0,
          "  at nine tenths too");
    check_rel(coarse, fine, 0.02, "  to the same velocity, m/s");
    check(explicit_run(1.02 * limit, 100, &coarse, words, sizeof words) == EXIT_UNSTABLE &&
              strstr(words, "explicit drag is unstable"),
          "  and beyond it the run is stopped: %.60s", words);
}

int main(void)
{
    omp_set_num_threads(1);
    test_implicit();
    test_explicit();
    return check_end();
}
