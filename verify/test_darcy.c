/* verify/test_darcy.c - Darcy in time and with a source against exact solutions, and a law that
 * depends on the velocity, driven by heads. Frozen grains of 1 mm, one to a cell of 1 mm: the fluid
 * fraction is 1 - pi/6 everywhere. */
/* slots: drag/ergun porosity/divided solver/fluid/darcy */
#include <omp.h>
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

/* Two layers of grains of different sizes between two heads: the flux and the heads of cells are those of
 * layers in series, exactly, at any place of the boundary between cells. */
static void check_layers(int below)
{
    const int n = 12;
    const double h = 1e-3, finer = 0.6, H0 = 1e-10;
    const double eps = 1.0 - phi * finer * finer * finer, sigma = 1.0 - eps;
    const double K[2] = {conductivity(), rho * g * eps * eps * eps * finer * finer * d * d /
                                             (150.0 * mu * sigma * sigma)};
    char *const text = xprintf(
        "[grains coarse]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = unit_cell\nspacing = 1 "
        "mm\nto = 2 2 %d mm\nfrozen = yes\n"
        "[grains fine]\ndiameter = 0.6 mm\ndensity = 2650 kg/m3\nfill = unit_cell\nspacing = 1 "
        "mm\nfrom = 0 0 %d mm\nfrozen = yes\n"
        "[domain]\nsize = 2 2 %d mm\ncells = 2 2 %d\nx = periodic\ny = periodic\nz = head\n"
        "[side z-]\nhead = 1e-10 m\n"
        "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 1 s\n[run]\nend = 1e9 s\n",
        below, below, n, n);
    struct sim *const s = sim_from(text);
    xfree(text);
    for (int k = 0; k < 3; k++)
        step(s);
    const double U = H0 / (below * h / K[0] + (n - below) * h / K[1]);
    double lost = 0.0, worst = 0.0;
    for (int k = 1; k <= n; k++) {
        const double mine = U * h / K[k > below];
        worst = fmax(worst, fabs(head(s, k) - (H0 - lost - 0.5 * mine)) / H0);
        lost += mine;
    }
    const int c = cell(&s->grid, 2, 1, 4);
    /* Ergun's inertial part is 1e-8 of it */
    check_rel(s->fluid.u[2][c] * grid_face(s->fluid.eps, c, s->grid.sk), U, 1e-7,
              "two layers: flux");
    check(worst < 1e-8, "two layers, %d of %d cells coarse: heads within %.2g", below, n,
          worst);
    sim_free(s);
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
    check(s->fluid.divergence < 1e-10, "continuity with a source: %.2g", s->fluid.divergence);
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
    check_rel(s->fluid.u[2][c] * grid_face(s->fluid.eps, c, s->grid.sk), exact, 1e-8, what);
    xfree(what);
    sim_free(s);
    xfree(sides);
}

/* A drained layer: initial excess head, head 0 at the top, closed below. p/p0 =
 * sum 2/M sin(M Z) exp(-M^2 T), M = (2m + 1) pi/2, Z from the drained side, T = c_v t/L^2,
 * c_v = k/(mu m_v) [Terzaghi43]; the degree of consolidation U against the tabulated values. */
