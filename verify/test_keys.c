/* test_keys.c - the tables of keys, of the library and of every answer: every default is itself
 * a sound value, in a unit that exists and inside its own range. */
#include <string.h>
#include "../solver/coupling.h"
#include "../solver/domain.h"
#include "../solver/flow.h"
#include "../solver/grains.h"
#include "../solver/insert.h"
#include "../solver/run.h"
#include "../solver/walls.h"
#include "answers.h"
#include "check.h"
#include "keys.h"

/* Every default of a table reads without an error, in a unit that exists. */
static void check_table(const char *title, const struct key *keys)
{
    struct scene *const s = scene_load(NULL, 0, NULL);
    int n = 0;
    scene_declare(s, keys);
    for (const struct key *k = keys; k->section; k++, n++) {
        if (k->standard)
            read_key(s, k, NULL);
        if (scene_errors(s) > 0 || !k->meaning || !k->unit || !k->allowed) {
            check(false, "%s: the default of %s.%s is not sound", title, k->section, k->name);
            break;
        }
    }
    if (scene_errors(s) == 0)
        check(true, "%s: %d keys, every default is sound", title, n);
    scene_free(s);
}

static const char *slot;

static void check_answer(const char *name, void *answer)
{
    char *const symbol = xprintf("%s_keys", slot), *const title =
                                                       xprintf("%s = %s", slot, name);
    const struct key *keys = NULL;
    if (answers_symbol(answer, symbol, &keys, sizeof keys))
        check_table(title, keys);
    xfree(symbol);
    xfree(title);
}

int main(int argc, char **argv)
{
    (void)argc;
    const char *const folder[][2] = {
        {"shape", "shapes"},
        {"contact", "contact"},
        {"rolling", "contact/rolling"},
        {"bond", "contact/bond"},
        {"cohesion", "contact/cohesion"},
        {"drag", "drag"},
        {"porosity", "porosity"},
        {"fluid", "solver/fluid"},
        {"reference", "reference"},
    };
    check_table("domain", domain_keys);
    check_table("grains", grains_keys);
    check_table("sizes", sizes_keys);
    check_table("insert", insert_keys);
    check_table("walls", wall_keys);
    check_table("motion of walls", wall_motion_keys);
    for (int k = 0; wall_kinds[k]; k++)
        check_table(wall_kinds[k]->name, wall_kinds[k]->keys);
    check_table("run", run_keys);
    check_table("flow", flow_keys);
    check_table("coupling", coupling_keys);
    for (size_t i = 0; i < sizeof folder / sizeof folder[0]; i++) {
        slot = folder[i][0];
        answers_visit(argv[0], folder[i][1], check_answer);
    }
    return check_end();
}
