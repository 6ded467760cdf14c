/* step.c - one coupled step: the program on a page. */
#include "step.h"

#include "contact_loop.h"
#include "motion.h"
#include "sim.h"

void step_grains(struct sim *s)
{
    struct timers *const t = &s->timers;
    double clock = wall_clock();
    motion_kick_drift(s);
    clock = timer_add(t, TIME_MOTION, clock);
    neighbours_refresh(s);
    clock = timer_add(t, TIME_NEIGHBOURS, clock);
    contact_loop(s); /* shapes -> contact (+ cohesion, rolling, bond) -> one record each */
    clock = timer_add(t, TIME_CONTACTS, clock);
    contact_gather(s);
    clock = timer_add(t, TIME_GATHER, clock);
    motion_kick(s);
    timer_add(t, TIME_MOTION, clock);
    s->substep++;
}

void step(struct sim *s)
{
    struct timers *const t = &s->timers;
    double clock = wall_clock();
    s->fluid.on = s->fluid.exists && s->t >= s->flow.start - 0.5 * s->run.dt;
    if (s->fluid.on) {
        fluid_sense(s); /* porosity, implicit drag on the grid */
        clock = timer_add(t, TIME_SENSE, clock);
        fluid_step(s);
        clock = timer_add(t, TIME_FLUID, clock);
        fluid_load(s); /* force of the fluid on each grain */
        timer_add(t, TIME_LOAD, clock);
    }
    if (s->grains.n > s->grains.n_frozen)
        for (int m = 0; m < s->run.substeps; m++)
            step_grains(s);
    s->step++;
    s->t = s->run.dt * s->run.substeps * (double)s->step;
    clock = wall_clock();
    ledger_close(s); /* mass, momentum, volume, energy */
    timer_add(t, TIME_LEDGER, clock);
}
