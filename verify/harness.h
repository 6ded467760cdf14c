/* verify/harness.h - a run made from the text of a scene, for tests. */
#ifndef HARNESS_H
#define HARNESS_H

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "../solver/contact_loop.h"
#include "../solver/feasibility.h"
#include "../solver/force_names.h"
#include "../solver/modules.h"
#include "../solver/sim.h"
#include "../solver/step.h"

/* What a scene says to ask for the forces linked in. Free with xfree. */
static inline char *forces_asked(void)
{
    char *const built = forces_built(), *const usual = force_names("standard", true);
    char *const words = xprintf("%s+%s", built, usual), *rest = NULL,
                *text = xstrdup("standard");
    for (char *word = strtok_r(words, "+", &rest); word; word = strtok_r(NULL, "+", &rest)) {
        const bool in = force_names_given(built, word), ever = force_names_given(usual, word);
        char *const longer = xprintf("%s%s%s", text,
                                     in == ever ? ""
                                     : in       ? " "
                                                : " -",
                                     in == ever ? "" : word);
        xfree(text);
        text = longer;
    }
    xfree(words);
    xfree(usual);
    xfree(built);
    return text;
}

/* A started run; ends the test where the scene is refused. The scene may be freed at once. */
static inline struct sim *sim_from(const char *text)
{
    char path[] = "/tmp/silt-test-XXXXXX";
    const int fd = mkstemp(path);
    FILE *const file = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (!file)
        abort();
    fputs(text, file);
    fclose(file);
    char *answers[SLOTS + 1]; /* the scene asks for what the test links */
    for (int i = 0; i < SLOTS; i++)
        answers[i] = xprintf("modules.%s=%s", slots[i].name, slots[i].about->name);
    char *const asked = forces_asked();
    answers[SLOTS] = xprintf("modules.forces=%s", asked);
    xfree(asked);
    struct scene *const scene = scene_load(path, SLOTS + 1, answers);
    for (int i = 0; i <= SLOTS; i++)
        xfree(answers[i]);
    struct sim *const s = sim_alloc();
    struct feasibility f = {0};
    sim_create(s, scene, &f);
    scene_finish(scene);
    unlink(path);
    scene_free(scene);
    sim_start(s);
    return s;
}

/* Index of the grain with this id. */
static inline int grain_at(const struct sim *s, int id)
{
    for (int i = 0; i < s->grains.n; i++)
        if (s->grains.id[i] == id)
            return i;
    return -1;
}

/* FNV-1a over the state of the grains in order of id, and over the fields of the fluid. */
static inline unsigned long sim_bits(const struct sim *s)
{
    unsigned long h = 14695981039346656037ul;
    for (int f = 0; f < s->fields.n; f++) {
        const struct field *const field = &s->fields.field[f];
        const size_t size = kind_size(field->kind);
        const size_t n = field->place == PLACE_GRAIN ? (size_t)s->grains.n : s->grid.total;
        const unsigned char *const data = *field->data;
        for (size_t i = 0; i < n; i++) {
            const size_t at = field->place == PLACE_GRAIN ? (size_t)grain_at(s, (int)i) : i;
            for (size_t b = 0; b < size; b++)
                h = (h ^ data[at * size + b]) * 1099511628211ul;
        }
    }
    return h;
}

#endif
