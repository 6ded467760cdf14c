/* contact/cohesion/cohesion.h - contract: what pulls when wet or sticky?
 *
 * To add one: copy none.c to contact/cohesion/NAME.c. Called after contact_forces for each
 * block; adds to fx..fz. It may act across a gap (depth < 0) up to cohesion_range: the loop
 * then keeps the contact alive that far. Parameters and threads as in contact/contact.h. */
#ifndef COHESION_H
#define COHESION_H

#include "../touch.h"
#include "../../solver/materials.h"

extern const struct about cohesion_about;
extern const struct key cohesion_keys[];
extern const int cohesion_history;    /* reals per contact */
extern const unsigned cohesion_needs; /* TOUCH_... of touch.h */

void cohesion_init(struct scene *s, const struct materials *m);
void cohesion_forces(struct touch *t, real (*history)[TOUCH]);
void cohesion_energy(struct touch *t, real (*history)[TOUCH]); /* adds what it stores, J */
double cohesion_range(void); /* m, largest gap at which it acts; 0 if only in contact */

#endif
