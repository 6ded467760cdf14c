/* verify/test_hertz.c - Hertz-Mindlin in whole runs: restitution, overlap and duration of an
 * elastic impact against Hertz [ChungOoi11, tests 1 and 2], energy, momentum, oblique impacts
 * in the sliding range (test 4). */
/* slots: contact/hertz_mindlin */
#include "csv.h"
#include "two_bodies.h"

#define MATERIAL "young = 0.7e8 Pa\npoisson = 0.22\n"

/* Two equal spheres head on: reference/hertz_normal_impact.csv, test 1. The overlap is followed
 * through the largest elastic energy, E = (8/15) E* sqrt(R*) depth^(5/2). */
static void check_hertz(const char *name, double young, double nu, double density, double depth,
                        double duration)
{
    const double dt = duration / 2000.0;
    char *const text =
        xprintf("[grains a]\ndiameter = 20 mm\ndensity = %g kg/m3\nfill = point\n"
                "position = 39.9 50 50 mm\nvelocity = 10 0 0 m/s\nmaterial = m\n"
                "[grains b]\ndiameter = 20 mm\ndensity = %g kg/m3\nfill = point\n"
                "position = 60.1 50 50 mm\nvelocity = -10 0 0 m/s\nmaterial = m\n"
                "[domain]\nsize = 100 100 100 mm\ngravity = 0 0 0 m/s2\n"
                "[run]\nend = 1 s\nsubsteps = 1\ndt = %.17g s\n[material m]\nyoung = %g "
                "Pa\npoisson = %g\n"
                "restitution = 1\nfriction = 0.35\n",
                density, density, dt, young, nu);
    struct sim *const s = sim_from(text);
    long steps = 0;
    double deepest = 0.0;
    bool touched = false;
    for (;;) {
        step(s);
        if (s->neighbours.touching > 0) {
            touched = true;
            steps++;
            deepest = fmax(deepest, 0.01 * s->overlap);
        } else if (touched) {
            break;
        }
    }
    char *const what[2] = {xprintf("%s: largest overlap, m", name),
                           xprintf("%s: duration, s", name)};
    check_rel(deepest, depth, 1e-3, what[0]);
    check_rel((double)steps * dt, duration, 1e-3, what[1]);
    check_rel(s->grains.vel[grain_at(s, 1)].x, 10.0, 1e-4, "rebound speed");
    xfree(what[0]);
    xfree(what[1]);
    sim_free(s);
    xfree(text);
}

/* While the contact slides throughout: v_t' = v_t - mu (1 + e) v_n, w' = 2.5 mu (1 + e) v_n/R.
 */
static void check_sliding(double angle)
{
    const double speed = 3.9, e = 0.98, mu = 0.092, r = 2.5e-3;
    const double vt = speed * sin(angle * PI / 180.0), vn = speed * cos(angle * PI / 180.0);
    char *const text = xprintf(
        "[grains a]\ndiameter = 5 mm\ndensity = 4000 kg/m3\nfill = point\n"
        "position = 50 50 2.5005 mm\nvelocity = %.17g 0 %.17g m/s\nmaterial = m\n[domain]\n"
        "size = 100 100 100 mm\ngravity = 0 0 0 m/s2\nx = periodic\ny = periodic\n"
        "[run]\nend = 1 s\nsubsteps = 1\ndt = 5 ns\n[material m]\nyoung = 7.6e11 Pa\n"
        "poisson = 0.23\nrestitution = %g\nfriction = %g\n",
        vt, -vn, e, mu);
    struct sim *const s = sim_from(text);
    bool touched = false;
    for (;;) {
        step(s);
        touched = touched || s->neighbours.touching > 0;
        if (touched && s->neighbours.touching == 0)
            break;
    }
    char *const what = xprintf("oblique impact at %g deg: tangential velocity", angle);
    check_rel(s->grains.vel[0].x, vt - mu * (1.0 + e) * vn, 1e-3, what);
    check_rel(s->grains.spin[0].y, 2.5 * mu * (1.0 + e) * vn / r, 2e-3, "and spin");
    xfree(what);
    sim_free(s);
    xfree(text);
}

int main(void)
{
    check_restitution(MATERIAL, 5e-7);
    const struct csv *const t = csv_read("hertz_normal_impact.csv");
    for (int i = 0; i < t->n; i++)
        if (csv_value(t, i, "test") == 1.0)
            check_hertz(csv_text(t, i, "material"), csv_value(t, i, "E_Pa"),
                        csv_value(t, i, "nu"), csv_value(t, i, "rho"),
                        csv_value(t, i, "delta_max_m"), csv_value(t, i, "t_contact_s"));
    check_energy(MATERIAL, 2.5e-6);
    check_momentum(MATERIAL, 2e-7);
    check_sliding(45.0);
    check_sliding(60.0);
    return check_end();
}
