/* search.c - grids per class of grains, pairs.
 *
 * Everything here follows from the state alone, and is the same on any number of threads: grains of
 * a cell are put in the order of their places, whoever put them there. */
#include "search.h"

#include "sim.h"

#define SLOW 0.1 /* skin over radius: to one class, to the next */
#define FAST 0.3

enum { FEW = 2, ONE_CELL = 32 }; /* grains: so many slow ones for a fast one; need no cells */

static int halvings(const struct search *c, float radius)
{
    int k = 0;
    for (double r = c->largest; (double)radius <= 0.5 * r && k < SEARCH_SIZES - 1; k++)
        r *= 0.5;
    return k;
}

static int kind_of(const struct search *c, float radius, float skin)
{
    const int size = halvings(c, radius);
    const double of = (double)skin / ldexp(c->largest, -size);
    return SEARCH_SPEEDS * size + (of > SLOW) + (of > FAST);
}

/* With what single precision leaves open. */
static float reach_of(const struct sim *s, int i, double skin, double gap)
{
    const vec3 x = s->grains.pos[i];
    const double *const size = s->domain.size;
    const double far = fabs(x.x) + fabs(x.y) + fabs(x.z) + size[0] + size[1] + size[2];
    return (float)((s->grains.radius[i] + skin + 0.5 * gap) * (1.0 + 1e-6) + 2e-7 * far);
}

static void open_classes(struct search *c, const struct sim *s, const float *skin, double gap)
{
    const struct grains *const g = &s->grains;
    double widest[SEARCH_CLASSES] = {0.0};
    int count[SEARCH_CLASSES] = {0};
    bool merged[SEARCH_CLASSES] = {false};
    for (int i = 0; i < g->n; i++)
        c->largest = fmax(c->largest, (double)(float)g->radius[i]);
    for (int i = 0; i < g->n; i++) {
        const int k = kind_of(c, (float)g->radius[i], skin[i]);
        count[k]++;
        widest[k] = fmax(widest[k], (double)reach_of(s, i, (double)skin[i], gap));
    }
    for (int k = 0; k < SEARCH_CLASSES; k++) {
        /* a class of its own for those that are fast pays where they are few */
        if (k % SEARCH_SPEEDS < SEARCH_SPEEDS - 1 && count[k] < FEW * count[k + 1]) {
            count[k + 1] += count[k];
            widest[k + 1] = fmax(widest[k + 1], widest[k]);
            count[k] = 0;
            merged[k] = true;
        }
        if (count[k] == 0)
            continue;
        for (int m = k; m >= 0 && (m == k || merged[m]); m--)
            c->class_of[m] = c->classes;
        c->class[c->classes++] = (struct search_class){
            .size = k / SEARCH_SPEEDS, .widest = widest[k], .n_grains = count[k]};
    }
}

/* Cells no narrower than the widest pair, and not more of them than twice the grains. */
static void open_cells(struct search *c, const struct sim *s)
{
    const double *const size = s->domain.size;
    for (int k = 0; k < c->classes; k++) {
        struct search_class *const l = &c->class[k];
        const double room = size[0] * size[1] * size[2] / (2.0 * l->n_grains);
        const double edge =
            l->n_grains <= ONE_CELL ? (double)INFINITY : fmax(2.0 * l->widest, cbrt(room));
        for (int a = 0; a < 3; a++) {
            l->n[a] = (int)fmin(fmax(1.0, floor(size[a] / edge)), 1000.0);
            l->per_metre[a] = l->n[a] / size[a];
        }
        l->first = c->cells;
        c->cells += l->n[0] * l->n[1] * l->n[2];
    }
}

/* The cell of a place along an axis; what lies outside is in the last one. */
static int step_to(const struct search_class *l, double x, int a)
{
    const double at = x * l->per_metre[a];
    return at < l->n[a] ? at > 0.0 ? (int)at : 0 : l->n[a] - 1;
}

static int home_of(const struct search *c, const struct sim *s, const float *skin, int i)
{
    const vec3 x = s->grains.pos[i];
    const struct search_class *const l =
        &c->class[c->class_of[kind_of(c, (float)s->grains.radius[i], skin[i])]];
    return l->first + step_to(l, x.x, 0) +
           l->n[0] * (step_to(l, x.y, 1) + l->n[1] * step_to(l, x.z, 2));
}

