/* keys.h - reads a key of any type, for tests of the scene reader and of the tables of keys. */
#ifndef KEYS_H
#define KEYS_H

#include "../solver/scene.h"

static void read_key(struct scene *s, const struct key *k, const char *name)
{
    int cells[3];
    if (k->type == KEY_REAL)
        scene_real(s, k->section, name, k->name);
    else if (k->type == KEY_VECTOR)
        scene_vector(s, k->section, name, k->name);
    else if (k->type == KEY_INT)
        scene_int(s, k->section, name, k->name);
    else if (k->type == KEY_CELLS)
        scene_cells(s, k->section, name, k->name, cells);
    else if (k->type == KEY_CHOICE)
        scene_choice(s, k->section, name, k->name);
    else
        scene_text(s, k->section, name, k->name);
}

#endif
