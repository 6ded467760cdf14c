/* contact/lubrication/lubrication.h - contract: what does the fluid squeezed between two grains do?
 *
 * The grid does not see the film between grains that are nearly in touch; this force stands for
 * it. To add one: copy none.c to contact/lubrication/NAME.c. Called after cohesion_forces for each
 * block; adds to fx..fz and mx..mz. It acts across a gap (depth < 0) up to lubrication_range: the
 * loop keeps the contact alive that far. Parameters and threads as in contact/contact.h. */
#ifndef LUBRICATION_H
#define LUBRICATION_H

#include "../touch.h"
#include "../../solver/materials.h"

extern const struct about lubrication_about;
extern const struct key lubrication_keys[];
extern const int lubrication_history;    /* reals per contact */
extern const unsigned lubrication_needs; /* TOUCH_... of touch.h */

void lubrication_init(struct scene *s, const struct materials *m);
void lubrication_forces(struct touch *t, real (*history)[TOUCH]);
void lubrication_energy(struct touch *t, real (*history)[TOUCH]); /* adds what it stores, J */
double lubrication_range(void); /* m, largest gap at which it acts; 0 if only in contact */

#endif
