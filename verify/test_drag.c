/* verify/test_drag.c - the laws of drag.
 *
 * Against published formulas: factors at 13 points per law (reference/drag_points.csv), of the
 * isolated sphere (drag_isolated.csv) and of isolated grains that are none
 * (drag_nonspherical.csv), to half a unit of the tables' tenth digit; Brown and Lawler's
 * settling curve (brown_lawler.csv); permeabilities as the
 * review's Table 3 writes them. Against the contract, for every answer there is: finite and
 * positive for any eps in (0, 1] and any Re, force rising with the slip, the limit of an
 * isolated sphere that it states; its largest jump is printed, and in its range is no larger
 * than it states. */
#include <stdio.h>
#include <string.h>
#include "drag_laws.h"

static const double table = 5.01e-10;

/* The law that a row of the tables is about, where the names differ. */
static const char *const row_of[][2] = {{"hkl_benyahia", "koch_hill"},
                                        {"koch_hill", "koch_hill_linear"},
                                        {"ganser_isometric", "ganser"},
                                        {"holzer_sommerfeld_simple", "holzer_sommerfeld"},
                                        {"wang_calcareous", "wang"}};

static int all_points; /* of the tables that some law has met */

static bool row_is_of(const char *row, const struct law *law)
{
    for (size_t i = 0; i < sizeof row_of / sizeof row_of[0]; i++)
        if (strcmp(row, row_of[i][0]) == 0)
            return strcmp(row_of[i][1], law->name) == 0;
    return strcmp(row, law->name) == 0;
}

struct worst {
    int points;
    double error; /* largest relative error */
};

/* Calls `error` for each row of the law; it returns the relative error, or -1 for none. */
static struct worst walk(const struct law *law, const char *path,
                         double (*error)(const struct law *, const char *rest))
{
    struct worst w = {0, 0.0};
    char line[512], name[64];
    FILE *const f = fopen(path, "r");
    if (!f) {
        check(false, "%s opens", path);
        return w;
    }
    while (fgets(line, sizeof line, f)) {
        if (sscanf(line, "%63[a-z_0-9],", name) != 1 || !row_is_of(name, law))
            continue;
        const double e = error(law, line + strlen(name));
        if (e >= 0.0) {
            w.points++;
            all_points++;
            w.error = fmax(w.error, e);
        }
    }
    fclose(f);
    return w;
}

static double error_bed(const struct law *law, const char *rest)
{
    double eps, re, want;
    if (sscanf(rest, ",%lf,%lf,%*f,%lf", &eps, &re, &want) != 3)
        return -1.0;
    return fabs(law_factor(law, eps, re) / want - 1.0);
}

static double error_sphere(const struct law *law, const char *rest)
{
    double re, want;
    if (sscanf(rest, ",%lf,%*f,%lf", &re, &want) != 2)
        return -1.0;
    return fabs(law_factor(law, 1.0, re) / want - 1.0);
}

/* The crosswise sphericity is blank where the law has none. */
static double error_shape(const struct law *law, const char *rest)
{
    double sphericity, crosswise = 1.0, re, want;
    if (sscanf(rest, ",%lf,%lf,%lf,%lf", &sphericity, &crosswise, &re, &want) != 4 &&
        sscanf(rest, ",%lf,,%lf,%lf", &sphericity, &re, &want) != 3)
        return -1.0;
    const struct law shaped = law_shaped(law, sphericity, crosswise);
    return fabs(law_factor(&shaped, 1.0, re) * 24.0 / re / want - 1.0);
}

/* Fhat Re = eps Ar/18. The table gives nine digits of Re, and the force goes as Re^2 at most. */
static double error_settling(const struct law *law, const char *rest)
{
    double ar, eps, re;
    if (sscanf(rest, ",%lf,%lf,%lf", &ar, &eps, &re) != 3)
        return -1.0;
    return fabs(18.0 * re * law_factor(law, eps, re) / (eps * ar) - 1.0);
}

