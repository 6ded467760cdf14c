/* sim.c - makes a run from a scene, and unmakes it. */
#include "sim.h"

#include "../reference/reference.h"
#include "contact_loop.h"
#include "feasibility.h"
#include "modules.h"
#include "probes.h"
#include "motion.h"
#include "run.h"

struct sim *sim_alloc(void)
{
    return xalloc(1, sizeof(struct sim));
}

void sim_create(struct sim *s, struct scene *scene, struct feasibility *f)
{
    modules_declare(scene);
    domain_read(&s->domain, scene);
    run_read(s, scene);
    flow_read(&s->flow, scene);
    walls_create(s, scene);
    grains_create(s, scene);
    walls_materials(s, scene);
    insert_create(s, scene);
    contact_create(s, scene);
    fluid_create(s, scene);
    run_steps(s, scene);
    probes_create(s, scene);
    analysis_create(s, scene);
    reference_create(s, scene);
    if (scene_errors(scene) == 0) {
        neighbours_check(s, scene);
        walls_check(s, scene);
        feasibility_fill(s, f);
        feasibility_enforce(s, scene, f);
    }
    neighbours_create(s);
}

void sim_start(struct sim *s)
{
    if (s->grains.n == s->grains.n_frozen)
        return;
    motion_sense_loads(s);
    bodies_fill(s);
    neighbours_rebuild(s);
    contact_prepare(s);
#pragma omp parallel
    {
        contact_loop(s, s->t, true, true);
        motion_forces(s);
    }
    contact_collect(s, 0);
    contact_guard(s);
}

void sim_free(struct sim *s)
{
    reference_free(s);
    probes_free(s);
    analysis_free(s);
    fluid_free(s);
    contact_free(s);
    neighbours_free(s);
    insert_free(s);
    grains_free(s);
    walls_free(s);
    flow_free(&s->flow);
    domain_free(&s->domain);
    tables_free(&s->tables);
    fields_free(&s->fields);
    series_free(&s->series);
    summary_free(&s->summary);
    xfree(s->run.directory);
    xfree(s);
}
