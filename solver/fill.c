/* fill.c - placing the grains: how many of which sizes, and where.
 *
 * At random: grains are added one by one, the largest first, where they overlap nothing (random
 * sequential addition, which jams at a solid fraction of 0.384 for equal spheres [Zhang13]); a
 * grain that finds no room in a few tries is put down all the same, and then all are pushed apart
 * (fill_relax.c), which reaches about 0.6. `grow` lets them grow in place, to dense packings
 * (fill_grow.c). `settle` is a random filling of the lower part of the region at SETTLE_LOOSE, which
 * then falls (settle.c). All of these keep clear of walls. */
#include "fill.h"

#include <stdlib.h>
#include "../shapes/shape.h"
#include "contact_path.h"
#include "fill_grow.h"
#include "fill_patterns.h"
#include "fill_room.h"
#include "sim.h"

#define PI           3.14159265358979323846
#define LATTICE_MOST (shape.flat ? 0.7854 : 0.5236) /* square; simple cubic */
#define RANDOM_MOST  (shape.flat ? 0.84 : 0.64)
#define GROW_MOST    (shape.flat ? 0.9069 : 0.7405) /* the densest lattice */
#define SIZES_MOST   0.85 /* of differing sizes, the small in the gaps of the large */
#define SETTLE_LOOSE 0.28
#define SWELL        0.01

enum { TRIES = 10, COUNT_MOST = 100000000, ROOM_POINTS = 1 << 18, HEIGHT_POINTS = 1 << 13 };

static struct fill_region region_read(struct sim *s, struct scene *scene, const char *name,
                                      double widest)
{
    struct fill_region r = {.flat = shape.flat, .middle = 0.5 * s->domain.size[1]};
    const vec3 from = scene_vector(scene, "grains", name, "from");
    const vec3 to = scene_vector(scene, "grains", name, "to");
    const bool lower = !scene_word(scene, "grains", name, "from", "box");
    const bool upper = !scene_word(scene, "grains", name, "to", "box");
    const double f[3] = {from.x, from.y, from.z}, t[3] = {to.x, to.y, to.z};
    for (int a = 0; a < 3; a++) {
        const double size = s->domain.size[a];
        r.from[a] = lower ? f[a] : 0.0;
        r.to[a] = upper ? t[a] : size;
        if (r.from[a] < 0.0 || r.to[a] > size * (1.0 + 1e-12) || !(r.from[a] < r.to[a]))
            scene_error(scene, "grains", name,
                        upper   ? "to"
                        : lower ? "from"
                                : NULL,
                        "the region must lie inside the box, from below to");
        r.open[a] = s->domain.periodic[a] && r.from[a] == 0.0 && r.to[a] == size;
        if (!r.open[a] && r.to[a] - r.from[a] < widest)
            scene_error(scene, "grains", name, "diameter",
                        "the widest grain, %g m, is wider than the region (%g m)", widest,
                        r.to[a] - r.from[a]);
    }
    return r;
}

/* m3 of the region that a grain of diameter d takes: of shapes that are no spheres the bounding ones, as
 * they find room; of discs as if they were as thick as the region. */
static double solid_of(const struct fill_task *t, double d)
{
    const double thick = t->region.to[1] - t->region.from[1];
    return shape.flat ? 0.25 * PI * d * d * thick : PI / 6.0 * d * d * d;
}

/* m3, its own. */
static double own_volume(const struct fill_task *t, double d)
{
    return shape.flat ? grains_volume(t->species, d) : PI / 6.0 * d * d * d;
}

/* The key that says how many: count, mass or porosity. */
static const char *amount_key(struct scene *scene, const char *name)
{
    const bool mass = !scene_word(scene, "grains", name, "mass", "auto");
    const bool porosity = !scene_word(scene, "grains", name, "porosity", "auto");
    const bool count = scene_given(scene, "grains", name, "count");
    if (mass + porosity + count > 1)
        scene_error(scene, "grains", name, porosity ? "porosity" : "mass",
                    "give one of count, mass and porosity");
    return porosity ? "porosity" : mass ? "mass" : "count";
}

/* The diameters of the grains asked for: to the last grain of a count, to half a grain of a mass
 * or of a volume of solid. */
