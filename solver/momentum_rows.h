/* momentum_rows.h - the inside of momentum*.c: rows of faces and what they share. */
#ifndef MOMENTUM_ROWS_H
#define MOMENTUM_ROWS_H

#include "momentum.h"

/* Fluxes rho w u_a/h of one row of control volumes: fx[i-1], fx[i] beside volume i; low and
 * high [0] in y, [1] in z. */
struct fluxes {
    double *fx, *low[2], *high[2];
};

/* The scratch of a thread; rows are numbered (k - 1) n_y + j - 1. */
struct scratch {
    double *layer[3]; /* fluxes through the upper faces of a layer in z, per component */
    double *row[3];   /* through those of a row in y */
    double *fx, *fy, *fz, *laplace, *rest;
    long first; /* row that the thread began with */
};

void momentum_rows(const struct grid *g, long *lo, long *hi); /* of this thread: [lo, hi) */
struct scratch momentum_scratch(const struct momentum *m, const struct grid *g, long first);

/* Row (j, k) of component a; lower fluxes kept from before where there are any. Afterwards
 * momentum_keep makes the upper fluxes the lower ones of rows to come. */
struct fluxes momentum_fluxes(const struct sim *s, const struct momentum *m,
                              const struct scratch *t, int a, int j, int k, bool porous);
void momentum_keep(const struct grid *g, const struct fluxes *f);

/* What comes back in through face c of an open side (end 0: low, 1: high) is held back by the
 * pressure -rho u^2/2 outside, N/m3. */
double momentum_back(const struct sim *s, int a, int end, int c);

#endif
