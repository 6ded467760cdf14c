/* materials.c - parameters of pairs of materials. */
#include "materials.h"

static double pair_value(struct scene *s, const char *a, const char *b, const char *key,
                         bool *given)
{
    char *const names[2] = {xprintf("%s-%s", a, b), xprintf("%s-%s", b, a)};
    double value = 0.0;
    *given = false;
    for (int i = 0; i < 2; i++)
        if (!*given && scene_given(s, "pair", names[i], key) &&
            !scene_word(s, "pair", names[i], key, "mixed")) {
            value = scene_real(s, "pair", names[i], key);
            *given = true;
        }
    xfree(names[0]);
    xfree(names[1]);
    return value;
}

void materials_pair_values(struct scene *s, const struct materials *m, const char *key,
                           enum mix mix, double *out)
{
    for (int a = 0; a < m->n; a++)
        for (int b = a; b < m->n; b++) {
            bool given;
            double value = pair_value(s, m->name[a], m->name[b], key, &given);
            if (given) { /* what the pair overrides is in use all the same */
                scene_given(s, "material", m->name[a], key);
                scene_given(s, "material", m->name[b], key);
            } else {
                const double of_a = scene_real(s, "material", m->name[a], key);
                const double of_b = scene_real(s, "material", m->name[b], key);
                value = mix == MIX_SERIES ? of_a * of_b / (of_a + of_b)
                        : a == b          ? of_a
                                          : sqrt(of_a * of_b);
            }
            out[a * m->n + b] = out[b * m->n + a] = value;
        }
}