static void draw_sizes(const struct sim *s, struct fill_task *t, const char *key)
{
    const double density = s->grains.species[t->species].density;
    double (*const volume_of)(const struct fill_task *, double) =
        key[0] == 'm' ? own_volume : solid_of;
    double solid = (double)INFINITY, sum = 0.0;
    double most = COUNT_MOST;
    if (key[0] == 'c')
        most = scene_int(t->scene, "grains", t->name, "count");
    else if (key[0] == 'm')
        solid = scene_real(t->scene, "grains", t->name, "mass") / density;
    else
        solid = (1.0 - scene_real(t->scene, "grains", t->name, "porosity")) * t->room;
    const double expected = fmin(most, solid / volume_of(t, cbrt(t->sizes->mean_cube)));
    if (expected > 0.999 * COUNT_MOST) {
        scene_error(t->scene, "grains", t->name, key, "are about %.3g grains; at most %d",
                    expected, COUNT_MOST);
        return;
    }
    int capacity = (int)(1.1 * expected) + 16;
    t->diameter = xalloc((size_t)capacity, sizeof *t->diameter);
    for (long k = 0; k < (long)most; k++) {
        const double d = sizes_draw(t->sizes, t->seed, t->species, k);
        if (sum + 0.5 * volume_of(t, d) > solid)
            break;
        if (t->n == capacity) {
            t->diameter = xrealloc(t->diameter, (size_t)capacity, 2 * (size_t)capacity,
                                   sizeof *t->diameter);
            capacity *= 2;
        }
        t->diameter[t->n++] = d * t->bounding;
        sum += volume_of(t, d);
    }
    if (t->n == 0 && most > 0.0)
        scene_error(t->scene, "grains", t->name, key, "is less than half a grain of %g m",
                    sizes_draw(t->sizes, t->seed, t->species, 0));
}

/* Solid fraction that the task asks of its region. */
static double solid_fraction(const struct fill_task *t)
{
    double sum = 0.0;
    for (int i = 0; i < t->n; i++)
        sum += solid_of(t, t->diameter[i]);
    return t->room > 0.0 ? sum / t->room : (double)INFINITY;
}

/* True, or an error on the list, if the grains are at most `most` of the region. */
static bool fits(const struct fill_task *t, const char *key, double most, const char *why)
{
    const double solid = solid_fraction(t);
    if (solid <= most)
        return true;
    scene_error(t->scene, "grains", t->name, key,
                "the grains fill %.3g %% of their region%s; at most %.3g %% %s", 100.0 * solid,
                t->walls ? " between the walls" : "", 100.0 * most, why);
    return false;
}

/* One grain of a random filling. */
struct drawn {
    double diameter;
    int task, order;
};

static int largest_first(const void *a, const void *b)
{
    const struct drawn *const x = a, *const y = b;
    if (x->diameter != y->diameter)
        return x->diameter > y->diameter ? -1 : 1;
    return x->order - y->order;
}

/* Puts down the grains, largest first; returns the largest overlap that was left. */
static double put_down(struct fill_grid *b, const struct drawn *drawn, int n,
                       const struct fill_task *task, gsl_rng *rng)
{
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        const struct fill_task *const t = &task[drawn[i].task];
        const double d = drawn[i].diameter;
        vec3 x = v3(0.0, 0.0, 0.0);
        double overlap = 1.0;
        for (int k = 0; k < TRIES && overlap > 0.0; k++) {
            if (!room_somewhere(t->walls, &t->region, 0.5 * d, rng, &x)) {
                scene_error(t->scene, "grains", t->name, NULL,
                            "between the walls there is no place in the region for a grain of "
                            "%g m",
                            d);
                return 0.0;
            }
            overlap = fill_grid_overlap(b, x, d, 0.0);
        }
        worst = fmax(worst, overlap);
        fill_grid_add(b, (struct placed){x, d, t->species});
    }
    return worst;
}

/* Pushes the grains apart, with room to spare first, or with less of it. */
static double push_apart(struct fill_grid *b, int first, const struct fill_region *regions,
                         const struct sim *walls)
{
    struct relaxed r = {.overlap = 1.0};
    for (double swell = SWELL; swell > 5e-4 && r.overlap > 0.0; swell *= 0.2)
        r = fill_relax(b, first, regions,
                       &(struct relax_goal){.scale = 1.0,
                                            .swell = swell,
                                            .sweeps = swell < SWELL ? 3000 : 600,
                                            .walls = walls});
    return r.overlap;
}

