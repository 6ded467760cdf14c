/* verify/test_chung_ooi.c - the impacts of [ChungOoi11] with Hertz-Mindlin: 1 two spheres head on, 2 a
 * sphere and a rigid plane, 3 restitution, 4 oblique impacts, 6 and 7 spinning spheres. Exact values
 * where there are: Hertz's, and the rigid-body result while the contact slides throughout. Where it
 * sticks the published variants of the law differ by up to 10 %; the value is printed beside them. */
/* slots: contact/hertz_mindlin */
#include "impact.h"

/* E* and G* of a body on a rigid plane. */
static char *rigid(double young, double nu, double e, double mu)
{
    return xprintf("young = %.17g Pa\npoisson = %.17g\ne_star = %.17g Pa\ng_star = %.17g Pa\n"
                   "restitution = %.17g\nfriction = %.17g\n",
                   young, nu, young / (1.0 - nu * nu), young / (2.0 * (2.0 - nu) * (1.0 + nu)),
                   e, mu);
}

static double duration(double r, double density, double e_star, double v)
{
    const double m = density * 4.0 / 3.0 * PI * r * r * r;
    return 2.87 * pow(m * m / (r * e_star * e_star * v), 0.2);
}

static void check_value(double got, double want, double tolerance, const char *format,
                        const char *name, double x)
{
    char *const text = xprintf(format, name, x);
    check_rel(got, want, tolerance, text);
    xfree(text);
}

/* Tests 1 and 2; the values are those of Hertz's closed form. */
static void check_elastic(void)
{
    static const struct {
        const char *name;
        bool pair;
        double r, density, young, nu, v, depth, duration, force;
    } row[] = {
        {"1 glass", true, 0.01, 2800, 4.8e10, 0.2, 10, 0.0002741127, 4.0339453e-05, 10696.889},
        {"1 limestone", true, 0.01, 2500, 2e10, 0.25, 10, 0.00036830403, 5.4201002e-05,
         7108.2413},
        {"2 al_alloy", false, 0.1, 2699, 7e10, 0.3, 0.2, 4.9717175e-05, 0.00073165659,
         11369.858},
        {"2 mg_alloy", false, 0.1, 1800, 4e10, 0.35, 0.2, 5.2123288e-05, 0.00076706586,
         7232.681}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        char *const plane = rigid(row[i].young, row[i].nu, 1.0, 0.35);
        char *const like =
            xprintf("young = %g Pa\npoisson = %g\nrestitution = 1\nfriction = 0.35\n",
                    row[i].young, row[i].nu);
        const struct impact p = {.r = row[i].r,
                                 .density = row[i].density,
                                 .vn = row[i].v,
                                 .material = row[i].pair ? like : plane,
                                 .dt = row[i].duration / 1000.0,
                                 .pair = row[i].pair};
        const struct rebound r = impact_run(&p);
        const double e =
            row[i].young / (1.0 - row[i].nu * row[i].nu) / (row[i].pair ? 2.0 : 1.0);
        const double r_eff = row[i].r / (row[i].pair ? 2.0 : 1.0);
        check_value(r.depth, row[i].depth, 5e-3, "test %s: largest overlap, m%.0g", row[i].name,
                    0.0);
        check_value(4.0 / 3.0 * e * sqrt(r_eff) * pow(r.depth, 1.5), row[i].force, 5e-3,
                    "test %s: largest force, N%.0g", row[i].name, 0.0);
        check_value(r.duration, row[i].duration, 5e-3, "test %s: duration, s%.0g", row[i].name,
                    0.0);
        check_value(r.vn, row[i].v, 1e-4, "test %s: rebound speed, m/s%.0g", row[i].name, 0.0);
        xfree(plane);
        xfree(like);
    }
}

static void check_restitutions(void)
{
    static const struct {
        const char *name;
        double density, young, nu;
    } row[] = {{"al_oxide", 4000, 3.8e11, 0.23}, {"cast_iron", 7000, 1e11, 0.25}};
    for (int i = 0; i < 2; i++)
        for (double e = 0.2; e < 1.01; e += 0.2) {
            char *const material = rigid(row[i].young, row[i].nu, fmin(e, 1.0), 0.0);
            const struct impact p = {.r = 2.5e-3,
                                     .density = row[i].density,
                                     .vn = 3.9,
                                     .material = material,
                                     .dt = duration(2.5e-3, row[i].density, row[i].young, 3.9) /
                                           500.0};
            check_value(impact_run(&p).vn / 3.9, e, 2e-3, "test 3 %s: restitution %g",
                        row[i].name, e);
            xfree(material);
        }
}

