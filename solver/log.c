/* log.c - the head of a run's output: the physics in it, each force on or off. */
#include "log.h"

#include <omp.h>
#include <string.h>
#include "../forces/force.h"
#include "modules.h"
#include "provenance_info.h"
#include "sim.h"

static void log_answers(FILE *out)
{
    for (int i = 0; i < SLOTS; i++) {
        const struct about *const a = slots[i].about;
        if (strcmp(a->name, "none") != 0)
            fprintf(out, "  %-9s %-16s %s\n", slots[i].name, a->name,
                    a->equation[0] ? a->equation : a->summary);
    }
    for (int f = 0; forces[f]; f++)
        fprintf(out, "  force     %-16s %s\n", forces[f]->about.name,
                forces[f]->about.equation);
}

static void log_grains(FILE *out, const struct sim *s)
{
    const struct grains *const g = &s->grains;
    for (int k = 0; k < g->n_species; k++) {
        const struct species *const sp = &g->species[k];
        fprintf(out, "  grains    %d %s of %g m, %g kg/m3, material %s%s\n", sp->count,
                sp->name, sp->diameter, sp->density, g->materials[sp->material].name,
                sp->frozen ? ", frozen" : "");
    }
}

static void log_forces(FILE *out, const struct sim *s)
{
    const struct coupling *const c = &s->coupling;
    if (s->fluid.equation)
        fprintf(out, "  momentum  form %s\n", s->fluid.equation);
    fprintf(out,
            "  fluid     %d x %d x %d cells, %g kg/m3, %g Pa s, step %g s = %d steps of the "
            "grains\n"
            "  coupling  %s; drag on grains %s%s\n",
            s->grid.n[0], s->grid.n[1], s->grid.n[2], s->fluid.rho, s->fluid.mu, s->fluid.dt,
            s->run.substeps, c->ways == 2 ? "two-way" : "one-way",
            c->implicit ? "implicit" : "explicit",
            s->fluid.whole_pressure ? ", over the fluid fraction for pressure and viscous force"
                                    : "");
}

void log_start(FILE *out, const struct sim *s)
{
    struct provenance line[PROVENANCE_LINES];
    const int n = provenance(line);
    const char *revision = "";
    for (int i = 0; i < n; i++)
        if (strcmp(line[i].key, "revision") == 0)
            revision = line[i].value;
    fprintf(out, "silt %s, %d threads\n", revision, omp_get_max_threads());
    log_answers(out);
    log_grains(out, s);
    if (s->fluid.exists)
        log_forces(out, s);
    fprintf(out, "  steps     %g s for the grains, to t = %g s\n", s->run.dt, s->run.end);
    fflush(out);
}
