/* contact/rolling/rolling.h - contract: what resists rolling?
 *
 * To add one: copy none.c to contact/rolling/NAME.c. Called after contact_forces for each
 * block; adds to mx, my, mz from fn, the relative spin, and its own rows of history. Parameters
 * and threads as in contact/contact.h. */
#ifndef ROLLING_H
#define ROLLING_H

#include "../touch.h"
#include "../../solver/materials.h"

extern const struct about rolling_about;
extern const struct key rolling_keys[];
extern const int rolling_history;    /* reals per contact */
extern const unsigned rolling_needs; /* TOUCH_... of touch.h */

void rolling_init(struct scene *s, const struct materials *m);
void rolling_moments(struct touch *t, real (*history)[TOUCH]);
void rolling_energy(struct touch *t, real (*history)[TOUCH]); /* adds what it stores, J */

#endif
