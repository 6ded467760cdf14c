/* verify/test_terzaghi_grains.c - consolidation where grains carry the load [Terzaghi43]: a column of
 * grains in water, closed below, drained above, is loaded by a plate. The water bears the load at
 * first; as it leaves, the grains take over. The stiffness of the bed is measured without water:
 *   m_v = settlement/(length stress),  c_v = K/(rho g m_v),  T = c_v t/L^2
 *   p/p0 = sum 2/M sin(M Z) exp(-M^2 T),  U = 1 - sum 2/M^2 exp(-M^2 T),  M = (2m + 1) pi/2
 * with Z from the drained side. Nothing of this is known to the solver: storage is zero, what the water
 * leaves is the change of the fluid fraction as grains move. */
/* slots: contact/linear drag/ergun porosity/divided solver/fluid/darcy */
#include <omp.h>
#include "check.h"
#include "harness.h"

static const double rho = 1000.0, gravity = 9.81, d = 1e-3, K = 1e-4, stress = 1370.0;
enum { LAYERS = 24, SIDE = 3 };

/* The column under its plate; the water flows from `start` on. */
static struct sim *column(double start, double dt, int substeps)
{
    char *const text = xprintf(
        "[grains bed]\ndiameter = 1 mm\ndensity = 2650 kg/m3\nfill = unit_cell\nspacing = 1 mm\n"
        "[material bed]\nstiffness = 3000 N/m\nrestitution = 0.3\nfriction = 0.3\n"
        "[domain]\nsize = %d %d %d mm\ncells = %d %d %d\ngravity = 0 0 0 m/s2\nx = periodic\n"
        "y = periodic\nz- = wall\nz+ = head\n"
        "[wall plate]\npoint = 0 0 %d mm\nnormal = 0 0 -1\ndirection = 0 0 -1\nstress = %.17g Pa\n"
        "speed_max = 0.03 m/s\n"
        "[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\nconductivity = 0.1 0.1 0.1 mm/s\n"
        "dt = %.17g s\n[flow]\nstart = %.17g s\n[run]\nsubsteps = %d\ndt = %.17g s\nend = 1 s\n",
        SIDE, SIDE, LAYERS, SIDE, SIDE, LAYERS, LAYERS, stress, dt, start, substeps, dt / substeps);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

/* m, by which the highest layer came down. */
static double settlement(const struct sim *s)
{
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < s->grains.n; i++)
        if (s->grains.pos[i].z > (LAYERS - 1) * d) {
            sum += (LAYERS - 0.5) * d - s->grains.pos[i].z;
            n++;
        }
    return sum / n;
}

int main(int argc, char **argv)
{
    omp_set_num_threads(1);
    const double dt = argc > 1 ? atof(argv[1]) : 20e-6;
    const int sub = argc > 2 ? atoi(argv[2]) : 10;
    struct sim *s = column(1e9, dt, sub);
    for (int k = 0; k < (int)(0.05/dt); k++)
        {step(s); if ((k < 30 || k > 190) && k < 215) printf("%g %g force %g shift %g speed %g top %g n %d %s\n", s->t, settlement(s), s->walls.wall[s->walls.n - 1].force.z, s->walls.wall[s->walls.n - 1].pose.shift.z, s->walls.wall[s->walls.n - 1].state.speed, s->grains.pos[s->grains.n-1].z, s->walls.n, s->walls.wall[s->walls.n - 1].name);}
    const double most = settlement(s), L = LAYERS * d;
    sim_free(s);
    const double c_v = K / (rho * gravity) * (L - 0.5 * d) * stress / most;
    printf("settle %g m strain %g; c_v %g; T=1 at %g s\n", most, most / L, c_v, L * L / c_v);
    s = column(0.0, dt, sub);
    const int steps = (int)(L * L / c_v / dt);
    for (int k = 0; k < steps; k++) {
        step(s);
        if (k % (steps / 20) == 0) {
            const double T = c_v * s->t / (L * L);
            double worst = 0.0, U = 1.0, mean = 0;
            for (int m = 0; m < 40; m++) {
                const double M = (2 * m + 1) * PI / 2.0;
                U -= 2.0 / (M * M) * exp(-M * M * T);
            }
            for (int i = 1; i <= LAYERS; i++) {
                const double Z = 1.0 - (i - 0.5) / LAYERS;
                const double p = s->fluid.p[cell(&s->grid, 2, 1, i)] / stress;
                double exact = 0.0;
                for (int m = 0; m < 40; m++) {
                    const double M = (2 * m + 1) * PI / 2.0;
                    exact += 2.0 / M * sin(M * Z) * exp(-M * M * T);
                }
                worst = fabs(p - exact) > fabs(worst) ? p - exact : worst; mean += p / LAYERS;
            }
            printf("T %.4f U %.4f settlement %.4f pressure %.4f worst head %.4f relax %g\n", T, U, settlement(s) / most, 1 - mean, worst, s->coupling.relaxation);
        }
    }
    return check_end();
}
