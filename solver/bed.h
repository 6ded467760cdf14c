/* bed.h - a bed of grains as the classical laws see it: porosity, height, diameter, pressure
 * drop.
 *
 * All of it is measured from the grains and from the fluid fraction on the grid. Velocities are
 * superficial, gradients are -dp/dx > 0. */
#ifndef BED_H
#define BED_H

struct drag_grain;
struct sim;

/* What a law needs besides porosity and velocity. */
struct bed_fluid {
    double d;                       /* m, diameter */
    double rho, mu;                 /* kg/m3, Pa s */
    const struct drag_grain *grain; /* for bed_law: what its grains are */
};

/* Mean of a field of cells over each plane across `axis`; out[0..n-1] from the low side. */
void bed_planes(const struct sim *s, int axis, const double *field, double *out);

/* m; volume-to-surface (Sauter) mean of the grains' diameters: sum d^3 / sum d^2. */
double bed_diameter(const struct sim *s);

/* m3; of all grains. */
double bed_solid(const struct sim *s);

/* N; weight less buoyancy of the grains that are free to move. */
double bed_weight(const struct sim *s);

/* What the profile of porosity says of a bed. */
struct bed_size {
    double middle;   /* porosity inside, away from bottom and surface */
    double height;   /* m, from bottom to surface */
    double porosity; /* of the whole bed: 1 - (volume of grains per area)/height */
};

/* From the porosity of n layers of thickness h, for grains of diameter d and `solid` m of them
 * (volume per area). The middle leaves out 2 d, and one layer at least, at either end, as far
 * as there are layers enough. The surface lies where the layers' solid would end if the last
 * were packed like the middle; likewise the bottom, unless the bed rests on the side of the
 * box. */
struct bed_size bed_measure(const double *eps, int n, double h, double d, double solid);

/* Pa/m at porosity eps and superficial velocity u. */
double bed_ergun(const struct bed_fluid *f, double eps, double u); /* [Ergun52] */
double bed_kozeny_carman(const struct bed_fluid *f, double eps, double u, double constant);
double bed_law(const struct bed_fluid *f, double eps, double u); /* the drag law linked in */

/* m/s; velocities at which the drop over a bed is `weight` (Pa): Ergun's, in closed form, and
 * the linked law's, a root; NAN if there is none. */
double bed_ergun_velocity(const struct bed_fluid *f, const struct bed_size *bed, double weight);
double bed_law_velocity(const struct bed_fluid *f, const struct bed_size *bed, double weight);

/* A curve drop = a u + b u^2. */
struct bed_curve {
    double a, b; /* Pa s/m, Pa s2/m2 */
};

/* By least squares of the relative errors of n points, all positive; b = 0 from less than 4
 * points, or where it would be negative. */
struct bed_curve bed_curve_fit(int n, const double *u, const double *drop);
double bed_curve_meets(const struct bed_curve *c,
                       double drop); /* m/s, where it reaches a drop */

#endif
