/* tools/extremes.c - where a scene breaks: extremes SCENE [axis=values ...] (./run.sh extremes;
 * study.h).
 *
 * Two axes: every combination. Otherwise each axis alone, the rest as the scene has it; without
 * axes all named ones that apply. Every point runs in spite of limits of its time step
 * (run.force = on), so that what happens beyond them is seen beside what they predict; with
 * --no-force those are refused. Each point is judged (extremes.h); between neighbours that differ
 * the edge is found to 5 %. Writes extremes.csv, edges.csv, extremes.nc, extremes.png. Exit code 1:
 * a point is broken. */
#include <string.h>
#include "study/extremes.h"

enum { EXIT_BROKEN = 1 };
#define STANDARD_TIMEOUT 60.0 /* s */

static double parse_within(const char *text)
{
    char unit[2] = "";
    double x;
    const int n = sscanf(text, "%lf%1s", &x, unit);
    if (n < 1 || !(x >= 0.0) || (n == 2 && unit[0] != '%'))
        die(EXIT_SCENE, "--within takes an error, such as 5%% or 0.05, not %s", text);
    return n == 2 ? 0.01 * x : x;
}

/* All named axes; those that do not apply are told later. */
static void add_standard(struct extremes *x)
{
    for (int i = 0; named_axes[i].name; i++) {
        char *const text = xprintf("%s=%s", named_axes[i].name, named_axes[i].standard);
        char *const wrong = axis_parse(&x->study.axis[x->study.n_axes++], text);
        if (wrong)
            die(EXIT_SCENE, "%s", wrong);
        xfree(text);
    }
}

static void parse(struct extremes *x, int argc, char **argv)
{
    x->within = (double)NAN;
    x->study.force = true;
    x->study.timeout = STANDARD_TIMEOUT;
    x->study.repeats = 1;
    x->study.inspect = extremes_inspect;
    study_arguments(&x->study, "extremes", &argc, argv);
    for (int i = 1; i < argc; i++) {
        const char *const name = argv[i], *const value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(name, "--no-force") == 0) {
            x->study.force = false;
        } else if (strcmp(name, "--no-edges") == 0) {
            x->no_edges = true;
        } else if (strcmp(name, "--within") == 0 && *value) {
            x->within = parse_within(value);
            i++;
        } else if (strcmp(name, "--error") == 0 && *value) {
            x->error_key = value;
            i++;
        } else {
            die(EXIT_SCENE, "no such option of extremes, or one without its value: %s", name);
        }
    }
    x->standard = x->study.n_axes == 0;
    if (x->standard)
        add_standard(x);
    x->grid = x->study.n_axes == 2;
    for (int a = 0; a < x->study.n_axes; a++)
        x->shown[a] = x->study.axis[a].n;
}

static void none_chosen(const struct extremes *x, int *choice)
{
    for (int a = 0; a < MOST_AXES; a++)
        choice[a] = a < x->study.n_axes ? -1 : 0;
}

/* An axis that does not apply: an error where it was asked for. */
static void does_not_apply(const struct extremes *x, char *why)
{
    if (!x->standard)
        die(EXIT_SCENE, "%s", why);
    xfree(why);
}

static void run_strips(struct extremes *x)
{
    int choice[MOST_AXES];
    char *why;
    for (int a = 0; a < x->study.n_axes; a++) {
        none_chosen(x, choice);
        for (int i = 0; i < x->shown[a]; i++) {
            choice[a] = i;
            if (!extremes_point(x, choice, &why)) {
                printf("%s\n", why);
                does_not_apply(x, why);
                x->shown[a] = i;
                break;
            }
        }
    }
}

static void run_grid(struct extremes *x)
{
    int choice[MOST_AXES] = {0};
    char *why;
    for (choice[1] = 0; choice[1] < x->shown[1]; choice[1]++)
        for (choice[0] = 0; choice[0] < x->shown[0]; choice[0]++)
            if (!extremes_point(x, choice, &why))
                does_not_apply(x, why);
}