static void fill_cells(struct search *c, const struct sim *s, const float *skin)
{
    const int n = s->grains.n;
    int *const home = xalloc((size_t)n + 1, sizeof *home);
    int *const next = xalloc((size_t)c->cells + 1, sizeof *next);
    c->begin = xalloc((size_t)c->cells + 1, sizeof *c->begin);
    c->grain = xalloc((size_t)n + SEARCH_LANES, sizeof *c->grain);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; i++) {
        home[i] = home_of(c, s, skin, i);
#pragma omp atomic
        c->begin[home[i] + 1]++;
    }
    for (int k = 0; k < c->cells; k++) {
        next[k] = c->begin[k];
        c->begin[k + 1] += c->begin[k];
    }
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; i++) {
        int place;
#pragma omp atomic capture
        place = next[home[i]]++;
        c->grain[place] = i;
    }
#pragma omp parallel for schedule(static)
    for (int k = 0; k < c->cells; k++)
        sort_few(c->grain + c->begin[k], c->begin[k + 1] - c->begin[k]);
    xfree(next);
    xfree(home);
}

/* What a search reads of the grains, side by side. */
static void fill_lanes(struct search *c, const struct sim *s, const float *skin, double gap)
{
    const struct grains *const g = &s->grains;
    float **const all[] = {&c->x, &c->y, &c->z, &c->reach, &c->radius};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        *all[k] = xalloc((size_t)g->n + SEARCH_LANES, sizeof **all[k]);
    c->id = xalloc((size_t)g->n + SEARCH_LANES, sizeof *c->id);
#pragma omp parallel for schedule(static)
    for (int m = 0; m < g->n; m++) {
        const int i = c->grain[m];
        c->x[m] = (float)g->pos[i].x;
        c->y[m] = (float)g->pos[i].y;
        c->z[m] = (float)g->pos[i].z;
        c->reach[m] = reach_of(s, i, (double)skin[i], gap);
        c->radius[m] = (float)g->radius[i];
        c->id[m] = g->id[i];
    }
}

void search_open(struct search *c, const struct sim *s, const float *skin, double gap)
{
    *c = (struct search){.skin = skin, .gap = gap};
    open_classes(c, s, skin, gap);
    open_cells(c, s);
    fill_cells(c, s, skin);
    fill_lanes(c, s, skin, gap);
}

void search_free(struct search *c)
{
    void *const all[] = {c->begin, c->x, c->y, c->z, c->reach, c->radius, c->id, c->grain};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        xfree(all[k]);
}

static int step_down(double x)
{
    const double at = floor(x);
    return at < 1e6 ? at > -1e6 ? (int)at : -1000000 : 1000000;
}

/* Cells in a row along an axis: from lo[k] to hi[k], in one piece or two. */
struct spans {
    int n, lo[2], hi[2];
};

static struct spans spans_around(const struct search_class *l, const struct domain *d, double x,
                                 double reach, int a)
{
    const int n = l->n[a];
    if (n == 1)
        return (struct spans){1, {0}, {0}};
    const int lo = step_down((x - reach) * l->per_metre[a]);
    const int hi = step_down((x + reach) * l->per_metre[a]);
    if (!d->periodic[a])
        return (struct spans){1,
                              {lo < 0   ? 0
                               : lo < n ? lo
                                        : n - 1},
                              {hi < 0   ? 0
                               : hi < n ? hi
                                        : n - 1}};
    if (hi - lo + 1 >= n)
        return (struct spans){1, {0}, {n - 1}};
    if (lo < 0)
        return (struct spans){2, {lo + n, 0}, {n - 1, hi}};
    if (hi >= n)
        return (struct spans){2, {lo, 0}, {n - 1, hi - n}};
    return (struct spans){1, {lo}, {hi}};
}

/* Who looks. */
struct seeker {
    float x, y, z, reach, radius; /* m */
    float image[3], inv_image[3]; /* of the nearest image */
    int id;
};

