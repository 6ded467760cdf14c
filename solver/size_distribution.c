/* size_distribution.c - diameters by quantiles.
 *
 * Within a class of equal density by mass the density by number goes with d^-3, so with
 * v = part of the class' grains that are finer, d = (a^-2 + v (b^-2 - a^-2))^(-1/2); within one
 * of equal density by number, with v = part of its mass, d = (a^4 + v (b^4 - a^4))^(1/4).
 * A log-normal distribution by mass with median D and deviation s of ln d is one by number with
 * median D exp(-3 s^2) and the same s [HatchChoate29]; it is cut at both ends. The recurrence by
 * the golden ratio has the least discrepancy of its kind [Niederreiter92]. */
#include "size_distribution.h"

#include <errno.h>
#include <gsl/gsl_cdf.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include "../shapes/shape.h"
#include "bed_file.h"
#include "contact_path.h"
#include "fill.h"
#include "units.h"

#define GOLDEN     0.61803398874989484820
#define DEVIATIONS 2.5 /* where a log-normal distribution is cut by default */

const struct key sizes_keys[] = {
    {"grains", "diameter", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "volume-equivalent diameter; log-normal sizes: the median (uniform, table, curve: not "
     "used)"},
    {"grains", "sizes", KEY_CHOICE, "", "one | uniform | lognormal | table | curve", "one",
     "one diameter, or a distribution; table: classes of one diameter each, curve: parts finer "
     "than each diameter (a sieve curve)"},
    {"grains", "sizes_by", KEY_CHOICE, "", "mass | number", "mass",
     "whether fractions and medians of `sizes` count the grains' mass or their number"},
    {"grains", "diameter_min", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "least diameter, for uniform and lognormal; auto: 2.5 deviations below the median"},
    {"grains", "diameter_max", KEY_REAL, "m", "auto | (0, inf)", "auto",
     "largest diameter, likewise"},
    {"grains", "spread", KEY_REAL, "1", "auto | (1, 10]", "auto",
     "geometric standard deviation, for lognormal"},
    {"grains", "size_file", KEY_TEXT, "", "", "",
     "for table and curve: a text file with `diameter, fraction` a line; its first line may "
     "name "
     "the unit, as in `diameter mm, fraction`"},
    {0},
};

/* Mean of d^p over a..b with equal density in d. */
static double mean_power(double a, double b, int p)
{
    if (b - a < 1e-9 * b)
        return pow(0.5 * (a + b), p);
    return (pow(b, p + 1) - pow(a, p + 1)) / ((p + 1) * (b - a));
}

/* Sums the classes to cumulated parts by number and by mass. */
static void cumulate(struct sizes *z)
{
    double number = 0.0, mass = 0.0;
    for (int c = 0; c < z->n; c++) {
        struct size_class *const k = &z->classes[c];
        number += k->fraction * (z->by_mass ? mean_power(k->a, k->b, -3) : 1.0);
        mass += k->fraction * (z->by_mass ? 1.0 : mean_power(k->a, k->b, 3));
        k->number = number;
        k->mass = mass;
    }
    for (int c = 0; c < z->n; c++) {
        z->classes[c].number /= number;
        z->classes[c].mass /= mass;
    }
    z->mean_cube = mass / number;
    z->least = z->classes[0].a;
    z->largest = z->classes[z->n - 1].b;
}

static void one_class(struct sizes *z, double a, double b)
{
    z->n = 1;
    z->classes = xalloc(1, sizeof *z->classes);
    z->classes[0] = (struct size_class){.a = a, .b = b, .fraction = 1.0};
    cumulate(z);
}

/* A diameter key that this distribution needs; 0 where it is missing, which is on the list. */
static double needed(struct scene *s, const char *name, const char *key, const char *why)
{
    if (!scene_word(s, "grains", name, key, "auto"))
        return scene_real(s, "grains", name, key);
    scene_error(s, "grains", name, key, "must be given%s%s", why[0] ? " for sizes = " : "",
                why);
    return 0.0;
}