static void test_reference(const struct law *law)
{
    const struct worst settling =
        walk(law, "verify/reference/homogeneous_settling.csv", error_settling);
    if (settling.points > 0)
        check(settling.error <= 1.01e-8,
              "%s: %d points of homogeneous settling, largest relative error %.1e", law->name,
              settling.points, settling.error);
    static const struct {
        const char *path, *what;
        double (*error)(const struct law *, const char *);
    } file[] = {{"verify/reference/drag_points.csv", "of beds and suspensions", error_bed},
                {"verify/reference/drag_isolated.csv", "of the isolated sphere", error_sphere},
                {"verify/reference/drag_nonspherical.csv", "of other shapes", error_shape}};
    for (int i = 0; i < 3; i++) {
        const struct worst w = walk(law, file[i].path, file[i].error);
        if (w.points > 0)
            check(w.error <= table, "%s: %d points %s, largest relative error %.1e", law->name,
                  w.points, file[i].what, w.error);
    }
}

/* Finite and not negative everywhere, positive wherever there are neighbours or inertia. */
static void test_positive(const struct law *law)
{
    int bad = 0, points = 0;
    for (int i = 0; i <= 400; i++)
        for (int j = -1; j <= 280; j++) {
            const double eps = i == 0 ? 1e-3 : i / 400.0;
            const double re = j < 0 ? 0.0 : pow(10.0, -8.0 + 0.05 * j);
            const double f = law_factor(law, eps, re);
            const bool must = eps < 1.0 || re > 0.0;
            bad += !isfinite(f) || f < 0.0 || (must && f <= 0.0);
            points++;
        }
    check(bad == 0, "%s: finite and positive at %d of %d points, eps (0, 1], Re 0 .. 1e6",
          law->name, points - bad, points);
}

static void test_monotone(const struct law *law)
{
    int falls = 0, points = 0;
    double first_eps = 0.0, first_re = 0.0;
    for (int i = 4; i <= 100; i++) {
        double last = 0.0;
        for (int j = 0; j <= 2800; j++, points++) {
            const double re = pow(10.0, -8.0 + 0.005 * j);
            const double force = re * law_factor(law, 0.01 * i, re);
            if (!(force > last) && falls++ == 0) {
                first_eps = 0.01 * i;
                first_re = re;
            }
            last = force;
        }
    }
    check(falls == 0,
          "%s: force rises with slip, %d exceptions in %d steps, eps 0.04 .. 1%s (eps %.2f, Re "
          "%.3g)",
          law->name, falls, points, falls ? "; the first" : "", first_eps, first_re);
}

static void test_continuous(const struct law *law)
{
    const struct law_jump all = law_largest_jump(law, false), in = law_largest_jump(law, true);
    check(in.size <= 1.001 * law->limits.jump + 1e-4,
          "%s: largest jump in its range %.2e (eps %.4f, Re %.4g), stated %.2e; anywhere %.2e "
          "(eps %.4f, Re %.4g)",
          law->name, in.size, in.eps, in.re, law->limits.jump, all.size, all.eps, all.re);
}

static void test_isolated(const struct law *law)
{
    const double limit = law->limits.isolated;
    if (!(limit > 0.0)) {
        check(law->limits.eps_max < 1.0, "%s: no isolated sphere, and its range says so",
              law->name);
        return;
    }
    char *const text = xprintf("%s: isolated sphere, Re = 0, part of Stokes' drag", law->name);
    check_rel(law_factor(law, 1.0, 0.0), limit, 1e-12, text);
    check_rel(law_factor(law, 1.0 - 1e-10, 1e-10), limit, 1e-3, "  and near it");
    xfree(text);
}

static void test_limits(const struct law *law)
{
    const struct drag_limits *const l = &law->limits;
    check(l->eps_min >= 0.0 && l->eps_min < l->eps_max && l->eps_max <= 1.0 &&
              l->re_min >= 0.0 && l->re_max > l->re_min && law->about->range[0] != '\0',
          "%s: range %s", law->name, law->about->range);
}

