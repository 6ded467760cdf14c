/* verify/test_terzaghi_grains.c - consolidation where grains carry the load [Terzaghi43]: a column of
 * grains in water, closed below, drained above, consolidates under its own weight. The water bears
 * it at first; as it leaves, the grains take over:
 *   p/p_foot = sum 2 (-1)^m/M^2 sin(M Z) exp(-M^2 T),   M = (2m + 1) pi/2,  T = c_v t/L^2
 * with Z from the drained side, p_foot the submerged weight per area, c_v = K/(rho g m_v), and the
 * compressibility m_v as measured on the same column without water: strain over stress between
 * the two lowest layers. Nothing of this is known to the solver: its storage is zero, and what
 * the water leaves is the change of the fluid fraction as grains move. A column of n grains differs from the
 * series by its grain size, in proportion to 1/n; what two lengths extrapolate to must be it. */
/* slots: contact/linear drag/ergun porosity/trilinear solver/fluid/darcy */
#include <omp.h>
#include "check.h"
#include "harness.h"

enum { SIDE = 3, SHORT = 12, TIMES = 3, STEPS = 400 }; /* columns; layers; of T = 1, SHORT */

static const double rho = 1000.0, rho_s = 2650.0, gravity = 9.81, d = 1e-3, K = 1e-4;

/* The water flows from `start` on. */
static struct sim *column(int layers, double start, double dt)
{
    char *const text =
        xprintf("[grains bed]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = "
                "unit_cell\nspacing = 1 mm\n"
                "[material bed]\nstiffness = 3000 N/m\nrestitution = 0.3\nfriction = 0.3\n"
                "[domain]\nsize = %d %d %d mm\ncells = %d %d %d\nx = periodic\ny = periodic\n"
                "z- = wall\nz+ = head\n[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\n"
                "conductivity = 0.1 0.1 0.1 mm/s\ndt = %.17g s\n[flow]\nstart = %.17g s\n"
                "[run]\nsubsteps = 10\ndt = %.17g s\nend = 1 s\n",
                SIDE, SIDE, layers, SIDE, SIDE, layers, dt, start, 0.1 * dt);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

/* m, by which a layer (0: the lowest) came down. */
static double settlement(const struct sim *s, int layer)
{
    double sum = 0.0;
    for (int i = 0; i < s->grains.n; i++)
        if ((int)(s->grains.pos[i].z / d) == layer)
            sum += (layer + 0.5) * d - s->grains.pos[i].z;
    return sum / (SIDE * SIDE);
}

/* 1/Pa, without water */
static double compressibility(void)
{
    const double volume = PI / 6.0 * d * d * d;
    struct sim *const s = column(SHORT, 1e9, 20e-6);
    for (int k = 0; k < 2000; k++)
        step(s);
    const double strain = (settlement(s, 1) - settlement(s, 0)) / d;
    sim_free(s);
    return strain * d * d / ((SHORT - 1) * rho_s * volume * gravity);
}

static double series(double Z, double T)
{
    double sum = 0.0;
    for (int m = 0; m < 60; m++) {
        const double M = (2 * m + 1) * PI / 2.0;
        sum += (m % 2 ? -2.0 : 2.0) / (M * M) * sin(M * Z) * exp(-M * M * T);
    }
    return sum;
}

static const double at_T[TIMES] = {0.1, 0.2, 0.5};

/* p/p_foot of a column of so many layers in SHORT slices at the times at_T. */
static void consolidate(int layers, double m_v, double p[TIMES][SHORT])
{
    const double L = layers * d, c_v = K / (rho * gravity * m_v);
    const double foot = (rho_s - rho) * PI / 6.0 * gravity * L;
    const int fine = layers / SHORT, steps = STEPS * fine * fine;
    struct sim *const s = column(layers, 0.0, L * L / c_v / steps);
    for (int q = 0, k = 0; q < TIMES; q++) {
        for (; k < (int)rint(at_T[q] * steps); k++)
            step(s);
        for (int i = 0; i < layers; i++)
            p[q][i / fine] += s->fluid.p[cell(&s->grid, 2, 1, i + 1)] / (foot * fine);
    }
    check(s->fluid.divergence < 1e-8, "%d layers: continuity %.2g", layers,
          s->fluid.divergence);
    sim_free(s);
}

int main(void)
{
    omp_set_num_threads(1);
    const double m_v = compressibility();
    check_rel(m_v, d / 1500.0, 1e-3, "compressibility of a column of springs");
    double coarse[TIMES][SHORT] = {0}, fine[TIMES][SHORT] = {0};
    consolidate(SHORT, m_v, coarse);
    consolidate(2 * SHORT, m_v, fine);
    for (int q = 0; q < TIMES; q++) {
        double worst = 0.0, off[2] = {0.0, 0.0};
        for (int i = 0; i < SHORT; i++) {
            const double exact = series(1.0 - (i + 0.5) / SHORT, at_T[q]);
            off[0] = fmax(off[0], fabs(coarse[q][i] - exact));
            off[1] = fmax(off[1], fabs(fine[q][i] - exact));
            worst = fmax(worst, fabs(2.0 * fine[q][i] - coarse[q][i] - exact));
        }
        check(worst < 5e-3,
              "T = %g: pressure of the water off by %.4f of that at the foot with %d layers, "
              "%.4f "
              "with %d, %.4f extrapolated",
              at_T[q], off[0], SHORT, off[1], 2 * SHORT, worst);
        check(off[0] > 1.7 * off[1], "T = %g: by the grain size (%.2f)", at_T[q],
              off[0] / off[1]);
    }
    return check_end();
}
