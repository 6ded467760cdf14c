/* modules.h - the answers that this binary holds, one per slot. */
#ifndef MODULES_H
#define MODULES_H

#include "scene.h"

enum { SLOTS = 10 };

struct slot {
    const char *name;          /* "contact"; the key in [modules] */
    const struct about *about; /* of the answer linked in */
    const struct key *keys;
};

extern const struct slot slots[SLOTS];

/* Declares [modules] and the keys of every answer; a scene that asks for other answers than
 * these goes on the list of errors. */
void modules_declare(struct scene *s);

/* The forces that this binary holds, as force_names.h writes them; free with xfree. */
char *forces_built(void);

#endif
