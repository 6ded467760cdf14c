/* settle.h - grains fall and come to rest before the run starts, without the fluid. */
#ifndef SETTLE_H
#define SETTLE_H

struct sim;

/* Runs the grains until their kinetic energy is below run.settle_energy of m g d a grain, or
 * stops the program (EXIT_UNSTABLE) after run.settle_time; ends early when
 * run.stop asks for it. Leaves s->t = 0 and the bed at rest
 * in its contacts. Adds what it took to the summary. */
void settle(struct sim *s);

#endif
