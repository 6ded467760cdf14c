/* motion.h - velocity Verlet for translation and rotation; frozen grains stay. */
#ifndef MOTION_H
#define MOTION_H

struct sim;

/* Called by every thread of a team (or by one alone).
 *
 * Half a kick and a drift over run.dt: positions at the end of the step, velocities at its
 * middle, and their prediction for its end (vel_full). Notes how far grains have moved since the
 * pair list was made. Ends with all threads together. */
void motion_kick_drift(struct sim *s);

/* The other half of the kick, with the new forces: velocities at the end of the step. Does not
 * wait. */
void motion_kick(struct sim *s);

/* Stops the run (EXIT_UNSTABLE) where a position is not finite. */
void motion_guard(const struct sim *s);

#endif