/* The grains from `first` on, which overlap, are let grow; or an error that says how far they did. */
static void grow(struct sim *s, struct fill_grid *b, int first,
                 const struct fill_region *regions, const struct fill_task *last,
                 const struct grow_goal *goal)
{
    const struct grown g = fill_grow(b, first, regions, goal);
    if (g.scale < 1.0) {
        const double solid = solid_fraction(last);
        scene_error(
            last->scene, "grains", last->name, amount_key(last->scene, last->name),
            "the growing grains jam at %.4f of their diameter, where the porosity of "
            "their region is %.4f (asked: %.4f); ask for that, or let more overlap than "
            "%g (grains %s.overlap)",
            g.scale, 1.0 - solid * g.scale * g.scale * g.scale, 1.0 - solid, goal->overlap,
            last->name);
    }
    summary_number(&s->summary, "grown_overlap", g.overlap, "1");
    summary_number(&s->summary, "grown_sweeps", g.sweeps, "1");
}

/* Pushes the grains from `first` on apart; or an error. */
static void part(struct fill_grid *b, int first, const struct fill_region *regions,
                 const struct fill_task *last, const struct sim *walls)
{
    const double overlap = push_apart(b, first, regions, walls);
    if (overlap > 0.0)
        scene_error(last->scene, "grains", last->name, amount_key(last->scene, last->name),
                    "the grains find no room without overlap (%.2g of a diameter is left); ask "
                    "for a higher porosity or a larger region, or fill = grow",
                    overlap);
}

static bool at_random(int how)
{
    return how == FILL_RANDOM || how == FILL_SETTLE || how == FILL_GROW;
}

/* All species that are placed at random, together. */
static void fill_random(struct sim *s, struct fill_grid *b, struct fill_task *task, int n_tasks,
                        const int *how)
{
    struct fill_region *const regions = xalloc((size_t)n_tasks + 1, sizeof *regions);
    struct drawn *drawn = NULL;
    struct grow_goal goal = {.overlap = 1.0};
    int n = 0, first = b->n, last = -1;
    bool grows = false;
    for (int k = 0; k < n_tasks; k++) {
        regions[k] = task[k].region;
        if (!at_random(how[k]))
            continue;
        goal.walls = goal.walls ? goal.walls : task[k].walls;
        goal.solid += solid_fraction(&task[k]);
        if (how[k] == FILL_GROW) {
            grows = true;
            goal.overlap = fmin(goal.overlap,
                                scene_real(task[k].scene, "grains", task[k].name, "overlap"));
        }
        drawn = xrealloc(drawn, (size_t)n, (size_t)(n + task[k].n) + 1, sizeof *drawn);
        for (int i = 0; i < task[k].n; i++, n++)
            drawn[n] = (struct drawn){task[k].diameter[i], k, n};
        last = k;
    }
    if (n > 0) {
        gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
        gsl_rng_set(rng, s->run.seed);
        qsort(drawn, (size_t)n, sizeof *drawn, largest_first);
        const double overlap = put_down(b, drawn, n, task, rng);
        if (overlap > 0.0 && grows)
            grow(s, b, first, regions, &task[last], &goal);
        else if (overlap > 0.0)
            part(b, first, regions, &task[last], goal.walls);
        gsl_rng_free(rng);
    }
    xfree(drawn);
    xfree(regions);
}

/* The lower part of the region only: less far to fall. */
static void lower_part(struct fill_task *t)
{
    struct fill_region *const r = &t->region;
    const double want = solid_fraction(t) * t->room / SETTLE_LOOSE;
    const double height = r->to[2] - r->from[2], d = t->widest;
    const double least = fmin(height, r->open[2] ? 0.0 : 2.0 * d);
    double lo = 0.0, need = fmin(height, want / region_volume(r) * height);
    struct fill_region lower = *r;
    for (double hi = height; t->walls && hi - lo > 0.01 * d;) { /* where they leave enough */
        need = 0.5 * (lo + hi);
        lower.to[2] = r->from[2] + need;
        if (room_volume(t->walls, &lower, HEIGHT_POINTS) < want)
            lo = need;
        else
            hi = need;
    }
    need = fmax(need, least);
    if (need < height)
        r->open[2] = false;
    r->to[2] = r->from[2] + need;
}