static void test_law(const struct law *law)
{
    test_limits(law);
    test_reference(law);
    test_positive(law);
    test_monotone(law);
    test_continuous(law);
    test_isolated(law);
    if (law->limits.shape) {
        const struct law flake = law_shaped(law, 0.637, 0.423);
        test_positive(&flake);
        test_monotone(&flake);
    }
    if (law->limits.sauter) {
        struct law small = *law;
        small.y = 0.237;
        test_positive(&small);
        test_monotone(&small);
    }
}

static void test_kozeny_carman(const struct law *law)
{
    char constant[] = "drag.constant=150", cap[] = "drag.eps_cap=1";
    char *both[] = {constant, cap};
    const double d = law_d, eps = 0.4;
    struct law other = *law;
    check_rel(law_factor(law, eps, 7.0), 10.0 * 0.6 / 0.16, 1e-14,
              "Kozeny-Carman 180 at eps 0.4");
    const double k7 = 0.343 * d * d / (180.0 * 0.09);
    for (int i = 0; i < 3; i++)
        check_rel(law_permeability(law, 0.75 + 0.1 * i, 0.0), k7, 1e-13,
                  "Kozeny-Carman's permeability above the cap is that at 0.7");
    law_init(&other, 2, both);
    check_rel(law_factor(&other, eps, 0.0), 150.0 / 18.0 * 0.6 / 0.16, 1e-14,
              "with the constant 150");
    check_rel(law_factor(&other, 0.9, 0.0), 150.0 / 18.0 * 0.1 / 0.81, 1e-14,
              "without the cap");
}

static void test_kozeny_carman_d10(const struct law *law)
{
    char given[] = "drag.d10=0.237 mm";
    char *one[] = {given};
    const double eps = 0.3717, phi = 1.0 - eps;
    struct law other = *law;
    const double of_d10 = eps * eps * eps / (150.0 * phi * phi);
    check_rel(law_permeability(law, eps, 0.1), of_d10 * law->grain.d10 * law->grain.d10, 1e-13,
              "permeability of D10, of the scene");
    law_init(&other, 1, one);
    check_rel(law_permeability(&other, eps, 0.1), of_d10 * 0.237e-3 * 0.237e-3, 1e-13,
              "permeability of D10, given");
}

static void test_kozeny_carman_relative(const struct law *law)
{
    char k0[] = "drag.permeability=3.7e-11 m2", eps0[] = "drag.eps_0=0.4217";
    char *both[] = {k0, eps0};
    struct law other = *law;
    law_init(&other, 2, both);
    check_rel(law_permeability(&other, 0.4217, 0.1), 3.7e-11, 1e-13, "k0 at eps0");
    check_rel(law_permeability(&other, 0.3517, 0.1),
              3.7e-11 * pow(0.3517 / 0.4217, 3.0) * pow(0.5783 / 0.6483, 2.0), 1e-13,
              "and carried to another porosity");
}

static void test_kozeny_carman_tang(const struct law *law)
{
    char shape[] = "drag.shape_factor=2.87", way[] = "drag.tortuosity=1.237";
    char *both[] = {shape, way};
    const double eps = 0.4317, e = eps / (1.0 - eps), d32 = law_d / 1.37;
    check_rel(law_permeability(law, eps, 0.1),
              law_d * law_d * eps * eps * eps / (180.0 * (1.0 - eps) * (1.0 - eps)), 1e-13,
              "standard shape and tortuosity: Carman's 180");
    struct law other = law_shaped(law, 0.837, 1.0);
    law_init(&other, 2, both);
    other.y = 1.37;
    const double surface = 6.0 / (0.837 * d32);
    check_rel(law_permeability(&other, eps, 0.1),
              e * e * e / (1.0 + e) / (2.87 * surface * surface * 1.237 * 1.237), 1e-13,
              "by the void ratio, surface, shape factor, tortuosity");
}

