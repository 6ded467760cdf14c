/* step.c - one coupled step: the program on a page. */
#include "step.h"

#include <omp.h>
#include "contact_loop.h"
#include "insert.h"
#include "motion.h"
#include "sim.h"

/* The master's clock; the other threads' time is beside it. */
static double lap(struct timers *t, enum timer which, double since)
{
    return omp_get_thread_num() == 0 ? timer_add(t, which, since) : since;
}

/* Steps of one team of threads, until n are done or the pair list is stale (with the grains
 * drifted already); returns how many are done. `before`: those
 * of the same call that were done already. The threads meet twice a step: after the drift,
 * and before the forces on a grain are gathered. */
static int team_steps(struct sim *s, int n, int before, bool drifted)
{
    struct timers *const t = &s->timers;
    double clock = wall_clock();
    int done = 0;
    if (!drifted) {
#pragma omp master
        walls_drift(s, 0);
        motion_start(s, 0);
    }
    clock = lap(t, TIME_MOTION, clock);
    struct ageing age = neighbours_ageing(s, drifted);
    while (drifted || neighbours_fresh(s, &age, done)) {
        drifted = false;
        const double time = s->t + s->run.dt * (before + done + 1);
        contact_loop(s, time, age.choose, done == n - 1); /* shapes -> contact (+ ...) */
        clock = lap(t, TIME_CONTACTS, clock);
        if (s->contacts->too_deep)
            break;
        done++;
#pragma omp master
        {
            walls_feel(s);
            if (done < n)
                walls_drift(s, done);
        }
        motion_turn(s, done == n, done); /* gather, kick; kick and drift of the next step */
        clock = lap(t, TIME_MOTION, clock);
        if (done == n)
            break;
    }
#pragma omp barrier
#pragma omp master
    neighbours_aged(s, &age);
    return done;
}

void step_grains(struct sim *s, int n)
{
    bool drifted = false;
    motion_sense_loads(s);
    s->walls.ahead = 0;
    for (int left = n; left > 0;) {
        int done = 0;
#pragma omp parallel
        {
            const int mine = team_steps(s, left, n - left, drifted);
#pragma omp master
            done = mine;
        }
        if (done < left)
            motion_places(s);
        contact_guard(s);
        motion_guard(s);
        left -= done;
        s->substep += done;
        s->grain_steps += (double)done * s->grains.n;
        drifted = left > 0; /* the team stopped for a new list */
        if (drifted) {
            neighbours_rebuild(s); /* times its parts */
            const double clock = wall_clock();
            contact_prepare(s);
            timer_add(&s->timers, TIME_NEIGHBOURS, clock);
        }
    }
    contact_collect(s, n);
}

void step(struct sim *s)
{
    struct timers *const t = &s->timers;
    insert_step(s); /* grains that left, grains that are due */
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
        step_grains(s, s->run.substeps);
    s->step++;
    s->clock += s->run.substeps;
    s->t = s->run.dt * (double)s->clock;
    clock = wall_clock();
    ledger_close(s); /* mass, momentum, volume, energy */
    timer_add(t, TIME_LEDGER, clock);
}
