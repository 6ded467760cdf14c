/* motion.h - velocity Verlet for translation and rotation; frozen grains stay.
 *
 * Called by every thread of a team (or by one alone). */
#ifndef MOTION_H
#define MOTION_H

#include <stdbool.h>

struct sim;

/* Looks whether any grain bears a load of the fluid (or of whoever set one): if not, the steps
 * until the next look need not read them. By one thread. */
void motion_sense_loads(struct sim *s);

/* Half a kick with the forces at hand and a drift over run.dt: positions at the end of the step,
 * velocities at its middle; writes the bodies, notes the largest speed (neighbours_speed, for
 * step `parity`). Ends with all threads together. */
void motion_start(struct sim *s, int parity);

/* Gathers the new forces and gives the other half of the kick: velocities at the end of the step.
 * Unless `last`, goes straight on with motion_start of the next step (whose parity is given) and
 * ends with all threads together; else leaves force and torque and does not wait. */
void motion_turn(struct sim *s, bool last, int parity);

/* Where the grains are comes to their arrays: after a motion_turn that was not the last. By one thread. */
void motion_places(struct sim *s);

/* Gathers force and torque, moves nothing: at the start of a run. */
void motion_forces(struct sim *s);

/* Stops the run (EXIT_UNSTABLE) where a position is not finite. */
void motion_guard(const struct sim *s);

#endif
