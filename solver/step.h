/* step.h - one coupled step, and the settling of a bed before it. */
#ifndef STEP_H
#define STEP_H

struct sim;

/* Entry and exit: positions, velocities, forces and fields all at time s->t. */
void step(struct sim *s);

/* n steps of the grains, of length run.dt each. */
void step_grains(struct sim *s, int n);

#endif
