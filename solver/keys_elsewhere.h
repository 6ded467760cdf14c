/* keys_elsewhere.h - which answers have which keys, of all slots: a binary holds the keys of its own answers
 * only, but tells a scene that gives another's key whose it is. The table is made by tools/keys.awk. */
#ifndef KEYS_ELSEWHERE_H
#define KEYS_ELSEWHERE_H

struct elsewhere {
    const char *section, *key;
    const char *slot, *answer; /* "rolling", "epsd"; an answer of one slot stands together */
};

extern const struct elsewhere keys_elsewhere[]; /* ends with section NULL */

#endif
