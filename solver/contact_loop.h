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

/* Forces of every contact at the grains' positions, one record each; then contact_gather sums
 * them, with the load of the fluid, into grains.force and torque. Stops the run (EXIT_UNSTABLE)
 * where grains overlap too deeply. */
void contact_loop(struct sim *s);
void contact_gather(struct sim *s);

#endif
