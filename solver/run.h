/* run.h - [run] and [output]: how long, how finely, what is written when. */
#ifndef RUN_H
#define RUN_H

#include "scene.h"

struct sim;

extern const struct key run_keys[];

void run_read(struct sim *s, struct scene *scene);

/* Chooses dt (when it is auto) and the sub-steps, once grains and fluid are known: the fluid's
 * step is a whole number of the grains' steps, which are shortened for it. */
void run_steps(struct sim *s, struct scene *scene);

/* Of a dry scene: how many steps the next call of step() does: to the end of the record, or to `due` (s), the time of
 * an output. The trajectories are the same for that, but for round-off where shapes or servos are. */
void run_until(struct sim *s, double due);

#endif
