/* restitution.h - the damping that gives the restitution asked for. */
#ifndef RESTITUTION_H
#define RESTITUTION_H

/* Damping ratio zeta of a contact that ends when its force falls to zero (it never pulls) and
 * rebounds with restitution e in (0, 1]; 0 for e = 1. Holds for the linear spring with dashpot
 * 2 zeta sqrt(k m) and for Hertz with Tsuji's dashpot 2 sqrt(5/6) zeta sqrt(S_n m). */
double damping_ratio(double e);

/* omega dt up to which velocity Verlet, whose dashpots feel the velocity of the half step before, is
 * stable for a spring with dashpot 2 zeta sqrt(k m): 2 (sqrt(1 + zeta^2) - zeta). */
double damping_step(double zeta);

#endif