static void check_consolidation(void)
{
    static const double table[][2] = {/* T, U: published series, summed */
                                      {0.05, 0.25231325},
                                      {0.197, 0.50033812},
                                      {0.403, 0.70011070},
                                      {0.848, 0.89997892}};
    const int n = 32, steps = 1000;
    const double L = n * 1e-3, m_v = 3.3e-7, p0 = rho * g * 2.7e-6;
    const double c_v = conductivity() / (rho * g * m_v), dt = 0.848 * L * L / c_v / steps;
    char *const fluid =
        xprintf("compressibility = %.17g 1/Pa\nhead = 2.7 um\ndt = %.17g s\n", m_v, dt);
    struct sim *const s = column(n, "z- = wall\nz+ = head\n", fluid);
    double worst = 0.0, worst_u = 0.0, residual = 0.0;
    for (int k = 0, row = 0; k < steps; k++) {
        step(s);
        residual = fmax(residual, s->fluid.divergence);
        const double T = c_v * s->t / (L * L);
        double mean = 0.0;
        for (int i = 1; i <= n; i++) {
            const double Z = 1.0 - (i - 0.5) / n, p = s->fluid.p[cell(&s->grid, 2, 1, i)] / p0;
            double exact = 0.0;
            for (int m = 0; m < 40; m++) {
                const double M = (2 * m + 1) * PI / 2.0;
                exact += 2.0 / M * sin(M * Z) * exp(-M * M * T);
            }
            if (T > 0.05)
                worst = fmax(worst, fabs(p - exact));
            mean += p / n;
        }
        if (row < 4 && T >= table[row][0] - 1e-9) { /* U grows by dU/dT from the tabled T */
            double rate = 0.0;
            for (int m = 0; m < 40; m++) {
                const double M = (2 * m + 1) * PI / 2.0;
                rate += 2.0 * exp(-M * M * T);
            }
            const double U = 1.0 - mean - rate * (T - table[row][0]);
            worst_u = fmax(worst_u, fabs(U / table[row][1] - 1.0));
            row++;
        }
    }
    check(residual < 1e-10, "consolidation: continuity with storage %.2g", residual);
    check(worst < 5e-3, "consolidation: head within %.2g of the first, against the series",
          worst);
    check(worst_u < 5e-3, "consolidation: U against Terzaghi's table: %.2g off", worst_u);
    xfree(fluid);
    sim_free(s);
}

