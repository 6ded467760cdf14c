/* contact_loop.h - all contact forces: shapes -> contact -> cohesion -> rolling -> bond. */
#ifndef CONTACT_LOOP_H
#define CONTACT_LOOP_H

struct sim;
struct scene;

/* Initialises the laws (parameters from the scene) and the scratch of the loop. */
void contact_create(struct sim *s, struct scene *scene);
void contact_free(struct sim *s);

int contact_rows(void);     /* doubles of history per contact, all laws together */
double contact_reach(void); /* m, gap up to which some law acts */

/* Room for the records of the list at hand: after every rebuild of the list. */
void contact_prepare(struct sim *s);

/* Forces of every contact at the grains' positions, one record each; then contact_gather sums
 * them, with the load of the fluid, into grains.force and torque. Both are called by every thread
 * of a team (or by one alone); the first ends with all threads together, the second gives each
 * thread the same grains as motion_kick does and does not wait. */
void contact_loop(struct sim *s);
void contact_gather(struct sim *s);

/* Stops the run (EXIT_UNSTABLE) where grains overlapped too deeply. */
void contact_guard(const struct sim *s);

#endif
