/* verify/test_darcy.c - Darcy in time and with a source against exact solutions, and a law that
 * depends on the velocity, driven by heads. Frozen grains of 1 mm, one to a cell of 1 mm: the fluid
 * fraction is 1 - pi/6 everywhere. */
/* slots: drag/ergun porosity/divided solver/fluid/darcy */
#include "check.h"
#include "harness.h"

static const double rho = 1000.0, mu = 1e-3, d = 1e-3, g = 9.81, phi = PI / 6.0;

/* Column of n cells of 1 mm with these sides and keys of the fluid. */
static struct sim *column(int n, const char *sides, const char *fluid)
{
    char *const text =
        xprintf("[grains bed]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = "
                "unit_cell\nspacing = 1 mm\n"
                "frozen = yes\n[domain]\nsize = 2 2 %d mm\ncells = 2 2 %d\nx = periodic\ny = "
                "periodic\n%s"
                "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\n%s[run]\nend = 1e9 s\n",
                n, n, sides, fluid);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

/* m/s, Ergun's laminar part at this porosity: K = rho g eps^3 d^2/(150 mu phi^2) */
static double conductivity(void)
{
    const double eps = 1.0 - phi;
    return rho * g * eps * eps * eps * d * d / (150.0 * mu * phi * phi);
}

static double head(const struct sim *s, int k)
{
    return s->fluid.p[cell(&s->grid, 1, 2, k)] / (rho * g);
}

/* Heads drop from 0 to H0 = 1 um at the foot, the top is closed:
 * H/H0 = 1 - sum 4/(pi m) sin(m pi z/2L) exp(-(m pi/2L)^2 K t/S_s), m odd [Terzaghi43]. */
static double transient(int steps)
{
    const int n = 20;
    const double L = n * 1e-3, H0 = 1e-6, S = 3.7, end = 0.2 * L * L * S / conductivity();
    char *const fluid = xprintf("storage = %.17g 1/m\ndt = %.17g s\n", S, end / steps);
    struct sim *const s = column(n, "z- = head\nz+ = wall\n[side z-]\nhead = 1 um\n", fluid);
    double worst = 0.0;
    for (int k = 0; k < steps; k++)
        step(s);
    for (int k = 1; k <= n; k++) {
        const double z = (k - 0.5) * 1e-3;
        double exact = 1.0;
        for (int m = 1; m < 60; m += 2) {
            const double w = m * PI / (2.0 * L);
            exact -= 4.0 / (PI * m) * sin(w * z) * exp(-w * w * conductivity() * s->t / S);
        }
        worst = fmax(worst, fabs(head(s, k) / H0 - exact));
    }
    sim_free(s);
    xfree(fluid);
    return worst;
}

/* Source q between two heads of 0: H = q z (L - z)/2K, exact at centres but for q h^2/8K. */
static void check_source(void)
{
    const int n = 16;
    const double L = n * 1e-3, h = 1e-3, q = 1e-5;
    struct sim *const s = column(n, "z- = head\nz+ = head\n", "source = 1e-5 1/s\ndt = 1 s\n");
    double worst = 0.0, most = 0.0;
    for (int k = 0; k < 3; k++)
        step(s);
    for (int k = 1; k <= n; k++) {
        const double z = (k - 0.5) * h,
                     exact = q * (z * (L - z) + 0.25 * h * h) / (2.0 * conductivity());
        worst = fmax(worst, fabs(head(s, k) - exact));
        most = fmax(most, exact);
    }
    check(worst < 1e-5 * most, "a source between two heads: %.2g of the largest head off",
          worst / most);
    sim_free(s);
}

/* Ergun far from its linear range, driven by a head: a U + b U^2 = rho g i. */
static void check_ergun(double gradient)
{
    const double eps = 1.0 - phi, e3 = eps * eps * eps;
    const double a = 150.0 * mu * phi * phi / (e3 * d * d), b = 1.75 * rho * phi / (e3 * d);
    const double drive = rho * g * gradient;
    const double exact = 2.0 * drive / (a + sqrt(a * a + 4.0 * b * drive));
    char *const sides =
        xprintf("z- = head\nz+ = head\n[side z-]\nhead = %.17g m\n", 6e-3 * gradient);
    struct sim *const s = column(6, sides, "dt = 1 s\n");
    for (int k = 0; k < 3; k++)
        step(s);
    const int c = cell(&s->grid, 1, 1, 3);
    char *const what = xprintf("Ergun by heads, Re %.3g: flux", rho * exact * d / mu);
    check_rel(s->fluid.u[2][c] * s->fluid.eps_f[2][c], exact, 1e-8, what);
    xfree(what);
    sim_free(s);
    xfree(sides);
}

int main(void)
{
    const double coarse = transient(50), fine = transient(100);
    check(fine < 2e-3, "head after a sudden rise, against the exact series: %.3g off", fine);
    check(coarse / fine > 1.7, "first order in time: %.3g and %.3g", coarse, fine);
    check_source();
    check_ergun(1e-4);
    check_ergun(1.0);
    check_ergun(1e4);
    return check_end();
}