/* Checks one species' amount against its region. */
static void prepare(struct sim *s, struct fill_task *t, int how)
{
    const char *const key = amount_key(t->scene, t->name);
    const bool one = t->sizes->kind == SIZES_ONE;
    if (how == FILL_UNIT_CELL || how == FILL_FILE)
        return;
    t->walls = walls_named(s) && !s->grains.species[t->species].frozen ? s : NULL;
    t->room =
        how == FILL_POINT || how == FILL_LATTICE
            ? region_volume(&t->region)
            : room_volume(t->walls, &t->region, key[0] == 'p' ? ROOM_POINTS : HEIGHT_POINTS);
    draw_sizes(s, t, key);
    if (how == FILL_LATTICE)
        fits(t, key, LATTICE_MOST, "can lie on a lattice");
    else if (how != FILL_POINT &&
             fits(t, key,
                  !one               ? SIZES_MOST
                  : how == FILL_GROW ? GROW_MOST
                                     : RANDOM_MOST,
                  how == FILL_GROW ? "find room" : "find room at random (fill = grow: more)") &&
             how == FILL_SETTLE)
        lower_part(t);
}

static void place(struct fill_grid *b, struct fill_task *t, int how, struct fill_motion *m)
{
    switch (how) {
    case FILL_LATTICE:
        fill_lattice(b, t);
        break;
    case FILL_UNIT_CELL:
        fill_unit_cell(b, t);
        break;
    case FILL_POINT:
        fill_point(b, t);
        break;
    case FILL_FILE:
        fill_from_file(b, t, m);
        break;
    default:
        break; /* at random: all of these together, later */
    }
}

void fill(struct sim *s, struct scene *scene, struct fill *f)
{
    const struct grains *const g = &s->grains;
    const int n = g->n_species;
    struct fill_task *const task = xalloc((size_t)n + 1, sizeof *task);
    int *const how = xalloc((size_t)n + 1, sizeof *how);
    const char *const *names;
    double widest = 0.0, total = 0.0;
    struct fill_grid b;
    struct fill_motion motion = {0};
    scene_names(scene, "grains", &names);
    *f = (struct fill){0};
    for (int k = 0; k < n; k++) {
        task[k] = (struct fill_task){.scene = scene, .name = names[k], .species = k};
        task[k].sizes = &g->species[k].sizes;
        task[k].seed = s->run.seed;
        how[k] = scene_choice(scene, "grains", names[k], "fill");
        task[k].bounding = g->species[k].form.bounding;
        task[k].axes = g->species[k].form.axes;
        task[k].widest = task[k].sizes->largest * task[k].bounding;
        task[k].region = region_read(s, scene, names[k], task[k].widest);
        widest = fmax(widest, task[k].widest);
    }
    for (int k = 0; k < n && scene_errors(scene) == 0; k++) {
        prepare(s, &task[k], how[k]);
        total += task[k].n;
    }
    if (scene_errors(scene) == 0 && n > 0) {
        fill_grid_open(&b, &s->domain, widest, (int)fmin(total, 2e8));
        for (int k = 0; k < n; k++)
            place(&b, &task[k], how[k], &motion);
        if (scene_errors(scene) == 0)
            fill_random(s, &b, task, n, how);
        for (int i = 0; i < b.n && shape.flat; i++)
            b.grain[i].pos.y = 0.5 * s->domain.size[1];
        for (int i = 0; i < motion.n && shape.flat; i++)
            motion.vel[i].y = motion.spin[i].x = motion.spin[i].z = 0.0;
        if (!shape.path->turning &&
            scene_errors(scene) == 0) /* of others, walls_check tells where they reach */
            fill_check(s, scene, &b, names);
        *f = (struct fill){b.n, b.grain, motion.n, motion.vel, motion.spin, motion.turn};
        b.grain = NULL;
        fill_grid_close(&b);
    }
    for (int k = 0; k < n; k++)
        xfree(task[k].diameter);
    xfree(task);
    xfree(how);
}

void fill_free(struct fill *f)
{
    xfree(f->grain);
    xfree(f->vel);
    xfree(f->spin);
    xfree(f->turn);
    *f = (struct fill){0};
}

bool fill_settles(struct sim *s, struct scene *scene)
{
    const char *const *names;
    scene_names(scene, "grains", &names);
    for (int i = 0; i < s->grains.n_species; i++)
        if (scene_choice(scene, "grains", names[i], "fill") == FILL_SETTLE)
            return true;
    return false;
}