/* The last row of Table 3: K = rho g/{(1-eps)/(d eps^3) [150 mu (1-eps)/d + 1.75 rho U]}. */
static void test_ergun(const struct law *law)
{
    const double rho = 913.0, mu = 1.37e-3, U = 0.0237, eps = 0.4217, phi = 1.0 - eps;
    const double slope =
        phi / (law_d * eps * eps * eps) * (150.0 * mu * phi / law_d + 1.75 * rho * U);
    check_rel(law_permeability(law, eps, rho * U * law_d / mu) * rho * 9.81 / mu,
              rho * 9.81 / slope, 1e-13, "Ergun's conductivity depends on the velocity, m/s");
}

/* Fhat of a grain of another size than the mean: y F(eps, Re/y). */
static void test_beetstra(const struct law *law)
{
    struct law small = *law;
    small.y = 0.637;
    check_rel(law_factor(&small, 0.4717, 23.7), 0.637 * law_factor(law, 0.4717, 23.7 / 0.637),
              1e-14, "a grain smaller than the mean");
    double sum = 0.0, volume = 0.0; /* mixture: volumes 0.3, 0.7 of sizes 1 and 2.3 */
    for (int i = 0; i < 2; i++) {
        const double d = i ? 2.3 : 1.0, part = i ? 0.7 : 0.3, d32 = 1.0 / (0.3 + 0.7 / 2.3);
        small.y = d / d32;
        sum += part * law_factor(&small, 0.4717, 0.0) / (d * d) * d32;
        volume += part / d;
    }
    check_rel(sum, volume * law_factor(law, 0.4717, 0.0), 1e-14,
              "the mixture's creeping drag is that of its mean size");
}

/* Their settling curve, to the eight digits of its table: Fhat Re = Ar/18. */
static void test_brown_lawler(const struct law *law)
{
    FILE *const f = fopen("verify/reference/brown_lawler.csv", "r");
    char line[512];
    double ar, re, worst = 0.0;
    int points = 0;
    if (!check(f != NULL, "their settling curve opens"))
        return;
    while (fgets(line, sizeof line, f))
        if (sscanf(line, "%*f,%lf,%lf", &ar, &re) == 2) {
            worst = fmax(worst, fabs(18.0 * re * law_factor(law, 1.0, re) / ar - 1.0));
            points++;
        }
    fclose(f);
    check(points == 21 && worst < 1e-7, "%d points of their settling curve, largest error %.1e",
          points, worst);
}

static void test_tang(const struct law *law)
{
    char on[] = "drag.mobility=on";
    char *one[] = {on};
    struct law other = *law;
    const double fixed = law_factor(law, 0.4717, 23.7);
    law_init(&other, 1, one);
    check_rel(law_factor(&other, 0.4717, 23.7) - fixed,
              2.98 * 0.5283 / (0.4717 * 0.4717) * 2.108 * pow(23.7, 0.85) /
                  sqrt(other.grain.density_ratio),
              1e-12, "Tang's addition for mobile grains");
}

static const struct {
    const char *name;
    void (*test)(const struct law *law);
} own_tests[] = {{"kozeny_carman", test_kozeny_carman},
                 {"kozeny_carman_d10", test_kozeny_carman_d10},
                 {"kozeny_carman_relative", test_kozeny_carman_relative},
                 {"kozeny_carman_tang", test_kozeny_carman_tang},
                 {"ergun", test_ergun},
                 {"beetstra", test_beetstra},
                 {"brown_lawler", test_brown_lawler},
                 {"tang", test_tang}};

static void visit(const char *name, void *answer)
{
    struct law law;
    if (!law_load(&law, name, answer))
        return;
    law_init(&law, 0, NULL);
    if (strcmp(name, "none") == 0) {
        check(law_factor(&law, 0.4, 1.0) == 0.0, "none: no drag");
        return;
    }
    test_law(&law);
    for (size_t i = 0; i < sizeof own_tests / sizeof own_tests[0]; i++)
        if (strcmp(name, own_tests[i].name) == 0)
            own_tests[i].test(&law);
}

int main(int argc, char **argv)
{
    (void)argc;
    answers_visit(argv[0], "drag", visit);
    /* 13 laws of 13, 7 of 18, 3 of 25 and one of 20, 9 of 32 */
    check(all_points == 678, "%d of 678 points of the tables found their law", all_points);
    return check_end();
}
