/* fluid_state.h - what the fluid solvers share: reading, fields, sides, guards. */
#ifndef FLUID_STATE_H
#define FLUID_STATE_H

#include "pressure.h"
#include "sim.h"

/* Reads domain.cells, density, viscosity and dt of [fluid], makes the grid, allocates and
 * registers the fields of struct fluid, and the coupling; of a bare fluid (fluid.bare, set
 * before) only velocity and pressure. dt = auto takes half of the limits at
 * the largest velocity of [flow]. False if the scene has errors: nothing is allocated then. */
bool fluid_state_create(struct sim *s, struct scene *scene);
void fluid_state_free(struct sim *s);

/* Largest sum of u dt/h over the directions: Adams-Bashforth 2 with upwind or van Leer's slopes
 * was seen to hold to 0.50, to blow up at 0.52. */
#define COURANT_MOST 0.5

double fluid_courant_limit(const struct sim *s); /* s, at the largest velocity of [flow] */
double fluid_viscous_limit(const struct sim *s); /* s, 1/(4 nu sum 1/h^2) */

/* m/s; the largest interstitial velocity to expect: that of [flow] at a porosity of 0.4. */
double fluid_expected_velocity(const struct sim *s);

/* Last face to be looped over in direction b, for faces of direction a: n, or n + 1 where b ==
 * a. */
static inline int face_last(const struct grid *g, int a, int b)
{
    return g->n[b] + (a == b);
}

/* Sides as the pressure sees them: `open` kinds are Dirichlet. */
void fluid_pressure_sides(const struct domain *d, enum poisson_side side[6]);
bool side_open(const struct domain *d, int side); /* outflow or head: pressure given */

/* 1/s; largest inflow velocity at time t (at porosity 0.4 among grains) over the cell. */
double fluid_entry_rate(const struct sim *s, double t);

/* m/s; mean superficial velocity into the box at an inflow side at time t. */
double fluid_inflow(const struct sim *s, int side, double t);

/* Normal velocities on the faces of sides where they are given at time t, ghosts of all
 * components. */
void fluid_velocity_sides(struct sim *s, double t);

/* The same for a change of component a where nothing that is given changes. */
void fluid_ghosts_of_change(const struct sim *s, int a, double *du);

/* Ghosts of any face field of direction a: periodic copies, else the nearest value. */
void fluid_ghosts_nearest(const struct sim *s, int a, double *u);

/* dp/dx_a on face c of an open side (end 0: low, 1: high), half a cell from p = 0. */
static inline double fluid_gradient(const struct sim *s, const double *p, int a, int end, int c)
{
    return end ? -2.0 * p[c - s->grid.s[a]] / s->grid.h[a] : 2.0 * p[c] / s->grid.h[a];
}

/* Pressure on a side: the mean over its faces of p + G h/2, or of the value held. */
double fluid_boundary_pressure(const struct sim *s, int side);

/* out = scale times the residual of continuity on all cells, 1/s: div(eps u) plus the difference of
 * eps in time, or fluid.rate where there is one; returns, among grains, the largest u/h, 1/s. */
double fluid_divergences(const struct sim *s, double scale, double *out);

/* Sets fluid.divergence and fluid.courant; stops the run (EXIT_UNSTABLE) where a velocity is
 * not finite or, if `limited`, where the Courant number passes COURANT_MOST. */
void fluid_guard(struct sim *s, bool limited);

#endif
