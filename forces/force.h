/* forces/force.h - contract: what does the fluid do to a grain, besides drag?
 *
 * A scene names as many answers as it wants, in [modules]. The standard ones of FORCES_STANDARD need no
 * name; a minus takes one away, `none` all of them:
 *   forces = virtual_mass -viscous     buoyancy, pressure gradient, virtual mass
 *   forces = none buoyancy             nothing but buoyancy
 * The binary holds those and no others. To add one: a new file forces/NAME.c with one
 * `const struct force force_NAME`; nothing else is edited.
 *
 * Pressure and viscous force and buoyancy are terms that the fluid's equation holds already: `of_pressure`,
 * `of_viscous`, `of_weight` say how much of V (f - grad p), V div tau and V rho g a grain takes. Forms 27a
 * and 27b of the momentum equation give eps of the stress to the fluid and the rest to the grains, with the
 * weights by which they are spread; 27c gives all to the fluid, drag/eps to the grains, and a scene of that
 * form that names one of the two is refused. Without one of them the fluid keeps its equation, and what
 * the grains would have borne is lost to both.
 *
 * Another force is a pure function of what a grain sees at the start of a fluid step and stays constant over
 * the step. It is called from parallel loops. Its reaction, where `returned`, goes to the fluid of the
 * same step with the weights by which the grain is spread, in every form of the momentum equation: form
 * 27a and 27b hold the pressure and viscous forces already, 27c none of these (the review's eq. 30
 * returns all of them alike).
 *
 * Two effects are not forces of this kind, and the coupling takes them implicitly:
 *   added inertia   m_a (Du/Dt - dv/dt), m_a = added_mass() rho V: dv/dt moves to the other side, so the
 *                   grain has the inertia m + m_a in its contacts too, and no density ratio is unstable
 *   torque          rate (curl u/2 - omega), backward Euler: no limit on the fluid's step */
#ifndef FORCE_H
#define FORCE_H

#include "../solver/scene.h"

/* What a grain sees; fields of the fluid with the weights by which it is spread. */
struct force_view {
    double d, mass; /* m, volume-equivalent diameter; kg */
    double rho, mu; /* kg/m3, Pa s, of the fluid */
    double eps;     /* fluid fraction */
    double dt;      /* s, the fluid's step */
    vec3 slip;      /* m/s, u - v, interstitial */
    vec3 curl;      /* 1/s, of the fluid's velocity */
    vec3 spin;      /* rad/s, of the grain */
    long id, step;  /* of the grain, of the run: what random numbers may depend on */
    unsigned long seed;
};

#define FORCES_STANDARD "buoyancy pressure_gradient viscous"

struct force {
    struct about about;
    const struct key *keys;                          /* of section "forces" */
    bool returned;                                   /* the fluid feels the reaction */
    void (*read)(struct scene *s);                   /* NULL: nothing to read */
    vec3 (*act)(const struct force_view *v);         /* N; NULL: none of this kind */
    double (*added_mass)(void);                      /* over rho V; NULL: none */
    double (*spin_rate)(const struct force_view *v); /* N m s; NULL: no torque */
    double of_pressure, of_viscous, of_weight;       /* V (f - grad p), V div tau, V rho g */
};

/* The forces of this binary; the last entry is NULL. */
extern const struct force *const forces[];

#endif
