/* verify/test_drag.c - the laws of drag.
 *
 * Against published formulas: factors at 13 points per law (reference/drag_points.csv) and of
 * the isolated sphere (reference/drag_isolated.csv). Against the contract, for every answer
 * there is: finite and positive for any eps in (0, 1] and any Re, force rising with the slip;
 * its limit for an isolated sphere and its largest jump are printed. */
#include <stdio.h>
#include <string.h>
#include "../drag/drag.h"
#include "answers.h"

struct law {
    const char *name;
    double (*factor)(const struct drag_point *p);
    void (*init)(struct scene *s);
    const struct key *keys;
};

static double factor(const struct law *law, double eps, double re)
{
    return law->factor(&(struct drag_point){.eps = eps, .re = re});
}

/* Initialises the law with its standard values or with the overrides. */
static void law_init(const struct law *law, int n, char **overrides)
{
    struct scene *const s = scene_load(NULL, n, overrides);
    scene_declare(s, law->keys);
    law->init(s);
    check(scene_errors(s) == 0, "%s: its keys read without error", law->name);
    scene_free(s);
}

/* Largest relative error of the law at its points of the file; -1 if it has none. */
static double worst_point(const struct law *law, const char *path, bool isolated, int *points)
{
    FILE *const f = fopen(path, "r");
    char line[512], name[64];
    double worst = -1.0;
    *points = 0;
    if (!check(f != NULL, "%s opens", path))
        return NAN;
    while (fgets(line, sizeof line, f)) {
        double eps = 1.0, re, want;
        if (isolated ? sscanf(line, "%63[^,],%lf,%*f,%lf", name, &re, &want) != 3
                     : sscanf(line, "%63[^,],%lf,%lf,%*f,%lf", name, &eps, &re, &want) != 4)
            continue;
        /* Di Felice's sphere is Dallavalle's. */
        const char *const row =
            isolated && strcmp(name, "dallavalle") == 0 ? "di_felice" : name;
        if (strcmp(row, law->name) != 0)
            continue;
        worst = fmax(worst, fabs(factor(law, eps, re) / want - 1.0));
        ++*points;
    }
    fclose(f);
    return worst;
}

static void test_reference(const struct law *law)
{
    int points;
    const double bed = worst_point(law, "verify/reference/drag_points.csv", false, &points);
    if (points > 0)
        check(bed <= 1e-8, "%s: %d reference points, largest relative error %.1e within 1e-8",
              law->name, points, bed);
    const double alone = worst_point(law, "verify/reference/drag_isolated.csv", true, &points);
    if (points > 0)
        check(alone <= 1e-8, "%s: %d points of the isolated sphere, largest error %.1e",
              law->name, points, alone);
}

/* Finite and not negative everywhere, positive wherever there are neighbours or inertia. */
static void test_positive(const struct law *law)
{
    int bad = 0, points = 0;
    for (int i = 0; i <= 400; i++)
        for (int j = -1; j <= 280; j++) {
            const double eps = i == 0 ? 1e-3 : i / 400.0;
            const double re = j < 0 ? 0.0 : pow(10.0, -8.0 + 0.05 * j);
            const double f = factor(law, eps, re);
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
    for (int i = 4; i <= 100; i++) {
        double last = 0.0;
        for (int j = 0; j <= 5600; j++, points++) {
            const double re = pow(10.0, -8.0 + 0.0025 * j);
            const double force = re * factor(law, 0.01 * i, re);
            falls += !(force > last);
            last = force;
        }
    }
    check(falls == 0, "%s: force rises with slip, %d exceptions in %d steps, eps 0.04 .. 1",
          law->name, falls, points);
}

/* What remains of the jump of log Fhat between two points when they close in on it. */
static double jump_between(const struct law *law, struct drag_point a, struct drag_point b)
{
    for (int i = 0; i < 40; i++) {
        const struct drag_point c = {.eps = 0.5 * (a.eps + b.eps), .re = 0.5 * (a.re + b.re)};
        const double f = law->factor(&c);
        if (fabs(f - law->factor(&a)) > fabs(f - law->factor(&b)))
            b = c;
        else
            a = c;
    }
    return fabs(law->factor(&b) / law->factor(&a) - 1.0);
}

static void test_continuous(const struct law *law)
{
    double in_re = 0.0, in_eps = 0.0, at_re = 0.0, at_eps = 0.0;
    for (int i = 1; i < 200; i++) {
        for (int j = 0; j < 280; j++) {
            const double eps = 0.3 + 0.0035 * (i - 1), next = eps + 0.0035;
            const double re = pow(10.0, -8.0 + 0.05 * j), more = re * pow(10.0, 0.05);
            const struct drag_point a = {eps, re}, b = {eps, more}, c = {next, re};
            const double jump_re = jump_between(law, a, b), jump_eps = jump_between(law, a, c);
            if (jump_re > in_re) {
                in_re = jump_re;
                at_re = re;
            }
            if (jump_eps > in_eps) {
                in_eps = jump_eps;
                at_eps = eps;
            }
        }
    }
    check(in_re < 0.5 && in_eps < 0.5,
          "%s: largest jump %.1e in Re (near %.3g), %.1e in eps (near %.3g); allowed 0.5",
          law->name, in_re, at_re, in_eps, at_eps);
}

static void test_kozeny_carman(const struct law *law)
{
    char constant[] = "drag.constant=150", cap[] = "drag.eps_cap=1";
    char *both[] = {constant, cap};
    const double d = 1e-3, eps = 0.4;
    check_rel(factor(law, eps, 7.0), 10.0 * 0.6 / 0.16, 1e-14, "Kozeny-Carman 180 at eps 0.4");
    const double k7 = 0.343 * d * d / (180.0 * 0.09);
    for (int i = 0; i < 3; i++) {
        const double e = 0.75 + 0.1 * i;
        check_rel(e * d * d / (18.0 * (1.0 - e) * factor(law, e, 0.0)), k7, 1e-13,
                  "Kozeny-Carman's permeability above the cap is that at 0.7");
    }
    law_init(law, 2, both);
    check_rel(factor(law, eps, 0.0), 150.0 / 18.0 * 0.6 / 0.16, 1e-14, "with the constant 150");
    check_rel(factor(law, 0.9, 0.0), 150.0 / 18.0 * 0.1 / 0.81, 1e-14, "without the cap");
}

static void visit(const char *name, void *answer)
{
    struct law law = {.name = name};
    if (!answers_symbol(answer, "drag_factor", &law.factor, sizeof law.factor) ||
        !answers_symbol(answer, "drag_init", &law.init, sizeof law.init) ||
        !answers_symbol(answer, "drag_keys", &law.keys, sizeof law.keys))
        return;
    law_init(&law, 0, NULL);
    if (strcmp(name, "none") == 0) {
        check(factor(&law, 0.4, 1.0) == 0.0, "none: no drag");
        return;
    }
    test_reference(&law);
    test_positive(&law);
    test_monotone(&law);
    test_continuous(&law);
    const double limit = factor(&law, 1.0, 1e-9);
    check(isfinite(limit), "%s: isolated sphere, Re -> 0: %.6g of Stokes' drag", name, limit);
    if (strcmp(name, "kozeny_carman") == 0)
        test_kozeny_carman(&law);
}

int main(int argc, char **argv)
{
    (void)argc;
    answers_visit(argv[0], "drag", visit);
    return check_end();
}
