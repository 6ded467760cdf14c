/* ledger.c - what must add up, summed in the order of the grains. */
#include "ledger.h"

#include "sim.h"

/* Energy is only followed where gravity has a potential: not along a periodic direction. */
static bool potential_exists(const struct sim *s)
{
    const vec3 g = s->domain.gravity;
    const bool *const p = s->domain.periodic;
    return !((p[0] && g.x != 0.0) || (p[1] && g.y != 0.0) || (p[2] && g.z != 0.0));
}

static void sum_grains(struct sim *s)
{
    const struct grains *const g = &s->grains;
    struct ledger *const l = &s->ledger;
    l->mass = l->inertia = l->kinetic = l->potential = 0.0;
    l->momentum = v3(0.0, 0.0, 0.0);
    for (int i = 0; i < g->n; i++) {
        if (g->inv_mass[i] == 0.0)
            continue;
        const double inertia = 1.0 / g->inv_mass[i]; /* added mass included */
        l->mass += g->mass[i];
        l->inertia += inertia;
        l->momentum = v3_axpy(l->momentum, inertia, g->vel[i]);
        l->kinetic += 0.5 * inertia * v3_dot(g->vel[i], g->vel[i]) + grain_rotation(g, i);
        l->potential -= inertia * v3_dot(s->domain.gravity, g->pos[i]);
    }
    l->elastic = s->elastic;
}

static vec3 wall_impulses(const struct sim *s)
{
    vec3 sum = s->walls.skeleton_impulse;
    for (int k = 0; k < s->walls.n; k++)
        sum = v3_add(sum, s->walls.wall[k].impulse);
    return sum;
}

/* N s; of each wall on its own: those on two sides of a sample cancel. */
static double wall_impulse_size(const struct sim *s)
{
    double sum = v3_norm(s->walls.skeleton_impulse);
    for (int k = 0; k < s->walls.n; k++)
        sum += v3_norm(s->walls.wall[k].impulse);
    return sum;
}

void ledger_gain(struct sim *s, int i, double mass)
{
    const struct grains *const g = &s->grains;
    struct ledger *const l = &s->ledger;
    const vec3 v = g->vel[i];
    l->momentum_start = v3_axpy(l->momentum_start, mass, v);
    l->energy_start += mass * (0.5 * v3_dot(v, v) - v3_dot(s->domain.gravity, g->pos[i]));
}

void ledger_start(struct sim *s)
{
    struct ledger *const l = &s->ledger;
    *l = (struct ledger){0};
    walls_open(s);
    sum_grains(s);
    l->momentum_start = l->momentum;
    l->mass_start = l->mass;
    l->energy_start = l->kinetic + l->potential + l->elastic;
    series_add(&s->series, "kinetic_energy", "J", "kinetic energy of the grains", &l->kinetic);
    series_add(&s->series, "elastic_energy", "J", "energy in the contacts", &l->elastic);
    series_add(&s->series, "dissipated_energy", "J", "energy lost in the contacts",
               &l->dissipated);
}

static void close_momentum(struct sim *s, double time)
{
    const struct grains *const g = &s->grains;
    struct ledger *const l = &s->ledger;
    vec3 load = v3(0.0, 0.0, 0.0);
    for (int i = 0; i < g->n; i++)
        if (g->inv_mass[i] != 0.0)
            load = v3_add(load, g->load[i]);
    l->impulse_weight = v3_axpy(l->impulse_weight, l->inertia * time, s->domain.gravity);
    l->impulse_fluid = v3_axpy(l->impulse_fluid, time, load);
    l->impulse_walls = v3_scale(-1.0, wall_impulses(s));
    const vec3 sum = v3_add(l->impulse_weight, v3_add(l->impulse_fluid, l->impulse_walls));
    const vec3 change = v3_sub(l->momentum, l->momentum_start);
    double size = v3_norm(l->impulse_weight) + v3_norm(l->impulse_fluid) + wall_impulse_size(s);
    size += sqrt(2.0 * l->mass * l->kinetic);
    l->momentum_error = size > 0.0 ? v3_norm(v3_sub(change, sum)) / size : 0.0;
}

static void close_energy(struct sim *s)
{
    const struct grains *const g = &s->grains;
    struct ledger *const l = &s->ledger;
    if (s->fluid.on)
        for (int i = 0; i < g->n; i++)
            if (g->inv_mass[i] != 0.0)
                l->work_fluid += v3_dot(
                    g->load[i], domain_minimum_image(
                                    &s->domain, v3_sub(g->pos[i], s->coupling.pos_load[i])));
    const double before = l->dissipated;
    l->dissipated = l->energy_start + l->work_fluid + walls_work(s) -
                    (l->kinetic + l->potential + l->elastic);
    l->dissipated_least = fmin(l->dissipated_least, l->dissipated - before);
}

void ledger_close(struct sim *s)
{
    struct ledger *const l = &s->ledger;
    sum_grains(s);
    if (s->grains.n > s->grains.n_frozen)
        close_momentum(s, s->run.dt * s->run.substeps);
    if (potential_exists(s))
        close_energy(s);
    if (!s->fluid.on || s->grains.n == 0)
        return;
    const vec3 to = s->coupling.to_grains, from = s->coupling.from_fluid;
    const double size = v3_norm(to) + v3_norm(from);
    if (size > 0.0)
        l->handover_error = fmax(l->handover_error, v3_norm(v3_sub(to, from)) / size);
    l->volume_error = fmax(l->volume_error, s->coupling.volume_error);
}

/* One line of the ledger; shouts when it does not close. */
static bool line(struct sim *s, const char *key, double error, double most)
{
    summary_number(&s->summary, key, error, "1");
    if (error <= most)
        return true;
    fprintf(stderr, "silt: THE LEDGER DOES NOT CLOSE: %s = %.3g, more than %.3g\n", key, error,
            most);
    return false;
}

void ledger_report(struct sim *s)
{
    walls_report(s);
    const struct ledger *const l = &s->ledger;
    bool closes = true;
    if (s->grains.n > s->grains.n_frozen) {
        summary_number(&s->summary, "mass_moving", l->mass, "kg");
        const double scale = l->mass + fabs(l->mass_start) + s->traffic.mass_in;
        closes = line(s, "ledger_mass_error",
                      scale > 0.0 ? fabs(l->mass - l->mass_start) / scale : 0.0, 1e-12) &&
                 closes;
        closes = line(s, "ledger_momentum_error", l->momentum_error, 1e-9) && closes;
    }
    if (s->fluid.exists && s->grains.n > 0) {
        closes = line(s, "ledger_handover_error", l->handover_error, 1e-9) && closes;
        closes = line(s, "ledger_volume_error", l->volume_error, 1e-12) && closes;
    }
    if (potential_exists(s) && s->grains.n > s->grains.n_frozen) {
        summary_number(&s->summary, "energy_kinetic", l->kinetic, "J");
        summary_number(&s->summary, "energy_elastic", l->elastic, "J");
        summary_number(&s->summary, "energy_work_of_fluid", l->work_fluid, "J");
        summary_number(&s->summary, "energy_dissipated", l->dissipated, "J");
        const double size = fabs(l->dissipated) + fabs(l->work_fluid) + l->kinetic +
                            l->elastic + fabs(l->potential - l->energy_start);
        const double made = size > 0.0 ? -l->dissipated_least / size : 0.0;
        closes = line(s, "ledger_energy_made", made, 1e-3) && closes;
    }
    summary_text(&s->summary, "ledger", "%s", closes ? "closes" : "DOES NOT CLOSE");
}
