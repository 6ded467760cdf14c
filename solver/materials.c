/* materials.c - parameters of pairs of materials. */
#include "materials.h"

bool materials_fit(struct scene *s, const struct materials *m)
{
    if (m->n <= MATERIALS_MAX)
        return true;
    scene_error(s, "material", NULL, NULL, "at most %d materials", MATERIALS_MAX);
    return false;
}

/* A number, or NAN for the word (NULL: none). */
static double number(struct scene *s, const char *section, const char *name, const char *key,
                     const char *word)
{
    if (word && scene_word(s, section, name, key, word))
        return (double)NAN;
    return scene_real(s, section, name, key);
}

static double pair_value(struct scene *s, const char *a, const char *b, const char *key,
                         const char *word, bool *given)
{
    char *const names[2] = {xprintf("%s-%s", a, b), xprintf("%s-%s", b, a)};
    double value = 0.0;
    *given = false;
    for (int i = 0; i < 2; i++)
        if (!*given && scene_given(s, "pair", names[i], key) &&
            !scene_word(s, "pair", names[i], key, "mixed")) {
            value = number(s, "pair", names[i], key, word);
            *given = true;
        }
    xfree(names[0]);
    xfree(names[1]);
    return value;
}

static double mixed(double a, double b, bool like, enum mix mix)
{
    switch (mix) {
    case MIX_SERIES:
        return a + b > 0.0 ? a * b / (a + b) : a + b; /* NAN stays */
    case MIX_MEAN:
        return 0.5 * (a + b);
    default:
        return like ? a : sqrt(a * b);
    }
}

void materials_pair_optional(struct scene *s, const struct materials *m, const char *key,
                             const char *word, enum mix mix, double *out, bool *own)
{
    for (int a = 0; a < m->n; a++)
        for (int b = a; b < m->n; b++) {
            bool given;
            double value = pair_value(s, m->name[a], m->name[b], key, word, &given);
            if (given) { /* what the pair overrides is in use all the same */
                scene_given(s, "material", m->name[a], key);
                scene_given(s, "material", m->name[b], key);
            } else {
                value = mixed(number(s, "material", m->name[a], key, word),
                              number(s, "material", m->name[b], key, word), a == b, mix);
            }
            out[a * m->n + b] = out[b * m->n + a] = value;
            if (own)
                own[a * m->n + b] = own[b * m->n + a] = given;
        }
}

void materials_pair_values(struct scene *s, const struct materials *m, const char *key,
                           enum mix mix, double *out)
{
    materials_pair_optional(s, m, key, NULL, mix, out, NULL);
}
