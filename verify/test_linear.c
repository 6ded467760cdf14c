/* verify/test_linear.c - the linear law in whole runs: restitution, energy, momentum, oblique
 * impact against the closed form. */
/* slots: contact/linear */
#include "csv.h"
#include "impact.h"
#include "two_bodies.h"

#define MATERIAL "stiffness = 2.3e5 N/m\n"

/* Sphere on plane, no slip, no damping: v_c'/v_c = cos(pi sqrt(3.5 k_t/k_n))
 * (reference/linear_oblique.csv). */
static void check_oblique(double ratio, double of_contact, double of_centre)
{
    const double vt = 0.31, vn = 0.27, r = 5e-3;
    char *const text = xprintf(
        "[grains a]\ndiameter = 10 mm\ndensity = 2385 kg/m3\nfill = point\n"
        "position = 50 50 5.0005 mm\nvelocity = %g 0 %g m/s\nmaterial = m\n[domain]\n"
        "size = 100 100 100 mm\ngravity = 0 0 0 m/s2\nx = periodic\ny = periodic\n"
        "[run]\nend = 1 s\nsubsteps = 1\ndt = 2 ns\n[material m]\nstiffness = 4.6e7 N/m\n"
        "stiffness_ratio = %g\nrestitution = 1\nfriction = 1e6\n",
        vt, -vn, ratio);
    struct sim *const s = sim_from(text);
    bool touched = false;
    for (;;) {
        step(s);
        touched = touched || s->neighbours.touching > 0;
        if (touched && s->neighbours.touching == 0)
            break;
    }
    const double contact = s->grains.vel[0].x - r * s->grains.spin[0].y;
    char *const what = xprintf("oblique impact, k_t/k_n = %g: contact velocity ratio", ratio);
    check_abs(contact / vt, of_contact, 5e-3, what);
    xfree(what);
    check_abs(s->grains.vel[0].x / vt, of_centre, 5e-3, "  of the centre");
    sim_free(s);
    xfree(text);
}

/* A damping ratio that is given is not corrected for the force that is cut where it would pull. */
static void check_damping_ratios(void)
{
    const struct csv *const t = csv_read("restitution_damping.csv");
    for (int i = 0; i < t->n; i++) {
        char *const material =
            xprintf(MATERIAL "friction = 0\nrestitution = none\ndamping_ratio = %.17g\n",
                    csv_value(t, i, "zeta"));
        const struct impact p = {
            .r = 5e-3, .density = 2385, .vn = 0.37, .material = material, .dt = 2e-7};
        const struct rebound out = impact_run(&p);
        check_rel(out.vn / 0.37, csv_value(t, i, "lsd_e_out_force0"), 1e-3,
                  "restitution of a damping ratio that is given");
        xfree(material);
    }
}

int main(void)
{
    check_restitution(MATERIAL, 5e-7);
    check_energy(MATERIAL, 2e-6);
    check_momentum(MATERIAL, 1e-6);
    const struct csv *const t = csv_read("linear_oblique.csv");
    for (int i = 0; i < t->n; i++)
        check_oblique(csv_value(t, i, "kt_over_kn"), csv_value(t, i, "vc_ratio"),
                      csv_value(t, i, "vt_ratio"));
    check_damping_ratios();
    return check_end();
}
