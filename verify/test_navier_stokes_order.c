/* verify/test_navier_stokes_order.c - orders of accuracy of the fluid: in time, with explicit
 * and implicit viscosity and steps that change; in space, Womersley's channel, Brinkman's, the
 * lid-driven cavity, and a manufactured flow among porosities that vary (forms a, b, c). */
/* slots: drag/ergun porosity/divided solver/fluid/navier_stokes contact/linear */
#include <complex.h>
#include <omp.h>
#include <string.h>
#include "../solver/fluid_state.h"
#include "check.h"
#include "harness.h"

static void check_order(const char *what, double coarse, double fine, double least)
{
    check(log2(coarse / fine) > least, "%s: errors %.3g and %.3g, order %.2f", what, coarse,
          fine, log2(coarse / fine));
}

/* Vortices carried along, 12 x 12 cells, at t = 0.4 in `steps` steps, of changing length or
 * not. */
static void carried_vortices(int steps, const char *viscous, bool uneven, double *out)
{
    char *const text = xprintf(
        "[domain]\nsize = 1 1 1 m\ncells = 12 12 1\nx = periodic\ny = periodic\nz = periodic\n"
        "[fluid]\ndensity = 1.3 kg/m3\nviscosity = 0.02 Pa s\ndt = %.17g s\n"
        "convection = centred\nviscous = %s\n[run]\nend = 1e9 s\nforce = on\n",
        0.4 / steps, viscous);
    struct sim *const s = sim_from(text);
    const struct grid *const g = &s->grid;
    const double k = 2.0 * PI, dt = s->fluid.dt;
    for (int j = 1; j <= 12; j++)
        for (int i = 1; i <= 12; i++) {
            const double x = (i - 1) / 12.0, y = (j - 1) / 12.0, half = 1.0 / 24.0;
            s->fluid.u[0][cell(g, i, j, 1)] = 0.31 + 0.4 * sin(k * x) * cos(k * (y + half));
            s->fluid.u[1][cell(g, i, j, 1)] = -0.17 - 0.4 * cos(k * (x + half)) * sin(k * y) +
                                              0.1 * cos(2.0 * k * (x + half));
        }
    for (int n = 0; n < steps; n++) {
        s->fluid.dt = uneven ? (n % 2 ? 1.3 : 0.7) * dt : dt;
        fluid_step(s);
        s->t += s->fluid.dt;
    }
    for (int j = 0; j < 12; j++)
        for (int i = 0; i < 12; i++)
            out[12 * j + i] = s->fluid.u[0][cell(g, i + 1, j + 1, 1)];
    sim_free(s);
    xfree(text);
}

/* Flow into a channel with walls, its inflow growing, 10 x 8 cells. */
static void growing_channel(int steps, const char *viscous, bool uneven, double *out)
{
    (void)uneven;
    char *const text =
        xprintf("[domain]\nsize = 1 0.8 1 m\ncells = 10 8 1\nx- = inflow\nx+ = outflow\n"
                "z = periodic\n[flow]\nvelocity = 0.5 m/s\nramp = 1 s\nprofile = parabolic\n"
                "[fluid]\ndensity = 1.3 kg/m3\nviscosity = 0.02 Pa s\ndt = %.17g s\n"
                "convection = centred\nviscous = %s\n[run]\nend = 1e9 s\nforce = on\n",
                0.4 / steps, viscous);
    struct sim *const s = sim_from(text);
    for (int n = 0; n < steps; n++)
        step(s);
    memset(out, 0, 144 * sizeof *out);
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < 10; i++)
            out[10 * j + i] = s->fluid.u[0][cell(&s->grid, i + 1, j + 1, 1)];
    sim_free(s);
    xfree(text);
}

