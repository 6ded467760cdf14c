/* neighbours.c - when the lists are made anew, and how far each grain may move until then.
 *
 * Skins adapt to the motion: thick for grains that fall, thin in a bed at rest. They follow from the
 * state alone, so they are the same on any number of threads and after a restart. */
#include "neighbours.h"

#include <string.h>
#include "../contact/contact.h"
#include "contact_loop.h"
#include "contact_path.h"
#include "halos.h"
#include "memory_order.h"
#include "search.h"
#include "sim.h"
#include "slots.h"

#define SKIN_LEAST  0.03  /* of the mean diameter, what any grain may move: in a bed at rest */
#define SKIN_FLOW   0.10  /* where others move so fast that one at rest may soon do, too */
#define FLOW_STEPS  15.0  /* of the fastest, in between */
#define SKIN_MOST   0.50  /* more than that by its speed */
#define SKIN_STEPS  60.0  /* that a skin should last */
#define INNER_STEPS 8.0   /* that the thin part of it should last */
#define INNER_LEAST 0.001 /* of the mean diameter: a bed at rest may wake up */
#define INNER_MOST  0.10

void neighbours_check(const struct sim *s, struct scene *scene)
{
    const struct grains *const g = &s->grains;
    const double widest = 2.0 * grains_widest(g);
    if (g->n == g->n_frozen || !isfinite(contact_duration(0, 0, 1.0, 1.0, 1.0)))
        return; /* nothing touches */
    const double least = g->n > 1 ? 2.0 * (widest + contact_reach()) : widest;
    for (int a = 0; a < 3; a++)
        if (s->domain.periodic[a] && s->domain.size[a] < least)
            scene_error(
                scene, "domain", NULL, "size",
                "must be %g m at least in periodic %c, two of the widest grains: narrower, "
                "a grain would touch another's image on both sides",
                least, 'x' + a);
}

void neighbours_create(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    const int n = s->grains.n;
    nb->reach = contact_reach();
    nb->rows = shape.path->rows(s);
    slots_create(&nb->pairs, n);
    slots_create(&nb->walls, n);
    nb->moved = nb->moved_inner = (double)INFINITY; /* stale from the start */
    frame_of(&s->frame, &s->domain);
    grains_follow(&s->grains, (void **)&nb->skin, sizeof *nb->skin);
    grains_follow(&s->grains, (void **)&nb->pace, sizeof *nb->pace);
    grains_follow(&s->grains, (void **)&s->bodies, sizeof *s->bodies);
    grains_follow(&s->grains, (void **)&s->rests, sizeof *s->rests);
}

void neighbours_free(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    slots_free(&nb->pairs);
    slots_free(&nb->walls);
    xfree(nb->to);
    xfree(nb->halo_begin);
    xfree(nb->in);
    xfree(nb->begin_in);
    xfree(nb->skin);
    xfree(nb->pace);
    xfree(s->bodies);
    xfree(s->rests);
}

enum { BLOCK = 1024 };

/* m/s, of the grains that move, by number; nothing where some never do, or do not follow. */
static double4 mean_velocity(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    const int blocks = (g->n + BLOCK - 1) / BLOCK;
    double4 *const part = xalloc((size_t)blocks + 1, sizeof *part);
#pragma omp parallel for schedule(static)
    for (int b = 0; b < blocks; b++)
        for (int i = b * BLOCK; i < g->n && i < (b + 1) * BLOCK; i++)
            part[b] += __builtin_convertvector(s->bodies[i].vel, double4);
    double4 sum = {0.0};
    for (int b = 0; b < blocks; b++)
        sum += part[b];
    xfree(part);
    const bool known = isfinite(sum[0] + sum[1] + sum[2]) && g->n > 0 && g->n_frozen == 0;
    return known ? sum / (double)g->n * (double4){1.0, 1.0, 1.0, 0.0} : (double4){0.0};
}

/* m, of grain i in a step, beside the drift; with what its parts move by its spin, where that
 * matters. */
static double way_of(const struct sim *s, int i, bool turns)
{
    const struct body *const b = &s->bodies[i];
    const double4 v = __builtin_convertvector(b->vel, double4) - s->neighbours.drift;
    const double4 w = __builtin_convertvector(b->spin, double4);
    double way = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (turns)
        way += sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) * w[3];
    return way * s->run.dt;
}

