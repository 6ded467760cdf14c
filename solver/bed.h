/* bed.h - a bed of grains as the classical laws see it: porosity, height, diameter, pressure drop.
 *
 * All of it is measured from the grains and from the fluid fraction on the grid. Velocities are
 * superficial, gradients are -dp/dx > 0. */
#ifndef BED_H
#define BED_H

struct sim;

/* What a law needs besides porosity and velocity. */
struct bed_fluid {
    double d;       /* m, diameter */
    double rho, mu; /* kg/m3, Pa s */
};

/* Mean of a field of cells over each plane across `axis`; out[0..n-1] from the low side. */
void bed_planes(const struct sim *s, int axis, const double *field, double *out);

/* m; volume-to-surface (Sauter) mean of the grains' diameters: sum d^3 / sum d^2. */
double bed_diameter(const struct sim *s);

/* m3; of all grains. */
double bed_solid(const struct sim *s);

/* N; weight less buoyancy of the grains that are free to move. */
double bed_weight(const struct sim *s);

/* Mean porosity inside the bed, from its profile in n layers of h: without 2 d, and one layer at
 * least, at its bottom and top (as far as there are layers enough). 1 without a bed. */
double bed_porosity(const double *eps, int n, double h, double d);

/* Pa/m at porosity eps and superficial velocity u. */
double bed_ergun(const struct bed_fluid *f, double eps, double u);                /* [Ergun52] */
double bed_kozeny_carman(const struct bed_fluid *f, double eps, double u, double constant);
double bed_law(const struct bed_fluid *f, double eps, double u); /* the drag law linked in */

#endif
