/* size_distribution.h - the diameters of a species: one, uniform, log-normal, or from a table.
 *
 * A distribution is asked for by mass (a part q of the solid's mass is in finer grains: what a
 * sieve weighs) or by number; grains are drawn by number, so a distribution by mass is divided by
 * d^3 first. Grain k takes the quantile u_k = frac(u_0 + k golden) of the distribution by number
 * (an additive recurrence): every stretch of the sequence follows the distribution to about one
 * grain, where independent draws would miss it by the square root of their number. It follows
 * from seed, species and k alone. */
#ifndef SIZE_DISTRIBUTION_H
#define SIZE_DISTRIBUTION_H

#include "scene.h"

enum sizes_kind { SIZES_ONE, SIZES_UNIFORM, SIZES_LOGNORMAL, SIZES_TABLE, SIZES_CURVE };

/* Diameters a..b with equal density (by mass or by number) between; a = b: one diameter. */
struct size_class {
    double a, b;     /* m */
    double fraction; /* as asked; all together 1 */
    double number;   /* of the grains up to and with this class */
    double mass;     /* of the solid up to and with this class */
};

struct sizes {
    enum sizes_kind kind;
    bool by_mass;
    double least, largest; /* m */
    double mean_cube;      /* m3, mean of d^3 by number */
    double median, spread; /* log-normal: m, by number; logarithm of the geometric deviation */
    int n;
    struct size_class *classes;
};

extern const struct key sizes_keys[]; /* of section "grains" */

/* Reads the sizes of species `name`; errors go on the scene's list, and sizes are sound numbers
 * all the same. Freed by sizes_free. */
void sizes_read(struct sizes *z, struct scene *scene, const char *name);
void sizes_free(struct sizes *z);

double sizes_by_number(const struct sizes *z,
                       double u);                      /* m; a part u of the grains is finer */
double sizes_by_mass(const struct sizes *z, double q); /* m; a part q of the mass is finer */
double sizes_draw(const struct sizes *z, unsigned long seed, int species, long k); /* m */

/* m; diameter below which a part q of the mass of these n grains lies: between two diameters,
 * linear in the mass up to the middle of each. Sorts d. */
double sizes_measured(double *d, size_t n, double q);

#endif
