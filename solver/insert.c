/* insert.c - grains come and go between steps: what is due, where it finds room, what has left. */
#include "insert.h"

#include <gsl/gsl_rng.h>
#include <string.h>
#include "../porosity/porosity.h"
#include "contact_loop.h"
#include "fill_grid.h"
#include "contact_path.h"
#include "sim.h"
#include "turning.h"

enum { TRIES = 200, STEPS_BETWEEN = 100 }; /* places tried per grain and batch; see `every` */

bool insert_changes(const struct sim *s)
{
    return s->traffic.n_sources + s->traffic.n_sinks > 0;
}

/* Splits one number into the seed of a generator: [Steele14]'s mix. */
static unsigned long mix(unsigned long a, unsigned long b)
{
    unsigned long x = a * 0x9e3779b97f4a7c15ul + b + 0x632be59bd9b4e019ul;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ul;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebul;
    return x ^ (x >> 31);
}

/* Grains near the region, to be kept clear of. */
static void gather(const struct sim *s, const struct source *o, struct fill_grid *near)
{
    const struct grains *const g = &s->grains;
    vec3 lo, hi;
    insert_region_bounds(&o->region, &lo, &hi);
    const vec3 centre = v3_scale(0.5, v3_add(lo, hi)), half = v3_scale(0.5, v3_sub(hi, lo));
    const double largest =
        g->species[o->species].largest * g->species[o->species].form.bounding;
    fill_grid_open(near, &s->domain, largest, g->n / 8 + 64);
    for (int i = 0; i < g->n; i++) {
        const vec3 d = domain_minimum_image(&s->domain, v3_sub(g->pos[i], centre));
        const double reach = g->radius[i] + 0.5 * largest;
        if (fabs(d.x) > half.x + reach || fabs(d.y) > half.y + reach ||
            fabs(d.z) > half.z + reach)
            continue;
        fill_grid_add(near, (struct placed){domain_wrap(&s->domain, g->pos[i]),
                                            2.0 * g->radius[i], g->kind[i]});
    }
}

int insert_grain(struct sim *s, int species, vec3 pos, double diameter, vec3 vel)
{
    struct grains *const g = &s->grains;
    grains_reserve(s, g->n + 1);
    const int i = g->n++;
    for (int f = 0; f < s->fields.n; f++) {
        const struct field *const field = &s->fields.field[f];
        const size_t size = kind_size(field->kind);
        if (field->place == PLACE_GRAIN)
            memset((char *)*field->data + (size_t)i * size, 0, size);
    }
    g->id[i] = g->next_id++;
    g->kind[i] = species;
    g->pos[i] = pos;
    g->vel[i] = vel;
    grains_body(g, i, diameter);
    if (g->orientation)
        shape.path->turning->place(g, i, s->run.seed);
    if (s->coupling.vel_old) {
        s->coupling.vel_old[i] = vel;
        s->coupling.pos_load[i] = pos;
    }
    species_count(&g->species[species], diameter);
    return i;
}

/* Whether a grain would touch no wall: asked of the walls for the place behind the last grain. */
static bool clear_of_walls(struct sim *s, vec3 x, double diameter)
{
    return walls_gap(s, x, 0.5 * diameter, diameter, NULL) >= 0.0;
}

/* A free place for a grain; false if none was found. */
static bool find_place(struct sim *s, const struct source *o, const struct fill_grid *near,
                       double diameter, gsl_rng *rng, vec3 *x)
{
    for (int k = 0; k < TRIES; k++) {
        const double u[3] = {gsl_rng_uniform(rng), gsl_rng_uniform(rng), gsl_rng_uniform(rng)};
        *x = domain_wrap(&s->domain, insert_region_point(&o->region, 0.5 * diameter, u));
        if (shape.flat)
            x->y = 0.5 * s->domain.size[1];
        if (fill_grid_overlap(near, *x, diameter, 0.0) == 0.0 &&
            clear_of_walls(s, *x, diameter))
            return true;
    }
    return false;
}

