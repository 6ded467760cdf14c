/* contact/contact.h - contract: what force when two bodies touch?
 *
 * To add a law: copy none.c to contact/NAME.c and write `contact = NAME` in a scene. No other
 * file changes. Every answer exports exactly the symbols below.
 *
 * Parameters are per pair of materials: an answer reads [material *] (and [pair A-B], which
 * overrides for that pair of materials, either order) in contact_init and keeps a table of
 * n_materials^2 entries, indexed by touch.pair; it keeps no other state. What a contact
 * remembers lives in its rows of history: `history[k][c]` is number k of contact c, zero when
 * the contact is new, forgotten when it ends (depth below -contact_range). Of three or more numbers the
 * first three are a vector in the plane of contact, which turns with a wall that turns. Called from parallel
 * loops. */
#ifndef CONTACT_H
#define CONTACT_H

#include "touch.h"
#include "../solver/materials.h"

extern const struct about contact_about;
extern const struct key contact_keys[]; /* of sections "material" and "pair" */
extern const int contact_history;       /* reals per contact */

/* Reads the parameters; wrong ones go on the scene's list. */
void contact_init(struct scene *s, const struct materials *m);

/* Sets fx..fz, fn and kn of every contact of the block. Where depth <= 0 the force must be
 * zero. A law without cohesion never pulls: the normal force is cut at zero. */
void contact_forces(struct touch *t, real (*history)[TOUCH]);

/* c[k], N s/m, of every contact: what the normal force falls by over the normal velocity, before it is
 * cut and without touch.start; for dashpots of faces that rock on each other (contact_rocking.c). */
void contact_damping(const struct touch *t, real *c);

/* Sets energy [J], what the springs hold after contact_forces; asked for at the end of a step
 * whose ledger is closed, not at every one. */
void contact_energy(struct touch *t, real (*history)[TOUCH]);

/* s; the shortest duration of a contact between grains of mass m [kg] and radius r [m] of
 * material a against material b at relative speed v [m/s]; INFINITY if there is none. For the
 * feasibility report and dt = auto. */
double contact_duration(int a, int b, double m_eff, double r_eff, double v);

/* s; Rayleigh's time step for a grain [LiXuThornton05]; INFINITY if the law has no elastic
 * moduli. */
double contact_rayleigh(int a, double radius, double density);

#endif
