/* neighbours.c - the pair list: grains sorted by search cell, pairs found in the 27 cells
 * around, the history of live contacts carried from the old list to the new.
 *
 * The skin adapts to the motion: thick while grains fall, thin in a bed at rest. It follows
 * from the state alone, so it is the same on any number of threads and after a restart. */
#include "neighbours.h"

#include <string.h>
#include "../contact/contact.h"
#include "contact_loop.h"
#include "sim.h"

#define SKIN_LEAST 0.10 /* of the mean diameter */
#define SKIN_MOST  0.30
#define SKIN_STEPS 25.0 /* steps that a skin should last */

/* The search grid of one build. */
struct search {
    int n[3];
    double edge[3];
    int *begin; /* cells + 1: grains are sorted by cell */
};

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
    nb->reach = contact_reach();
    nb->rows = contact_rows();
    nb->begin = xalloc((size_t)s->grains.n + 1, sizeof *nb->begin);
    grains_follow(&s->grains, (void **)&nb->begin_in, sizeof *nb->begin_in);
    grains_follow(&s->grains, (void **)&nb->pos_built, sizeof *nb->pos_built);
    nb->moved = (double)INFINITY; /* stale from the start */
}

void neighbours_free(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    void *const all[] = {nb->begin,    nb->owner, nb->other,   nb->begin_in,
                         nb->slots_in, nb->live,  nb->history, nb->pos_built};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

static double choose_skin(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    double fastest = 0.0, sum = 0.0;
    for (int i = 0; i < g->n; i++) {
        fastest = fmax(fastest, v3_dot(g->vel[i], g->vel[i]));
        sum += g->radius[i];
    }
    const double mean = g->n > 0 ? 2.0 * sum / g->n : 0.0;
    const double wish = 2.0 * SKIN_STEPS * sqrt(fastest) * s->run.dt;
    return fmin(fmax(wish, SKIN_LEAST * mean), SKIN_MOST * mean);
}

static double largest_radius(const struct grains *g)
{
    double r = 0.0;
    for (int i = 0; i < g->n; i++)
        r = fmax(r, g->radius[i]);
    return r;
}

/* Cells no smaller than the widest pair, and not many more of them than grains. */
static void search_open(struct search *c, const struct sim *s)
{
    const struct neighbours *const nb = &s->neighbours;
    double edge = 2.0 * largest_radius(&s->grains) + nb->reach + nb->skin;
    const double *const size = s->domain.size;
    const double room = size[0] * size[1] * size[2] / (4.0 * s->grains.n + 64.0);
    edge = fmax(edge, cbrt(room));
    for (int a = 0; a < 3; a++) {
        c->n[a] = (int)fmin(fmax(1.0, floor(size[a] / edge)), 1000.0);
        c->edge[a] = size[a] / c->n[a];
    }
}

static int search_index(const struct search *c, const struct domain *d, double x, int a)
{
    int i = (int)floor(x / c->edge[a]);
    if (d->periodic[a])
        i = (i % c->n[a] + c->n[a]) % c->n[a];
    return i < 0 ? 0 : i >= c->n[a] ? c->n[a] - 1 : i;
}

static int search_cell(const struct search *c, const struct domain *d, vec3 x)
{
    return search_index(c, d, x.x, 0) +
           c->n[0] * (search_index(c, d, x.y, 1) + c->n[1] * search_index(c, d, x.z, 2));
}

/* Sorts all arrays of the grains by search cell, without those that are gone (id < 0); returns
 * order[new] = old. */
static int *sort_grains(struct sim *s, struct search *c)
{
    struct grains *const g = &s->grains;
    const int cells = c->n[0] * c->n[1] * c->n[2];
    int *const order = xalloc((size_t)g->n, sizeof *order);
    int *const home = xalloc((size_t)g->n, sizeof *home);
    c->begin = xalloc((size_t)cells + 1, sizeof *c->begin);
    for (int i = 0; i < g->n; i++) {
        if (g->id[i] < 0)
            continue;
        g->pos[i] = domain_wrap(&s->domain, g->pos[i]);
        home[i] = search_cell(c, &s->domain, g->pos[i]);
        c->begin[home[i] + 1]++;
    }
    for (int k = 0; k < cells; k++)
        c->begin[k + 1] += c->begin[k];
    int *const next = xalloc((size_t)cells, sizeof *next);
    memcpy(next, c->begin, (size_t)cells * sizeof *next);
    for (int i = 0; i < g->n; i++)
        if (g->id[i] >= 0)
            order[next[home[i]]++] = i;
    g->n = c->begin[cells];
    xfree(next);
    xfree(home);
#pragma omp parallel for schedule(dynamic)
    for (int f = 0; f < s->fields.n; f++) {
        const struct field *const field = &s->fields.field[f];
        if (field->place != PLACE_GRAIN)
            continue;
        const size_t size = kind_size(field->kind);
        char *const old = *field->data, *const sorted = xalloc((size_t)g->capacity, size);
        for (int i = 0; i < g->n; i++)
            memcpy(sorted + (size_t)i * size, old + (size_t)order[i] * size, size);
        *field->data = sorted;
        xfree(old);
    }
    return order;
}

/* Neighbouring search cells along an axis, each once; returns how many. */
static int around(const struct search *c, const struct domain *d, int i, int a, int out[3])
{
    int n = 0;
    for (int o = -1; o <= 1; o++) {
        int k = i + o;
        if (d->periodic[a])
            k = (k + c->n[a]) % c->n[a];
        bool seen = k < 0 || k >= c->n[a];
        for (int m = 0; m < n; m++)
            seen = seen || out[m] == k;
        if (!seen)
            out[n++] = k;
    }
    return n;
}

/* The slots that grain i owns, into `out` if it is not NULL; returns how many. */
static int pairs_of(const struct sim *s, const struct search *c, int i, int *out)
{
    const struct grains *const g = &s->grains;
    const double margin = s->neighbours.reach + s->neighbours.skin;
    const vec3 x = g->pos[i];
    const bool frozen = g->inv_mass[i] == 0.0;
    const double at[3] = {x.x, x.y, x.z};
    int near[3][3], n[3], found = 0;
    for (int a = 0; a < 3; a++)
        n[a] = around(c, &s->domain, search_index(c, &s->domain, at[a], a), a, near[a]);
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int h = 0; h < n[0]; h++) {
                const int home = near[0][h] + c->n[0] * (near[1][j] + c->n[1] * near[2][k]);
                for (int m = c->begin[home]; m < c->begin[home + 1]; m++) {
                    if (g->id[m] <= g->id[i] || (frozen && g->inv_mass[m] == 0.0))
                        continue;
                    const vec3 r = domain_minimum_image(&s->domain, v3_sub(x, g->pos[m]));
                    const double cut = g->radius[i] + g->radius[m] + margin;
                    if (v3_dot(r, r) >= cut * cut)
                        continue;
                    if (out)
                        out[found] = m;
                    found++;
                }
            }
    for (int w = 0; w < s->walls.n && !frozen; w++) {
        const struct wall *const wall = &s->walls.wall[w];
        if (v3_dot(v3_sub(x, wall->point), wall->normal) >= g->radius[i] + margin)
            continue;
        if (out)
            out[found] = -1 - w;
        found++;
    }
    return found;
}

