/* bed.c - measures of a bed, and the laws of its pressure drop.
 *
 *   Ergun          -dp/dx = 150 mu (1-eps)^2 u/(eps^3 d^2) + 1.75 rho (1-eps) u^2/(eps^3 d)
 *                                                                              [Ergun52]
 *   Kozeny-Carman  -dp/dx = C mu (1-eps)^2 u/(eps^3 d^2)              [Kozeny27], [Carman37]
 *   any drag law   -dp/dx = 18 mu (1-eps) Fhat u/(eps d^2)            drag/drag.h, a bed at rest */
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

double bed_porosity(const double *eps, int n, double h, double d)
{
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
        return 1.0;
    if (2 * skip > last - first)
        skip = (last - first) / 2;
    for (int k = first + skip; k <= last - skip; k++)
        sum += eps[k];
    return sum / (last - first + 1 - 2 * skip);
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
    const struct drag_point p = {.eps = eps, .re = f->rho * u * f->d / f->mu};
    const double phi = 1.0 - eps;
    return phi > 0.0 ? 18.0 * f->mu * phi * drag_factor(&p) * u / (eps * f->d * f->d) : 0.0;
}
