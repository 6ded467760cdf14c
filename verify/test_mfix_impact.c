/* verify/test_mfix_impact.c - a sphere falls on a floor, linear law: MFiX's cases DEM01 (a contact
 * with gravity, exact) and DEM02 (heights of bounces of hard spheres, h_k = (h_0 - r) e^(2k) + r). */
/* slots: contact/linear */
#include "../solver/restitution.h"
#include "impact.h"

static struct sim *drop(double k, double e, double dt)
{
    char *const text = xprintf(
        "[grains a]\ndiameter = 0.2 m\ndensity = 2600 kg/m3\nfill = point\nmaterial = m\n"
        "position = 1 1 0.5 m\n[domain]\nsize = 2 2 2 m\ngravity = 0 0 -9.80665 m/s2\n"
        "[run]\nend = 20 s\nsubsteps = 1\ndt = %.17g s\nspeed = 3 m/s\noverlap_max = 0.999\n"
        "[material m]\nstiffness = 1e4 N/m\nrestitution = %.17g\nfriction = 0\n"
        "[pair m-m]\nstiffness = %.17g N/m\n",
        dt, e, k);
    omp_set_num_threads(1);
    struct sim *const s = sim_from(text);
    xfree(text);
    return s;
}

/* The damped oscillator with gravity, let go where its force is zero: the law's own, by small
 * steps of the exact solution. */
static void exact(double k, double e, double *v_out, double *lowest)
{
    const double g = 9.80665, m = 2600.0 * 4.0 / 3.0 * PI * 1e-3, zeta = damping_ratio(e);
    const double w0 = sqrt(k / m), wd = w0 * sqrt(1.0 - zeta * zeta), n = zeta * w0;
    const double v0 = sqrt(2.0 * g * 0.4), sag = m * g / k;
    const double b = (v0 - n * sag) / wd;
    *lowest = 0.1;
    for (double t = 1e-9; t < 1.0; t += 2e-7) {
        const double x =
            sag + exp(-n * t) * (-sag * cos(wd * t) + b * sin(wd * t)); /* overlap */
        const double v =
            exp(-n * t) * ((n * sag + b * wd) * cos(wd * t) + (sag * wd - n * b) * sin(wd * t));
        *lowest = fmin(*lowest, 0.1 - x);
        if (k * x + 2.0 * n * m * v <= 0.0 && t > 1e-3) {
            *v_out = -v;
            return;
        }
    }
}

static void check_contact(double k, double e)
{
    double want_v = 0.0, want_low = 0.0;
    const double dt = 1e-5;
    exact(k, e, &want_v, &want_low);
    struct sim *const s = drop(k, e, dt);
    double low = 1.0, v = 0.0;
    for (int i = 0; i * dt < 0.6; i++) {
        step(s);
        low = fmin(low, s->grains.pos[0].z);
        /* the law lets go while the sphere is below its radius: gravity alone from there on */
        if (v == 0.0 && s->t > 0.29 && s->grains.vel[0].z > 0.0 &&
            s->grains.pos[0].z > 0.1 - 1e-12) {
            v = s->grains.vel[0].z;
        }
    }
    char *const text = xprintf("DEM01, k = %g N/m, e = %g:", k, e);
    char *const what[2] = {xprintf("%s lowest centre, m", text),
                           xprintf("%s height it rises to, m", text)};
    check_rel(low, want_low, 5e-3, what[0]);
    /* from where the force is zero on there is gravity alone; compare the tops of the flights */
    const double zeta = damping_ratio(e), m = 2600.0 * 4.0 / 3.0 * PI * 1e-3;
    const double overlap = 2.0 * zeta * sqrt(k * m) * want_v / k;
    check_rel(0.1 + 0.5 * v * v / 9.80665, 0.1 - overlap + 0.5 * want_v * want_v / 9.80665,
              5e-3, what[1]);
    xfree(what[0]);
    xfree(what[1]);
    xfree(text);
    sim_free(s);
}

static void check_bounces(double e)
{
    const double dt = 2e-6, k = 5e8;
    struct sim *const s = drop(k, e, dt);
    double before = 0.0;
    int bounce = 0;
    for (long i = 0; i < 1000000 && bounce < 2; i++) {
        step(s);
        const double v = s->grains.vel[0].z;
        if (before > 0.0 && v <= 0.0) {
            bounce++;
            char *const text = xprintf("DEM02, e = %g: height of bounce %d, m", e, bounce);
            check_rel(s->grains.pos[0].z, 0.4 * pow(e, 2.0 * bounce) + 0.1, 5e-3, text);
            xfree(text);
        }
        before = v;
    }
    check(bounce == 2, "DEM02, e = %g: %d bounces", e, bounce);
    sim_free(s);
}

int main(void)
{
    static const double k[] = {1e4, 2.5e4, 5e4, 1e5};
    for (int i = 0; i < 4; i++) {
        check_contact(k[i], 0.9);
        check_contact(k[i], 0.6);
    }
    check_bounces(0.9);
    check_bounces(0.6);
    return check_end();
}
