/* bed.c - measures of a bed, and the laws of its pressure drop.
 *
 *   Ergun          -dp/dx = 150 mu (1-eps)^2 u/(eps^3 d^2) + 1.75 rho (1-eps) u^2/(eps^3 d)
 *                                                                              [Ergun52]
 *   Kozeny-Carman  -dp/dx = C mu (1-eps)^2 u/(eps^3 d^2)              [Kozeny27], [Carman37]
 *   any drag law   -dp/dx = 18 mu (1-eps) Fhat u/(eps d^2)            drag/drag.h, a bed at
 * rest */
#include "bed.h"

#include "../drag/drag.h"
#include "sim.h"

void bed_planes(const struct sim *s, int axis, const double *field, double *out)
{
    const struct grid *const g = &s->grid;
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (int layer = 1; layer <= g->n[axis]; layer++) {
        double sum = 0.0;
        for (int k = 1; k <= g->n[c]; k++)
            for (int j = 1; j <= g->n[b]; j++)
                sum += field[layer * g->s[axis] + j * g->s[b] + k * g->s[c]];
        out[layer - 1] = sum / ((double)g->n[b] * g->n[c]);
    }
}

double bed_diameter(const struct sim *s)
{
    double cubes = 0.0, squares = 0.0;
    for (int i = 0; i < s->grains.n; i++) {
        const double d = s->grains.species[s->grains.kind[i]].diameter;
        cubes += d * d * d;
        squares += d * d;
    }
    return squares > 0.0 ? cubes / squares : 0.0;
}

double bed_solid(const struct sim *s)
{
    double volume = 0.0;
    for (int i = 0; i < s->grains.n; i++)
        volume += s->grains.volume[i];
    return volume;
}

double bed_weight(const struct sim *s)
{
    double mass = 0.0;
    for (int i = 0; i < s->grains.n; i++)
        if (s->grains.inv_mass[i] > 0.0)
            mass += s->grains.mass[i] - s->fluid.rho * s->grains.volume[i];
    return mass * v3_norm(s->domain.gravity);
}

/* Layers, and part of one, that the solid of layer `edge` and of those outwards of it would
 * fill if packed like the middle. One, where the bed ends on the side of the box. */
static double edge_layers(const double *eps, int n, int edge, int outwards, double phi)
{
    double sum = 0.0;
    if (edge + outwards < 0 || edge + outwards >= n)
        return 1.0;
    for (int k = edge; k >= 0 && k < n; k += outwards)
        sum += (1.0 - eps[k]) / phi;
    return sum;
}

struct bed_size bed_measure(const double *eps, int n, double h, double d, double solid)
{
    struct bed_size bed = {.middle = 1.0, .porosity = 1.0};
    double most = 0.0, sum = 0.0;
    int first = n, last = -1, skip = (int)ceil(fmax(2.0 * d, h) / h - 1e-9);
    for (int k = 0; k < n; k++)
        most = fmax(most, 1.0 - eps[k]);
    for (int k = 0; k < n && most > 0.0; k++)
        if (1.0 - eps[k] > 0.5 * most) {
            first = k < first ? k : first;
            last = k;
        }
    if (last < 0)
        return bed;
    if (2 * skip > last - first)
        skip = (last - first) / 2;
    for (int k = first + skip; k <= last - skip; k++)
        sum += eps[k];
    bed.middle = sum / (last - first + 1 - 2 * skip);
    const double phi = 1.0 - bed.middle;
    bed.height = solid / phi;
    if (last > first)
        bed.height = h * (last - first - 1 + edge_layers(eps, n, first, -1, phi) +
                          edge_layers(eps, n, last, 1, phi));
    bed.porosity = 1.0 - solid / bed.height;
    return bed;
}

double bed_ergun(const struct bed_fluid *f, double eps, double u)
{
    const double phi = 1.0 - eps, eps3 = eps * eps * eps;
    return 150.0 * f->mu * phi * phi * u / (eps3 * f->d * f->d) +
           1.75 * f->rho * phi * u * u / (eps3 * f->d);
}

double bed_kozeny_carman(const struct bed_fluid *f, double eps, double u, double constant)
{
    const double phi = 1.0 - eps;
    return constant * f->mu * phi * phi * u / (eps * eps * eps * f->d * f->d);
}

double bed_law(const struct bed_fluid *f, double eps, double u)
{
    const struct drag_point p = {
        .eps = eps, .re = f->rho * u * f->d / f->mu, .d = f->d, .y = 1.0, .grain = f->grain};
    const double phi = 1.0 - eps;
    return phi > 0.0 ? 18.0 * f->mu * phi * drag_factor(&p) * u / (eps * f->d * f->d) : 0.0;
}

double bed_ergun_velocity(const struct bed_fluid *f, const struct bed_size *bed, double weight)
{
    const struct bed_fluid inviscid = {.d = f->d, .rho = f->rho};
    const struct bed_curve c = {.a = bed->height *
                                     bed_kozeny_carman(f, bed->porosity, 1.0, 150.0),
                                .b = bed->height * bed_ergun(&inviscid, bed->porosity, 1.0)};
    return bed_curve_meets(&c, weight);
}

double bed_law_velocity(const struct bed_fluid *f, const struct bed_size *bed, double weight)
{
    double lo = 0.0, hi = 1e-9;
    while (bed_law(f, bed->porosity, hi) * bed->height < weight) {
        hi *= 2.0;
        if (hi > 1e6)
            return (double)NAN;
    }
    for (int i = 0; i < 200; i++) { /* to the last bit */
        const double middle = 0.5 * (lo + hi);
        if (bed_law(f, bed->porosity, middle) * bed->height < weight)
            lo = middle;
        else
            hi = middle;
    }
    return hi;
}

struct bed_curve bed_curve_fit(int n, const double *u, const double *drop)
{
    struct bed_curve c = {0.0, 0.0};
    double s11 = 0.0, s12 = 0.0, s22 = 0.0, s1 = 0.0, s2 = 0.0;
    for (int k = 0; k < n; k++) {
        const double x = u[k] / drop[k], y = x * u[k];
        s11 += x * x;
        s12 += x * y;
        s22 += y * y;
        s1 += x;
        s2 += y;
    }
    const double det = s11 * s22 - s12 * s12;
    if (n > 0)
        c.a = s1 / s11;
    if (n >= 4 && s11 * s2 > s12 * s1) {
        c.a = (s22 * s1 - s12 * s2) / det;
        c.b = (s11 * s2 - s12 * s1) / det;
    }
    return c;
}

double bed_curve_meets(const struct bed_curve *c, double drop)
{
    return 2.0 * drop / (c->a + sqrt(c->a * c->a + 4.0 * c->b * drop));
}
