/* verify/drag_figures.c - the numbers of two figures, from every law of drag there is.
 *
 * Settling: a sphere on its own. With Ar = g d^3 rho_f (rho_p - rho_f)/mu^2 a law's Reynolds number
 * at terminal velocity is the root of Fhat(1, Re) Re = Ar/18; u* = Re/Ar^(1/3) is that velocity over
 * (mu g (rho_p - rho_f)/rho_f^2)^(1/3). Compared at equal Ar with the sphere of Brown and Lawler
 * [BrownLawler03], for its Re from 1e-3 to 1e5; the review's Figure 15.
 * Porosity: Fhat at eps from 0.35 to 1, Re 0.01, 1, 100, 1000.
 *
 *   drag_figures DIR   writes to DIR: settling.list, porosity.list (number, family, title of a
 *                      curve), settling_N.dat, porosity_N.dat; prints the table of errors
 *
 * Laws whose curves agree to 1e-6 share one. Families follow from what a law says of itself. */
#include "drag_laws.h"

enum { LAWS = 64, RE = 321, EPS = 131, PANELS = 4, CELLS = 4 };
static const double cell_eps[CELLS] = {1.0, 0.999, 0.99, 0.95};
static const double panel_re[PANELS] = {0.01, 1.0, 100.0, 1000.0};
static const double crossover = 40.0; /* the review's: one law is best below, another above */

struct figure_law {
    struct law law;
    double re[RE]; /* terminal, at the Ar of each point */
    double factor[PANELS][EPS];
    int settles_as, flows_as;  /* first law with the same curve */
    double below, above;       /* mean |u/u_BL - 1| */
    double below_in, above_in; /* where the law holds; NAN if nowhere */
    double own_cell[CELLS][2]; /* below, above, in a cell of that porosity */
};

static struct figure_law laws[LAWS];
static int n_laws;
static double reference_re[RE];

static double point_re(int i)
{
    return pow(10.0, -3.0 + 8.0 * i / (RE - 1));
}

static double point_eps(int i)
{
    return 0.35 + 0.65 * i / (EPS - 1);
}

static double brown_lawler(double re)
{
    return 1.0 + 0.15 * pow(re, 0.681) + 0.407 / 24.0 * re * re / (re + 8710.0);
}

/* rho u_r d/mu at which the law's drag carries Ar/18 in a cell of fluid fraction eps; the force
 * rises with Re, so there is one. */
static double terminal_re(const struct law *law, double eps, double ar18)
{
    double lo = -12.0, hi = 12.0; /* log10 */
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (lo + hi), re = pow(10.0, middle);
        if (re * law_factor(law, eps, re) < ar18)
            lo = middle;
        else
            hi = middle;
    }
    return pow(10.0, 0.5 * (lo + hi)) / eps;
}

static void mean_errors(struct figure_law *f)
{
    double sum[2][2] = {{0.0}};
    int n[2][2] = {{0}};
    for (int i = 0; i < RE; i++) {
        const double error = fabs(f->re[i] / reference_re[i] - 1.0);
        const int above = reference_re[i] > crossover;
        for (int in = 0; in < 2; in++)
            if (!in || law_holds(&f->law, 1.0, reference_re[i])) {
                sum[above][in] += error;
                n[above][in]++;
            }
    }
    f->below = sum[0][0] / n[0][0];
    f->above = sum[1][0] / n[1][0];
    f->below_in = n[0][1] ? sum[0][1] / n[0][1] : (double)NAN;
    f->above_in = n[1][1] ? sum[1][1] / n[1][1] : (double)NAN;
}

/* In a coupled run a grain lowers the porosity of its own cell, and a law takes that for
 * neighbours: the same errors again where the cell says eps. */
static void own_cell_errors(struct figure_law *f)
{
    for (int k = 0; k < CELLS; k++) {
        double sum[2] = {0.0};
        int n[2] = {0};
        for (int i = 0; i < RE; i++) {
            const double re = reference_re[i], ar18 = re * brown_lawler(re);
            const int above = re > crossover;
            sum[above] += fabs(terminal_re(&f->law, cell_eps[k], ar18) / re - 1.0);
            n[above]++;
        }
        for (int above = 0; above < 2; above++)
            f->own_cell[k][above] = sum[above] / n[above];
    }
}