static void read_uniform(struct sizes *z, struct scene *s, const char *name)
{
    const double a = needed(s, name, "diameter_min", "uniform");
    const double b = needed(s, name, "diameter_max", "uniform");
    if (a > 0.0 && b > 0.0 && !(a < b))
        scene_error(s, "grains", name, "diameter_max", "must be above diameter_min, %g m", a);
    one_class(z, a > 0.0 ? a : 1.0, b > a ? b : a > 0.0 ? a : 1.0);
}

/* Standard scores of the ends, by number shifted by `shift` deviations. */
static double score(const struct sizes *z, double d, double shift)
{
    return log(d / z->median) / z->spread - shift * z->spread;
}

static void read_lognormal(struct sizes *z, struct scene *s, const char *name)
{
    const double median = needed(s, name, "diameter", "lognormal");
    const double deviation = needed(s, name, "spread", "lognormal");
    if (!(median > 0.0) || !(deviation > 1.0)) {
        one_class(z, 1.0, 1.0);
        z->kind = SIZES_ONE;
        return;
    }
    z->spread = log(deviation);
    z->median = z->by_mass ? median * exp(-3.0 * z->spread * z->spread) : median;
    const bool low = scene_word(s, "grains", name, "diameter_min", "auto");
    const bool high = scene_word(s, "grains", name, "diameter_max", "auto");
    z->least = low ? median * exp(-DEVIATIONS * z->spread)
                   : scene_real(s, "grains", name, "diameter_min");
    z->largest = high ? median * exp(DEVIATIONS * z->spread)
                      : scene_real(s, "grains", name, "diameter_max");
    if (!(z->least < z->largest)) {
        scene_error(s, "grains", name, high ? "diameter_min" : "diameter_max",
                    "the sizes must span from diameter_min to diameter_max, %g to %g m",
                    z->least, z->largest);
        z->largest = z->least * 1.001;
    }
    const double lo = score(z, z->least, 0.0), hi = score(z, z->largest, 0.0);
    const double lo3 = score(z, z->least, 3.0), hi3 = score(z, z->largest, 3.0);
    z->mean_cube = exp(3.0 * log(z->median) + 4.5 * z->spread * z->spread) *
                   (gsl_cdf_ugaussian_P(hi3) - gsl_cdf_ugaussian_P(lo3)) /
                   (gsl_cdf_ugaussian_P(hi) - gsl_cdf_ugaussian_P(lo));
}

/* "diameter mm, fraction": its unit in metres, or NULL and a message. */
static char *header_unit(const char *line, double *unit, bool *is_header)
{
    char word[64] = "", name[32] = "", extra[8] = "";
    double offset = 0.0;
    *is_header = strncasecmp(line + strspn(line, " \t"), "diameter", 8) == 0;
    if (!*is_header)
        return NULL;
    const int got = sscanf(line, " %31[^] \t,([]%*[] \t([]%63[^]),\t ]%7s", name, word, extra);
    if (got < 2)
        return NULL; /* no unit: metres */
    if (units_convert(word, "m", unit, &offset) != UNIT_GOOD || offset != 0.0)
        return xprintf("%s is not a unit of length", word);
    return NULL;
}

/* Rows of two numbers. Returns NULL, or why it cannot. */
static char *read_rows(FILE *file, const char *path, int *n, double **rows)
{
    char line[256];
    double unit = 1.0;
    int capacity = 0;
    for (int number = 1; fgets(line, sizeof line, file); number++) {
        line[strcspn(line, "#\r\n")] = '\0';
        if (line[strspn(line, " \t")] == '\0')
            continue;
        bool header = false;
        if (*n == 0) {
            char *const why = header_unit(line, &unit, &header);
            if (why) {
                char *const full = xprintf("%s:%d: %s", path, number, why);
                xfree(why);
                return full;
            }
        }
        if (header)
            continue;
        char *at, *end;
        const double d = strtod(line, &at);
        at += strspn(at, ", ;\t");
        const double f = strtod(at, &end);
        if (at == line || end == at || end[strspn(end, " \t,;")] != '\0' || !isfinite(d * f) ||
            !(d > 0.0) || f < 0.0)
            return xprintf(
                "%s:%d: must hold a diameter above 0 and a fraction, \"%.40s\" does not", path,
                number, line);
        if (*n == capacity) {
            *rows =
                xrealloc(*rows, 2 * (size_t)capacity, 2 * (size_t)capacity + 64, sizeof **rows);
            capacity += 32;
        }
        (*rows)[2 * *n] = unit * d;
        (*rows)[2 * (*n)++ + 1] = f;
        if (*n > 1 && !(unit * d > (*rows)[2 * *n - 4]))
            return xprintf("%s:%d: diameters must rise", path, number);
    }
    return NULL;
}

