/* contact/bond/bond.h - contract: what holds two grains glued together?
 *
 * To add one: copy none.c to contact/bond/NAME.c. Called after the other laws for each block;
 * adds to fx..fz and mx..mz. Bonds live in their rows of history (row 0: 0 never bonded, 1
 * intact, -1 broken), are made from the gap at a given time, and keep a contact alive up to
 * bond_range. Parameters and threads as in contact/contact.h. */
#ifndef BOND_H
#define BOND_H

#include "../touch.h"
#include "../../solver/materials.h"

extern const struct about bond_about;
extern const struct key bond_keys[];
extern const int bond_history;    /* reals per contact */
extern const unsigned bond_needs; /* TOUCH_... of touch.h */

void bond_init(struct scene *s, const struct materials *m);
void bond_forces(struct touch *t, real (*history)[TOUCH]);
void bond_energy(struct touch *t, real (*history)[TOUCH]); /* adds what it stores, J */
double bond_range(void);                                   /* m */

#endif