/* The old list, kept while the new one is made. */
struct old_list {
    int n; /* grains that it knows; those that came since have larger indices */
    int *begin, *other;
    unsigned char *live;
    double *history;
};

/* Copies the history of the live contacts of grain i from the old list. */
static void carry_history(struct neighbours *nb, const struct old_list *old, const int *order,
                          int i)
{
    const int was = order[i];
    for (int t = nb->begin[i]; t < nb->begin[i + 1]; t++) {
        const int other = nb->other[t] < 0 ? nb->other[t] : order[nb->other[t]];
        nb->live[t] = 0;
        for (int o = was < old->n ? old->begin[was] : 0;
             was < old->n && o < old->begin[was + 1]; o++) {
            if (!old->live[o] || old->other[o] != other)
                continue;
            nb->live[t] = 1;
            memcpy(&nb->history[(size_t)t * nb->rows], &old->history[(size_t)o * nb->rows],
                   (size_t)nb->rows * sizeof(double));
            break;
        }
    }
}

static void list_incoming(struct neighbours *nb, int n)
{
    memset(nb->begin_in, 0, ((size_t)n + 1) * sizeof *nb->begin_in);
    for (size_t t = 0; t < nb->n_slots; t++)
        if (nb->other[t] >= 0)
            nb->begin_in[nb->other[t] + 1]++;
    for (int i = 0; i < n; i++)
        nb->begin_in[i + 1] += nb->begin_in[i];
    int *const next = xalloc((size_t)n, sizeof *next);
    memcpy(next, nb->begin_in, (size_t)n * sizeof *next);
    for (size_t t = 0; t < nb->n_slots; t++)
        if (nb->other[t] >= 0)
            nb->slots_in[next[nb->other[t]]++] = (int)t;
    xfree(next);
}