/* Classes from the rows. Returns NULL, or what is wrong. */
static char *make_classes(struct sizes *z, int n, const double *rows)
{
    const bool curve = z->kind == SIZES_CURVE;
    double sum = 0.0;
    if (n < (curve ? 2 : 1))
        return xprintf("holds %d lines of numbers, too few", n);
    for (int i = 0; i < n; i++) {
        sum = curve ? rows[2 * i + 1] : sum + rows[2 * i + 1];
        if (curve && i > 0 && rows[2 * i + 1] < rows[2 * i - 1])
            return xprintf("the part finer must not fall");
    }
    if (curve && rows[1] != 0.0)
        return xprintf("the part finer than the first diameter must be 0, it is %g", rows[1]);
    const double full = fabs(sum - 1.0) < 1e-3 ? 1.0 : fabs(sum - 100.0) < 0.1 ? 100.0 : 0.0;
    if (full == 0.0)
        return xprintf(curve ? "the part finer must end at 1 (or 100), it ends at %g"
                             : "the fractions must add up to 1 (or 100), they add up to %g",
                       sum);
    z->classes = xalloc((size_t)n, sizeof *z->classes);
    for (int i = curve ? 1 : 0; i < n; i++) {
        const double part = (curve ? rows[2 * i + 1] - rows[2 * i - 1] : rows[2 * i + 1]) / sum;
        if (part > 0.0)
            z->classes[z->n++] = (struct size_class){
                .a = rows[2 * (curve ? i - 1 : i)], .b = rows[2 * i], .fraction = part};
    }
    cumulate(z);
    return NULL;
}

static void read_table(struct sizes *z, struct scene *s, const char *name)
{
    const char *const path = scene_text(s, "grains", name, "size_file");
    char *why = NULL, *const found = bed_file_path(path, scene_path(s));
    double *rows = NULL;
    int n = 0;
    FILE *const file = path[0] ? fopen(found, "r") : NULL;
    if (path[0] == '\0')
        why = xstrdup("must name a file, for sizes = table and curve");
    else if (!file)
        why = xprintf("%s: %s", path, strerror(errno));
    else if (!(why = read_rows(file, path, &n, &rows)) && (why = make_classes(z, n, rows))) {
        char *const full = xprintf("%s: %s", path, why);
        xfree(why);
        why = full;
    }
    if (file)
        fclose(file);
    if (why) {
        scene_error(s, "grains", name, "size_file", "%s", why);
        xfree(z->classes);
        one_class(z, 1.0, 1.0);
    }
    xfree(why);
    xfree(found);
    xfree(rows);
}

/* Whether grain i of a file is of the species that is to take it, see fill_from_file. */
static bool takes(const struct bed_file *f, int i, const char *species)
{
    return !f->kind || f->n_species < 2 || strcmp(f->species[f->kind[i]], species) == 0;
}

/* From the finest to the widest grain of the file that the species is filled from; false where no file
 * tells, or where it tells the diameters of bounding spheres of other shapes. */
static bool read_file(struct sizes *z, struct scene *s, const char *name)
{
    const char *const asked = scene_text(s, "grains", name, "file_species");
    struct bed_file f;
    if (!scene_word(s, "grains", name, "diameter", "auto") || shape.path->turning ||
        scene_choice(s, "grains", name, "fill") != FILL_FILE)
        return false;
    char *const why = bed_file_read(&f, scene_text(s, "grains", name, "file"), scene_path(s));
    double least = (double)INFINITY, largest = 0.0;
    for (int i = 0; !why && i < f.n; i++)
        if (takes(&f, i, asked[0] ? asked : name)) {
            least = fmin(least, f.diameter[i]);
            largest = fmax(largest, f.diameter[i]);
        }
    if (why)
        scene_error(s, "grains", name, "file", "%s", why);
    else
        bed_file_free(&f);
    if (why || largest > 0.0)
        one_class(z, why ? 1e-9 : least, why ? 1e-9 : largest);
    const bool told = why || largest > 0.0;
    xfree(why);
    return told;
}

