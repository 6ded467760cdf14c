/* motion.h - velocity Verlet for translation and rotation; frozen grains stay. */
#ifndef MOTION_H
#define MOTION_H

struct sim;

/* Half a kick and a drift over run.dt: positions at the end of the step, velocities at its
 * middle, and their prediction for its end (vel_full). Notes how far grains have moved since
 * the pair list was made. Stops the run where a position is not finite. */
void motion_kick_drift(struct sim *s);

/* The other half of the kick, with the new forces: velocities at the end of the step. */
void motion_kick(struct sim *s);

#endif