/* Skins: a bit for anyone, and what the grain's own speed takes in a number of steps. */
static void choose_skins(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    const struct grains *const g = &s->grains;
    const bool turns = shape.path->turns && shape.path->turns(s);
    const double mean = g->n > 0 ? 2.0 * sum_blocks(g->radius, (size_t)g->n) / g->n : 0.0;
    const double most = SKIN_MOST * mean;
    double farthest = 0.0;
    nb->drift = mean_velocity(s);
#pragma omp parallel for schedule(static) reduction(max : farthest)
    for (int i = 0; i < g->n; i++)
        farthest = fmax(farthest, g->inv_mass[i] != 0.0 ? way_of(s, i, turns) : 0.0);
    const double least = fmin(fmax(FLOW_STEPS * farthest, SKIN_LEAST * mean), SKIN_FLOW * mean);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        const bool moves = g->inv_mass[i] != 0.0;
        const double way = moves ? way_of(s, i, turns) : 0.0;
        const double skin = moves ? least + fmin(SKIN_STEPS * way, most) : 0.0;
        nb->skin[i] = (float)skin;
        nb->pace[i] = moves ? (float)(1.00001 / (skin * skin)) : 0.0F;
    }
    const double4 u = nb->drift;
    nb->drift_speed = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    const double wall_way = (nb->drift_speed + s->walls.speed) * s->run.dt;
    nb->wall_skin = least + fmin(SKIN_STEPS * wall_way, mean);
    farthest = fmax(farthest, wall_way);
    const double inner =
        fmin(fmax(INNER_STEPS * farthest, INNER_LEAST * mean), INNER_MOST * mean);
    const double rate = farthest / (least + fmin(SKIN_STEPS * farthest, most));
    nb->thin = inner / (least + fmin(SKIN_STEPS * farthest, most));
    nb->thin = nb->thin > 2.0 * rate ? nb->thin : 0.0;
}

void neighbours_speed(struct sim *s, int step, double square, double tip)
{
    struct neighbours *const nb = &s->neighbours;
#pragma omp critical(neighbours_speed)
    {
        nb->fastest[step % 2] = larger(nb->fastest[step % 2], square);
        nb->tips[step % 2] = larger(nb->tips[step % 2], tip);
    }
}

void neighbours_wall_speed(struct sim *s, int step, double speed)
{
    const struct neighbours *const nb = &s->neighbours;
    const double rate = (nb->drift_speed + speed) / nb->wall_skin;
    if (nb->builds > 0)
        neighbours_speed(s, step, rate * rate, 0.0);
}

struct ageing neighbours_ageing(const struct sim *s, bool new)
{
    const struct neighbours *const nb = &s->neighbours;
    return (struct ageing){
        .moved = nb->moved, .moved_inner = new ? 0.0 : nb->moved_inner, .choose = true};
}

/* The speeds of two steps are kept apart, so that one can be cleared while the other is read. */
bool neighbours_fresh(struct sim *s, struct ageing *age, int step)
{
    struct neighbours *const nb = &s->neighbours;
    double way = sqrt(nb->fastest[step % 2]) * s->run.dt, tip = 0.0;
    if (s->walls.n > 0) { /* even walls at rest, where the grains drift */
        const double past = nb->drift_speed * s->run.dt / nb->wall_skin;
        way = way <= past ? past : way;
    }
    if (shape.path->turns && shape.path->turns(s))
        tip = sqrt(nb->tips[step % 2]) * s->run.dt;
    age->moved += way;
    age->moved_inner += way + tip;
    if (!(age->moved <= 1.0))
        return false;
    age->choose = !(age->moved_inner <= nb->thin);
    if (age->choose) {
        age->moved_inner = 0.0;
        age->choices++;
    }
#pragma omp master
    nb->fastest[(step + 1) % 2] = nb->tips[(step + 1) % 2] = 0.0;
    return true;
}

void neighbours_aged(struct sim *s, const struct ageing *age)
{
    struct neighbours *const nb = &s->neighbours;
    nb->moved = age->moved;
    nb->moved_inner = age->moved_inner;
    nb->choices += age->choices;
    nb->fastest[0] = nb->fastest[1] = nb->tips[0] = nb->tips[1] = 0.0;
}

static int find_walls(const struct search *c, const struct sim *s, int i, int **out, int *room,
                      int n)
{
    const struct neighbours *const nb = &s->neighbours;
    (void)c;
    return walls_near(s, i, nb->reach + (double)nb->skin[i] + nb->wall_skin, out, room, n);
}

void neighbours_rebuild(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    const int rows = nb->rows;
    struct search c;
    double clock = wall_clock();
    contact_put_back(s);
    clock = timer_add(&s->timers, TIME_NEIGHBOURS, clock);
    int *const order = memory_order(s);
    for (nb->run = RUN_LEAST; nb->run < RUN_MOST && s->grains.n >= 2 * nb->run * RUNS_LEAST;)
        nb->run *= 2;
    nb->runs = (s->grains.n + nb->run - 1) / nb->run;
    bodies_sort(s, order, nb->listed);
    choose_skins(s);
    clock = timer_add(&s->timers, TIME_SORT, clock);
    struct kept pairs = slots_keep(&nb->pairs, nb->listed, rows);
    struct kept walls = slots_keep(&nb->walls, nb->listed, rows);
    search_open(&c, s, nb->skin, nb->reach);
    slots_fill(s, &nb->pairs, search_pairs, &c, &pairs, order, true);
    search_free(&c);
    slots_fill(s, &nb->walls, find_walls, NULL, &walls, order, false);
    clock = timer_add(&s->timers, TIME_SEARCH, clock);
    halos_make(nb, s->grains.n);
    nb->listed = s->grains.n;
    nb->moved = 0.0;
    nb->moved_inner = (double)INFINITY;
    nb->builds++;
    xfree(order);
    timer_add(&s->timers, TIME_NEIGHBOURS, clock);
}