static void check_oblique(void)
{
    /* angle; rebound v_t of the variants: force kept, rescaled, total */
    static const double stick[][4] = {
        {2, 0.128973, 0.118464, 0.134175},  {5, 0.302138, 0.29147, 0.32788},
        {10, 0.480181, 0.478586, 0.473016}, {15, 0.635691, 0.639795, 0.63893},
        {20, 0.816446, 0.830302, 0.830302}, {25, 1.03697, 1.05379, 1.05379}};
    static const double slide[] = {30, 35, 40, 50, 60, 70, 80, 85};
    const double e = 0.98, mu = 0.092, r = 2.5e-3, v = 3.9;
    char *const material = rigid(3.8e11, 0.23, e, mu);
    struct impact p = {.r = r, .density = 4000, .material = material};
    p.dt = duration(r, 4000, 3.8e11, v) / 1000.0;
    for (size_t i = 0; i < sizeof slide / sizeof slide[0]; i++) {
        const double angle = slide[i] * PI / 180.0;
        p.vt = v * sin(angle);
        p.vn = v * cos(angle);
        const struct rebound out = impact_run(&p);
        check_value(out.vt / p.vt, 1.0 - mu * (1.0 + e) / tan(angle),
                    slide[i] > 31 ? 5e-3 : 1e-2, "test 4%s, %g deg: tangential restitution", "",
                    slide[i]);
        check_value(out.spin, 2.5 * mu * (1.0 + e) * p.vn / r, slide[i] > 31 ? 5e-3 : 1e-2,
                    "test 4%s, %g deg: spin, rad/s", "", slide[i]);
    }
    for (size_t i = 0; i < sizeof stick / sizeof stick[0]; i++) {
        const double *const s = stick[i], angle = s[0] * PI / 180.0;
        p.vt = v * sin(angle);
        p.vn = v * cos(angle);
        const double vt = impact_run(&p).vt;
        const double low = fmin(s[1], fmin(s[2], s[3])), high = fmax(s[1], fmax(s[2], s[3]));
        check(vt > 0.98 * low && vt < 1.02 * high,
              "test 4, %g deg, sticking: v_t = %.5g m/s; variants give %.5g, %.5g, %.5g", s[0],
              vt, s[1], s[2], s[3]);
    }
    xfree(material);
}

static void check_spinning(void)
{
    const double e = 0.5, mu = 0.4, r = 0.1, v = 0.2, slip = 3.5 * mu * (1.0 + e) * v / r;
    char *const plane = rigid(7e10, 0.33, e, mu);
    const char *const like =
        "young = 70 GPa\npoisson = 0.33\nrestitution = 0.5\nfriction = 0.4\n";
    static const double spins[] = {4.7, 5, 8, 12, 21};
    struct impact p = {.r = r, .density = 2700, .vn = v, .material = plane};
    p.dt = duration(r, 2700, 7e10, v) / 1000.0;
    for (size_t i = 0; i < sizeof spins / sizeof spins[0]; i++) {
        p.spin = spins[i];
        p.pair = false;
        p.material = plane;
        struct rebound out = impact_run(&p);
        check_value((r * out.spin - out.vt) / (r * spins[i]), 1.0 - slip / spins[i],
                    5e-3 / fmax(0.2, 1.0 - slip / spins[i]),
                    "test 6%s, spin %g: velocity of the contact point", "", spins[i]);
        p.pair = true;
        p.material = like;
        out = impact_run(&p);
        check_value(out.spin, spins[i] - 2.5 * mu * (1.0 + e) * v / r, 5e-3,
                    "test 7%s, like spins %g: spin after, rad/s", "", spins[i]);
        check_value(fabs(out.vt), mu * (1.0 + e) * v, 5e-3,
                    "test 7%s, like spins %g: tangential speed, m/s", "", spins[i]);
    }
    xfree(plane);
}

int main(void)
{
    check_elastic();
    check_restitutions();
    check_oblique();
    check_spinning();
    return check_end();
}
