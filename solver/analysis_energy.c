/* analysis_energy.c - energy by kind, as time series: of translation, of rotation, potential (from
 * z = 0), in the contacts, lost in them, and the work done from outside. The sums are the
 * ledger's; what the contacts hold is one number, as the laws give it. */
#include "analysis.h"
#include "sim.h"

static const struct key keys[] = {
    {"output", "energy", KEY_CHOICE, "", "off | on", "off",
     "energy by kind as time series: translation, rotation, potential, work"},
    {0},
};

struct energy {
    double translation, rotation; /* J */
};

static void *create(struct sim *s, struct scene *scene)
{
    if (scene_choice(scene, "output", NULL, "energy") != 1)
        return NULL;
    struct energy *const e = xalloc(1, sizeof *e);
    series_add(&s->series, "translational_energy", "J", "kinetic energy of translation",
               &e->translation);
    series_add(&s->series, "rotational_energy", "J", "kinetic energy of rotation",
               &e->rotation);
    series_add(&s->series, "potential_energy", "J", "potential energy, 0 at the origin",
               &s->ledger.potential);
    series_add(&s->series, "work_of_fluid", "J", "work done by the fluid on the grains",
               &s->ledger.work_fluid);
    return e;
}

static void sample(struct sim *s, void *state)
{
    struct energy *const e = state;
    const struct grains *const g = &s->grains;
    e->rotation = 0.0;
    for (int i = 0; i < g->n; i++)
        if (g->inv_mass[i] != 0.0)
            e->rotation += grain_rotation(g, i);
    e->translation = s->ledger.kinetic - e->rotation;
}

static void report(struct sim *s, void *state)
{
    const struct energy *const e = state;
    sample(s, state);
    summary_number(&s->summary, "energy_translational", e->translation, "J");
    summary_number(&s->summary, "energy_rotational", e->rotation, "J");
    summary_number(&s->summary, "energy_potential", s->ledger.potential, "J");
}

const struct analysis_part analysis_energy = {.name = "energy",
                                              .keys = keys,
                                              .create = create,
                                              .sample = sample,
                                              .report = report,
                                              .free = xfree};