void sizes_read(struct sizes *z, struct scene *s, const char *name)
{
    *z = (struct sizes){0};
    z->kind = (enum sizes_kind)scene_choice(s, "grains", name, "sizes");
    if (z->kind != SIZES_ONE)
        z->by_mass = scene_choice(s, "grains", name, "sizes_by") == 0;
    switch (z->kind) {
    case SIZES_ONE: {
        if (read_file(z, s, name))
            break;
        const double d = needed(s, name, "diameter", "");
        one_class(z, d > 0.0 ? d : 1.0, d > 0.0 ? d : 1.0);
        break;
    }
    case SIZES_UNIFORM:
        read_uniform(z, s, name);
        break;
    case SIZES_LOGNORMAL:
        read_lognormal(z, s, name);
        break;
    default:
        read_table(z, s, name);
    }
}

void sizes_free(struct sizes *z)
{
    xfree(z->classes);
    *z = (struct sizes){0};
}

/* The quantile of a cut log-normal distribution. */
static double lognormal(const struct sizes *z, double part, double shift)
{
    const double lo = gsl_cdf_ugaussian_P(score(z, z->least, shift));
    const double hi = gsl_cdf_ugaussian_P(score(z, z->largest, shift));
    const double x = gsl_cdf_ugaussian_Pinv(lo + part * (hi - lo));
    const double d = z->median * exp(z->spread * (x + shift * z->spread));
    return fmin(fmax(d, z->least), z->largest);
}

static double quantile(const struct sizes *z, double part, bool of_mass)
{
    int c = 0;
    part = fmin(fmax(part, 0.0), 1.0);
    while (c < z->n - 1 && part >= (of_mass ? z->classes[c].mass : z->classes[c].number))
        c++;
    const struct size_class *const k = &z->classes[c], *const before = c > 0 ? k - 1 : NULL;
    if (k->a == k->b)
        return k->a;
    const double from = !before ? 0.0 : of_mass ? before->mass : before->number;
    const double v = (part - from) / ((of_mass ? k->mass : k->number) - from);
    const int p = of_mass == z->by_mass ? 1 : of_mass ? 4 : -2;
    const double a = pow(k->a, p), b = pow(k->b, p);
    return fmin(fmax(pow(a + v * (b - a), 1.0 / p), k->a), k->b);
}

double sizes_by_number(const struct sizes *z, double u)
{
    return z->kind == SIZES_LOGNORMAL ? lognormal(z, u, 0.0) : quantile(z, u, false);
}

double sizes_by_mass(const struct sizes *z, double q)
{
    return z->kind == SIZES_LOGNORMAL ? lognormal(z, q, 3.0) : quantile(z, q, true);
}

double sizes_draw(const struct sizes *z, unsigned long seed, int species, long k)
{
    const double start = (double)((seed * 2654435761u + 97u * (unsigned)species) & 0xffffffu);
    const double u = start / 16777216.0 + (double)k * GOLDEN;
    return sizes_by_number(z, u - floor(u));
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double sizes_measured(double *d, size_t n, double q)
{
    double total = 0.0, below = 0.0, last = 0.0, at_last = 0.0;
    qsort(d, n, sizeof *d, rising);
    for (size_t i = 0; i < n; i++)
        total += d[i] * d[i] * d[i];
    for (size_t i = 0; i < n; i++) {
        const double cube = d[i] * d[i] * d[i], middle = below + 0.5 * cube;
        if (middle >= q * total) {
            if (i == 0 || middle == at_last)
                return d[i];
            return last + (d[i] - last) * (q * total - at_last) / (middle - at_last);
        }
        last = d[i];
        at_last = middle;
        below += cube;
    }
    return n > 0 ? d[n - 1] : 0.0;
}