static double apart(const double *a, const double *b)
{
    double most = 0.0;
    for (int i = 0; i < 144; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* Order in time from three numbers of steps. */
static void check_time(const char *what, void (*flow)(int, const char *, bool, double *),
                       const char *viscous, bool uneven)
{
    double a[144], b[144], c[144];
    flow(20, viscous, uneven, a);
    flow(40, viscous, uneven, b);
    flow(80, viscous, uneven, c);
    check_order(what, apart(a, b), apart(b, c), 1.8);
}

/* Womersley's channel of n cells: largest error over a period, started on the exact flow. */
static double womersley(int n, int steps, const char *viscous)
{
    const double A = 0.7, T = 2.3, rho = 1.3, nu = 0.11, h = 0.6, omega = 2.0 * PI / T;
    char *const text = xprintf(
        "[domain]\nsize = 1 %.17g 1 m\ncells = 1 %d 1\nx = periodic\nz = periodic\n"
        "[flow]\npressure_gradient = %.17g 0 0 Pa/m\nperiod = %.17g s\n"
        "[fluid]\ndensity = %g kg/m3\nviscosity = %.17g Pa s\ndt = %.17g s\nviscous = %s\n"
        "[run]\nend = 1e9 s\nforce = on\n",
        2.0 * h, n, A * rho, T, rho, nu * rho, T / steps, viscous);
    struct sim *const s = sim_from(text);
    const double complex imaginary = (double complex)I;
    const double complex k = csqrt(imaginary * omega / nu);
    double worst = 0.0, fastest = 0.0;
    for (int m = 0; m <= steps; m++) {
        for (int j = 1; j <= n; j++) {
            const double y = (j - 0.5) * 2.0 * h / n - h;
            const double exact =
                creal(A / (imaginary * omega) * (1.0 - ccosh(k * y) / ccosh(k * h)) *
                      cexp(imaginary * omega * s->t));
            double *const u = &s->fluid.u[0][cell(&s->grid, 1, j, 1)];
            if (m == 0)
                *u = exact;
            worst = fmax(worst, fabs(*u - exact));
            fastest = fmax(fastest, fabs(exact));
        }
        if (m < steps)
            step(s);
    }
    sim_free(s);
    xfree(text);
    return worst / fastest;
}

/* A channel full of an even bed [Brinkman49]: eps mu u'' - B u + eps G = 0 between walls at rest, so that
 * u = eps G/B (1 - cosh(s (y/H - 1/2))/cosh(s/2)), s^2 = B H^2/(eps mu). Largest error of the steady
 * velocity over eps G/B. */
static double brinkman(int n, double s_H, const char *form, const char *viscous)
{
    const double H = 1.2, mu = 0.3, eps = 0.45, G = 0.8, B = s_H * s_H * eps * mu / (H * H);
    const bool implicit = viscous[0] == 'i';
    const double dt = implicit ? 0.2 : 0.2 * H * H / (n * n * mu);
    char *const text =
        xprintf("[domain]\nsize = 1 %g 1 m\ncells = 1 %d 1\nx = periodic\nz = periodic\n"
                "[grains g]\ndiameter = 1 mm\ndensity = 2 kg/m3\nfill = point\n"
                "position = 0.5 0.5 0.5 m\nfrozen = yes\nmaterial = m\n[material m]\n"
                "stiffness = 100 N/m\nrestitution = 0.6\nfriction = 0.4\n"
                "[flow]\npressure_gradient = %g 0 0 Pa/m\n[fluid]\ndensity = 1 kg/m3\n"
                "viscosity = %g Pa s\ndt = %.17g s\nform = %s\nviscous = %s\n"
                "[run]\nend = 1e9 s\nforce = on\n",
                H, n, G, mu, dt, form, viscous);
    struct sim *const s = sim_from(text);
    double worst = 0.0;
    for (size_t c = 0; c < s->grid.total; c++) {
        s->fluid.eps[c] = s->fluid.eps_old[c] = eps;
        for (int a = 0; a < 3; a++)
            s->fluid.drag[a][c] = B;
    }
    for (int m = 0; m < (implicit ? 400 : 10 * n * n); m++)
        fluid_step(s);
    for (int j = 1; j <= n; j++) {
        const double y = (j - 0.5) / n - 0.5, u = s->fluid.u[0][cell(&s->grid, 1, j, 1)];
        worst = fmax(worst, fabs(u * B / (eps * G) - 1.0 + cosh(s_H * y) / cosh(0.5 * s_H)));
    }
    sim_free(s);
    xfree(text);
    return worst;
}

static void check_brinkman(const char *form, const char *viscous, double s_H)
{
    char *const what = xprintf("Brinkman's channel, H/sqrt(K) = %g, form %s, %s viscosity", s_H,
                               form, viscous);
    const int n =
        (int)(5.0 *
              s_H); /* so many cells in the layers at the walls, 1/s thick, that h^2 leads */
    const double fine = brinkman(2 * n, s_H, form, viscous);
    check_order(what, brinkman(n, s_H, form, viscous), fine, 1.8);
    xfree(what);
}

/* u on the vertical centre line of the cavity at Re = 100, at y = 1/2 and y = 0.171875, against
 * the converged values of verify/reference/lid_cavity.csv. */
static double cavity(int n)
{
    char *const text = xprintf("[domain]\nsize = 1 1 1 m\ncells = %d %d 1\nz = periodic\n"
                               "[side y+]\nvelocity = 1 0 0 m/s\n"
                               "[fluid]\ndensity = 1 kg/m3\nviscosity = 0.01 Pa s\n"
                               "dt = %g s\nconvection = centred\n[run]\nend = 1e9 s\n",
                               n, n, 5.12 / (n * n));
    struct sim *const s = sim_from(text);
    const struct grid *const g = &s->grid;
    for (int m = 0; m < 20 * n * n / 5; m++)
        step(s);
    const int c = cell(g, n / 2 + 1, n / 2, 1);
    const double middle = 0.5 * (s->fluid.u[0][c] + s->fluid.u[0][c + g->sj]);
    sim_free(s);
    xfree(text);
    return fabs(middle + 0.20915);
}

/* ---- a manufactured flow: eps, u, p given, periodic unit square, rho = 1 ---- */

enum { NODES = 4 }; /* on each side of the differences of eighth order */
static const double mms_mu = 0.05, mms_wave = 2.0 * PI;
static enum { A, B, C } mms_form;

static double mms_eps(double x, double y)
{
    return 0.6 + 0.2 * sin(mms_wave * x) * sin(mms_wave * y);
}

static double mms_u(int a, double x, double y)
{
    const double flow =
        a == 0 ? cos(mms_wave * x) * sin(mms_wave * y) : -sin(mms_wave * x) * cos(mms_wave * y);
    return flow / mms_eps(x, y);
}

static double mms_p(double x, double y)
{
    return cos(2.0 * mms_wave * x) + cos(2.0 * mms_wave * y);
}

static double mms_drag(double x, double y) /* B, kg/(m3 s): Ergun's, d = 0.1 m */
{
    const double e = mms_eps(x, y), d = 0.1;
    const double speed = hypot(mms_u(0, x, y), mms_u(1, x, y));
    return 150.0 * (1.0 - e) * (1.0 - e) * mms_mu / (e * d * d) + 1.75 * (1.0 - e) * speed / d;
}

/* df/dx_b of a function of place with an index. */
static double slope(double (*f)(int, double, double), int index, int b, double x, double y)
{
    static const double weight[NODES] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
    const double h = 1e-3;
    double sum = 0.0;
    for (int k = 1; k <= NODES; k++) {
        const double dx = b == 0 ? k * h : 0.0, dy = b == 1 ? k * h : 0.0;
        sum += weight[k - 1] * (f(index, x + dx, y + dy) - f(index, x - dx, y - dy));
    }
    return sum / h;
}

static double pressure_at(int index, double x, double y)
{
    (void)index;
    return mms_p(x, y);
}

static double momentum_flux(int index, double x, double y) /* eps u_a u_b */
{
    return mms_eps(x, y) * mms_u(index / 2, x, y) * mms_u(index % 2, x, y);
}

static double stress(int index, double x, double y) /* tau_ab */
{
    const int a = index / 2, b = index % 2;
    const double div = slope(mms_u, 0, 0, x, y) + slope(mms_u, 1, 1, x, y);
    return mms_mu * (slope(mms_u, a, b, x, y) + slope(mms_u, b, a, x, y) -
                     (a == b ? 2.0 / 3.0 * div : 0.0));
}

static double eps_stress(int index, double x, double y)
{
    return mms_eps(x, y) * stress(index, x, y);
}

/* What has to push so that the flow is steady, N/m3. */
static double mms_source(int a, double x, double y)
{
    const double eps = mms_eps(x, y);
    double sum = (mms_form == C ? 1.0 : eps) * slope(pressure_at, 0, a, x, y);
    for (int b = 0; b < 2; b++) {
        sum += slope(momentum_flux, 2 * a + b, b, x, y);
        sum -= mms_form == A ? eps * slope(stress, 2 * a + b, b, x, y)
                             : slope(eps_stress, 2 * a + b, b, x, y);
    }
    return sum + mms_drag(x, y) * mms_u(a, x, y);
}

/* The grid's porosity, drag and source, in place of what grains would give. */
static void mms_fill(struct sim *s, int n)
{
    struct fluid *const f = &s->fluid;
    const struct grid *const g = &s->grid;
    for (int k = 0; k <= 2; k++)
        for (int j = 0; j <= n + 1; j++)
            for (int i = 0; i <= n + 1; i++) {
                const int c = cell(g, i, j, k);
                const double x = (i - 0.5) / n, y = (j - 0.5) / n, half = 0.5 / n;
                f->eps[c] = f->eps_old[c] = mms_eps(x, y);
                f->p[c] = mms_p(x, y);
                for (int a = 0; a < 3; a++) {
                    const double xf = a == 0 ? x - half : x, yf = a == 1 ? y - half : y;
                    f->drag[a][c] = mms_drag(xf, yf);
                    f->drag_s[a][c] = a < 2 && k == 1 ? mms_source(a, xf, yf) : 0.0;
                    f->u[a][c] = a < 2 ? mms_u(a, xf, yf) : 0.0;
                }
            }
}

struct error {
    double u, p;
};

static struct error manufactured(int n, const char *form, const char *convection,
                                 const char *viscous)
{
    char *const text = xprintf(
        "[grains g]\ndiameter = 0.01 m\ndensity = 2 kg/m3\nfill = point\nposition = 0.5 0.5 "
        "0.5 m\n"
        "frozen = yes\nmaterial = m\n[material m]\nstiffness = 100 N/m\nrestitution = 0.6\n"
        "friction = 0.4\n"
        "[domain]\nsize = 1 1 1 m\ncells = %d %d 1\nx = periodic\ny = periodic\nz = periodic\n"
        "[fluid]\ndensity = 1 kg/m3\nviscosity = %g Pa s\ndt = %.17g s\nconvection = %s\n"
        "form = %s\nviscous = %s\n[run]\nend = 1e9 s\nforce = on\n",
        n, n, mms_mu, 0.05 / n, convection, form, viscous);
    struct sim *const s = sim_from(text);
    struct error e = {0.0, 0.0};
    double mean = 0.0;
    mms_fill(s, n);
    for (int m = 0; m < 6 * n; m++)
        fluid_step(s);
    for (int j = 1; j <= n; j++)
        for (int i = 1; i <= n; i++)
            mean += s->fluid.p[cell(&s->grid, i, j, 1)] / (n * n);
    for (int j = 1; j <= n; j++)
        for (int i = 1; i <= n; i++) {
            const int c = cell(&s->grid, i, j, 1);
            const double x = (i - 0.5) / n, y = (j - 0.5) / n, half = 0.5 / n;
            const double du = s->fluid.u[0][c] - mms_u(0, x - half, y);
            const double dv = s->fluid.u[1][c] - mms_u(1, x, y - half);
            const double dp = s->fluid.p[c] - mean - mms_p(x, y);
            e.u += (du * du + dv * dv) / (n * n);
            e.p += dp * dp / (n * n);
        }
    check(s->fluid.divergence < 1e-10, "  continuity: %.2g", s->fluid.divergence);
    sim_free(s);
    xfree(text);
    return (struct error){sqrt(e.u), sqrt(e.p)};
}

static void check_manufactured(const char *form, const char *convection, const char *viscous)
{
    mms_form = form[0] == 'a' ? A : form[0] == 'b' ? B : C;
    const struct error coarse = manufactured(16, form, convection, viscous);
    const struct error fine = manufactured(32, form, convection, viscous);
    char *const what =
        xprintf("manufactured, form %s, %s, %s viscosity", form, convection, viscous);
    char *const velocity = xprintf("%s: u", what), *const pressure = xprintf("%s: p", what);
    check_order(velocity, coarse.u, fine.u, 1.8);
    check_order(pressure, coarse.p, fine.p, 1.5);
    xfree(what);
    xfree(velocity);
    xfree(pressure);
}

int main(void)
{
    omp_set_num_threads(1); /* small grids: a team would only wait */
    check_time("in time, vortices, explicit", carried_vortices, "explicit", false);
    check_time("in time, vortices, implicit", carried_vortices, "implicit", false);
    check_time("in time, vortices, explicit, uneven steps", carried_vortices, "explicit", true);
    check_time("in time, growing inflow, explicit", growing_channel, "explicit", false);
    check_time("in time, growing inflow, implicit", growing_channel, "implicit", false);
    check_order("Womersley, explicit", womersley(16, 800, "explicit"),
                womersley(32, 3200, "explicit"), 1.8);
    check_order("Womersley, implicit", womersley(32, 320, "implicit"),
                womersley(64, 640, "implicit"), 1.8);
    check_order("cavity, Re 100, middle", cavity(16), cavity(32), 1.7);
    check_manufactured("a", "centred", "explicit");
    check_manufactured("b", "centred", "explicit");
    check_manufactured("c", "centred", "explicit");
    check_manufactured("a", "centred", "implicit");
    check_brinkman("a", "implicit", 5.2);
    check_brinkman("b", "implicit", 11.0);
    check_brinkman("a", "explicit", 2.4);
    check_manufactured("b", "centred", "implicit");
    return check_end();
}