static void find_edges(struct extremes *x)
{
    int choice[MOST_AXES];
    none_chosen(x, choice);
    if (x->grid) {
        for (int row = 0; row < x->shown[1]; row++) {
            choice[1] = row;
            extremes_edges(x, 0, choice);
        }
        return;
    }
    for (int a = 0; a < x->study.n_axes; a++) {
        none_chosen(x, choice);
        extremes_edges(x, a, choice);
    }
}

static void print_points(const struct extremes *x)
{
    size_t width = 8;
    for (int i = 0; i < x->n; i++)
        width = width > strlen(x->point[i].v->label) ? width : strlen(x->point[i].v->label);
    printf("%-*s %-8s %10s %10s\n", (int)width, "point", "verdict", "error", "of limit");
    for (int i = 0; i < x->n; i++) {
        const struct point *const p = &x->point[i];
        int which;
        const double ratio = extremes_ratio(x, p, &which);
        printf("%-*s %-8s", (int)width, p->v->label, verdict_name[p->verdict]);
        if (isfinite(p->error))
            printf(" %10.3g", p->error);
        else
            printf(" %10s", "-");
        if (isfinite(ratio))
            printf(" %10.3g", ratio);
        else
            printf(" %10s", "-");
        printf("  %.100s\n", p->v->reason);
    }
}

static void print_edges(const struct extremes *x)
{
    for (int i = 0; i < x->n_edges; i++) {
        const struct edge *const e = &x->edge[i];
        const char *const label = e->left->label;
        printf("edge: %s = %.4g, %s below, %s above", x->study.axis[e->axis].name, e->found,
               verdict_name[e->before], verdict_name[e->after]);
        if (x->grid)
            printf(" (at %s)", strchr(label, ',') ? strchr(label, ',') + 2 : label);
        if (isfinite(e->predicted))
            printf("; %s is reached at %.4g", e->limit, e->predicted);
        printf("\n");
    }
}

/* How well the limits of `check` tell what happens; returns the exit code. */
static int print_counts(const struct extremes *x)
{
    int count[VERDICTS] = {0}, spared = 0, missed = 0;
    for (int i = 0; i < x->n; i++) {
        const struct point *const p = &x->point[i];
        int which;
        const double ratio = extremes_ratio(x, p, &which);
        count[p->verdict]++;
        spared += p->verdict == POINT_RIGHT && ratio > 1.0;
        missed += p->verdict == POINT_STOPPED && !(ratio > 1.0);
    }
    printf("%d points:", x->n);
    for (int v = POINT_RIGHT; v < VERDICTS; v++)
        printf(" %d %s%s", count[v], verdict_name[v], v + 1 < VERDICTS ? "," : "\n");
    printf("the limits of check: %d right points lie beyond one, %d stopped points lie within "
           "all\n",
           spared, missed);
    for (int i = 0; i < x->n; i++)
        if (x->point[i].verdict == POINT_BROKEN)
            printf("BROKEN: %s: %s\n  %s\n", x->point[i].v->label, x->point[i].v->reason,
                   x->point[i].v->command);
    return count[POINT_BROKEN] > 0 ? EXIT_BROKEN : EXIT_GOOD;
}

static int print_axes(void)
{
    printf(
        "An axis of trade or extremes is a key (run.dt), a slot (drag), real (double, float), "
        "threads, or:\n  %-14s %-40s %s\n",
        "axis", "values where none are given", "meaning");
    for (int i = 0; named_axes[i].name; i++)
        printf("  %-14s %-40s %s\n", named_axes[i].name, named_axes[i].standard,
               named_axes[i].meaning);
    printf("Values: a,b,c; or from:to:count, evenly on a logarithmic scale (from:to:count:lin: "
           "evenly).\n");
    return EXIT_GOOD;
}

int main(int argc, char **argv)
{
    static struct extremes x;
    if (argc == 2 && strcmp(argv[1], "axes") == 0)
        return print_axes();
    parse(&x, argc, argv);
    study_open(&x.study);
    if (x.grid)
        run_grid(&x);
    else
        run_strips(&x);
    if (!x.no_edges)
        find_edges(&x);
    print_points(&x);
    print_edges(&x);
    const int code = print_counts(&x);
    extremes_write(&x);
    extremes_draw(&x);
    xfree(x.point);
    study_close(&x.study);
    return code;
}
