/* reference/rebound.c - spheres fall on the floor and bounce, without a fluid.
 *
 *   h_k = r + (h_0 - r) e^(2k)
 *
 * height of the centre at the top of flight after k bounces of a sphere of radius r, in the
 * limit of hard spheres with restitution e. The tops of all grains are averaged over the grains
 * that reach them; the simulated one is z + v^2/(2 g) just past the top, where flight is free.
 * The flight of the first grain is drawn over the parabolas of the limit. A soft contact takes
 * a time t_c, in which the weight acts on: later bounces lag, and heights deviate by the order
 * of g t_c/v, v the speed of impact; so a comparison of bounces to come needs contacts stiff
 * enough for the last. */
#include "reference.h"

#include "../solver/sim.h"

const struct about reference_about = {
    .name = "rebound",
    .summary = "heights of bouncing spheres against those of hard spheres",
    .equation = "h_k = r + (h_0 - r) e^(2k)",
    .source = "",
    .range = "spheres falling on the floor z = 0, not on each other, without a fluid"};
const struct key reference_keys[] = {
    {"reference", "restitution", KEY_REAL, "1", "(0, 1]", NULL,
     "rebound speed over impact speed"},
    {"reference", "bounces", KEY_INT, "", "[1, 100]", "5",
     "bounces that are compared, at most"},
    {"reference", "tolerance", KEY_REAL, "1", "(0, inf)", "1 %",
     "of a height above that at contact"},
    {0},
};

enum { ROWS = 400 };

struct rebound {
    double e, gravity, tolerance;
    int bounces;
    int n;              /* grains, by id */
    int *count;         /* bounces so far */
    double *last, *top; /* m/s, velocity at the last step; m, height of the first top over r */
    double *simulated, *exact,
        *error;     /* per bounce: sums over grains; largest relative error */
    int *reached;   /* grains that reached the top after this bounce */
    double z, v, r; /* first grain at the start */
    double next;    /* s, of the next row of the flight */
    struct table *heights, *flight;
};

static const struct table heights_pattern = {
    .name = "rebound",
    .title = "heights of the centres at the tops of flight",
    .n_columns = 5,
    .column = {{"bounce", "1", "bounces before"},
               {"grains", "1", "grains that reached it"},
               {"simulated", "m", "height, mean over the grains"},
               {"exact", "m", "height of hard spheres, mean over the grains"},
               {"error", "1", "largest error of a grain, of the height above contact"}}};

static const struct table flight_pattern = {
    .name = "flight",
    .title = "height of the first grain",
    .n_columns = 3,
    .column = {{"time", "s", "time"},
               {"simulated", "m", "height of the centre, simulated"},
               {"exact", "m", "height of the centre, hard sphere"}},
    .figure = {
        .file = "rebound.png",
        .title = "height of the first grain",
        .x = "time",
        .x_label = "time / s",
        .y_label = "height / m",
        .n_curves = 2,
        .curve = {{"simulated", "points", "simulated"}, {"exact", "line", "hard sphere"}}}};

/* m; height of a hard sphere, started at z with velocity v, at time t. */
static double hard_sphere(const struct rebound *p, double t)
{
    const double g = p->gravity;
    double z = p->z, v = p->v;
    for (int k = 0; k < 10000; k++) {
        const double impact = sqrt(v * v + 2.0 * g * (z - p->r)), flight = (v + impact) / g;
        if (t < flight)
            return z + v * t - 0.5 * g * t * t;
        t -= flight;
        z = p->r;
        v = p->e * impact;
    }
    return p->r;
}

