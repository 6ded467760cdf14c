/* solver/fluid/fluid.h - contract: what flows?
 *
 * To add a solver: copy none.c to solver/fluid/NAME.c. Every answer exports exactly the symbols
 * below. The three verbs are those of step.c:
 *   fluid_sense  the grains as the grid sees them: fluid fraction and drag coefficients
 *   fluid_step   the fields advance by fluid.dt, to the positions of the grains at hand
 *   fluid_load   the force of the fluid on each grain, constant over the sub-steps that follow
 * A solver calls coupling.h for the exchange with the grains; `none` refers to nothing, so that
 * a dry binary links neither the coupling nor FFTW. */
#ifndef FLUID_H
#define FLUID_H

#include "../grid.h"

struct sim;

struct fluid {
    bool exists;    /* false: the `none` answer */
    bool on;        /* it flows (t >= flow.start) */
    double rho, mu; /* kg/m3, Pa s */
    double dt;      /* s, fluid step */
    double *u[3];   /* m/s, interstitial velocity on faces (low face of the cell) */
    double *p;      /* Pa at centres, without the hydrostatic part */
    double *eps;    /* fluid fraction at centres, ghosts filled; on a face, below eps_f, that of
                          the two cells (grid_face): on the boundary that of the one inside */
    double *eps_old;   /* the same at the step before */
    double *drag[3];   /* kg/(m3 s), B on faces: the fluid feels -(B u - S) per volume, */
    double *drag_s[3]; /* N/m3, S = B v_s with the grains' velocity */
    double *stress[3]; /* N/m3 on faces, G = -grad p + div tau: fluid gets eps_f G, grains the
                          rest */
    bool bare;         /* there are no grains: eps = 1; eps*, drag*, stress are NULL */
    double *rate;      /* 1/s on cells, what continuity has besides div(eps u): d(eps)/dt by the
                          grains' flux, storage, sources; NULL: (eps - eps_old)/dt */
    int pieces;        /* grain steps per fluid step where no grain sets them (auto) */
    bool implicit_viscosity; /* no limit of the time step by viscosity */
    const char *equation;    /* the form of the momentum equation, for the log; or NULL */
    bool deaf;               /* it does not feel grains: the coupling is one-way */
    bool whole_pressure;     /* form 27c: the fluid takes all of G; on grains drag/eps alone */
    struct fluid_work *work; /* the answer's own: solver, scratch, fields of steps before */
    long steps;              /* taken so far */
    int iterations;          /* of the last pressure solve */
    double residual;         /* relative, of the last pressure solve */
    double divergence; /* largest residual of continuity, times h/U, after the last step */
    double courant;    /* largest sum over directions of u dt / h at the last step */
};

extern const struct about fluid_about;
extern const struct key fluid_keys[];

/* Reads its keys and allocates its fields (s->fluid, s->grid), registers them (s->fields). */
void fluid_create(struct sim *s, struct scene *scene);
void fluid_free(struct sim *s);

void fluid_sense(struct sim *s);
void fluid_step(struct sim *s);
void fluid_load(struct sim *s);

/* Pressure [Pa] at the boundary face next to cell c of side `side`, by the momentum balance of
 * the half cell; mean over the side. */
double fluid_side_pressure(const struct sim *s, int side);

/* Lines of the feasibility report, see feasibility.h. */
struct feasibility;
void fluid_feasibility(const struct sim *s, struct feasibility *f);

#endif
