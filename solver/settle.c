/* settle.c - settling of a bed by its own contacts. */
#include "settle.h"

#include "progress.h"
#include "sim.h"
#include "step.h"

enum { BETWEEN = 200 }; /* steps between looks at the energy */

/* Kinetic energy over sum of m g d, of the grains that move. */
static double agitation(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    const double gravity = v3_norm(s->domain.gravity);
    double kinetic = 0.0, scale = 0.0;
    for (int i = 0; i < g->n; i++) {
        if (g->inv_mass[i] == 0.0)
            continue;
        kinetic += 0.5 * g->mass[i] * v3_dot(g->vel[i], g->vel[i]);
        scale += g->mass[i] * gravity * 2.0 * g->radius[i];
    }
    return scale > 0.0 ? kinetic / scale : 0.0;
}

/* How far a bed has come to rest, 0 to 1: its energy falls by the same factor in equal times. */
static double calmed(double left, double most, double target)
{
    return left > target && most > target ? log(most / left) / log(most / target) : 0.0;
}

void settle(struct sim *s)
{
    const long most = (long)ceil(s->run.settle_time / s->run.dt);
    const int moving = s->grains.n - s->grains.n_frozen;
    const double begin = wall_clock();
    struct progress progress;
    double left = agitation(s), most_left = left;
    bool rests = moving == 0;
    long steps = 0;
    s->walls.still = true;
    progress_start(&progress, 0.0, 1.0, "settling");
    s->t = -s->run.dt * (double)most;
    while (!rests && !(s->run.stop && *s->run.stop)) {
        step_grains(s, BETWEEN);
        steps += BETWEEN;
        s->t = s->run.dt * (double)(steps - most); /* before 0 */
        left = agitation(s);
        /* at the top of a fall grains are slow too, but nothing touches */
        rests = left < s->run.settle_energy && s->neighbours.touching > moving;
        if (!rests && steps >= most)
            die(EXIT_UNSTABLE,
                "the bed has not settled after run.settle_time = %g s: kinetic energy is %.3g "
                "of m g "
                "d per grain, run.settle_energy is %g",
                s->run.settle_time, left, s->run.settle_energy);
        most_left = fmax(most_left, left);
        progress_update(&progress, calmed(left, most_left, s->run.settle_energy),
                        (double)moving * BETWEEN);
    }
    progress_end(&progress);
    summary_number(&s->summary, "settling_time", s->run.dt * (double)steps, "s");
    summary_number(&s->summary, "settling_wall_time", wall_clock() - begin, "s");
    s->t = 0.0;
    s->walls.still = false;
}