void reference_create(struct sim *s, struct scene *scene)
{
    struct rebound *const p = xalloc(1, sizeof *p);
    const vec3 g = s->domain.gravity;
    s->reference = p;
    p->e = scene_real(scene, "reference", NULL, "restitution");
    p->bounces = scene_int(scene, "reference", NULL, "bounces");
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    p->gravity = v3_norm(g);
    if (!(g.z < 0.0) || g.x != 0.0 || g.y != 0.0 || s->domain.periodic[2])
        scene_error(scene, "domain", NULL, "gravity",
                    "rebound needs gravity along -z and a floor there");
    if (s->fluid.exists || (scene_errors(scene) == 0 && s->grains.n == 0))
        scene_error(scene, "modules", NULL, "reference", "rebound needs grains and no fluid");
    if (scene_errors(scene) > 0)
        return;
    const size_t n = (size_t)s->grains.n, tops = (size_t)p->bounces + 1;
    p->n = s->grains.n;
    p->count = xalloc(n, sizeof *p->count);
    p->last = xalloc(n, sizeof *p->last);
    p->top = xalloc(n, sizeof *p->top);
    p->simulated = xalloc(tops, sizeof *p->simulated);
    p->exact = xalloc(tops, sizeof *p->exact);
    p->error = xalloc(tops, sizeof *p->error);
    p->reached = xalloc(tops, sizeof *p->reached);
    p->heights = tables_add(&s->tables, &heights_pattern);
    p->flight = tables_add(&s->tables, &flight_pattern);
    for (int i = 0; i < s->grains.n; i++) {
        const int id = s->grains.id[i];
        const double z = s->grains.pos[i].z, v = s->grains.vel[i].z;
        p->last[id] = v;
        /* the top that it reaches, or from which it would fall like that */
        p->top[id] = z + 0.5 * v * v / p->gravity - s->grains.radius[i];
        if (id == 0) {
            p->z = z;
            p->v = v;
            p->r = s->grains.radius[i];
        }
    }
}

/* A grain past the top of its flight, `above` m over its height at contact. */
static void count_top(struct rebound *p, int id, double above, double r)
{
    const int k = p->count[id];
    if (k > p->bounces)
        return;
    const double want = p->top[id] * pow(p->e, 2.0 * k);
    p->simulated[k] += above + r;
    p->exact[k] += want + r;
    p->error[k] = fmax(p->error[k], fabs(above / want - 1.0));
    p->reached[k]++;
}

void reference_watch(struct sim *s)
{
    struct rebound *const p = s->reference;
    const struct grains *const g = &s->grains;
    for (int i = 0; i < g->n; i++) {
        const int id = g->id[i];
        const double v = g->vel[i].z, last = p->last[id];
        if (last < 0.0 && v > 0.0)
            p->count[id]++;
        else if (last >= 0.0 && v < 0.0)
            count_top(p, id, g->pos[i].z + 0.5 * v * v / p->gravity - g->radius[i],
                      g->radius[i]);
        p->last[id] = v;
        if (id == 0 && s->t >= p->next) {
            const double row[] = {s->t, g->pos[i].z, hard_sphere(p, s->t)};
            table_row(p->flight, row);
            p->next = s->t + s->run.end / ROWS;
        }
    }
}

void reference_report(struct sim *s)
{
    struct rebound *const p = s->reference;
    double worst = 0.0, last[2] = {(double)NAN, (double)NAN};
    int bounces = 0;
    for (int k = 0; k <= p->bounces; k++) {
        const int n = p->reached[k];
        if (n == 0)
            continue;
        const double row[] = {k, n, p->simulated[k] / n, p->exact[k] / n, p->error[k]};
        table_row(p->heights, row);
        worst = fmax(worst, p->error[k]);
        last[0] = row[2];
        last[1] = row[3];
        bounces = k;
    }
    table_print(stdout, p->heights);
    const bool good = bounces > 0 && worst <= p->tolerance;
    summary_number(&s->summary, "bounces", bounces, "1");
    summary_number(&s->summary, "height_error", worst, "1");
    summary_reference(
        &s->summary,
        (struct comparison){.quantity = "height of the last bounce; error: of the worst",
                            .source = reference_about.source,
                            .unit = "m",
                            .got = last[0],
                            .want = last[1],
                            .error = bounces > 0 ? worst : (double)NAN,
                            .tolerance = p->tolerance});
    summary_text(&s->summary, "verdict", good ? "pass" : "FAIL");
    printf("reference: %s heights after %d bounces, largest error %.4f %%, tolerance %g %%\n",
           good ? "pass" : "FAIL", bounces, 100.0 * worst, 100.0 * p->tolerance);
}

void reference_free(struct sim *s)
{
    struct rebound *const p = s->reference;
    if (!p)
        return;
    void *const all[] = {p->count, p->last,  p->top,     p->simulated,
                         p->exact, p->error, p->reached, p};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}