static struct seeker seeker_of(const struct search *c, const struct sim *s, int i)
{
    const struct grains *const g = &s->grains;
    struct seeker k = {.x = (float)g->pos[i].x,
                       .y = (float)g->pos[i].y,
                       .z = (float)g->pos[i].z,
                       .reach = reach_of(s, i, (double)c->skin[i], c->gap),
                       .radius = (float)g->radius[i],
                       .id = g->id[i]};
    for (int a = 0; a < 3; a++) {
        k.image[a] = (float)s->domain.image[a];
        k.inv_image[a] = (float)s->domain.inv_image[a];
    }
    return k;
}

/* Those of the grains from..to-1 of the grids that the seeker owns a pair with. */
static int scan(const struct search *c, const struct seeker *k, int from, int to, int *out,
                int n)
{
    const float x = k->x, y = k->y, z = k->z, reach = k->reach, radius = k->radius;
    const float lx = k->image[0], ly = k->image[1], lz = k->image[2];
    const float ix = k->inv_image[0], iy = k->inv_image[1], iz = k->inv_image[2];
    const int id = k->id;
    for (int m = from; m < to; m += SEARCH_LANES) {
        const float *const mx = c->x + m, *const my = c->y + m, *const mz = c->z + m;
        const float *const mreach = c->reach + m, *const mradius = c->radius + m;
        const int *const mid = c->id + m;
        int near[SEARCH_LANES];
#pragma omp simd
        for (int q = 0; q < SEARCH_LANES; q++) { /* beyond `to` too: a whole vector */
            float dx = x - mx[q], dy = y - my[q], dz = z - mz[q];
            dx -= lx * rintf(dx * ix);
            dy -= ly * rintf(dy * iy);
            dz -= lz * rintf(dz * iz);
            const float cut = reach + mreach[q];
            near[q] = (dx * dx + dy * dy + dz * dz < cut * cut) &
                      ((mradius[q] > radius) | ((mradius[q] == radius) & (mid[q] > id)));
        }
        const int count = to - m < SEARCH_LANES ? to - m : SEARCH_LANES;
        for (int q = 0; q < count; q++) {
            out[n] = c->grain[m + q];
            n += near[q];
        }
    }
    return n;
}

/* Of the neighbours of a frozen grain those that move. */
static int keep_moving(const struct grains *g, int *out, int from, int to)
{
    int n = from;
    for (int k = from; k < to; k++)
        if (g->inv_mass[out[k]] != 0.0)
            out[n++] = out[k];
    return n;
}

int search_pairs(const struct search *c, const struct sim *s, int i, int **out, int *room,
                 int n)
{
    const struct seeker k = seeker_of(c, s, i);
    const vec3 x = s->grains.pos[i];
    const double at[3] = {x.x, x.y, x.z};
    const int own = halvings(c, k.radius), before = n;
    for (int level = 0; level < c->classes && c->class[level].size <= own; level++) {
        const struct search_class *const l = &c->class[level];
        struct spans span[3];
        for (int a = 0; a < 3; a++)
            span[a] = spans_around(l, &s->domain, at[a], (double)k.reach + l->widest, a);
        for (int p = 0; p < span[2].n; p++)
            for (int kz = span[2].lo[p]; kz <= span[2].hi[p]; kz++)
                for (int q = 0; q < span[1].n; q++)
                    for (int ky = span[1].lo[q]; ky <= span[1].hi[q]; ky++)
                        for (int r = 0; r < span[0].n; r++) {
                            const int row = l->first + l->n[0] * (ky + l->n[1] * kz);
                            const int from = c->begin[row + span[0].lo[r]];
                            const int to = c->begin[row + span[0].hi[r] + 1];
                            if (from == to)
                                continue;
                            if (n + to - from + 1 > *room) {
                                const int more = 2 * (n + to - from) + 1024;
                                *out =
                                    xrealloc(*out, (size_t)*room, (size_t)more, sizeof **out);
                                *room = more;
                            }
                            n = scan(c, &k, from, to, *out, n);
                        }
    }
    return s->grains.inv_mass[i] == 0.0 ? keep_moving(&s->grains, *out, before, n) : n;
}