static void make_slots(struct sim *s, const struct search *c, const int *order)
{
    struct neighbours *const nb = &s->neighbours;
    const int n = s->grains.n;
    struct old_list old = {.other = nb->other, .live = nb->live, .history = nb->history};
    old.begin = nb->begin;
    old.n = nb->n_listed;
    nb->n_listed = n;
    nb->begin = xalloc((size_t)n + 1, sizeof *nb->begin);
#pragma omp parallel for schedule(dynamic, 256)
    for (int i = 0; i < n; i++)
        nb->begin[i + 1] = pairs_of(s, c, i, NULL);
    size_t total = 0;
    for (int i = 0; i < n; i++) {
        total += (size_t)nb->begin[i + 1];
        if (total > 2000000000u)
            die(EXIT_UNSTABLE,
                "more than 2e9 pairs of grains are near each other at t = %g s: "
                "the grains overlap all over",
                s->t);
        nb->begin[i + 1] = (int)total;
    }
    nb->n_slots = total;
    nb->other = xalloc(total, sizeof *nb->other);
    nb->live = xalloc(total, 1);
    nb->history = xalloc(total * (size_t)nb->rows, sizeof *nb->history);
    xfree(nb->owner);
    xfree(nb->slots_in);
    nb->owner = xalloc(total, sizeof *nb->owner);
    nb->slots_in = xalloc(total, sizeof *nb->slots_in);
#pragma omp parallel for schedule(dynamic, 256)
    for (int i = 0; i < n; i++) {
        pairs_of(s, c, i, &nb->other[nb->begin[i]]);
        for (int t = nb->begin[i]; t < nb->begin[i + 1]; t++)
            nb->owner[t] = i;
        carry_history(nb, &old, order, i);
    }
    xfree(old.begin);
    xfree(old.other);
    xfree(old.live);
    xfree(old.history);
}

void neighbours_moved(struct sim *s, double moved)
{
#pragma omp critical(neighbours_moved)
    if (!(moved <= s->neighbours.moved)) /* the largest; not a number stays */
        s->neighbours.moved = moved;
}

bool neighbours_stale(const struct sim *s)
{
    return !(s->neighbours.moved <= 0.5 * s->neighbours.skin);
}

void neighbours_rebuild(struct sim *s)
{
    struct neighbours *const nb = &s->neighbours;
    struct search c;
    nb->skin = choose_skin(s);
    search_open(&c, s);
    int *const order = sort_grains(s, &c);
    make_slots(s, &c, order);
    list_incoming(nb, s->grains.n);
    memcpy(nb->pos_built, s->grains.pos, (size_t)s->grains.n * sizeof *nb->pos_built);
    nb->moved = 0.0;
    nb->builds++;
    xfree(order);
    xfree(c.begin);
}