static bool same(const double *a, const double *b, int n)
{
    for (int i = 0; i < n; i++)
        if (!(fabs(a[i] / b[i] - 1.0) < 1e-6))
            return false;
    return true;
}

static void visit(const char *name, void *answer)
{
    struct figure_law *const f = &laws[n_laws];
    if (n_laws == LAWS || strcmp(name, "none") == 0 || !law_load(&f->law, name, answer))
        return;
    f->law.grain.d10 = law_d; /* a bed of one size */
    law_init(&f->law, 0, NULL);
    for (int i = 0; i < RE; i++) {
        const double re = reference_re[i] = point_re(i);
        f->re[i] = f->law.limits.isolated > 0.0
                       ? terminal_re(&f->law, 1.0, re * brown_lawler(re))
                       : (double)NAN;
    }
    mean_errors(f);
    own_cell_errors(f);
    for (int k = 0; k < PANELS; k++)
        for (int i = 0; i < EPS; i++)
            f->factor[k][i] = law_factor(&f->law, point_eps(i), panel_re[k]);
    f->settles_as = f->flows_as = n_laws;
    for (int k = n_laws - 1; k >= 0; k--) {
        if (same(f->re, laws[k].re, RE))
            f->settles_as = k;
        if (same(f->factor[0], laws[k].factor[0], PANELS * EPS))
            f->flows_as = k;
    }
    n_laws++;
}

/* Of the laws that share the curve of law k: "suspension" if one of them is for these. */
static const char *family(int k, bool settling)
{
    const char *name = laws[k].law.limits.eps_min >= 0.99 ? "isolated" : "packed";
    for (int i = k; i < n_laws; i++) {
        const struct drag_limits *const l = &laws[i].law.limits;
        if ((settling ? laws[i].settles_as : laws[i].flows_as) == k && l->eps_min < 0.99 &&
            l->isolated > 0.0)
            name = "suspension";
    }
    return name;
}

/* The names of all laws that share a curve. */
static char *title(int k, bool settling)
{
    char *text = xstrdup("");
    for (int i = k; i < n_laws; i++)
        if ((settling ? laws[i].settles_as : laws[i].flows_as) == k) {
            char *const longer = xprintf("%s%s%s", text, i == k ? "" : " = ", laws[i].law.name);
            xfree(text);
            text = longer;
        }
    return text;
}

static FILE *create(const char *directory, const char *name, int k)
{
    char *const path =
        k < 0 ? xprintf("%s/%s", directory, name) : xprintf("%s/%s_%d.dat", directory, name, k);
    FILE *const f = fopen(path, "w");
    if (!f)
        die(EXIT_WRITE, "%s: cannot be written", path);
    xfree(path);
    return f;
}

static void write_settling(const char *directory)
{
    FILE *const list = create(directory, "settling.list", -1);
    for (int k = 0; k < n_laws; k++) {
        const struct figure_law *const f = &laws[k];
        if (f->settles_as != k || isnan(f->re[0]))
            continue;
        char *const names = title(k, true);
        fprintf(list, "%d;%s;%s\n", k, family(k, true), names);
        xfree(names);
        FILE *const out = create(directory, "settling", k);
        fprintf(out, "# Re of Brown and Lawler, u* of theirs, u* of the law, error\n");
        for (int i = 0; i < RE; i++) {
            const double re = reference_re[i], scale = cbrt(18.0 * re * brown_lawler(re));
            fprintf(out, "%.8g %.8g %.8g %.8g\n", re, re / scale, f->re[i] / scale,
                    f->re[i] / re - 1.0);
        }
        fclose(out);
    }
    fclose(list);
}

