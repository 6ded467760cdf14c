/* forces.h - the answers of forces/ at work: what they see, what they do, what the fluid gets back.
 * Part of the coupling, which calls it.
 *
 * A fluid step: forces_sense at its start makes the explicit force F_x of each grain from the fields at
 * hand, and the torque's rate; forces_on_fluid takes the reaction from the fluid's momentum, per face,
 * with the weights of the grain's shares; forces_load at the end of the step adds what the grain feels.
 *
 * Added inertia: a grain's inverse mass is that of m + m_a, and its load holds m_a (Du/Dt - g), with the
 * fluid's acceleration over this very step; -m_a g undoes what weight the motion gives to m_a. What the
 * fluid loses by it is the mean of the step before, m_a (Du/Dt - dv/dt). */
#ifndef FORCES_H
#define FORCES_H

#include "table.h"
#include "vec3.h"

struct sim;
struct scene;

struct fluid_forces {
    double pressure, viscous,
        weight;      /* what a grain takes of V (f - grad p), V div tau, V rho g */
    bool any, spins; /* some other force; some torque */
    double added;    /* m_a over rho V */
    bool due;        /* F_x of this step is still to be made */
    double *u[3],
        *curl[3];        /* on cells: interstitial velocity and its curl, as grains see them */
    double *u_old[3];    /* m/s on cells, a step ago (state) */
    double *on_cells[3]; /* N, returned forces on cells */
    vec3 *force;         /* N per grain, F_x (state, output) */
    vec3 *force_old;     /* N per grain, F_x of the step before (state) */
    vec3 *pulled;        /* N per grain, m_a Du/Dt of the last step (state) */
    vec3 *given;         /* N per grain, what the fluid loses at this step */
    vec3 *spin_old;      /* rad/s at the last fluid step (state) */
    vec3 *torque;        /* N m per grain at this step */
};

void forces_read(struct sim *s, struct scene *scene);
void forces_create(struct sim *s);
void forces_free(struct sim *s);

void forces_sense(struct sim *s);
vec3 forces_change(const struct sim *s, int i); /* N, F_x less that of the step before */
void forces_on_fluid(struct sim *s);            /* drag_s less the reaction */
/* The fluid's acceleration over the step just done; then, once per step and grain, what else grain i is
 * to feel over the grain steps that follow, N. Sets its torque. */
void forces_see_acceleration(struct sim *s);
vec3 forces_load(struct sim *s, int i);
/* Gives grains that move the inertia m + m_a. */
void forces_inertia(struct sim *s);

#endif
