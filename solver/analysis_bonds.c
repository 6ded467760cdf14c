/* analysis_bonds.c - the bonds that broke: how many, and each with its time, place and mode, as a
 * table of run.nc. Costs nothing where nothing is glued. */
#include <stdlib.h>
#include "../contact/bond/bond.h"
#include "analysis.h"
#include "contact_loop.h"
#include "sim.h"

static const struct key keys[] = {{0}};

struct counts {
    double tension, shear;
};

static void *create(struct sim *s, struct scene *scene)
{
    (void)scene;
    if (bond_history == 0)
        return NULL;
    struct counts *const c = xalloc(1, sizeof *c);
    series_add(&s->series, "bonds_broken_tension", "1", "bonds that broke in tension so far",
               &c->tension);
    series_add(&s->series, "bonds_broken_shear", "1", "bonds that broke in shear so far",
               &c->shear);
    return c;
}

static void sample(struct sim *s, void *state)
{
    struct counts *const c = state;
    const struct break_list *const list = &s->contacts->broken;
    *c = (struct counts){0};
    for (int k = 0; k < list->n; k++)
        if (list->bond[k].mode == BROKE_TENSION)
            c->tension++;
        else
            c->shear++;
}

/* By time, then by the grains: threads note bonds in any order. */
static int earlier(const void *a, const void *b)
{
    const struct broken *const x = a, *const y = b;
    if (x->time != y->time)
        return x->time < y->time ? -1 : 1;
    if (x->i != y->i)
        return x->i < y->i ? -1 : 1;
    return (x->j > y->j) - (x->j < y->j);
}

static void report(struct sim *s, void *state)
{
    static const struct table pattern = {
        .name = "broken_bonds",
        .title = "broken bonds",
        .bulky = true,
        .n_columns = 7,
        .column = {{"time", "s", "when it broke"},
                   {"x", "m", "contact point"},
                   {"y", "m", "contact point"},
                   {"z", "m", "contact point"},
                   {"mode", "1", "1: in tension, 2: in shear"},
                   {"grain", "1", "id of the owner"},
                   {"other", "1", "id of the other grain; -1 - index of a wall"}}};
    struct counts *const c = state;
    struct break_list *const list = &s->contacts->broken;
    sample(s, state);
    summary_number(&s->summary, "bonds_broken_tension", c->tension, "1");
    summary_number(&s->summary, "bonds_broken_shear", c->shear, "1");
    if (list->n == 0)
        return;
    qsort(list->bond, (size_t)list->n, sizeof *list->bond, earlier);
    struct table *const t = tables_add(&s->tables, &pattern);
    for (int k = 0; k < list->n; k++) {
        const struct broken *const b = &list->bond[k];
        table_row(t, (const double[]){b->time, b->point.x, b->point.y, b->point.z, b->mode,
                                      b->i, b->j});
    }
}

const struct analysis_part analysis_bonds = {.name = "bonds",
                                             .keys = keys,
                                             .create = create,
                                             .sample = sample,
                                             .report = report,
                                             .free = xfree};
