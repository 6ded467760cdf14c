/* verify/test_contact_keys.c - the parameters of every contact law there is.
 *
 * What a pair of materials may override is a parameter of a material too, in the same unit, and
 * is mixed from the two materials where it is not given; a law takes nothing but [material] and
 * [pair]. */
#include <string.h>
#include "../contact/contact.h"
#include "answers.h"

static const struct key *find(const struct key *keys, const char *section, const char *name)
{
    for (; keys->section; keys++)
        if (strcmp(keys->section, section) == 0 && strcmp(keys->name, name) == 0)
            return keys;
    return NULL;
}

static void visit(const char *name, void *answer)
{
    const struct key *keys;
    int pairs = 0, others = 0, good = 0;
    if (!answers_symbol(answer, "contact_keys", &keys, sizeof keys))
        return;
    for (const struct key *k = keys; k->section; k++) {
        others += strcmp(k->section, "material") != 0 && strcmp(k->section, "pair") != 0;
        if (strcmp(k->section, "pair") != 0)
            continue;
        const struct key *const own = find(keys, "material", k->name);
        pairs++;
        good += own && strcmp(own->unit, k->unit) == 0 && own->type == k->type && k->standard &&
                strcmp(k->standard, "mixed") == 0 && strncmp(k->allowed, "mixed | ", 8) == 0 &&
                strcmp(k->allowed + 8, own->allowed) == 0;
    }
    check(good == pairs, "%s: %d of %d parameters of a pair are those of a material", name,
          good, pairs);
    check(others == 0, "%s: no keys but those of materials and pairs", name);
}

int main(int argc, char **argv)
{
    (void)argc;
    answers_visit(argv[0], "contact", visit);
    return check_end();
}
