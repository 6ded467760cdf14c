/* ledger.h - what must add up: mass, momentum, volume, energy. Closed once per step().
 *
 * Momentum of the grains: change = weight + walls + fluid (contacts cancel). Momentum handed
 * over between fluid and grains: both sides are summed on their own and compared. Volume:
 * grains on the grid against grains. Energy: kinetic + potential + elastic + dissipated = start
 * + work of the fluid (and of moving walls); what the contacts dissipated follows and must not
 * be negative. */
#ifndef LEDGER_H
#define LEDGER_H

#include "base.h"

struct sim;

struct ledger {
    double inertia;                /* kg, mass and added mass of these */
    double mass;                   /* kg of grains that move */
    double mass_start;             /* kg, and what came less what went since */
    vec3 momentum, momentum_start; /* kg m/s */
    vec3 impulse_weight, impulse_walls, impulse_fluid; /* N s since the start */
    double momentum_error; /* |change - impulses| / (sum of |impulses|, wall by wall) */
    double handover_error; /* largest |to_grains + from_grains| / |to_grains| */
    double volume_error;   /* largest |volume on grid / volume - 1| */
    double kinetic, potential, elastic;          /* J */
    double energy_start, work_fluid, dissipated; /* J */
    double dissipated_least; /* J, most negative drop seen: contacts that made energy */
};

void ledger_start(struct sim *s);
void ledger_close(struct sim *s);
/* From now on grain i has more inertia than its mass: fluid that moves with it. */
void ledger_gain(struct sim *s, int i, double mass);

void ledger_report(
    struct sim *s); /* to the summary; a ledger that does not close says so loudly */

#endif