static void account(struct sim *s, int i, double sign)
{
    struct traffic *const t = &s->traffic;
    const struct grains *const g = &s->grains;
    const vec3 v = g->vel[i];
    const double mass = g->mass[i];
    const double energy = 0.5 * mass * v3_dot(v, v) +
                          (g->inv_inertia[i] > 0.0 ? grain_rotation(g, i) : 0.0) -
                          mass * v3_dot(s->domain.gravity, g->pos[i]);
    if (sign > 0.0) {
        t->inserted += 1.0;
        t->mass_in += mass;
        t->momentum_in = v3_axpy(t->momentum_in, mass, v);
        t->energy_in += energy;
    } else {
        t->removed += 1.0;
        t->mass_out += mass;
        t->momentum_out = v3_axpy(t->momentum_out, mass, v);
        /* the half kick of its contacts that their other sides are still to get */
        const vec3 contacts = v3_sub(g->force[i], g->load[i]);
        t->momentum_out = v3_axpy(t->momentum_out, 0.5 * s->run.dt, contacts);
        t->energy_out += energy;
    }
}

/* The fluid makes room for grain i (sign 1) or takes its place (-1), see the head of insert.h. */
static void displace(struct sim *s, int i, double sign)
{
    struct coupling *const c = &s->coupling;
    if (!s->fluid.exists || !porosity_displaces || c->ways == 1 || c->calls == 0)
        return;
    struct share *const share = xalloc((size_t)c->reach, sizeof *share);
    const int n = porosity_shares(&s->grid, &s->domain, &s->grains, i, share);
    const double part = sign * s->grains.volume[i] / s->grid.volume;
    for (int k = 0; k < n; k++)
        s->fluid.eps[share[k].cell] -= part * share[k].weight;
    xfree(share);
}

/* Grains due by the time `until`, and their mass. */
static void set_due(const struct sim *s, struct source *o, double until)
{
    const struct species *const k = &s->grains.species[o->species];
    const double mean = k->density * grains_volume(o->species, cbrt(k->sizes.mean_cube));
    const double time = fmax(0.0, fmin(until, o->end) - o->start);
    if (o->rate > 0.0) {
        o->asked = fmin(o->count_most, floor(o->rate * time * (1.0 + 1e-12) + 1e-9));
        o->asked_mass = fmin(o->mass_most, o->asked * mean);
    } else {
        o->asked_mass = fmin(fmin(o->mass_most, o->mass_flow * time), o->count_most * mean);
        o->asked = o->done + fmax(0.0, rint((o->asked_mass - o->done_mass) / mean));
    }
}

static bool is_due(const struct source *o, double mass)
{
    if (o->done >= o->count_most || o->done_mass + 0.5 * mass > o->mass_most)
        return false;
    return o->rate > 0.0 ? o->done < o->asked : o->done_mass + 0.5 * mass <= o->asked_mass;
}

/* s; when the next grain of a source was due. */
static double due_time(const struct source *o, double mass)
{
    return o->start + (o->rate > 0.0 ? (o->done + 1.0) / o->rate
                                     : (o->done_mass + 0.5 * mass) / o->mass_flow);
}

static _Noreturn void die_full(const struct sim *s, const struct source *o, double diameter,
                               double late)
{
    die(EXIT_UNSTABLE,
        "insert %s: no room for a grain of %g m, %g s late at t = %.9g s: asked %.0f grains "
        "(%.6g kg), done %.0f (%.6g kg); a larger region, faster grains, or more "
        "insert %s.patience",
        o->name, diameter, late, s->t, o->asked, o->asked_mass, o->done, o->done_mass, o->name);
}