/* A box without grains, of a given conductivity. */
static struct sim *aquifer(int n, const char *more)
{
    char *const text = xprintf(
        "[domain]\nsize = 99 99 7 m\ncells = %d %d 1\nx = head\ny = head\nz = wall\n"
        "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 10 s\n%s[run]\nend = 1e9 s\n",
        n, n, more);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

/* Thiem: h(r) - h(R) = Q/(2 pi T) ln(R/r), T = K L, around a steady well in the middle of a square
 * whose sides hold the head 0 (their images change the difference by less than (r/99 m)^4). */
static double thiem(int n, double ratio)
{
    const double Q = 3.7e-3, T = 2.3e-4 * 7.0;
    struct sim *const s =
        aquifer(n, "conductivity = 2.3e-4 2.3e-4 1e-6 m/s\n[well main]\n"
                   "from = 49.5 49.5 0 m\nto = 49.5 49.5 7 m\nrate = 3.7 l/s\n");
    step(s);
    step(s);
    const int middle = n / 2 + 1, r = 3 * n / 99, R = (int)(ratio * r);
    const double *const p = s->fluid.p;
    const double drop =
        (p[cell(&s->grid, middle + r, middle, 1)] - p[cell(&s->grid, middle, middle + R, 1)]) /
        (rho * g);
    sim_free(s);
    return 2.0 * PI * T * drop / Q / log(ratio) - 1.0;
}

/* Wells with a ramp: what they give leaves through the sides. */
static void check_wells(void)
{
    struct sim *const s =
        aquifer(33, "conductivity = 1e-4 3e-4 1e-4 m/s\n[well slant]\nfrom = 10.3 20.1 1 m\n"
                    "to = 71.9 83.3 5 m\nrate = 5 l/s\nramp = 40 s\n"
                    "[well point]\nfrom = 80.2 11.7 3 m\nrate = -1.3 l/s\n");
    for (int k = 1; k <= 5; k++) {
        step(s);
        double out = 0.0;
        for (int a = 0; a < 2; a++)
            for (int i = 1; i <= 33; i++) {
                const int lo = cell(&s->grid, a ? i : 1, a ? 1 : i, 1);
                const int hi = lo + 33 * s->grid.s[a];
                out += (s->fluid.u[a][hi] - s->fluid.u[a][lo]) * 3.0 * 7.0;
            }
        const double want = 5e-3 * fmin(1.0, s->t / 40.0) - 1.3e-3;
        check_rel(out, want, 1e-9, "two wells, one ramped: flow through the sides");
    }
    sim_free(s);
}

static double slope_of(int a) /* of the head, in the box of check_direction */
{
    static const double size[3] = {4e-3, 6e-3, 5e-3};
    return 12e-6 / size[a];
}

/* A given conductivity along each direction: flux K i, and the grains bear the whole gradient. */
static void check_direction(int a, const char *keys, double K)
{
    static const char *const sides[3] = {
        "x = head\ny = periodic\nz = wall\n[side x-]\nhead = 12 um\n",
        "x = wall\ny = head\nz = wall\n[side y-]\nhead = 12 um\n",
        "x = wall\ny = periodic\nz = head\n[side z-]\nhead = 12 um\n"};
    char *const text = xprintf(
        "[grains bed]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = unit_cell\nspacing = 1 "
        "mm\n"
        "frozen = yes\n[domain]\nsize = 4 6 5 mm\ncells = 4 6 5\n%s[fluid]\ndensity = 1000 "
        "kg/m3\nviscosity = 1 mPa s\ndt = 1 s\n%s[run]\nend = 1e9 "
        "s\n",
        sides[a], keys);
    struct sim *const s = sim_from(text);
    xfree(text);
    for (int k = 0; k < 3; k++)
        step(s);
    const double slope = slope_of(a);
    const int c = cell(&s->grid, 2, 3, 2);
    check_rel(s->fluid.u[a][c] * grid_face(s->fluid.eps, c, s->grid.s[a]), K * slope, 1e-6,
              "flux along one direction");
    const double force[3] = {s->coupling.to_grains.x, s->coupling.to_grains.y,
                             s->coupling.to_grains.z};
    const double want = rho * g * slope * 4e-3 * 6e-3 * 5e-3;
    check_rel(force[a], want, 1e-9, "and the grains bear its pressure gradient");
    sim_free(s);
}

static void check_anisotropy(void)
{
    const char *const given = "conductivity = 0.31 0.011 2.7 mm/s\n";
    const char *const ratio = "anisotropy = 1.7 0.23 4.1\n";
    static const double K[3] = {3.1e-4, 1.1e-5, 2.7e-3}, factor[3] = {1.7, 0.23, 4.1};
    for (int a = 0; a < 3; a++) {
        check_direction(a, given, K[a]);
        /* (a U + b U^2)/factor = rho g i */
        const double eps = 1.0 - phi, e3 = eps * eps * eps,
                     drive = factor[a] * rho * g * slope_of(a);
        const double A = 150.0 * mu * phi * phi / (e3 * d * d), B = 1.75 * rho * phi / (e3 * d);
        const double flux = 2.0 * drive / (A + sqrt(A * A + 4.0 * B * drive));
        check_direction(a, ratio, flux / slope_of(a));
    }
}

int main(void)
{
    omp_set_num_threads(1); /* small boxes; threads are for test_poisson and the scenes */
    const double coarse = transient(50), fine = transient(100);
    check(fine < 2e-3, "head after a sudden rise, against the exact series: %.3g off", fine);
    check(coarse / fine > 1.7, "first order in time: %.3g and %.3g", coarse, fine);
    check_source();
    check_layers(5);
    check_layers(8);
    check_consolidation();
    static const double ratios[2] = {2.0, 5.0};
    for (int i = 0; i < 2; i++) {
        const double wide = thiem(99, ratios[i]), narrow = thiem(165, ratios[i]);
        const double order = log(fabs(wide / narrow)) / log(165.0 / 99.0);
        check(fabs(narrow) < 6e-3 && order > 1.8 && order < 2.5,
              "Thiem's well, radii 1 to %g: %.2g and, with finer cells, %.2g off: order %.2f",
              ratios[i], wide, narrow, order);
    }
    check_wells();
    check_anisotropy();
    check_ergun(1e-4);
    check_ergun(1.0);
    check_ergun(1e4);
    return check_end();
}
