/* analysis.c - the parts of the analysis, called in one order. */
#include "analysis.h"

#include "sim.h"

extern const struct analysis_part analysis_coordination, analysis_contacts, analysis_regions,
    analysis_energy, analysis_profile, analysis_meters, analysis_surfaces, analysis_bonds;

const struct analysis_part *const analysis_parts[] = {
    &analysis_coordination, &analysis_contacts, &analysis_regions,
    &analysis_energy,       &analysis_profile,  &analysis_meters,
    &analysis_surfaces,     &analysis_bonds,    NULL};

void analysis_create(struct sim *s, struct scene *scene)
{
    for (int k = 0; analysis_parts[k]; k++) {
        scene_declare(scene, analysis_parts[k]->keys);
        s->analysis.state[k] = analysis_parts[k]->create(s, scene);
    }
}

void analysis_start(struct sim *s)
{
    for (int k = 0; analysis_parts[k]; k++)
        if (s->analysis.state[k] && analysis_parts[k]->start)
            analysis_parts[k]->start(s, s->analysis.state[k]);
}

void analysis_watch(struct sim *s)
{
    for (int k = 0; analysis_parts[k]; k++)
        if (s->analysis.state[k] && analysis_parts[k]->watch)
            analysis_parts[k]->watch(s, s->analysis.state[k]);
}

void analysis_sample(struct sim *s)
{
    for (int k = 0; analysis_parts[k]; k++)
        if (s->analysis.state[k] && analysis_parts[k]->sample)
            analysis_parts[k]->sample(s, s->analysis.state[k]);
}

void analysis_define(struct sim *s, struct output_file *f)
{
    for (int k = 0; analysis_parts[k]; k++)
        if (s->analysis.state[k] && analysis_parts[k]->define)
            analysis_parts[k]->define(s, s->analysis.state[k], f);
}

void analysis_record(struct sim *s, struct output_file *f)
{
    for (int k = 0; analysis_parts[k]; k++)
        if (s->analysis.state[k] && analysis_parts[k]->record)
            analysis_parts[k]->record(s, s->analysis.state[k], f);
}

void analysis_report(struct sim *s)
{
    for (int k = 0; analysis_parts[k]; k++)
        if (s->analysis.state[k] && analysis_parts[k]->report)
            analysis_parts[k]->report(s, s->analysis.state[k]);
}

void analysis_free(struct sim *s)
{
    for (int k = 0; analysis_parts[k]; k++)
        if (s->analysis.state[k])
            analysis_parts[k]->free(s->analysis.state[k]);
    xfree(s->analysis.view.seen);
}