static void write_porosity(const char *directory)
{
    FILE *const list = create(directory, "porosity.list", -1);
    for (int k = 0; k < n_laws; k++) {
        const struct figure_law *const f = &laws[k];
        if (f->flows_as != k || f->law.limits.eps_min >= 0.99)
            continue; /* a level line says nothing */
        char *const names = title(k, false);
        fprintf(list, "%d;%s;%s\n", k, family(k, false), names);
        xfree(names);
        FILE *const out = create(directory, "porosity", k);
        for (int p = 0; p < PANELS; p++) {
            fprintf(out, "# Re = %g: eps, Fhat, Fhat where the law holds\n", panel_re[p]);
            for (int i = 0; i < EPS; i++) {
                const bool holds = law_holds(&f->law, point_eps(i), panel_re[p]);
                fprintf(out, "%.8g %.8g %.8g\n", point_eps(i), f->factor[p][i],
                        holds ? f->factor[p][i] : (double)NAN);
            }
            fprintf(out, "\n\n");
        }
        fclose(out);
    }
    fclose(list);
}

static int by_error_below(const void *a, const void *b)
{
    const double x = (*(const struct figure_law *const *)a)->below;
    const double y = (*(const struct figure_law *const *)b)->below;
    return (x > y) - (x < y);
}

static void print_part(double error)
{
    if (isnan(error))
        printf(" %9s", "-");
    else
        printf(" %9.2f", 100.0 * error);
}

static void print_own_cell(const struct figure_law *const *sorted, int n)
{
    printf(
        "\n  mean |error|, %%, below and above Re = 40, of one sphere in a cell of porosity\n"
        "  %-24s",
        "");
    for (int k = 0; k < CELLS; k++)
        printf(" %13g", cell_eps[k]);
    putchar('\n');
    for (int i = 0; i < n; i++) {
        if (sorted[i]->law.limits.eps_min >= 0.99)
            continue; /* they do not see it */
        printf("  %-24s", sorted[i]->law.name);
        for (int k = 0; k < CELLS; k++)
            printf(" %6.1f %6.1f", 100.0 * sorted[i]->own_cell[k][0],
                   100.0 * sorted[i]->own_cell[k][1]);
        putchar('\n');
    }
}

/* The review reads its Figure 15 so: Koch and Hill's law is best below Re = 40, Ergun's with Wen
 * and Yu's (gidaspow) best above, Di Felice's worst on both sides. */
static void print_reading(void)
{
    static const char *const of_review[] = {"gidaspow", "di_felice", "koch_hill",
                                            "koch_hill_linear"};
    printf("  of the review's laws");
    for (int above = 0; above < 2; above++) {
        const struct figure_law *best = NULL, *worst = NULL;
        for (int k = 0; k < n_laws; k++)
            for (int i = 0; i < 4; i++)
                if (strcmp(laws[k].law.name, of_review[i]) == 0) {
                    if (!best || laws[k].own_cell[0][above] < best->own_cell[0][above])
                        best = &laws[k];
                    if (!worst || laws[k].own_cell[0][above] > worst->own_cell[0][above])
                        worst = &laws[k];
                }
        if (best)
            printf("%s %s Re = 40: %s is best, %s worst", above ? ";" : "",
                   above ? "above" : "below", best->law.name, worst->law.name);
    }
    putchar('\n');
}

static void print_table(void)
{
    const struct figure_law *sorted[LAWS];
    int n = 0;
    for (int k = 0; k < n_laws; k++)
        if (!isnan(laws[k].re[0]))
            sorted[n++] = &laws[k];
    qsort(sorted, (size_t)n, sizeof sorted[0], by_error_below);
    printf("  %-24s %19s %19s\n  %-24s %9s %9s %9s %9s\n", "", "Re 1e-3 to 40", "Re 40 to 1e5",
           "mean |error|, %", "all", "in range", "all", "in range");
    for (int i = 0; i < n; i++) {
        printf("  %-24s", sorted[i]->law.name);
        print_part(sorted[i]->below);
        print_part(sorted[i]->below_in);
        print_part(sorted[i]->above);
        print_part(sorted[i]->above_in);
        putchar('\n');
    }
    printf("  not shown, having no isolated sphere:");
    for (int k = 0; k < n_laws; k++)
        if (isnan(laws[k].re[0]))
            printf(" %s", laws[k].law.name);
    putchar('\n');
    print_reading();
    print_own_cell(sorted, n);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: drag_figures DIR\n");
        return EXIT_SCENE;
    }
    check_quiet = true;
    answers_visit(argv[0], "drag", visit);
    write_settling(argv[1]);
    write_porosity(argv[1]);
    print_table();
    return check_failed != 0;
}