/* One batch; returns how many came. */
static int serve(struct sim *s, int source, double until)
{
    struct source *const o = &s->traffic.source[source];
    const struct species *const k = &s->grains.species[o->species];
    const unsigned long seed = mix(s->run.seed, (unsigned long)source + 1ul);
    struct fill_grid near = {0};
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_taus2);
    int came = 0;
    set_due(s, o, until);
    for (bool open = false;; open = true) {
        const double d = sizes_draw(&k->sizes, seed & 0xfffffful, o->species, (long)o->done);
        const double mass = k->density * grains_volume(o->species, d);
        vec3 x;
        if (!is_due(o, mass)) {
            o->waits = -1.0;
            break;
        }
        if (!open)
            gather(s, o, &near);
        gsl_rng_set(rng, mix(mix(seed, (unsigned long)o->done), (unsigned long)s->step));
        const double wide = d * k->form.bounding;
        if (!find_place(s, o, &near, wide, rng, &x)) {
            o->waits = o->waits < 0.0 ? s->t : o->waits;
            const double late = s->t - fmax(o->waits, due_time(o, mass));
            if (late >= o->patience)
                die_full(s, o, d, late);
            break;
        }
        vec3 v = v3(o->velocity.x + o->scatter * (2.0 * gsl_rng_uniform(rng) - 1.0),
                    o->velocity.y + o->scatter * (2.0 * gsl_rng_uniform(rng) - 1.0),
                    o->velocity.z + o->scatter * (2.0 * gsl_rng_uniform(rng) - 1.0));
        v.y = shape.flat ? 0.0 : v.y;
        const int i = insert_grain(s, o->species, x, d, v);
        fill_grid_add(&near, (struct placed){x, wide, o->species});
        o->done += 1.0;
        o->done_mass += s->grains.mass[i];
        account(s, i, 1.0);
        displace(s, i, 1.0);
        came++;
    }
    gsl_rng_free(rng);
    fill_grid_close(&near);
    return came;
}

/* Marks what has left. Returns how many. */
static int remove_leavers(struct sim *s)
{
    struct grains *const g = &s->grains;
    struct traffic *const t = &s->traffic;
    int gone = 0;
    for (int i = 0; i < g->n; i++) {
        const vec3 x = g->pos[i];
        const double at[3] = {x.x, x.y, x.z};
        for (int k = 0; k < t->n_sinks && g->inv_mass[i] > 0.0; k++) {
            struct sink *const sink = &t->sink[k];
            bool leaves;
            if (sink->side >= 0) {
                const int a = sink->side / 2;
                leaves = sink->side % 2 ? at[a] > s->domain.size[a] + g->radius[i]
                                        : at[a] < -g->radius[i];
            } else {
                leaves = (sink->species < 0 || sink->species == g->kind[i]) &&
                         insert_region_holds(s, &sink->region, domain_wrap(&s->domain, x)) !=
                             sink->outside;
            }
            if (!leaves)
                continue;
            sink->removed += 1.0;
            sink->removed_mass += g->mass[i];
            account(s, i, -1.0);
            displace(s, i, -1.0);
            g->id[i] = -1;
            gone++;
            break;
        }
    }
    return gone;
}

/* The ledger starts from what it had and what came and went. */
static void tell_ledger(struct sim *s, const struct traffic *before)
{
    const struct traffic *const t = &s->traffic;
    struct ledger *const l = &s->ledger;
    l->momentum_start = v3_add(l->momentum_start, v3_sub(t->momentum_in, before->momentum_in));
    l->momentum_start =
        v3_sub(l->momentum_start, v3_sub(t->momentum_out, before->momentum_out));
    l->energy_start += t->energy_in - before->energy_in;
    l->energy_start -= t->energy_out - before->energy_out;
    l->mass_start += t->mass_in - before->mass_in;
    l->mass_start -= t->mass_out - before->mass_out;
}

void insert_step(struct sim *s)
{
    struct traffic *const t = &s->traffic;
    const int record = s->fluid.exists ? s->run.substeps : s->run.record;
    if (!insert_changes(s) || (!s->fluid.exists && s->clock % record != 0))
        return;
    const double step = s->run.dt * record, slack = 1e-6 * s->run.dt;
    const struct traffic before = *t;
    int changes = t->n_sinks > 0 ? remove_leavers(s) : 0;
    for (int k = 0; k < t->n_sources; k++) {
        struct source *const o = &t->source[k];
        if (s->t + step <= o->next_batch + slack || s->t < o->start - step)
            continue;
        const double every = o->every_time > 0.0 ? o->every_time : STEPS_BETWEEN * s->run.dt;
        /* what is due until the next batch, or until the end */
        o->next_batch = fmin(s->t + fmax(every, step), s->run.end);
        changes += serve(s, k, o->next_batch);
    }
    if (changes == 0)
        return;
    tell_ledger(s, &before);
    if (s->fluid.exists && s->coupling.calls > 0)
        grid_ghosts(&s->grid, &s->domain, s->fluid.eps);
    bodies_fill(s);
    neighbours_rebuild(s);
    contact_prepare(s);
    t->grains = s->grains.n;
}
